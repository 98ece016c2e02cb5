// A ghost object: checked, not simulated yet.
#include "scene/block_kinds.h"
#include "scene/detail/groups.h"

namespace ambf::scene::group {

namespace {

constexpr Key kGhostKeys[] = {
    {.name = "parent", .type = KeyType::text, .meaning = "Object that it sits on; may be in another file."},
    {.name = "location", .type = KeyType::map, .sub = &kPose},
};

constexpr const Group* kLooks[] = {&kIdentity, &kVisual, &kCollision, &kColor};

}  // namespace

const Group kGhostObject{
    .title = "ghost object", .meaning = "Not simulated yet.", .keys = kGhostKeys, .includes = kLooks, .is_block = true};

}  // namespace ambf::scene::group

namespace ambf::scene::kind {

const BlockKind kGhostObject{
    .group = &group::kGhostObject,
    .list = {.name = "ghost objects", .type = KeyType::texts, .meaning = "Ghost object blocks."},
    .prefix = "GHOST "};

}  // namespace ambf::scene::kind
