// The header of a world file.
#include "scene/description.h"
#include "scene/detail/groups.h"

namespace ambf::scene::group {

namespace {

constexpr Word kSolvers[] = {{"direct"}, {"si"}, {"mlcp"}};

constexpr Key kWorldKeys[] = {
    {.name = "adf version",
     .type = KeyType::text,
     .fallback = "1.0",
     .meaning =
         "Version of the format. Only 1.0 exists; a file that names another one is refused. Upper case is accepted."},
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
     .member = to<&World::enclosure>(),
     .unit = "m",
     .fallback = "4 x 4 x 3",
     .meaning = "Size of the walled ground; used without environment only.",
     .sub = &kEnclosure},
    {.name = "enclosure size",
     .type = KeyType::map,
     .member = to<&World::enclosure>(),
     .unit = "m",
     .meaning = "Shipped worlds write it so.",
     .sub = &kEnclosure,
     .preferred = "enclosure"},
    {.name = "max iterations",
     .type = KeyType::integer,
     .member = to<&World::max_iterations>(),
     .fallback = "22 at 1 ms, fewer where the machine is slow",
     .meaning = "Max steps in one iteration of the physics loop; time beyond that is given up, and counted.",
     .rule = Rule::positive},
    {.name = "gravity",
     .type = KeyType::vector,
     .member = to<&World::gravity>(),
     .unit = "m/s^2",
     .meaning = "Of everything that names none."},
    {.name = "lights", .type = KeyType::texts, .fallback = "one default light", .meaning = "Light blocks to load."},
    {.name = "cameras", .type = KeyType::texts, .fallback = "one default camera", .meaning = "Camera blocks to load."},
    {.name = "shaders",
     .type = KeyType::map,
     .meaning = "Shader pair for all bodies that name none.",
     .sub = &kShaders},
    {.name = "skybox", .type = KeyType::map, .meaning = "Six images around the scene.", .sub = &kSkybox},
    {.name = "solver",
     .type = KeyType::choice,
     .member = to<&World::solver>(),
     .fallback = "direct",
     .meaning = "direct: joints solved together and exactly; si: Bullet's sequential impulse; mlcp: Bullet's MLCP. Not "
                "known to the original.",
     .words = kSolvers,
     .instead = "direct"},
    {.name = "solver iterations",
     .type = KeyType::integer,
     .member = to<&World::solver_iterations>(),
     .fallback = "the solver's own",
     .meaning = "Iterations for contacts (all rows with si). Not known to the original.",
     .rule = Rule::positive},
    {.name = "plugins",
     .type = KeyType::maps,
     .meaning = "Libraries to load with it.",
     .sub = &kPlugin,
     .status = KeyStatus::later},
    {.name = "name",
     .type = KeyType::text,
     .meaning = "The world is always named World.",
     .status = KeyStatus::ignored},
    {.name = "conversion factor",
     .type = KeyType::text,
     .meaning = "The original never read it.",
     .status = KeyStatus::unread},
};

constexpr Key kEnclosureKeys[] = {
    {.name = "length",
     .type = KeyType::number,
     .member = to<&math::Vec3::x>(),
     .unit = "m",
     .meaning = "Along x.",
     .rule = Rule::positive},
    {.name = "width",
     .type = KeyType::number,
     .member = to<&math::Vec3::y>(),
     .unit = "m",
     .meaning = "Along y.",
     .rule = Rule::positive},
    {.name = "height",
     .type = KeyType::number,
     .member = to<&math::Vec3::z>(),
     .unit = "m",
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
    {.name = "shaders", .type = KeyType::map, .meaning = "Shader pair for the sky.", .sub = &kShaders},
};

}  // namespace

const Group kWorld{
    .title = "world file", .meaning = "The top level of a world file.", .keys = kWorldKeys, .is_header = true};
const Group kEnclosure{.title = "enclosure", .keys = kEnclosureKeys};
const Group kSkybox{.title = "skybox", .meaning = "All six images are needed.", .keys = kSkyboxKeys};

}  // namespace ambf::scene::group
