#include "scene/detail/keys_internal.h"

namespace ambf::scene::table {

namespace {

constexpr Key kVersionKey{
    .name = "adf version",
    .type = KeyType::text,
    .fallback = "1.0",
    .meaning =
        "Version of the format. Only 1.0 exists; a file that names another one is refused. Upper case is accepted."};
constexpr Key kNamespaceKey{.name = "namespace",
                            .type = KeyType::text,
                            .fallback = "none",
                            .meaning = "Put before the namespace of every block, as text: end it with '/'."};
constexpr Key kShadersKey{.name = "shaders",
                          .type = KeyType::map,
                          .meaning = "Shader pair for all bodies that name none.",
                          .sub = Group::shaders};
constexpr Key kPluginsKey{.name = "plugins",
                          .type = KeyType::maps,
                          .meaning = "Libraries to load with it.",
                          .sub = Group::plugin,
                          .status = KeyStatus::later};

constexpr Key kModelKeys[] = {
    kVersionKey,
    kNamespaceKey,
    {.name = "bodies", .type = KeyType::texts, .meaning = "Body blocks to load, in this order."},
    {.name = "joints", .type = KeyType::texts, .meaning = "Joint blocks to load, in this order."},
    {.name = "cameras", .type = KeyType::texts, .meaning = "Camera blocks to load."},
    {.name = "lights", .type = KeyType::texts, .meaning = "Light blocks to load."},
    {.name = "soft bodies", .type = KeyType::texts, .meaning = "Soft body blocks."},
    {.name = "ghost objects", .type = KeyType::texts, .meaning = "Ghost object blocks."},
    {.name = "vehicles", .type = KeyType::texts, .meaning = "Vehicle blocks."},
    {.name = "volumes", .type = KeyType::texts, .meaning = "Volume blocks."},
    {.name = "sensors", .type = KeyType::texts, .meaning = "Sensor blocks."},
    {.name = "actuators", .type = KeyType::texts, .meaning = "Actuator blocks."},
    {.name = "high resolution path",
     .type = KeyType::folder,
     .fallback = "the file's folder",
     .meaning = "Folder of the visual meshes."},
    {.name = "low resolution path",
     .type = KeyType::folder,
     .fallback = "high resolution path",
     .meaning = "Folder of the collision meshes."},
    {.name = "ignore inter-collision",
     .type = KeyType::boolean,
     .fallback = "false",
     .meaning = "No collisions among the bodies of this file."},
    {.name = "gravity",
     .type = KeyType::vector,
     .unit = "m/s^2",
     .fallback = "the world's",
     .meaning = "For all bodies of this file that name none."},
    {.name = "joint erp",
     .type = KeyType::number,
     .fallback = "0.8",
     .meaning = "Part of a joint's error that is corrected in each step.",
     .rule = Rule::not_negative},
    {.name = "joint cfm",
     .type = KeyType::number,
     .fallback = "0",
     .meaning = "Softness of the joints.",
     .rule = Rule::not_negative},
    kShadersKey,
    kPluginsKey,
    {.name = "name", .type = KeyType::text, .meaning = "A model is named by its file.", .status = KeyStatus::ignored},
};

constexpr Key kWorldKeys[] = {
    kVersionKey,
    {.name = "namespace",
     .type = KeyType::text,
     .fallback = "none",
     .meaning =
         "For the World topic, and put before the namespaces of the world's lights and cameras. Models do not get it."},
    {.name = "environment",
     .type = KeyType::file,
     .fallback = "a walled ground",
     .meaning = "A model file that is loaded first and replaces the walled ground."},
    {.name = "enclosure",
     .type = KeyType::map,
     .unit = "m",
     .fallback = "4 x 4 x 3",
     .meaning = "Size of the walled ground; used without environment only.",
     .sub = Group::enclosure},
    {.name = "enclosure size",
     .type = KeyType::map,
     .unit = "m",
     .meaning = "The same; shipped worlds write it so.",
     .sub = Group::enclosure},
    {.name = "max iterations",
     .type = KeyType::integer,
     .fallback = "10",
     .meaning = "Most steps in one turn of the physics loop; time beyond that is given up, and counted.",
     .rule = Rule::positive},
    {.name = "gravity",
     .type = KeyType::vector,
     .unit = "m/s^2",
     .fallback = "0, 0, -9.8",
     .meaning = "Of everything that names none."},
    {.name = "lights", .type = KeyType::texts, .fallback = "one default light", .meaning = "Light blocks to load."},
    {.name = "cameras", .type = KeyType::texts, .fallback = "one default camera", .meaning = "Camera blocks to load."},
    kShadersKey,
    {.name = "skybox", .type = KeyType::map, .meaning = "Six images around the scene.", .sub = Group::skybox},
    {.name = "solver",
     .type = KeyType::choice,
     .fallback = "direct",
     .meaning = "direct: joints solved together and exactly; si: Bullet's sequential impulse; mlcp: Bullet's MLCP. Not "
                "known to the original.",
     .choices = "direct|si|mlcp",
     .instead = "direct is used"},
    {.name = "solver iterations",
     .type = KeyType::integer,
     .fallback = "the solver's own",
     .meaning = "Iterations for contacts (all rows with si). Not known to the original.",
     .rule = Rule::positive},
    kPluginsKey,
    {.name = "name",
     .type = KeyType::text,
     .meaning = "The world is always named World.",
     .status = KeyStatus::ignored},
    {.name = "conversion factor",
     .type = KeyType::text,
     .meaning = "The original never read it.",
     .status = KeyStatus::unread},
};

constexpr Key kLaunchKeys[] = {
    kVersionKey,
    {.name = "world config", .type = KeyType::file, .fallback = "a default world", .meaning = "World file."},
    {.name = "color config",
     .type = KeyType::file,
     .fallback = "no names",
     .meaning = "Colour file: names for `color`."},
    {.name = "input devices config", .type = KeyType::file, .fallback = "none", .meaning = "Input devices file."},
    {.name = "multibody configs",
     .type = KeyType::texts,
     .fallback = "none",
     .meaning = "Model files; `-l 0,3` loads by place in this list."},
    {.name = "world configs",
     .type = KeyType::texts,
     .fallback = "`world config` for all",
     .meaning = "A world file for each of `multibody configs`: the first entry of -l takes its own instead of `world "
                "config`. Not "
                "known to the original."},
    kPluginsKey,
};

constexpr Key kInputDevicesKeys[] = {
    kVersionKey,
    {.name = "input devices", .type = KeyType::texts, .meaning = "Input device blocks."},
};

constexpr Key kEnclosureKeys[] = {
    {.name = "length",
     .type = KeyType::number,
     .unit = "m",
     .fallback = "4",
     .meaning = "Along x.",
     .rule = Rule::positive},
    {.name = "width",
     .type = KeyType::number,
     .unit = "m",
     .fallback = "4",
     .meaning = "Along y.",
     .rule = Rule::positive},
    {.name = "height",
     .type = KeyType::number,
     .unit = "m",
     .fallback = "3",
     .meaning = "Along z.",
     .rule = Rule::positive},
};

constexpr Key kSkyboxKeys[] = {
    {.name = "path", .type = KeyType::folder, .meaning = "Folder of the images.", .required = true},
    {.name = "right", .type = KeyType::file, .meaning = "Along +y.", .required = true},
    {.name = "left", .type = KeyType::file, .meaning = "Along -y.", .required = true},
    {.name = "top", .type = KeyType::file, .meaning = "Along +z, its lower edge above the front.", .required = true},
    {.name = "bottom", .type = KeyType::file, .meaning = "Along -z, its upper edge below the front.", .required = true},
    {.name = "front", .type = KeyType::file, .meaning = "Along -x.", .required = true},
    {.name = "back", .type = KeyType::file, .meaning = "Along +x.", .required = true},
    {.name = "shaders", .type = KeyType::map, .meaning = "Shader pair for the sky.", .sub = Group::shaders},
};

constexpr Key kPluginKeys[] = {
    {.name = "name", .type = KeyType::text, .required = true},
    {.name = "filename", .type = KeyType::text, .meaning = "Library, e.g. libexample.so.", .required = true},
    {.name = "path", .type = KeyType::folder, .meaning = "Folder of the library, from this file's folder."},
};

constexpr Key kShadersKeys[] = {
    {.name = "path",
     .type = KeyType::folder,
     .meaning = "Folder of the shaders, from this file's folder.",
     .required = true},
    {.name = "vertex", .type = KeyType::file, .required = true},
    {.name = "fragment", .type = KeyType::file, .required = true},
};

}  // namespace

const GroupInfo kModel{
    .group = Group::model,
    .title = "model file",
    .meaning =
        "The top level of a model file: lists name the blocks that are loaded; a block that no list names is not.",
    .keys = kModelKeys,
    .is_header = true};
const GroupInfo kWorld{.group = Group::world,
                       .title = "world file",
                       .meaning = "The top level of a world file.",
                       .keys = kWorldKeys,
                       .is_header = true};
const GroupInfo kLaunch{.group = Group::launch,
                        .title = "launch file",
                        .meaning = "The top level of a launch file. Paths start at its folder.",
                        .keys = kLaunchKeys,
                        .is_header = true};
const GroupInfo kInputDevices{.group = Group::input_devices,
                              .title = "input devices file",
                              .meaning = "The top level of an input devices file. Devices are not simulated yet.",
                              .keys = kInputDevicesKeys,
                              .is_header = true};
const GroupInfo kEnclosure{.group = Group::enclosure, .title = "enclosure", .meaning = {}, .keys = kEnclosureKeys};
const GroupInfo kSkybox{
    .group = Group::skybox, .title = "skybox", .meaning = "All six images are needed.", .keys = kSkyboxKeys};
const GroupInfo kPlugin{.group = Group::plugin,
                        .title = "plugins",
                        .meaning = "Each plugin may have further keys of its own.",
                        .keys = kPluginKeys,
                        .open = true};
const GroupInfo kShaders{.group = Group::shaders, .title = "shaders", .meaning = {}, .keys = kShadersKeys};

}  // namespace ambf::scene::table
