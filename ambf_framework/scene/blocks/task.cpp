// A task.
#include "scene/task.h"

#include "scene/detail/groups.h"

namespace ambf::scene::group {

namespace {

constexpr Word kOrders[] = {word("any", state::TaskOrder::any), word("listed", state::TaskOrder::listed)};

constexpr Word kPunctures[] = {word("in", state::HeldNode::Puncture::in), word("out", state::HeldNode::Puncture::out)};

constexpr Key kTaskKeys[] = {
    {.name = "parent",
     .type = KeyType::text,
     .member = to<&Task::parent>(),
     .fallback = "the world",
     .meaning = "Object in whose frame places are that name none."},
    {.name = "location",
     .type = KeyType::map,
     .member = to<&Task::T_parent_task>(),
     .meaning = "In the parent's frame.",
     .sub = &kPose},
    {.name = "holders",
     .type = KeyType::texts,
     .member = to<&Task::holders>(),
     .fallback = "none",
     .meaning = "Bodies that may hold pieces; each counts with all bodies that joints carry below it."},
    {.name = "goals", .type = KeyType::maps, .meaning = "At most 64.", .sub = &kTaskGoal, .required = true},
    {.name = "order",
     .type = KeyType::choice,
     .member = to<&Task::order>(),
     .meaning = "any: all goals must be met at the same time. listed: one after the other; what is done stays done.",
     .words = kOrders},
    {.name = "drop height",
     .type = KeyType::number,
     .member = to<&Task::drop_height_m>(),
     .unit = "m",
     .meaning = "A piece that falls so far once it is let go, elsewhere than at its places, is a drop.",
     .rule = Rule::positive},
    {.name = "avoid",
     .type = KeyType::texts,
     .member = to<&Task::avoid>(),
     .fallback = "none",
     .meaning = "Bodies that pieces must not touch: touches are counted."},
};

constexpr Key kTaskGoalKeys[] = {
    {.name = "name", .type = KeyType::text, .member = to<&TaskGoal::name>(), .fallback = "of piece and place"},
    {.name = "piece",
     .type = KeyType::text,
     .member = to<&TaskGoal::piece>(),
     .fallback = "one of `pieces`",
     .meaning = "Body that belongs there."},
    {.name = "pieces",
     .type = KeyType::texts,
     .member = to<&TaskGoal::pieces>(),
     .fallback = "`piece`",
     .meaning = "Instead of `piece`: bodies of which any one belongs there."},
    {.name = "point",
     .type = KeyType::vector,
     .member = to<&TaskGoal::point>(),
     .unit = "m",
     .meaning = "Of the piece, in its (mesh) frame, that comes to the place."},
    {.name = "puncture",
     .type = KeyType::choice,
     .member = to<&TaskGoal::puncture>(),
     .fallback = "none: the point counts",
     .meaning = "Instead of the point: where the needle on the piece went into tissue (in) or came out of it (out). In "
                "the frame of a soft body: there in the tissue as loaded.",
     .words = kPunctures},
    {.name = "place",
     .type = KeyType::text,
     .member = to<&TaskGoal::place>(),
     .fallback = "the task",
     .meaning = "Object in whose (mesh) frame `location` is."},
    {.name = "location",
     .type = KeyType::map,
     .member = to<&TaskGoal::T_place_goal>(),
     .meaning = "Where the piece belongs.",
     .sub = &kPose},
    {.name = "position tolerance",
     .type = KeyType::number_or_vector,
     .unit = "m",
     .fallback = "none: only `sensor` counts",
     .meaning = "How far off the point may be along each axis of the place, both ways.",
     .rule = Rule::not_negative},
    {.name = "angle tolerance",
     .type = KeyType::number,
     .member = to<&TaskGoal::angle_tolerance_rad>(),
     .unit = "rad",
     .fallback = "none: any orientation",
     .meaning = "How far the piece may be turned from the place.",
     .rule = Rule::not_negative},
    {.name = "axis",
     .type = KeyType::vector,
     .fallback = "none: the whole orientation counts",
     .meaning = "Only this axis, the same in both frames, must agree: of pieces that may turn about it."},
    {.name = "either way",
     .type = KeyType::boolean,
     .member = to<&TaskGoal::either_way>(),
     .meaning = "The axis may also point the other way: upside down counts."},
    {.name = "sensor",
     .type = KeyType::text,
     .member = to<&TaskGoal::sensor>(),
     .fallback = "none",
     .meaning = "Sensor that must match the piece (with a `matching key`), or else sense it."},
    {.name = "hold",
     .type = KeyType::number,
     .member = to<&TaskGoal::hold_s>(),
     .unit = "s",
     .meaning = "How long all that must last.",
     .rule = Rule::not_negative},
    {.name = "released",
     .type = KeyType::boolean,
     .member = to<&TaskGoal::released>(),
     .meaning = "No holder touches the piece."},
    {.name = "held by",
     .type = KeyType::text,
     .member = to<&TaskGoal::held_by>(),
     .fallback = "nobody",
     .meaning = "One of the holders, which must hold the piece; then `released` does not count."},
    {.name = "hand over",
     .type = KeyType::boolean,
     .member = to<&TaskGoal::hand_over>(),
     .meaning = "One holder must have passed the piece to another one in the air, since it was last grasped."},
};

constexpr const Group* kIdentityOnly[] = {&kIdentity};

}  // namespace

const Group kTask{.title = "task",
                  .meaning = "Pieces and where they belong; judged in every step (tasks.md).",
                  .keys = kTaskKeys,
                  .includes = kIdentityOnly,
                  .is_block = true};

const Group kTaskGoal{.title = "goals of a task", .keys = kTaskGoalKeys};

}  // namespace ambf::scene::group

namespace ambf::scene::kind {

const BlockKind kTask{.group = &group::kTask,
                      .list = {.name = "tasks", .type = KeyType::texts, .meaning = "Task blocks."},
                      .prefix = "TASK ",
                      .simulated = true};

}  // namespace ambf::scene::kind
