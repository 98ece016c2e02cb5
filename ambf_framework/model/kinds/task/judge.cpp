// The judge of tasks: who holds which piece, what was handed over, dropped or touched, and which goals are met. It
// looks at the contacts and poses of the step that was just made.
#include <algorithm>
#include <bit>
#include <cmath>

#include "model/kinds/held.h"
#include "model/kinds/sensor.h"
#include "model/kinds/task/detail/live_task.h"
#include "physics/needle.h"
#include "state/actuators.h"
#include "state/soft_bodies.h"

namespace ambf::model {
namespace {

// Two bodies of a holder grip a piece when the directions in which they press differ by more than this angle's cosine:
// 120 degrees.
constexpr double kOpposed = -0.5;
constexpr std::size_t kMaxPresses = 512;

const state::TaskInfo& info_of(const LiveWorld::Impl& live, std::uint32_t slot) {
  return state::tasks(*live.structure)[slot];
}

const physics::Body* body_at(const LiveWorld::Impl& live, std::uint32_t slot) {
  return slot == state::kNone ? nullptr : live.tables.bodies()[slot].body.get();
}

// ---- what a step's contacts say ----

void press(LiveTask& task, std::uint32_t piece, std::uint32_t holder, std::uint32_t body, const math::Vec3& direction) {
  WatchedPiece& pressed = task.pieces[piece];
  pressed.touching |= 1U << holder;
  for (const Press& other : task.presses) {
    const bool is_pair = other.piece == piece && other.holder == holder && other.body != body;
    if (is_pair && math::dot(other.towards_piece, direction) < kOpposed) pressed.gripping |= 1U << holder;
  }
  if (task.presses.size() < task.presses.capacity()) task.presses.push_back({piece, holder, body, direction});
}

void note_contact(LiveTask& task, std::uint32_t piece_body, std::uint32_t other, const math::Vec3& towards_piece) {
  const std::uint32_t piece = task.piece_of[piece_body];
  if (piece == state::kNone) return;
  if (task.holder_of[other] != state::kNone) {
    press(task, piece, task.holder_of[other], other, towards_piece);
  } else {
    task.pieces[piece].supported = true;
  }
  if (task.avoided[other]) task.pieces[piece].touches_avoided = true;
}

void look_at_contacts(const LiveWorld::Impl& live, std::size_t contacts, LiveTask& task) {
  for (WatchedPiece& piece : task.pieces) {
    piece.gripping = piece.touching = 0;
    piece.supported = piece.touches_avoided = false;
  }
  task.presses.clear();
  for (std::size_t i = 0; i < contacts; ++i) {
    const physics::Contact& contact = live.contacts[i];
    if (contact.distance > 0.0 && contact.normal_impulse <= 0.0) continue;
    const std::uint32_t a = contact.body_a->user_index(), b = contact.body_b->user_index();
    note_contact(task, a, b, contact.normal_on_b);
    note_contact(task, b, a, -contact.normal_on_b);
  }
}

void look_at_actuators(const LiveWorld::Impl& live, LiveTask& task) {
  for (std::uint32_t slot = 0; slot < state::actuators(*live.structure).size(); ++slot) {
    const HeldBodies held = held_by(live, slot);
    if (held.holder == state::kNone || task.holder_of[held.holder] == state::kNone) continue;
    for (std::uint32_t i = 0; i < held.count; ++i) {
      const std::uint32_t piece = task.piece_of[held.bodies[i]];
      if (piece == state::kNone) continue;
      task.pieces[piece].gripping |= 1U << task.holder_of[held.holder];
      task.pieces[piece].touching |= 1U << task.holder_of[held.holder];
    }
  }
}

// ---- where pieces are ----

struct Offset {
  bool known = false;
  math::Vec3 position;  // of the goal's point in the place
  math::Quat orientation;
};

math::Pose place_of(const LiveWorld::Impl& live, std::uint32_t slot, const state::TaskGoal& goal) {
  return live.pose_of(goal.at_task ? info_of(live, slot).object : goal.place_object);
}

// Of needles on the piece the puncture that is nearest to the goal. Where a soft body is now is much to work out, and
// does not count.
Offset puncture_offset(const LiveWorld::Impl& live, std::uint32_t slot, const state::TaskGoal& goal,
                       const physics::Body& piece) {
  const bool in_tissue =
      !goal.at_task && live.structure->objects[goal.place_object].kind == state::soft_body_kind().kind;
  const std::uint32_t tissue = in_tissue ? live.structure->objects[goal.place_object].slot : state::kNone;
  const math::Pose T_place = in_tissue ? math::Pose{} : place_of(live, slot, goal);
  const math::Pose to_goal = math::inverse(T_place * goal.T_place_goal);
  Offset nearest;
  for (std::uint32_t i = 0; i < state::actuators(*live.structure).size(); ++i) {
    const physics::Needle* needle = needle_of(live, i);
    if (needle == nullptr || needle->holder() != &piece) continue;
    for (const physics::SurfacePuncture& each : needle->on_surfaces()) {
      if (each.out != (goal.puncture == state::HeldNode::Puncture::out)) continue;
      if (in_tissue && each.body->user_index() != tissue) continue;
      const math::Vec3 at = to_goal * (in_tissue ? each.rest : each.needle);
      if (!nearest.known || math::norm(at) < math::norm(nearest.position)) nearest = {true, at, {}};
    }
  }
  return nearest;
}

Offset offset_of(const LiveWorld::Impl& live, std::uint32_t slot, const state::TaskGoal& goal, std::uint32_t index) {
  const physics::Body* piece = body_at(live, info_of(live, slot).pieces[index].body);
  if (piece == nullptr || (!goal.at_task && goal.place_object == state::kNone)) return {};
  if (goal.puncture != state::HeldNode::Puncture::none) return puncture_offset(live, slot, goal, *piece);
  const math::Pose T_goal_piece = math::inverse(place_of(live, slot, goal) * goal.T_place_goal) * piece->pose();
  return {true, T_goal_piece * goal.point, T_goal_piece.orientation};
}

double angle_of(const state::TaskGoal& goal, const math::Quat& q) {
  if (!goal.axis) return 2.0 * std::acos(std::min(1.0, std::abs(q.w)));
  const double cosine = std::clamp(math::dot(*goal.axis, math::rotate(q, *goal.axis)), -1.0, 1.0);
  return std::acos(goal.either_way ? std::abs(cosine) : cosine);
}

bool is_within(const math::Vec3& d, const math::Vec3& tolerance) {
  return std::abs(d.x) <= tolerance.x && std::abs(d.y) <= tolerance.y && std::abs(d.z) <= tolerance.z;
}

// A piece that falls there falls onto one of the places where it is to be let go, as a ring that slides down its peg.
bool is_over_its_place(const LiveWorld::Impl& live, std::uint32_t slot, std::uint32_t piece) {
  for (const state::TaskGoal& goal : info_of(live, slot).goals) {
    const bool is_its = std::find(goal.pieces.begin(), goal.pieces.end(), piece) != goal.pieces.end();
    if (!is_its || !goal.tolerance_m || goal.held_by != state::kNone) continue;
    const Offset offset = offset_of(live, slot, goal, piece);
    if (offset.known && std::abs(offset.position.x) <= goal.tolerance_m->x &&
        std::abs(offset.position.y) <= goal.tolerance_m->y)
      return true;
  }
  return false;
}

// ---- holds, hand-overs, drops ----

void follow_holders(LiveTask& task, WatchedPiece& piece, std::uint32_t let_go_steps) {
  const std::uint32_t before = piece.held_by;
  piece.held_by = piece.touched_by = 0;
  for (std::uint32_t holder = 0; holder < piece.gripped.size(); ++holder) {
    piece.gripped[holder].pass((piece.gripping >> holder & 1U) != 0);
    piece.touched[holder].pass((piece.touching >> holder & 1U) != 0);
    if (piece.gripped[holder].within(let_go_steps)) piece.held_by |= 1U << holder;
    if (piece.touched[holder].within(let_go_steps)) piece.touched_by |= 1U << holder;
  }
  if (piece.held_by == 0) {
    if (before != 0) piece.let_go = true;
    return;
  }
  if (before == 0) {
    piece.alone = state::kNone;
    piece.passed_in_air = false;
    piece.hand_overs = 0;
  }
  piece.let_go = false;
  if (!std::has_single_bit(piece.held_by)) {
    piece.passed_in_air |= !piece.supported;
    return;
  }
  const auto holder = static_cast<std::uint32_t>(std::countr_zero(piece.held_by));
  if (piece.alone != state::kNone && piece.alone != holder && piece.passed_in_air) {
    ++piece.hand_overs;
    ++task.hand_overs;
  }
  piece.alone = holder;
  piece.passed_in_air = false;
}

void follow_fall(const LiveWorld::Impl& live, std::uint32_t slot, std::uint32_t index, LiveTask& task) {
  WatchedPiece& piece = task.pieces[index];
  const state::TaskInfo& info = info_of(live, slot);
  const physics::Body* body = body_at(live, info.pieces[index].body);
  if (body == nullptr) return;
  const double height = body->com_pose().position.z;
  if (piece.gripping != 0) piece.height_m = height;
  if (!piece.let_go || height > piece.height_m - info.drop_height_m) return;
  piece.let_go = false;
  if (is_over_its_place(live, slot, index)) return;
  ++piece.drops;
  ++task.drops;
}

void follow_touches(LiveTask& task, WatchedPiece& piece, std::uint32_t let_go_steps) {
  if (piece.touches_avoided && !piece.avoided.within(let_go_steps)) ++task.touches;
  piece.avoided.pass(piece.touches_avoided);
}

// ---- goals ----

bool sensor_agrees(const LiveWorld::Impl& live, const state::TaskGoal& goal, std::uint32_t body) {
  if (!goal.needs_sensor) return true;
  if (goal.sensor == state::kNone || body == state::kNone) return false;
  const LiveSensor& sensor = sensor_at(live, goal.sensor);
  if (!state::sensors(*live.structure)[goal.sensor].matching_key.empty())
    return sensor.judgement.matched &&
           sensor.judgement.partner == live.structure->objects[live.structure->bodies[body].object].id;
  const physics::Body* piece = body_at(live, body);
  return std::any_of(sensor.hits.begin(), sensor.hits.end(),
                     [piece](const ElementHit& hit) { return hit.body == piece; });
}

bool is_met_by(const LiveWorld::Impl& live, std::uint32_t slot, const state::TaskGoal& goal, std::uint32_t index) {
  const WatchedPiece& piece = task_at(live, slot).pieces[index];
  const Offset offset = offset_of(live, slot, goal, index);
  if (!offset.known) return false;
  if (goal.tolerance_m && !is_within(offset.position, *goal.tolerance_m)) return false;
  if (goal.angle_tolerance_rad && angle_of(goal, offset.orientation) > *goal.angle_tolerance_rad) return false;
  if (goal.held_by != state::kNone) {
    if ((piece.held_by >> goal.held_by & 1U) == 0) return false;
  } else if (goal.released && piece.touched_by != 0) {
    return false;
  }
  if (goal.hand_over && piece.hand_overs == 0) return false;
  return sensor_agrees(live, goal, info_of(live, slot).pieces[index].body);
}

bool is_met(const LiveWorld::Impl& live, std::uint32_t slot, const state::TaskGoal& goal) {
  return std::any_of(goal.pieces.begin(), goal.pieces.end(),
                     [&](std::uint32_t piece) { return is_met_by(live, slot, goal, piece); });
}

// Half a step: a time in seconds is no whole number of them in binary.
bool lasts(const WatchedGoal& goal, double hold_s, double h_s) {
  return goal.held_steps > 0 && (static_cast<double>(goal.held_steps) + 0.5) * h_s >= hold_s;
}

void judge_any(const state::TaskInfo& info, LiveTask& task, double h_s) {
  for (std::size_t i = 0; i < task.goals.size(); ++i)
    task.goals[i].done = lasts(task.goals[i], info.goals[i].hold_s, h_s);
}

// Of a goal whose turn it is not, or was: whether it was brought about in the meantime.
void watch_out_of_turn(LiveTask& task, WatchedGoal& goal, double hold_s, double h_s) {
  if (goal.held_steps == 0) {
    goal.unmet_before = true;
    goal.strayed = false;
  } else if (goal.unmet_before && !goal.strayed && lasts(goal, hold_s, h_s)) {
    goal.strayed = true;
    ++task.wrong_order;
  }
}

void judge_listed(const state::TaskInfo& info, LiveTask& task, double h_s) {
  std::size_t turn = 0;
  while (turn < task.goals.size() && task.goals[turn].done) ++turn;
  if (turn == task.goals.size()) return;
  for (std::size_t i = turn + 1; i < task.goals.size(); ++i)
    watch_out_of_turn(task, task.goals[i], info.goals[i].hold_s, h_s);
  WatchedGoal& goal = task.goals[turn];
  if (goal.held_steps == 0) goal.armed = true;
  goal.done = goal.armed && lasts(goal, info.goals[turn].hold_s, h_s);
}

void judge(LiveWorld::Impl& live, std::uint32_t slot, std::size_t contacts) {
  const state::TaskInfo& info = info_of(live, slot);
  const double h_s = live.physics->options().step;
  const auto let_go_steps = static_cast<std::uint32_t>(std::lround(state::kLetGo_s / h_s));
  LiveTask& task = task_at(live, slot);
  look_at_contacts(live, contacts, task);
  look_at_actuators(live, task);
  for (std::uint32_t i = 0; i < task.pieces.size(); ++i) {
    follow_holders(task, task.pieces[i], let_go_steps);
    follow_fall(live, slot, i, task);
    follow_touches(task, task.pieces[i], let_go_steps);
  }
  for (std::size_t i = 0; i < task.goals.size(); ++i) {
    const bool met = is_met(live, slot, info.goals[i]);
    task.goals[i].held_steps = met ? task.goals[i].held_steps + 1 : 0;
  }
  if (info.order == state::TaskOrder::any) {
    judge_any(info, task, h_s);
  } else {
    judge_listed(info, task, h_s);
  }
  const bool success = std::all_of(task.goals.begin(), task.goals.end(), [](const auto& goal) { return goal.done; });
  if (!task.completed) ++task.steps;
  if (success != task.success) task.success_since_s = success ? live.sim_time : 0.0;
  task.success = success;
  task.completed |= success;
  measure(live, slot);
}

}  // namespace

void find_bodies(const LiveWorld::Impl& live, std::uint32_t slot) {
  const state::Structure& structure = *live.structure;
  const state::TaskInfo& info = info_of(live, slot);
  LiveTask& task = task_at(live, slot);
  task.piece_of.assign(structure.bodies.size(), state::kNone);
  task.holder_of.assign(structure.bodies.size(), state::kNone);
  task.avoided.assign(structure.bodies.size(), false);
  task.presses.reserve(kMaxPresses);
  // The largest first: of a body that two holders carry it is the nearer one's.
  std::vector<std::uint32_t> by_size;
  for (std::uint32_t i = 0; i < info.holders.size(); ++i)
    if (info.holders[i].body != state::kNone) by_size.push_back(i);
  std::stable_sort(by_size.begin(), by_size.end(), [&](std::uint32_t a, std::uint32_t b) {
    return structure.bodies[info.holders[a].body].children.size() >
           structure.bodies[info.holders[b].body].children.size();
  });
  for (const std::uint32_t i : by_size) {
    const std::uint32_t root = info.holders[i].body;
    task.holder_of[root] = i;
    for (const std::uint32_t object : structure.bodies[root].children)
      task.holder_of[structure.objects[object].slot] = i;
  }
  for (std::uint32_t i = 0; i < info.pieces.size(); ++i) {
    if (info.pieces[i].body == state::kNone) continue;
    task.piece_of[info.pieces[i].body] = i;
    task.holder_of[info.pieces[i].body] = state::kNone;
  }
  for (const std::uint32_t body : info.avoided)
    if (body != state::kNone) task.avoided[body] = true;
}

void measure(const LiveWorld::Impl& live, std::uint32_t slot) {
  const state::TaskInfo& info = info_of(live, slot);
  LiveTask& task = task_at(live, slot);
  for (std::size_t i = 0; i < task.goals.size(); ++i) {
    Offset nearest;
    for (const std::uint32_t piece : info.goals[i].pieces) {
      const Offset offset = offset_of(live, slot, info.goals[i], piece);
      const bool is_nearer = !nearest.known || math::norm(offset.position) < math::norm(nearest.position);
      if (offset.known && is_nearer) nearest = offset;
    }
    task.goals[i].distance_m = nearest.known ? math::norm(nearest.position) : 0.0;
    task.goals[i].angle_rad = nearest.known ? angle_of(info.goals[i], nearest.orientation) : 0.0;
  }
}

void judge_tasks(LiveWorld::Impl& live) {
  const auto tasks = static_cast<std::uint32_t>(live.tables.of(state::task_kind().kind).size());
  if (tasks == 0) return;
  const std::size_t contacts = std::min(live.physics->contacts(live.contacts), live.contacts.size());
  for (std::uint32_t slot = 0; slot < tasks; ++slot) judge(live, slot, contacts);
}

}  // namespace ambf::model
