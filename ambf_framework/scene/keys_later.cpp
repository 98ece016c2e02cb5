// Kinds of block that are recognised and checked, but not simulated yet.
#include "scene/detail/keys_internal.h"

namespace ambf::scene::table {

namespace {

constexpr Key kParentKey{
    .name = "parent", .type = KeyType::text, .meaning = "Object that it sits on; may be in another file."};
constexpr Key kLocationKey{.name = "location", .type = KeyType::map, .meaning = {}, .sub = Group::pose};

constexpr Key kSoftBodyKeys[] = {
    {.name = "mass", .type = KeyType::number, .unit = "kg", .fallback = "1", .meaning = {}, .rule = Rule::not_negative},
    kLocationKey,
    {.name = "inertial offset", .type = KeyType::map, .meaning = {}, .sub = Group::pose},
    {.name = "config", .type = KeyType::map, .meaning = "Bullet's soft body settings.", .sub = Group::soft_config},
    {.name = "randomize constraints", .type = KeyType::boolean, .fallback = "false", .meaning = {}},
    {.name = "linear gain",
     .type = KeyType::number_or_map,
     .meaning = {},
     .sub = Group::gains,
     .status = KeyStatus::ignored},
    {.name = "angular gain",
     .type = KeyType::number_or_map,
     .meaning = {},
     .sub = Group::gains,
     .status = KeyStatus::ignored},
};

constexpr Key kSoftConfigKeys[] = {
    {.name = "kLST", .type = KeyType::number, .fallback = "1", .meaning = "linear stiffness"},
    {.name = "kAST", .type = KeyType::number, .fallback = "1", .meaning = "angular stiffness"},
    {.name = "kVST", .type = KeyType::number, .fallback = "1", .meaning = "volume stiffness"},
    {.name = "kVCF", .type = KeyType::number, .fallback = "1", .meaning = "velocity correction"},
    {.name = "kDP", .type = KeyType::number, .fallback = "0", .meaning = "damping"},
    {.name = "kDG", .type = KeyType::number, .fallback = "0", .meaning = "drag"},
    {.name = "kLF", .type = KeyType::number, .fallback = "0", .meaning = "lift"},
    {.name = "kPR", .type = KeyType::number, .fallback = "0", .meaning = "pressure"},
    {.name = "kVC", .type = KeyType::number, .fallback = "0", .meaning = "volume conservation"},
    {.name = "kDF", .type = KeyType::number, .fallback = "0.2", .meaning = "dynamic friction"},
    {.name = "kMT", .type = KeyType::number, .fallback = "0", .meaning = "pose matching"},
    {.name = "kCHR", .type = KeyType::number, .fallback = "1", .meaning = "rigid contact hardness"},
    {.name = "kKHR", .type = KeyType::number, .fallback = "0.1", .meaning = "kinetic contact hardness"},
    {.name = "kSHR", .type = KeyType::number, .fallback = "1", .meaning = "soft contact hardness"},
    {.name = "kAHR", .type = KeyType::number, .fallback = "0.7", .meaning = "anchor hardness"},
    {.name = "kSRHR_CL", .type = KeyType::number, .fallback = "0.1", .meaning = "cluster against rigid"},
    {.name = "kSKHR_CL", .type = KeyType::number, .fallback = "1", .meaning = "cluster against kinetic"},
    {.name = "kSSHR_CL", .type = KeyType::number, .fallback = "0.5", .meaning = "cluster against soft"},
    {.name = "kSR_SPLT_CL", .type = KeyType::number, .fallback = "0.5"},
    {.name = "kSK_SPLT_CL", .type = KeyType::number, .fallback = "0.5"},
    {.name = "kSS_SPLT_CL", .type = KeyType::number, .fallback = "0.5"},
    {.name = "maxvolume", .type = KeyType::number, .fallback = "1"},
    {.name = "timescale", .type = KeyType::number, .fallback = "1"},
    {.name = "viterations", .type = KeyType::integer, .fallback = "0"},
    {.name = "piterations", .type = KeyType::integer, .fallback = "1"},
    {.name = "diterations", .type = KeyType::integer, .fallback = "0"},
    {.name = "citerations", .type = KeyType::integer, .fallback = "4"},
    {.name = "flags", .type = KeyType::integer, .fallback = "1", .meaning = "collision flags of Bullet, as bits"},
    {.name = "bending constraint", .type = KeyType::integer, .fallback = "off", .meaning = "distance in links"},
    {.name = "clusters", .type = KeyType::integer, .fallback = "off"},
    {.name = "fixed nodes",
     .type = KeyType::integers,
     .fallback = "none",
     .meaning = "vertices as the mesh file counts them"},
    {.name = "cutting", .type = KeyType::text, .status = KeyStatus::ignored},
    {.name = "margin", .type = KeyType::number, .status = KeyStatus::ignored},
};

constexpr Key kGhostKeys[] = {kParentKey, kLocationKey};

constexpr Key kVehicleKeys[] = {
    {.name = "chassis", .type = KeyType::text, .meaning = "Body block."},
    {.name = "wheels", .type = KeyType::maps, .meaning = {}, .sub = Group::wheel},
    {.name = "high resolution path", .type = KeyType::folder, .meaning = {}},
};

constexpr Key kWheelKeys[] = {
    {.name = "body", .type = KeyType::text, .meaning = "Body block that becomes the wheel; or `mesh`."},
    {.name = "mesh", .type = KeyType::file},
    {.name = "width", .type = KeyType::number, .unit = "m"},
    {.name = "radius", .type = KeyType::number, .unit = "m"},
    {.name = "friction", .type = KeyType::number},
    {.name = "suspension", .type = KeyType::map, .meaning = {}, .sub = Group::suspension},
    {.name = "roll influence", .type = KeyType::number},
    {.name = "down direction", .type = KeyType::vector},
    {.name = "axel direction", .type = KeyType::vector},
    {.name = "offset", .type = KeyType::vector, .unit = "m"},
    {.name = "front", .type = KeyType::boolean, .fallback = "false"},
    {.name = "steering limits", .type = KeyType::map, .meaning = {}, .sub = Group::steering_limits},
    {.name = "max engine power", .type = KeyType::number},
    {.name = "max brake power", .type = KeyType::number},
};
constexpr Key kSuspensionKeys[] = {
    {.name = "stiffness", .type = KeyType::number},
    {.name = "damping", .type = KeyType::number},
    {.name = "compression", .type = KeyType::number},
    {.name = "rest length", .type = KeyType::number, .unit = "m"},
};
constexpr Key kSteeringLimitsKeys[] = {
    {.name = "low", .type = KeyType::number, .unit = "rad"},
    {.name = "high", .type = KeyType::number, .unit = "rad"},
};

constexpr Key kVolumeKeys[] = {
    kParentKey,
    kLocationKey,
    {.name = "scale", .type = KeyType::number, .fallback = "1"},
    {.name = "images", .type = KeyType::map, .meaning = {}, .sub = Group::images},
    {.name = "dimensions", .type = KeyType::vector, .unit = "m", .fallback = "1"},
    {.name = "iso-surface value", .type = KeyType::number, .fallback = "0.5"},
    {.name = "optical density", .type = KeyType::number, .fallback = "1"},
    {.name = "quality", .type = KeyType::number, .fallback = "0.5"},
    {.name = "shaders", .type = KeyType::map, .meaning = {}, .sub = Group::shaders},
};
constexpr Key kImagesKeys[] = {
    {.name = "path", .type = KeyType::folder},
    {.name = "prefix", .type = KeyType::text},
    {.name = "format", .type = KeyType::text},
    {.name = "count", .type = KeyType::integer},
};

constexpr Key kSensorKeys[] = {
    {.name = "type",
     .type = KeyType::choice,
     .fallback = "Proximity",
     .meaning = "Missing in the older syntax of a single ray.",
     .choices = "Proximity|proximity|PROXIMITY|Resistance|resistance|RESISTANCE"},
    kParentKey,
    {.name = "location",
     .type = KeyType::vector_or_map,
     .meaning = "A pose; a bare vector in the older syntax of a single ray.",
     .sub = Group::pose},
    {.name = "direction", .type = KeyType::vector, .meaning = "Older syntax of a single ray."},
    {.name = "range", .type = KeyType::number, .unit = "m", .fallback = "0.5"},
    {.name = "array", .type = KeyType::maps, .meaning = "Rays, one by one.", .sub = Group::ray},
    {.name = "mesh", .type = KeyType::file, .meaning = "One ray a triangle."},
    {.name = "parametric", .type = KeyType::map, .meaning = "A fan of rays.", .sub = Group::parametric},
    {.name = "visible", .type = KeyType::boolean, .fallback = "false"},
    {.name = "visible size", .type = KeyType::number, .unit = "m", .fallback = "0.02"},
    {.name = "friction", .type = KeyType::map, .meaning = "Resistance.", .sub = Group::sensor_friction},
    {.name = "contact area", .type = KeyType::number, .unit = "m", .fallback = "0.1"},
    {.name = "contact stiffness", .type = KeyType::number, .fallback = "0"},
    {.name = "contact damping", .type = KeyType::number, .fallback = "0"},
    {.name = "depth", .type = KeyType::number, .unit = "m", .fallback = "0"},
};
constexpr Key kRayKeys[] = {
    {.name = "offset", .type = KeyType::vector, .unit = "m", .required = true},
    {.name = "direction", .type = KeyType::vector, .required = true},
};
constexpr Key kParametricKeys[] = {
    {.name = "resolution", .type = KeyType::integer},
    {.name = "horizontal angle", .type = KeyType::number, .unit = "rad"},
    {.name = "vertical angle", .type = KeyType::number, .unit = "rad"},
    {.name = "start offset", .type = KeyType::number, .unit = "m"},
};
constexpr Key kSensorFrictionKeys[] = {
    {.name = "static", .type = KeyType::number, .fallback = "0"},
    {.name = "damping", .type = KeyType::number, .fallback = "0.1"},
    {.name = "dynamic", .type = KeyType::number, .fallback = "0"},
    {.name = "variable", .type = KeyType::boolean, .fallback = "false", .meaning = "Scaled by the normal force."},
};

constexpr Key kActuatorKeys[] = {
    {.name = "type",
     .type = KeyType::choice,
     .meaning = {},
     .required = true,
     .choices = "Constraint|constraint|CONSTRAINT"},
    kParentKey,
    kLocationKey,
    {.name = "visible", .type = KeyType::boolean, .fallback = "false"},
    {.name = "visible size", .type = KeyType::number, .unit = "m", .fallback = "0.02"},
    {.name = "max impulse", .type = KeyType::number, .fallback = "10"},
    {.name = "tau", .type = KeyType::number, .fallback = "1"},
};

constexpr Key kResistiveSurfaceKeys[] = {
    {.name = "mesh", .type = KeyType::file, .fallback = "the visual mesh", .meaning = "In the high resolution path."},
    {.name = "range", .type = KeyType::number, .unit = "m", .fallback = "0.1"},
    {.name = "depth", .type = KeyType::number, .unit = "m", .fallback = "0"},
    {.name = "face resolution", .type = KeyType::integer, .status = KeyStatus::ignored},
    {.name = "edge resolution", .type = KeyType::integer, .status = KeyStatus::ignored},
    {.name = "contact area", .type = KeyType::number, .unit = "m", .fallback = "0.001"},
    {.name = "friction", .type = KeyType::map, .meaning = {}, .sub = Group::sensor_friction},
    {.name = "contact stiffness", .type = KeyType::number, .fallback = "0"},
    {.name = "contact damping", .type = KeyType::number, .fallback = "0"},
    {.name = "visible", .type = KeyType::boolean, .fallback = "false"},
    {.name = "visible size", .type = KeyType::number, .unit = "m"},
};

constexpr Group kIdentityOnly[] = {Group::identity};
constexpr Group kLooks[] = {Group::identity, Group::visual_keys, Group::collision_keys, Group::color_keys};
constexpr Group kColored[] = {Group::identity, Group::color_keys};

}  // namespace

const GroupInfo kSoftBody{.group = Group::soft_body,
                          .title = "soft body",
                          .meaning = "Not simulated yet.",
                          .keys = kSoftBodyKeys,
                          .includes = kLooks,
                          .is_block = true};
const GroupInfo kGhostObject{.group = Group::ghost_object,
                             .title = "ghost object",
                             .meaning = "Not simulated yet.",
                             .keys = kGhostKeys,
                             .includes = kLooks,
                             .is_block = true};
const GroupInfo kVehicle{.group = Group::vehicle,
                         .title = "vehicle",
                         .meaning = "Not simulated yet.",
                         .keys = kVehicleKeys,
                         .includes = kIdentityOnly,
                         .is_block = true};
const GroupInfo kVolume{.group = Group::volume,
                        .title = "volume",
                        .meaning = "Not simulated yet.",
                        .keys = kVolumeKeys,
                        .includes = kColored,
                        .is_block = true};
const GroupInfo kSensor{.group = Group::sensor,
                        .title = "sensor",
                        .meaning = "Not simulated yet.",
                        .keys = kSensorKeys,
                        .includes = kIdentityOnly,
                        .is_block = true};
const GroupInfo kActuator{.group = Group::actuator,
                          .title = "actuator",
                          .meaning = "Not simulated yet.",
                          .keys = kActuatorKeys,
                          .includes = kIdentityOnly,
                          .is_block = true};
const GroupInfo kResistiveSurface{.group = Group::resistive_surface,
                                  .title = "resistive surface",
                                  .meaning = "Not simulated yet.",
                                  .keys = kResistiveSurfaceKeys};
const GroupInfo kSensorFriction{
    .group = Group::sensor_friction, .title = "friction of a sensor", .meaning = {}, .keys = kSensorFrictionKeys};
const GroupInfo kRay{.group = Group::ray, .title = "array", .meaning = {}, .keys = kRayKeys};
const GroupInfo kParametric{.group = Group::parametric, .title = "parametric", .meaning = {}, .keys = kParametricKeys};
const GroupInfo kSoftConfig{.group = Group::soft_config, .title = "config", .meaning = {}, .keys = kSoftConfigKeys};
const GroupInfo kWheel{.group = Group::wheel, .title = "wheels", .meaning = {}, .keys = kWheelKeys};
const GroupInfo kSuspension{.group = Group::suspension, .title = "suspension", .meaning = {}, .keys = kSuspensionKeys};
const GroupInfo kSteeringLimits{
    .group = Group::steering_limits, .title = "steering limits", .meaning = {}, .keys = kSteeringLimitsKeys};
const GroupInfo kImages{.group = Group::images, .title = "images", .meaning = {}, .keys = kImagesKeys};

}  // namespace ambf::scene::table
