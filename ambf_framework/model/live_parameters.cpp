// LiveWorld: what may be changed of bodies and joints while it runs, and pushes.
#include <algorithm>
#include <cmath>

#include "model/detail/command_bounds.h"
#include "model/detail/live_impl.h"
#include "model/kinds/kind.h"
#include "model/kinds/registry.h"
#include "model/live_world.h"

namespace ambf::model {

state::BodyParameters parameters_of(const LiveBody& live) {
  return {live.body->surface(), live.controller.linear(), live.controller.angular()};
}

// What stays as it is is not touched: nobody wakes, no contact is computed anew.
void set_parameters(LiveBody& live, const state::BodyParameters& wanted, double h_s) {
  const state::BodyParameters now = parameters_of(live);
  if (wanted == now) return;
  const auto differs = [&](state::Parameter first, state::Parameter last) {
    for (int i = static_cast<int>(first); i <= static_cast<int>(last); ++i) {
      const auto parameter = static_cast<state::Parameter>(i);
      if (!(value_of(wanted, parameter) == value_of(now, parameter))) return true;
    }
    return false;
  };
  if (differs(state::Parameter::friction, state::Parameter::angular_damping)) live.body->set_surface(wanted.surface);
  if (differs(state::Parameter::linear_p, state::Parameter::angular_d)) {
    live.controller.set_gains(wanted.linear, wanted.angular, *live.body, h_s);
  }
}

state::JointParameters parameters_of(const LiveJoint& live) { return {live.controller.gains(), live.joint->damping()}; }

void set_parameters(LiveJoint& live, const state::JointParameters& wanted) {
  const state::JointParameters now = parameters_of(live);
  if (wanted == now) return;
  live.controller.set_gains(wanted.gains);
  if (wanted.damping != now.damping) live.joint->set_damping(wanted.damping);
}

std::optional<math::Vec3> LiveWorld::set_parameter(state::ObjectId id, state::Parameter parameter,
                                                   const math::Vec3& value) {
  Impl& live = *impl_;
  const std::uint32_t object = state::find(*live.structure, id);
  if (object == state::kNone) return std::nullopt;
  const state::ObjectInfo& info = live.structure->objects[object];
  if (info.kind != state::info_of(parameter).kind) return std::nullopt;
  ++live.parameters_version;
  live.changed = true;
  return kind_of(info.kind).set_parameter(live, info.slot, parameter, value);
}

bool LiveWorld::set_hold(state::ObjectId id, bool hold) {
  Impl& live = *impl_;
  const std::uint32_t object = state::find(*live.structure, id);
  if (object == state::kNone) return false;
  const state::ObjectInfo& info = live.structure->objects[object];
  const state::KindInfo& kind = state::info_of(info.kind);
  if (!kind.connects_bodies && !kind.has_mass) return false;
  const ObjectRef ref{info.kind, info.slot};
  LiveObject& held = live.tables.at(ref);
  if (held.hold && !hold) live.commands.end_hold(*live.structure, ref);
  held.hold = hold;
  live.changed = true;
  return true;
}

// A frame is brought up to date once a change: the pool has few, and a run has few changes.
void LiveWorld::fill_parameters(state::Frame& frame) const {
  const Impl& live = *impl_;
  frame.gravity_world = live.physics->options().gravity;
  if (frame.parameters_version == live.parameters_version) return;
  for (const auto& kind : kinds()) kind->fill_parameters(live, frame);
  frame.parameters_version = live.parameters_version;
}

std::uint32_t LiveWorld::Impl::body_slot(state::ObjectId id) const {
  const std::uint32_t object = state::find(*structure, id);
  if (object == state::kNone || !state::info_of(structure->objects[object].kind).has_mass) return state::kNone;
  return structure->objects[object].slot;
}

void LiveWorld::Impl::each_object(void (Kind::*act)(Impl&, std::uint32_t) const) {
  for (const auto& kind : kinds())
    for (std::uint32_t slot = 0; slot < tables.of(kind->number()).size(); ++slot) ((*kind).*act)(*this, slot);
}

void LiveWorld::reset_bodies(const std::vector<state::ObjectId>& bodies) {
  Impl& live = *impl_;
  bool any = false;
  for (const state::ObjectId id : bodies) {
    const std::uint32_t slot = live.body_slot(id);
    if (slot == state::kNone) continue;
    any = true;
    LiveBody& body = live.tables.bodies()[slot];
    body.body->reset();
    body.controller.reset();
    body.push_steps = 0;
    live.effectors.end_of(body);
    const TypedTable<LiveJoint> joints = live.tables.joints();
    for (std::size_t i = 0; i < joints.size(); ++i) {
      if (live.structure->joints[i].parent_body != slot && live.structure->joints[i].child_body != slot) continue;
      joints[i].joint->reset();
      joints[i].controller.reset();
      Impl::let_idle(joints[i]);  // until a command that is still in force acts again
    }
  }
  if (!any) return;
  live.list_pushed();
  live.each_object(&Kind::bodies_reset);
  live.each_object(&Kind::all_placed);
  ++live.epoch;
  live.changed = true;
}

namespace {

math::Wrench push_wrench(const LiveBody& live, const state::Push& push) {
  const math::Wrench at_point = wrench_of(*live.body, push.force_world, live.body->pose() * push.point_body);
  return {at_point.force, at_point.torque + push.torque_world};
}

}  // namespace

bool LiveWorld::push(state::ObjectId id, const state::Push& push) {
  Impl& live = *impl_;
  const std::uint32_t slot = live.body_slot(id);
  if (slot == state::kNone) return false;
  LiveBody& body = live.tables.bodies()[slot];
  if (body.body->is_static()) return false;
  CommandBound bound(body, live.physics->options().step);
  bound.wrench(push_wrench(body, push));
  if (body.body->frozen() && !bound.cut()) live.physics->release_frozen(*body.body);
  body.push = push;
  body.push_steps = static_cast<std::uint64_t>(std::max(1.0, std::round(push.seconds / live.physics->options().step)));
  live.list_pushed();
  return true;
}

void LiveWorld::Impl::list_pushed() {
  pushed.clear();
  const TypedTable<LiveBody> bodies = tables.bodies();
  for (std::uint32_t slot = 0; slot < bodies.size(); ++slot)
    if (bodies[slot].push_steps > 0) pushed.push_back(slot);
}

void LiveWorld::Impl::end_pushes() {
  for (const std::uint32_t slot : pushed) tables.bodies()[slot].push_steps = 0;
  pushed.clear();
}

void LiveWorld::Impl::act_pushes(double h_s) {
  for (std::size_t i = pushed.size(); i-- > 0;) {
    LiveBody& live = tables.bodies()[pushed[i]];
    CommandBound bound(live, h_s);
    const math::Wrench wrench = bound.wrench(push_wrench(live, live.push));
    if (bound.cut()) report_cut(live, live.push.source);
    live.body->apply_wrench(wrench);
    laws.add_share(live, live.push.source, wrench);
    if (--live.push_steps == 0) pushed.erase(pushed.begin() + static_cast<std::ptrdiff_t>(i));
  }
}

}  // namespace ambf::model
