#include "scene/detail/keys_internal.h"

namespace ambf::scene::table {

namespace {

constexpr Key kInputDeviceKeys[] = {
    {.name = "hardware name", .type = KeyType::text, .meaning = "As the device calls itself.", .required = true},
    {.name = "haptic gain", .type = KeyType::map, .meaning = "Gains of the device.", .sub = Group::haptic_gain},
    {.name = "controller gain",
     .type = KeyType::map,
     .meaning = "Gains of the root link.",
     .sub = Group::controller_gain},
    {.name = "controller", .type = KeyType::map, .meaning = "Gains of the root link.", .sub = Group::controller_gain},
    {.name = "deadband",
     .type = KeyType::number,
     .unit = "N",
     .meaning = "Smaller forces are 0.",
     .rule = Rule::not_negative},
    {.name = "max force", .type = KeyType::number, .unit = "N", .meaning = {}, .rule = Rule::not_negative},
    {.name = "max jerk", .type = KeyType::number, .meaning = {}, .rule = Rule::not_negative},
    {.name = "workspace scaling", .type = KeyType::number, .fallback = "1", .meaning = {}, .rule = Rule::positive},
    {.name = "location",
     .type = KeyType::map,
     .meaning = "Where the simulated end-effector starts.",
     .sub = Group::pose},
    {.name = "orientation offset", .type = KeyType::rotation, .unit = "rad", .meaning = {}},
    {.name = "simulated multibody", .type = KeyType::file, .meaning = "Model file of the simulated end-effector."},
    {.name = "root link", .type = KeyType::text, .meaning = "Body that the device moves."},
    {.name = "enable joint control",
     .type = KeyType::boolean,
     .fallback = "true",
     .meaning = "The gripper drives the joints."},
    {.name = "pair cameras", .type = KeyType::texts, .meaning = "The first one is the frame of reference."},
    {.name = "cameras", .type = KeyType::texts, .meaning = {}, .status = KeyStatus::older, .newer = "pair cameras"},
    {.name = "button mapping", .type = KeyType::map, .meaning = {}, .sub = Group::button_mapping},
    {.name = "visible", .type = KeyType::boolean, .fallback = "false", .meaning = {}},
    {.name = "visible size", .type = KeyType::number, .fallback = "1", .meaning = {}, .rule = Rule::positive},
    {.name = "visible color", .type = KeyType::text, .meaning = {}},
};

constexpr Key kHapticGainKeys[] = {
    {.name = "linear", .type = KeyType::number_or_map, .meaning = {}, .sub = Group::gains},
    {.name = "angular", .type = KeyType::number_or_map, .meaning = {}, .sub = Group::gains},
};
constexpr Key kControllerGainKeys[] = {
    {.name = "linear", .type = KeyType::number_or_map, .meaning = {}, .sub = Group::gains},
    {.name = "angular", .type = KeyType::number_or_map, .meaning = {}, .sub = Group::gains},
};
constexpr Key kButtonMappingKeys[] = {
    {.name = "a1", .type = KeyType::integer, .meaning = "clutch"},
    {.name = "a2", .type = KeyType::integer, .meaning = "camera clutch"},
    {.name = "g1", .type = KeyType::integer, .meaning = "gripper"},
    {.name = "next mode", .type = KeyType::integer},
    {.name = "prev mode", .type = KeyType::integer},
};

constexpr Group kIncludes[] = {Group::identity};

}  // namespace

const GroupInfo kInputDevice{.group = Group::input_device,
                             .title = "input device",
                             .meaning = "Not simulated yet.",
                             .keys = kInputDeviceKeys,
                             .includes = kIncludes,
                             .is_block = true};
const GroupInfo kHapticGain{
    .group = Group::haptic_gain, .title = "haptic gain", .meaning = {}, .keys = kHapticGainKeys};
const GroupInfo kControllerGain{
    .group = Group::controller_gain, .title = "controller gain", .meaning = {}, .keys = kControllerGainKeys};
const GroupInfo kButtonMapping{
    .group = Group::button_mapping, .title = "button mapping", .meaning = "-1: none.", .keys = kButtonMappingKeys};

}  // namespace ambf::scene::table
