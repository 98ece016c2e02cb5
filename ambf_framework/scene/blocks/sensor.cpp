// A sensor; and the resistive surface of a body, which is one, too.
#include "scene/sensor.h"

#include "scene/block_kinds.h"
#include "scene/detail/groups.h"

namespace ambf::scene::group {

namespace {

using state::SensorType;

constexpr Word kTypes[] = {word("Proximity", SensorType::proximity),
                           word("proximity", SensorType::proximity),
                           word("PROXIMITY", SensorType::proximity),
                           word("Resistance", SensorType::resistance),
                           word("resistance", SensorType::resistance),
                           word("RESISTANCE", SensorType::resistance),
                           word("Contact", SensorType::contact),
                           word("contact", SensorType::contact),
                           word("CONTACT", SensorType::contact),
                           word("IMU", SensorType::imu),
                           word("imu", SensorType::imu),
                           word("Force Torque", SensorType::force_torque),
                           word("force torque", SensorType::force_torque),
                           word("FORCE TORQUE", SensorType::force_torque),
                           word("Range", SensorType::range),
                           word("range", SensorType::range),
                           word("RANGE", SensorType::range)};

constexpr Word kSuccess[] = {word("never", state::SuccessWhen::never), word("matched", state::SuccessWhen::matched),
                             word("present", state::SuccessWhen::present), word("absent", state::SuccessWhen::absent)};

constexpr Key kSensorKeys[] = {
    {.name = "type",
     .type = KeyType::choice,
     .member = to<&Sensor::type>(),
     .meaning = "Missing in the older syntax of a single ray.",
     .words = kTypes},
    {.name = "parent",
     .type = KeyType::text,
     .member = to<&Sensor::parent>(),
     .fallback = "the world",
     .meaning = "Object that it sits on; may be in another file."},
    {.name = "location",
     .type = KeyType::vector_or_map,
     .meaning = "A pose in the parent's (mesh) frame; a bare vector in the older syntax of a single ray.",
     .sub = &kPose},
    {.name = "direction", .type = KeyType::vector, .meaning = "Older syntax of a single ray."},
    {.name = "range",
     .type = KeyType::number,
     .member = to<&Sensor::range_m>(),
     .unit = "m",
     .meaning = "Length of the rays; of `array`, times the length of the ray's direction.",
     .rule = Rule::positive},
    {.name = "array", .type = KeyType::maps, .meaning = "Rays, one by one.", .sub = &kRay},
    {.name = "mesh",
     .type = KeyType::file,
     .meaning = "One ray a triangle, from its centroid along its normal; see `placement`."},
    {.name = "placement",
     .type = KeyType::texts,
     .fallback = "faces",
     .meaning =
         "Of `mesh`: a ray on each of its `faces`, `edges`, `vertices`, along the mean normal of the faces there."},
    {.name = "wrap",
     .type = KeyType::map,
     .member = to<&Sensor::wrap>(),
     .meaning = "Of `mesh`: it is laid onto another mesh first, as a skin.",
     .sub = &kRayWrap},
    {.name = "parametric",
     .type = KeyType::map,
     .member = to<&Sensor::parametric>(),
     .meaning = "A fan of rays.",
     .sub = &kParametric},
    {.name = "rays per step",
     .type = KeyType::integer,
     .member = to<&Sensor::rays_per_step>(),
     .fallback = "all",
     .meaning = "Casts so many rays in a step, in turns. Resistance: always all.",
     .rule = Rule::not_negative},
    {.name = "distance threshold",
     .type = KeyType::number,
     .member = to<&Sensor::distance_threshold_m>(),
     .unit = "m",
     .meaning = "Since 3.0. Contact: what is as near as this counts, too.",
     .rule = Rule::not_negative},
    {.name = "process contact details",
     .type = KeyType::boolean,
     .member = to<&Sensor::contact_details>(),
     .meaning = "Since 3.0. Contact: publishes points and normals; false: names alone."},
    {.name = "joint",
     .type = KeyType::text,
     .member = to<&Sensor::joint>(),
     .meaning = "Force Torque: the joint that is measured. Without `parent` the sensor sits on its child."},
    {.name = "noise",
     .type = KeyType::map,
     .member = to<&Sensor::noise>(),
     .meaning = "IMU and Force Torque: standard deviations of normal noise.",
     .sub = &kSensorNoise},
    {.name = "range noise",
     .type = KeyType::map,
     .member = to<&Sensor::range_noise>(),
     .meaning = "Range: of the distances, normally distributed; the same in every run.",
     .sub = &kDepthNoise},
    {.name = "noise seed",
     .type = KeyType::integer,
     .member = to<&Sensor::noise_seed>(),
     .meaning = "Range: another number, other noise."},
    {.name = "matching key",
     .type = KeyType::text,
     .member = to<&Sensor::matching_key>(),
     .meaning = "Sensors with equal keys match while each senses the other's parent."},
    {.name = "success when",
     .type = KeyType::choice,
     .member = to<&Sensor::success_when>(),
     .meaning = "When the sensor's task is done: matched, something present or all absent.",
     .words = kSuccess},
    {.name = "hold",
     .type = KeyType::number,
     .member = to<&Sensor::hold_s>(),
     .unit = "s",
     .meaning = "How long that must last.",
     .rule = Rule::not_negative},
    {.name = "visible", .type = KeyType::boolean, .member = to<&Sensor::visible>()},
    {.name = "visible size",
     .type = KeyType::number,
     .member = to<&Sensor::visible_size_m>(),
     .unit = "m",
     .rule = Rule::not_negative},
    {.name = "friction",
     .type = KeyType::map,
     .member = to<&Sensor::friction>(),
     .meaning = "Resistance.",
     .sub = &kSensorFriction},
    {.name = "contact area",
     .type = KeyType::number,
     .member = to<&Sensor::contact_area_m>(),
     .unit = "m",
     .meaning = "Resistance: the stretch at which it slips and takes hold anew.",
     .rule = Rule::not_negative},
    {.name = "contact stiffness",
     .type = KeyType::number,
     .member = to<&Sensor::contact_stiffness>(),
     .unit = "N",
     .meaning = "Resistance: the normal force of an element at full depth.",
     .rule = Rule::not_negative},
    {.name = "contact damping",
     .type = KeyType::number,
     .member = to<&Sensor::contact_damping>(),
     .unit = "N s",
     .meaning = "Resistance: of the normal force, by the change of depth; limited to what is stable.",
     .rule = Rule::not_negative},
    {.name = "depth",
     .type = KeyType::number,
     .member = to<&Sensor::depth_m>(),
     .unit = "m",
     .meaning = "Of `mesh`: how far below its triangle a ray begins.",
     .rule = Rule::not_negative},
};

constexpr Key kRayKeys[] = {
    {.name = "offset", .type = KeyType::vector, .unit = "m", .required = true},
    {.name = "direction", .type = KeyType::vector, .required = true},
};

constexpr Key kParametricKeys[] = {
    {.name = "resolution",
     .type = KeyType::integer,
     .member = to<&ParametricRays::resolution>(),
     .meaning = "Rays each way: its square in all, at least 2 x 2.",
     .rule = Rule::not_negative,
     .max = kMaxRayResolution},
    {.name = "horizontal angle",
     .type = KeyType::number,
     .member = to<&ParametricRays::horizontal_rad>(),
     .unit = "rad",
     .meaning = "Whole angle of the fan about z, half of it to each side of x."},
    {.name = "vertical angle",
     .type = KeyType::number,
     .member = to<&ParametricRays::vertical_rad>(),
     .unit = "rad",
     .meaning = "The same about y."},
    {.name = "start offset",
     .type = KeyType::number,
     .member = to<&ParametricRays::start_offset_m>(),
     .unit = "m",
     .meaning = "From the sensor to where a ray begins, along the ray."},
};

constexpr Key kRayWrapKeys[] = {
    {.name = "onto",
     .type = KeyType::file,
     .fallback = "of a resistive surface: the visual mesh",
     .meaning = "Found as `mesh`; in the frame of the sensor's parent. Each vertex moves along its normal until it "
                "meets this mesh from outside; what meets nothing is left out."},
    {.name = "offset",
     .type = KeyType::number,
     .member = to<&RayWrap::offset_m>(),
     .unit = "m",
     .meaning = "How far above it the vertices come to lie.",
     .rule = Rule::not_negative},
};

constexpr Word kScales[] = {word("false", FrictionScale::none),        word("true", FrictionScale::normal_force),
                            word("depth", FrictionScale::depth),       word("False", FrictionScale::none),
                            word("FALSE", FrictionScale::none),        word("no", FrictionScale::none),
                            word("off", FrictionScale::none),          word("0", FrictionScale::none),
                            word("True", FrictionScale::normal_force), word("TRUE", FrictionScale::normal_force),
                            word("yes", FrictionScale::normal_force),  word("on", FrictionScale::normal_force),
                            word("1", FrictionScale::normal_force),    word("Depth", FrictionScale::depth)};

constexpr Key kSensorNoiseKeys[] = {
    {.name = "linear",
     .type = KeyType::number,
     .member = to<&SensorNoise::linear>(),
     .meaning = "Of each axis: m/s^2 of an IMU, N of a Force Torque sensor.",
     .rule = Rule::not_negative},
    {.name = "angular",
     .type = KeyType::number,
     .member = to<&SensorNoise::angular>(),
     .meaning = "Of each axis: rad/s of an IMU, N m of a Force Torque sensor.",
     .rule = Rule::not_negative},
};

constexpr Key kSensorFrictionKeys[] = {
    {.name = "static",
     .type = KeyType::number,
     .member = to<&ResistiveFriction::stick>(),
     .meaning = "Of the stretch, N/m; times the normal force (1/m) or the depth by `variable`.",
     .rule = Rule::not_negative},
    {.name = "damping",
     .type = KeyType::number,
     .member = to<&ResistiveFriction::damping>(),
     .meaning = "Of the stretch's change in a millisecond, N/m.",
     .rule = Rule::not_negative},
    {.name = "dynamic",
     .type = KeyType::number,
     .member = to<&ResistiveFriction::slide>(),
     .unit = "N s/m",
     .meaning = "Of the relative velocity.",
     .rule = Rule::not_negative},
    {.name = "variable",
     .type = KeyType::choice,
     .member = to<&ResistiveFriction::scale>(),
     .meaning = "true: scaled by the normal force (Eq. 6.1), depth: by the depth (Eq. 6.12).",
     .words = kScales},
};

// Read by the parser of bodies, with defaults of their own.
constexpr Key kSurfaceFrictionKeys[] = {
    {.name = "static", .type = KeyType::number, .fallback = "1", .rule = Rule::not_negative},
    {.name = "damping", .type = KeyType::number, .fallback = "1", .rule = Rule::not_negative},
    {.name = "dynamic", .type = KeyType::number, .fallback = "0.1", .rule = Rule::not_negative},
    {.name = "variable", .type = KeyType::choice, .fallback = "false", .words = kScales},
};

constexpr Key kResistiveSurfaceKeys[] = {
    {.name = "mesh", .type = KeyType::file, .fallback = "the visual mesh", .meaning = "In the high resolution path."},
    {.name = "placement", .type = KeyType::texts, .fallback = "faces", .meaning = "As of a sensor."},
    {.name = "wrap", .type = KeyType::map, .meaning = "As of a sensor.", .sub = &kRayWrap},
    {.name = "range", .type = KeyType::number, .unit = "m", .fallback = "0.1", .rule = Rule::positive},
    {.name = "depth", .type = KeyType::number, .unit = "m", .fallback = "0", .rule = Rule::not_negative},
    {.name = "face resolution", .type = KeyType::integer, .status = KeyStatus::ignored},
    {.name = "edge resolution", .type = KeyType::integer, .status = KeyStatus::ignored},
    {.name = "contact area", .type = KeyType::number, .unit = "m", .fallback = "0.001", .rule = Rule::not_negative},
    {.name = "friction", .type = KeyType::map, .sub = &kSurfaceFriction},
    {.name = "contact stiffness", .type = KeyType::number, .unit = "N", .fallback = "0", .rule = Rule::not_negative},
    {.name = "contact damping", .type = KeyType::number, .unit = "N s", .fallback = "0", .rule = Rule::not_negative},
    {.name = "visible", .type = KeyType::boolean, .fallback = "false"},
    {.name = "visible size",
     .type = KeyType::number,
     .unit = "m",
     .fallback = "a fifth of the range",
     .rule = Rule::not_negative},
};

constexpr const Group* kIdentityOnly[] = {&kIdentity};

}  // namespace

const Group kSensor{.title = "sensor",
                    .meaning =
                        "Rays that find the nearest body (of type Resistance they resist it, too), contacts, inertial "
                        "measurements, or a joint's reaction.",
                    .keys = kSensorKeys,
                    .includes = kIdentityOnly,
                    .is_block = true};
const Group kRay{.title = "array", .keys = kRayKeys};
const Group kParametric{.title = "parametric", .keys = kParametricKeys};
const Group kRayWrap{.title = "wrap", .keys = kRayWrapKeys};
const Group kSensorNoise{.title = "noise of a sensor", .keys = kSensorNoiseKeys};
const Group kSensorFriction{.title = "friction of a sensor", .keys = kSensorFrictionKeys};
const Group kSurfaceFriction{.title = "friction of a resistive surface",
                             .meaning = "As the friction of a sensor, with other defaults.",
                             .keys = kSurfaceFrictionKeys};
const Group kResistiveSurface{.title = "resistive surface",
                              .meaning = "A sensor of type Resistance on the body, with one ray a triangle.",
                              .keys = kResistiveSurfaceKeys};

}  // namespace ambf::scene::group

namespace ambf::scene::kind {

const BlockKind kSensor{.group = &group::kSensor,
                        .list = {.name = "sensors", .type = KeyType::texts, .meaning = "Sensor blocks."},
                        .prefix = "SENSOR ",
                        .simulated = true};

}  // namespace ambf::scene::kind
