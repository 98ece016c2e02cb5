// A vehicle: checked, not simulated yet.
#include "scene/block_kinds.h"
#include "scene/detail/groups.h"

namespace ambf::scene::group {

namespace {

constexpr Key kVehicleKeys[] = {
    {.name = "chassis", .type = KeyType::text, .meaning = "Body block."},
    {.name = "wheels", .type = KeyType::maps, .sub = &kWheel},
    {.name = "high resolution path", .type = KeyType::folder},
};

constexpr Key kWheelKeys[] = {
    {.name = "body", .type = KeyType::text, .meaning = "Body block that becomes the wheel; or `mesh`."},
    {.name = "mesh", .type = KeyType::file},
    {.name = "width", .type = KeyType::number, .unit = "m"},
    {.name = "radius", .type = KeyType::number, .unit = "m"},
    {.name = "friction", .type = KeyType::number},
    {.name = "suspension", .type = KeyType::map, .sub = &kSuspension},
    {.name = "roll influence", .type = KeyType::number},
    {.name = "down direction", .type = KeyType::vector},
    {.name = "axel direction", .type = KeyType::vector},
    {.name = "offset", .type = KeyType::vector, .unit = "m"},
    {.name = "front", .type = KeyType::boolean, .fallback = "false"},
    {.name = "steering limits", .type = KeyType::map, .sub = &kSteeringLimits},
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

constexpr const Group* kIdentityOnly[] = {&kIdentity};

}  // namespace

const Group kVehicle{.title = "vehicle",
                     .meaning = "Not simulated yet.",
                     .keys = kVehicleKeys,
                     .includes = kIdentityOnly,
                     .is_block = true};
const Group kWheel{.title = "wheels", .keys = kWheelKeys};
const Group kSuspension{.title = "suspension", .keys = kSuspensionKeys};
const Group kSteeringLimits{.title = "steering limits", .keys = kSteeringLimitsKeys};

}  // namespace ambf::scene::group

namespace ambf::scene::kind {

const BlockKind kVehicle{.group = &group::kVehicle,
                         .list = {.name = "vehicles", .type = KeyType::texts, .meaning = "Vehicle blocks."},
                         .prefix = "VEHICLE "};

}  // namespace ambf::scene::kind
