// Input devices and their file: checked, not simulated yet.
#include "scene/detail/groups.h"

namespace ambf::scene::group {

namespace {

constexpr Key kInputDevicesKeys[] = {
    {.name = "adf version",
     .type = KeyType::text,
     .fallback = "1.0",
     .meaning =
         "Version of the format. Only 1.0 exists; a file that names another one is refused. Upper case is accepted."},
    {.name = "input devices", .type = KeyType::texts, .meaning = "Input device blocks."},
};

constexpr Key kInputDeviceKeys[] = {
    {.name = "hardware name", .type = KeyType::text, .meaning = "As the device calls itself.", .required = true},
    {.name = "haptic gain", .type = KeyType::map, .meaning = "Gains of the device.", .sub = &haptic_gain},
    {.name = "controller gain", .type = KeyType::map, .meaning = "Gains of the root link.", .sub = &controller_gain},
    {.name = "controller", .type = KeyType::map, .meaning = "Gains of the root link.", .sub = &controller_gain},
    {.name = "deadband",
     .type = KeyType::number,
     .unit = "N",
     .meaning = "Smaller forces are 0.",
     .rule = Rule::not_negative},
    {.name = "max force", .type = KeyType::number, .unit = "N", .rule = Rule::not_negative},
    {.name = "max jerk", .type = KeyType::number, .rule = Rule::not_negative},
    {.name = "workspace scaling", .type = KeyType::number, .fallback = "1", .rule = Rule::positive},
    {.name = "location", .type = KeyType::map, .meaning = "Where the simulated end-effector starts.", .sub = &pose},
    {.name = "orientation offset", .type = KeyType::rotation, .unit = "rad"},
    {.name = "simulated multibody", .type = KeyType::file, .meaning = "Model file of the simulated end-effector."},
    {.name = "root link", .type = KeyType::text, .meaning = "Body that the device moves."},
    {.name = "enable joint control",
     .type = KeyType::boolean,
     .fallback = "true",
     .meaning = "The gripper drives the joints."},
    {.name = "pair cameras", .type = KeyType::texts, .meaning = "The first one is the frame of reference."},
    {.name = "cameras", .type = KeyType::texts, .status = KeyStatus::older, .preferred = "pair cameras"},
    {.name = "button mapping", .type = KeyType::map, .sub = &button_mapping},
    {.name = "visible", .type = KeyType::boolean, .fallback = "false"},
    {.name = "visible size", .type = KeyType::number, .fallback = "1", .rule = Rule::positive},
    {.name = "visible color", .type = KeyType::text},
};

constexpr Key kHapticGainKeys[] = {
    {.name = "linear", .type = KeyType::number_or_map, .sub = &gains},
    {.name = "angular", .type = KeyType::number_or_map, .sub = &gains},
};

constexpr Key kControllerGainKeys[] = {
    {.name = "linear", .type = KeyType::number_or_map, .sub = &gains},
    {.name = "angular", .type = KeyType::number_or_map, .sub = &gains},
};

constexpr Key kButtonMappingKeys[] = {
    {.name = "a1", .type = KeyType::integer, .meaning = "clutch"},
    {.name = "a2", .type = KeyType::integer, .meaning = "camera clutch"},
    {.name = "g1", .type = KeyType::integer, .meaning = "gripper"},
    {.name = "next mode", .type = KeyType::integer},
    {.name = "prev mode", .type = KeyType::integer},
};

constexpr const Group* kIdentityOnly[] = {&identity};

}  // namespace

const Group input_devices{.title = "input devices file",
                          .meaning = "The top level of an input devices file. Devices are not simulated yet.",
                          .keys = kInputDevicesKeys,
                          .is_header = true};
const Group input_device{.title = "input device",
                         .meaning = "Not simulated yet.",
                         .keys = kInputDeviceKeys,
                         .includes = kIdentityOnly,
                         .is_block = true};
const Group haptic_gain{.title = "haptic gain", .keys = kHapticGainKeys};
const Group controller_gain{.title = "controller gain", .keys = kControllerGainKeys};
const Group button_mapping{.title = "button mapping", .meaning = "-1: none.", .keys = kButtonMappingKeys};

}  // namespace ambf::scene::group
