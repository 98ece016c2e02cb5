// An actuator: checked, not simulated yet.
#include "scene/block_kinds.h"
#include "scene/detail/groups.h"

namespace ambf::scene::group {

namespace {

constexpr Word kTypes[] = {{"Constraint"}, {"constraint"}, {"CONSTRAINT"}};

constexpr Key kActuatorKeys[] = {
    {.name = "type", .type = KeyType::choice, .required = true, .words = kTypes},
    {.name = "parent", .type = KeyType::text, .meaning = "Object that it sits on; may be in another file."},
    {.name = "location", .type = KeyType::map, .sub = &kPose},
    {.name = "visible", .type = KeyType::boolean, .fallback = "false"},
    {.name = "visible size", .type = KeyType::number, .unit = "m", .fallback = "0.02"},
    {.name = "max impulse", .type = KeyType::number, .fallback = "10"},
    {.name = "tau", .type = KeyType::number, .fallback = "1"},
};

constexpr const Group* kIdentityOnly[] = {&kIdentity};

}  // namespace

const Group kActuator{.title = "actuator",
                      .meaning = "Not simulated yet.",
                      .keys = kActuatorKeys,
                      .includes = kIdentityOnly,
                      .is_block = true};

}  // namespace ambf::scene::group

namespace ambf::scene::kind {

const BlockKind kActuator{.group = &group::kActuator,
                          .list = {.name = "actuators", .type = KeyType::texts, .meaning = "Actuator blocks."},
                          .prefix = "ACTUATOR "};

}  // namespace ambf::scene::kind
