// A vehicle.
#include "scene/vehicle.h"

#include "scene/detail/groups.h"

namespace ambf::scene::group {

namespace {

constexpr Key kVehicleKeys[] = {
    {.name = "chassis",
     .type = KeyType::text,
     .member = to<&Vehicle::parent>(),
     .meaning = "Body that the wheels carry; may be in another file.",
     .required = true},
    {.name = "wheels", .type = KeyType::maps, .meaning = "In the order of commands.", .sub = &kWheel, .required = true},
    {.name = "high resolution path", .type = KeyType::folder, .status = KeyStatus::unread},
};

constexpr Key kWheelKeys[] = {
    {.name = "body",
     .type = KeyType::text,
     .member = to<&Wheel::body>(),
     .fallback = "none",
     .meaning =
         "Body that becomes the wheel, its centre of mass the hub; may be in another file. It weighs nothing and "
         "meets nothing while it is one, and its joints are off."},
    {.name = "mesh",
     .type = KeyType::file,
     .fallback = "none",
     .meaning = "Instead of `body`: what is drawn, its origin the hub, below the paths of the header."},
    {.name = "width",
     .type = KeyType::number,
     .member = to<&Wheel::width_m>(),
     .unit = "m",
     .meaning = "Without effect: a wheel meets the ground in a point.",
     .rule = Rule::not_negative},
    {.name = "radius",
     .type = KeyType::number,
     .member = to<&Wheel::radius_m>(),
     .unit = "m",
     .rule = Rule::positive,
     .required = true},
    {.name = "friction",
     .type = KeyType::number,
     .member = to<&Wheel::friction>(),
     .meaning = "Largest force along the ground by the one into it. The ground's own friction does not count.",
     .rule = Rule::not_negative},
    {.name = "suspension", .type = KeyType::map, .sub = &kSuspension, .required = true},
    {.name = "roll influence",
     .type = KeyType::number,
     .member = to<&Wheel::roll_influence>(),
     .meaning = "Share of a sideways force's lever that rolls the chassis: 1 all of it, 0 it never rolls.",
     .rule = Rule::not_negative},
    {.name = "down direction",
     .type = KeyType::vector,
     .member = to<&Wheel::down>(),
     .meaning = "Along the suspension, in the frame of the chassis' centre of mass."},
    {.name = "axel direction",
     .type = KeyType::vector,
     .member = to<&Wheel::axle>(),
     .meaning = "Likewise; the wheel drives along up x axle: -y drives along x."},
    {.name = "offset",
     .type = KeyType::vector,
     .member = to<&Wheel::connection>(),
     .unit = "m",
     .meaning = "Upper end of the suspension, in the frame of the chassis' centre of mass.",
     .required = true},
    {.name = "front", .type = KeyType::boolean, .member = to<&Wheel::front>(), .meaning = "For panels and scripts."},
    {.name = "steering limits", .type = KeyType::map, .sub = &kSteeringLimits},
    {.name = "max engine power",
     .type = KeyType::number,
     .member = to<&Wheel::max_drive_N>(),
     .unit = "N",
     .meaning = "Commands beyond it are cut.",
     .rule = Rule::not_negative},
    {.name = "max brake power",
     .type = KeyType::number,
     .member = to<&Wheel::max_brake_N>(),
     .unit = "N",
     .meaning = "Likewise.",
     .rule = Rule::not_negative},
};

constexpr Key kSuspensionKeys[] = {
    {.name = "stiffness",
     .type = KeyType::number,
     .member = to<&Wheel::stiffness>(),
     .unit = "1/s^2",
     .meaning = "Spring force by compression and mass of the chassis. n wheels sink by 9.8 / (n stiffness) m.",
     .rule = Rule::not_negative},
    {.name = "damping",
     .type = KeyType::number,
     .member = to<&Wheel::damping>(),
     .unit = "1/s",
     .meaning = "Damping force by speed and mass of the chassis while it expands.",
     .rule = Rule::not_negative},
    {.name = "compression",
     .type = KeyType::number,
     .member = to<&Wheel::compression>(),
     .unit = "1/s",
     .meaning = "The same while it is compressed.",
     .rule = Rule::not_negative},
    {.name = "rest length",
     .type = KeyType::number,
     .member = to<&Wheel::rest_length_m>(),
     .unit = "m",
     .meaning = "From the upper end to the hub, without load.",
     .rule = Rule::positive,
     .required = true},
};

constexpr Key kSteeringLimitsKeys[] = {
    {.name = "low",
     .type = KeyType::number,
     .member = to<&Wheel::steering_low>(),
     .unit = "rad",
     .meaning = "About up: positive turns left."},
    {.name = "high", .type = KeyType::number, .member = to<&Wheel::steering_high>(), .unit = "rad"},
};

constexpr const Group* kIdentityOnly[] = {&kIdentity};

}  // namespace

const Group kVehicle{.title = "vehicle",
                     .meaning = "A body on wheels.",
                     .keys = kVehicleKeys,
                     .includes = kIdentityOnly,
                     .is_block = true};
const Group kWheel{.title = "wheels", .meaning = "Of a vehicle.", .keys = kWheelKeys};
const Group kSuspension{.title = "suspension", .keys = kSuspensionKeys};
const Group kSteeringLimits{.title = "steering limits", .keys = kSteeringLimitsKeys};

}  // namespace ambf::scene::group

namespace ambf::scene::kind {

const BlockKind kVehicle{.group = &group::kVehicle,
                         .list = {.name = "vehicles", .type = KeyType::texts, .meaning = "Vehicle blocks to load."},
                         .prefix = "VEHICLE ",
                         .simulated = true};

}  // namespace ambf::scene::kind
