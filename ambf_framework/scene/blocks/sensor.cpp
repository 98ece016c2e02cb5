// A sensor, and the resistive surface of a body, which is made of sensors: checked, not simulated yet.
#include "scene/block_kinds.h"
#include "scene/detail/groups.h"

namespace ambf::scene::group {

namespace {

constexpr Word kTypes[] = {{"Proximity"}, {"proximity"}, {"PROXIMITY"}, {"Resistance"}, {"resistance"}, {"RESISTANCE"}};

constexpr Key kSensorKeys[] = {
    {.name = "type",
     .type = KeyType::choice,
     .fallback = "Proximity",
     .meaning = "Missing in the older syntax of a single ray.",
     .words = kTypes},
    {.name = "parent", .type = KeyType::text, .meaning = "Object that it sits on; may be in another file."},
    {.name = "location",
     .type = KeyType::vector_or_map,
     .meaning = "A pose; a bare vector in the older syntax of a single ray.",
     .sub = &kPose},
    {.name = "direction", .type = KeyType::vector, .meaning = "Older syntax of a single ray."},
    {.name = "range", .type = KeyType::number, .unit = "m", .fallback = "0.5"},
    {.name = "array", .type = KeyType::maps, .meaning = "Rays, one by one.", .sub = &kRay},
    {.name = "mesh", .type = KeyType::file, .meaning = "One ray a triangle."},
    {.name = "parametric", .type = KeyType::map, .meaning = "A fan of rays.", .sub = &kParametric},
    {.name = "visible", .type = KeyType::boolean, .fallback = "false"},
    {.name = "visible size", .type = KeyType::number, .unit = "m", .fallback = "0.02"},
    {.name = "friction", .type = KeyType::map, .meaning = "Resistance.", .sub = &kSensorFriction},
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

constexpr Key kResistiveSurfaceKeys[] = {
    {.name = "mesh", .type = KeyType::file, .fallback = "the visual mesh", .meaning = "In the high resolution path."},
    {.name = "range", .type = KeyType::number, .unit = "m", .fallback = "0.1"},
    {.name = "depth", .type = KeyType::number, .unit = "m", .fallback = "0"},
    {.name = "face resolution", .type = KeyType::integer, .status = KeyStatus::ignored},
    {.name = "edge resolution", .type = KeyType::integer, .status = KeyStatus::ignored},
    {.name = "contact area", .type = KeyType::number, .unit = "m", .fallback = "0.001"},
    {.name = "friction", .type = KeyType::map, .sub = &kSensorFriction},
    {.name = "contact stiffness", .type = KeyType::number, .fallback = "0"},
    {.name = "contact damping", .type = KeyType::number, .fallback = "0"},
    {.name = "visible", .type = KeyType::boolean, .fallback = "false"},
    {.name = "visible size", .type = KeyType::number, .unit = "m"},
};

constexpr const Group* kIdentityOnly[] = {&kIdentity};

}  // namespace

const Group kSensor{.title = "sensor",
                    .meaning = "Not simulated yet.",
                    .keys = kSensorKeys,
                    .includes = kIdentityOnly,
                    .is_block = true};
const Group kRay{.title = "array", .keys = kRayKeys};
const Group kParametric{.title = "parametric", .keys = kParametricKeys};
const Group kSensorFriction{.title = "friction of a sensor", .keys = kSensorFrictionKeys};
const Group kResistiveSurface{
    .title = "resistive surface", .meaning = "Not simulated yet.", .keys = kResistiveSurfaceKeys};

}  // namespace ambf::scene::group

namespace ambf::scene::kind {

const BlockKind kSensor{.group = &group::kSensor,
                        .list = {.name = "sensors", .type = KeyType::texts, .meaning = "Sensor blocks."},
                        .prefix = "SENSOR "};

}  // namespace ambf::scene::kind
