// A ghost object.
#include "scene/ghost.h"

#include "scene/detail/groups.h"

namespace ambf::scene::group {

namespace {

constexpr Key kGhostKeys[] = {
    {.name = "parent",
     .type = KeyType::text,
     .member = to<&Ghost::parent>(),
     .fallback = "the world",
     .meaning = "Object that it moves with; may be in another file."},
    {.name = "location",
     .type = KeyType::map,
     .member = to<&Ghost::T_parent_ghost>(),
     .meaning = "In the frame of the parent's centre of mass.",
     .sub = &kPose},
    {.name = "drag",
     .type = KeyType::number,
     .member = to<&Ghost::drag>(),
     .meaning = "0: none. Else bodies inside go with the parent, without gravity, and keep this share of their own "
                "velocity each millisecond: 0.9 is what AMBF 2.0 did.",
     .rule = Rule::not_negative,
     .max = 1.0},
};

constexpr const Group* kLooks[] = {&kIdentity, &kVisual, &kCollision, &kColor};

}  // namespace

const Group kGhostObject{.title = "ghost object",
                         .meaning = "A shape that feels what overlaps it and pushes nothing.",
                         .keys = kGhostKeys,
                         .includes = kLooks,
                         .is_block = true};

}  // namespace ambf::scene::group

namespace ambf::scene::kind {

const BlockKind kGhostObject{
    .group = &group::kGhostObject,
    .list = {.name = "ghost objects", .type = KeyType::texts, .meaning = "Ghost object blocks to load."},
    .prefix = "GHOST ",
    .simulated = true};

}  // namespace ambf::scene::kind
