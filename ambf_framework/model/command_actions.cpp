// LiveCommands::act, what becomes of commands to bodies that are frozen, and what is forgotten.
#include <algorithm>
#include <cmath>

#include "base/limits.h"
#include "math/rotation.h"
#include "model/detail/command_bounds.h"
#include "model/detail/live_commands.h"
#include "model/detail/live_impl.h"
#include "model/kinds/kind.h"
#include "model/kinds/registry.h"
#include "state/kind_rows.h"

namespace ambf::model {
namespace {

using state::CartesianCommandType;
using state::JointCommandType;

// Targets farther away than what is reached in this time are beyond the bounds; nearer ones are reached with stiff
// gains at the speed of the bound, which is no reason to warn.
constexpr double kReachableWithin_s = 1.0;

bool reachable(double way) { return std::abs(way) <= base::kMaxCommandedSpeed * kReachableWithin_s; }

// As of commands that only set joints.
bool is_zero(const math::Wrench& wrench) { return wrench.force == math::Vec3{} && wrench.torque == math::Vec3{}; }

// The body that stands for a joint in its bounds; null when both are static.
LiveBody* moved_by(const LiveJoint& live, const TypedTable<LiveBody>& bodies) {
  physics::Joint& joint = *live.joint;
  for (const physics::Body* body : {&joint.child(), &joint.parent()})
    if (!body->is_static()) return &bodies[body->user_index()];
  return nullptr;
}

bool within_bounds(const LiveBody& live, const state::RigidBodyCommand& command, double h_s) {
  CommandBound bound(live, h_s);
  switch (command.type) {
    case CartesianCommandType::none: return false;  // it commands joints only
    case CartesianCommandType::force:
      if (is_zero(command.wrench_world) && !command.joints.empty()) return false;
      bound.wrench(command.wrench_world);
      break;
    case CartesianCommandType::velocity:
      bound.velocity(command.twist_world.linear);
      bound.velocity(command.twist_world.angular);
      break;
    case CartesianCommandType::position:
      return reachable(math::norm(command.T_world_body.position - live.body->pose().position));
  }
  return !bound.cut();
}

bool within_bounds(const LiveBody& live, const physics::Joint& joint, const state::JointCommand& command, double h_s) {
  CommandBound bound(live, h_s);
  switch (command.type) {
    case JointCommandType::none: return false;
    case JointCommandType::effort: bound.effort(joint, command.value); break;
    case JointCommandType::velocity: bound.rate(command.value); break;
    case JointCommandType::position: return reachable(command.value - joint.position());
  }
  return !bound.cut();
}

}  // namespace

void LiveCommands::act(double h_s) {
  obey_waiting();
  act_on_joints(h_s);
  for (const ObjectRef object : tables_.commanded) {
    if (!state::info_of(object.kind).has_mass) continue;
    LiveBody& live = tables_.bodies()[object.slot];
    if (live.body->is_static()) {
      act_on_static(live, *slots(object), h_s);
    } else if (!live.body->frozen()) {
      act_on_body(live, *slots(object), h_s);
    }
  }
}

void LiveCommands::act_on_joints(double h_s) {
  const TypedTable<LiveBody> bodies = tables_.bodies();
  for (LiveJoint& live : tables_.joints()) {
    const JointOrder& order = live.order;
    if (order.type == JointCommandType::none || live.joint->frozen()) continue;
    const LiveBody* moved = moved_by(live, bodies);
    if (moved == nullptr) continue;
    CommandBound bound(*moved, h_s);
    switch (order.type) {
      case JointCommandType::none: break;
      case JointCommandType::effort: live.joint->set_effort(bound.effort(*live.joint, order.value)); break;
      case JointCommandType::position: live.controller.drive_to(*live.joint, order.value, h_s, bound); break;
      case JointCommandType::velocity: live.joint->set_motor_velocity(bound.rate(order.value)); break;
    }
    if (!bound.cut() || order.led == nullptr) continue;
    if (order.type == JointCommandType::position && reachable(order.value - live.joint->position())) continue;
    count_cut(*order.led, moved->body->user_index());
  }
}

// Carried along, turning about its own origin; what is too far for that is put there, and carries nothing along.
void LiveCommands::act_on_static(LiveBody& live, CommandSlots& all, double h_s) {
  physics::Body& body = *live.body;
  const math::Pose now = body.pose();
  if (live.mode == CartesianCommandType::position) {
    if (math::norm(live.T_world_target.position - now.position) > base::kMaxCommandedSpeed * h_s) {
      body.set_pose(live.T_world_target);
    } else {
      body.move_to(live.T_world_target);
    }
  }
  if (live.mode == CartesianCommandType::velocity) {
    CommandBound bound(live, h_s);
    const math::Vec3 linear = bound.velocity(live.twist_world.linear);
    const math::Vec3 angular = bound.velocity(live.twist_world.angular);
    body.move_to({now.position + linear * h_s, math::normalized(math::exp(angular * h_s) * now.orientation)});
    if (bound.cut()) count_cut(*all.find(static_cast<int>(live.target_source)), body.user_index());
  }
}

void LiveCommands::act_on_body(LiveBody& live, CommandSlots& all, double h_s) {
  physics::Body& body = *live.body;
  // The sum is applied at once: wrenches that cancel out do not wake a sleeper.
  CommandBound of_forces(live, h_s);
  const math::Wrench wrench = of_forces.wrench(live.wrench_world);
  body.apply_wrench(wrench);
  const bool cut = of_forces.cut();
  all.each([&](int source, CommandSlot& slot) {
    if (!slot.in_force) return;
    const auto& command = std::get<state::RigidBodyCommand>(slot.command());
    if (command.type != CartesianCommandType::force || is_zero(command.wrench_world)) return;
    CommandBound alone(live, h_s);
    const math::Wrench share = cut ? alone.wrench(command.wrench_world) : command.wrench_world;
    live_.laws.add_share(live, static_cast<state::Source>(source), share);
    if (cut) count_cut(slot, body.user_index());
  });
  if (live.mode != CartesianCommandType::position && live.mode != CartesianCommandType::velocity) return;
  CommandBound of_motion(live, h_s);
  const math::Wrench share = live.mode == CartesianCommandType::position
                                 ? live.controller.drive_to(body, live.T_world_target, h_s, of_motion, live.gain_scale)
                                 : set_twist(body, {of_motion.velocity(live.twist_world.linear),
                                                    of_motion.velocity(live.twist_world.angular)});
  live_.laws.add_share(live, live.target_source, share);
  if (!of_motion.cut()) return;
  if (live.mode == CartesianCommandType::position &&
      reachable(math::norm(live.T_world_target.position - body.pose().position)))
    return;
  count_cut(*all.find(static_cast<int>(live.target_source)), body.user_index());
}

void LiveCommands::count_cut(CommandSlot& slot, std::uint32_t body) {
  ++slot.bounded;
  if (slot.bound_logged) return;
  slot.bound_logged = true;
  live_.report_cut(body, slot.source);
}

void LiveCommands::release_frozen(const state::Structure& structure, ObjectRef object, const CommandSlot& slot) {
  const double h_s = live_.physics->options().step;
  const auto& command = std::get<state::RigidBodyCommand>(slot.command());
  const TypedTable<LiveBody> bodies = tables_.bodies();
  const LiveBody& live = bodies[object.slot];
  if (live.body->frozen() && within_bounds(live, command, h_s)) live_.physics->release_frozen(*live.body);
  const auto& joints = structure.bodies[object.slot].joints;
  for (std::size_t i = 0; i < std::min(command.joints.size(), joints.size()); ++i) {
    const LiveJoint& joint = tables_.joints()[joints[i]];
    if (!joint.joint->frozen()) continue;
    const LiveBody* moved = moved_by(joint, bodies);
    if (moved != nullptr && within_bounds(*moved, *joint.joint, command.joints[i], h_s))
      live_.physics->release_frozen(*moved->body);
  }
}

template <class Spared>
void LiveCommands::forget(Spared&& spared) {
  for (LiveJoint& live : tables_.joints()) {
    live.order = {};
    live.controller.reset();
  }
  for (std::size_t i = tables_.commanded.size(); i-- > 0;) {  // merge() takes the object out
    const ObjectRef object = tables_.commanded[i];
    if (spared(object)) continue;
    slots(object)->each([](int, CommandSlot& slot) {
      slot.in_force = slot.from_snapshot = slot.held = false;
      slot.give_up_waiting();
    });
    merge(object);
  }
}

void LiveCommands::forget_all() {
  forget([](ObjectRef) { return false; });
}

void LiveCommands::forget_for_reset() {
  forget([](ObjectRef object) { return kind_of(object.kind).commands_outlive_reset(); });
}

}  // namespace ambf::model
