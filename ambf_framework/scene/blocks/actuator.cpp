// An actuator.
#include "scene/actuator.h"

#include "scene/detail/groups.h"

namespace ambf::scene::group {

namespace {

constexpr Word kTypes[] = {
    word("Constraint", state::ActuatorType::constraint), word("constraint", state::ActuatorType::constraint),
    word("CONSTRAINT", state::ActuatorType::constraint), word("Magnet", state::ActuatorType::magnet),
    word("Blade", state::ActuatorType::blade),           word("Needle", state::ActuatorType::needle)};

constexpr Key kTriggerKeys[] = {
    {.name = "jaw",
     .type = KeyType::text,
     .member = to<&Actuator::jaw>(),
     .meaning = "Body; all limited joints below it are the jaw.",
     .required = true},
    {.name = "below",
     .type = KeyType::number,
     .member = to<&Actuator::below>(),
     .meaning = "Opening, 0 closed to 1 open, below which it holds; it lets go 0.05 above.",
     .rule = Rule::not_negative,
     .max = 1.0},
};

constexpr Key kActuatorKeys[] = {
    {.name = "type",
     .type = KeyType::choice,
     .member = to<&Actuator::type>(),
     .meaning = "Constraint: a fixed joint to what it holds, springs to nodes of soft bodies. Magnet: a pull on "
                "what its sensor senses. Blade: an edge that cuts tissue; Needle: an arc that sews it (tissue.md).",
     .required = true,
     .words = kTypes},
    {.name = "parent",
     .type = KeyType::text,
     .member = to<&Actuator::parent>(),
     .fallback = "the world",
     .meaning = "Body that it sits on and holds others on; may be in another file."},
    {.name = "location",
     .type = KeyType::map,
     .member = to<&Actuator::T_parent_actuator>(),
     .meaning = "In the frame of the parent's centre of mass.",
     .sub = &kPose},
    {.name = "visible",
     .type = KeyType::boolean,
     .member = to<&Actuator::visible>(),
     .meaning = "Drawn also while the layer of actuators is off."},
    {.name = "visible size",
     .type = KeyType::number,
     .member = to<&Actuator::visible_size_m>(),
     .unit = "m",
     .rule = Rule::not_negative},
    {.name = "max impulse",
     .type = KeyType::number,
     .member = to<&Actuator::max_impulse>(),
     .unit = "Ns",
     .fallback = "no bound",
     .meaning = "Along each axis and (Nms) about it, a step; beyond it what is held gives way.",
     .rule = Rule::not_negative},
    {.name = "tau",
     .type = KeyType::number,
     .member = to<&Actuator::tau>(),
     .fallback = "1",
     .meaning = "Factor on the share (0.8) of an error that a step takes back.",
     .rule = Rule::not_negative},
    {.name = "sensor",
     .type = KeyType::text,
     .member = to<&Actuator::sensor>(),
     .fallback = "none",
     .meaning = "Sensor whose bodies it holds, each once; may be in another file."},
    {.name = "trigger",
     .type = KeyType::text_or_map,
     .fallback = "command",
     .meaning = "What makes it hold without a command: nothing (command), its sensor (sensor), or that while a jaw is "
                "closed ({jaw: BODY gripper, below: 0.5}). Blades need no sensor for a jaw, and cut always with "
                "contact.",
     .sub = &kTrigger},
    {.name = "hardness",
     .type = KeyType::number,
     .member = to<&Actuator::hardness>(),
     .unit = "N/m",
     .meaning = "Of soft bodies: each node that it holds hangs on it by a spring of this stiffness.",
     .rule = Rule::not_negative},
    {.name = "damping",
     .type = KeyType::number,
     .member = to<&Actuator::damping>(),
     .unit = "N s/m",
     .meaning = "Of that spring.",
     .rule = Rule::not_negative},
    {.name = "strength",
     .type = KeyType::number,
     .member = to<&Actuator::strength_N>(),
     .unit = "N",
     .fallback = "0; needles: 5",
     .meaning = "Magnets: the pull where the sensor touches; strength (1 - distance / range)^2 further away. "
                "Needles: the force across the needle, or of its thread, above which a puncture tears out.",
     .rule = Rule::not_negative},
    {.name = "range",
     .type = KeyType::number,
     .member = to<&Actuator::range_m>(),
     .unit = "m",
     .fallback = "the sensor's",
     .meaning = "Magnets: where the pull ends.",
     .rule = Rule::not_negative},
    {.name = "edge",
     .type = KeyType::maps,
     .meaning = "Blades: at least two places of a polyline, in the parent's body frame.",
     .sub = &kEdgePoint},
    {.name = "sharpness",
     .type = KeyType::number,
     .member = to<&Actuator::sharpness>(),
     .unit = "N/m",
     .meaning = "Blades: the force that a cut takes, for each m of edge in tissue; 0: none.",
     .rule = Rule::not_negative},
    {.name = "arc",
     .type = KeyType::maps,
     .meaning =
         "Needles: places from the tip to the rear, in the parent's body frame. Two: straight; three: the arc of "
         "the circle through them; more: a polyline.",
     .sub = &kArcPoint},
    {.name = "puncture force",
     .type = KeyType::number,
     .member = to<&Actuator::puncture_force>(),
     .unit = "N",
     .meaning = "Needles: what the tip bears before it goes through.",
     .rule = Rule::not_negative},
    {.name = "friction",
     .type = KeyType::number,
     .member = to<&Actuator::needle_friction>(),
     .unit = "N/m",
     .meaning = "Needles: along the needle and its thread, for each m of them in tissue.",
     .rule = Rule::not_negative},
    {.name = "thread",
     .type = KeyType::text,
     .member = to<&Actuator::thread>(),
     .fallback = "none",
     .meaning = "Needles: soft body, of `kind: thread`, whose first end hangs on the rear and that stays in the "
                "punctures; may be in another file."},
};

constexpr Key kEdgePointKeys[] = {
    {.name = "x", .type = KeyType::number, .unit = "m", .required = true},
    {.name = "y", .type = KeyType::number, .unit = "m", .required = true},
    {.name = "z", .type = KeyType::number, .unit = "m", .required = true},
};

constexpr Key kArcPointKeys[] = {
    {.name = "x", .type = KeyType::number, .unit = "m", .required = true},
    {.name = "y", .type = KeyType::number, .unit = "m", .required = true},
    {.name = "z", .type = KeyType::number, .unit = "m", .required = true},
};

constexpr const Group* kIdentityOnly[] = {&kIdentity};

}  // namespace

const Group kActuator{.title = "actuator",
                      .meaning = "Holds bodies on the one that it sits on.",
                      .keys = kActuatorKeys,
                      .includes = kIdentityOnly,
                      .is_block = true};
const Group kEdgePoint{
    .title = "edge", .meaning = "Of an actuator: a place of a blade's edge.", .keys = kEdgePointKeys};
const Group kArcPoint{.title = "arc", .meaning = "Of an actuator: a place of a needle.", .keys = kArcPointKeys};
const Group kTrigger{.title = "trigger", .meaning = "Of an actuator.", .keys = kTriggerKeys};

}  // namespace ambf::scene::group

namespace ambf::scene::kind {

const BlockKind kActuator{.group = &group::kActuator,
                          .list = {.name = "actuators", .type = KeyType::texts, .meaning = "Actuator blocks to load."},
                          .prefix = "ACTUATOR ",
                          .simulated = true};

}  // namespace ambf::scene::kind
