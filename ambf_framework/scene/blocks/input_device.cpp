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
    {.name = "haptic gain", .type = KeyType::map, .meaning = "Gains of the device.", .sub = &kHapticGain},
    {.name = "controller gain", .type = KeyType::map, .meaning = "Gains of the root link.", .sub = &kControllerGain},
    {.name = "controller", .type = KeyType::map, .meaning = "Gains of the root link.", .sub = &kControllerGain},
    {.name = "deadband",
     .type = KeyType::number,
     .unit = "N",
     .meaning = "Smaller forces are 0.",
     .rule = Rule::not_negative},
    {.name = "max force", .type = KeyType::number, .unit = "N", .rule = Rule::not_negative},
    {.name = "max jerk", .type = KeyType::number, .rule = Rule::not_negative},
    {.name = "workspace scaling", .type = KeyType::number, .fallback = "1", .rule = Rule::positive},
    {.name = "location", .type = KeyType::map, .meaning = "Where the simulated end-effector starts.", .sub = &kPose},
    {.name = "orientation offset", .type = KeyType::rotation, .unit = "rad"},
    {.name = "simulated multibody", .type = KeyType::file, .meaning = "Model file of the simulated end-effector."},
    {.name = "root link", .type = KeyType::text, .meaning = "Body that the device moves."},
    {.name = "enable joint control",
     .type = KeyType::boolean,
     .fallback = "true",
     .meaning = "The gripper drives the joints."},
    {.name = "pair cameras", .type = KeyType::texts, .meaning = "The first one is the frame of reference."},
    {.name = "cameras", .type = KeyType::texts, .status = KeyStatus::older, .preferred = "pair cameras"},
    {.name = "button mapping", .type = KeyType::map, .sub = &kButtonMapping},
    {.name = "visible", .type = KeyType::boolean, .fallback = "false"},
    {.name = "visible size", .type = KeyType::number, .fallback = "1", .rule = Rule::positive},
    {.name = "visible color", .type = KeyType::text},
};

constexpr Key kHapticGainKeys[] = {
    {.name = "linear", .type = KeyType::number_or_map, .sub = &kGains},
    {.name = "angular", .type = KeyType::number_or_map, .sub = &kGains},
};

constexpr Key kControllerGainKeys[] = {
    {.name = "linear", .type = KeyType::number_or_map, .sub = &kGains},
    {.name = "angular", .type = KeyType::number_or_map, .sub = &kGains},
};

constexpr Key kButtonMappingKeys[] = {
    {.name = "a1", .type = KeyType::integer, .meaning = "clutch"},
    {.name = "a2", .type = KeyType::integer, .meaning = "camera clutch"},
    {.name = "g1", .type = KeyType::integer, .meaning = "gripper"},
    {.name = "next mode", .type = KeyType::integer},
    {.name = "prev mode", .type = KeyType::integer},
};

constexpr const Group* kIdentityOnly[] = {&kIdentity};

}  // namespace

const Group kInputDevices{.title = "input devices file",
                          .meaning = "The top level of an input devices file. Devices are not simulated yet.",
                          .keys = kInputDevicesKeys,
                          .is_header = true};
const Group kInputDevice{.title = "input device",
                         .meaning = "Not simulated yet.",
                         .keys = kInputDeviceKeys,
                         .includes = kIdentityOnly,
                         .is_block = true};
const Group kHapticGain{.title = "haptic gain", .keys = kHapticGainKeys};
const Group kControllerGain{.title = "controller gain", .keys = kControllerGainKeys};
const Group kButtonMapping{.title = "button mapping", .meaning = "-1: none.", .keys = kButtonMappingKeys};

}  // namespace ambf::scene::group
