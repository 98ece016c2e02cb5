// LiveWorld::fill: from live objects to a frame.
#include "model/detail/live_impl.h"
#include "model/live_world.h"

namespace ambf::model {
namespace {

// Reaction of a joint, at the COM in world axes, added to a body's published wrench in body axes.
void add_reaction(state::BodyState& body, const math::Wrench& reaction_world) {
  const math::Quat R_body_world = math::inverse(body.T_world_body.orientation);
  body.wrench_body.force += math::rotate(R_body_world, reaction_world.force);
  body.wrench_body.torque += math::rotate(R_body_world, reaction_world.torque);
}

}  // namespace

void LiveWorld::fill(state::Frame& frame) const {
  const Impl& live = *impl_;
  const LiveTables& tables = live.tables;
  frame.sim_step = static_cast<std::uint32_t>(live.steps);
  frame.sim_time = live.sim_time;
  frame.epoch = live.epoch;

  for (std::size_t slot = 0; slot < tables.bodies.size(); ++slot) {
    const LiveBody& body = *tables.bodies[slot];
    state::BodyState& out = frame.bodies[slot];
    out.T_world_body = body.body->pose();
    out.twist_world = body.body->twist();
    out.wrench_body = {};
    out.active = body.active;
    out.asleep = body.body->asleep();
  }

  for (std::size_t slot = 0; slot < tables.joints.size(); ++slot) {
    const LiveJoint& joint = *tables.joints[slot];
    state::JointState& out = frame.joints[slot];
    out.position = joint.joint->position();
    out.velocity = joint.joint->velocity();
    out.effort = 0.0;
    out.commanded = joint.order.value;
    out.commanded_type = joint.order.type;
    if (!joint.feedback) continue;
    const state::JointInfo& info = live.structure->joints[slot];
    out.effort = joint.joint->effort();
    add_reaction(frame.bodies[info.parent_body], joint.joint->reaction_on_parent());
    add_reaction(frame.bodies[info.child_body], joint.joint->reaction_on_child());
  }

  for (std::size_t slot = 0; slot < tables.cameras.size(); ++slot) {
    const LivePlaced& camera = *tables.cameras[slot];
    state::CameraState& out = frame.cameras[slot];
    out.T_parent_camera = camera.T_parent;
    out.T_world_camera = live.pose_of(camera, live.structure->cameras[slot].parent_object);
    out.lens = camera.lens;
    out.active = camera.active;
  }
  for (std::size_t slot = 0; slot < tables.lights.size(); ++slot) {
    const LivePlaced& light = *tables.lights[slot];
    state::LightState& out = frame.lights[slot];
    out.T_parent_light = light.T_parent;
    out.T_world_light = live.pose_of(light, live.structure->lights[slot].parent_object);
    out.beam = light.beam;
    out.active = light.active;
  }

  const std::size_t total = live.physics->contacts(live.contacts);
  const std::size_t shown = std::min(total, live.contacts.size());
  frame.contacts_total = static_cast<std::uint32_t>(total);
  frame.contacts.resize(shown);  // within what make_frame reserved
  for (std::size_t i = 0; i < shown; ++i) {
    const physics::Contact& contact = live.contacts[i];
    frame.contacts[i] = {contact.body_a->user_index(),
                         contact.body_b->user_index(),
                         contact.point_on_b,
                         contact.normal_on_b,
                         contact.distance,
                         contact.normal_impulse,
                         contact.friction_impulse};
  }
  live.picks.fill(frame.picks);  // likewise
  frame.commands.resize(tables.noted.size());
  for (std::size_t i = 0; i < tables.noted.size(); ++i) live.commands.fill(i, *live.structure, frame.commands[i]);
  frame.run.watchdog_s = live.commands.watchdog_s();
  live.changed = false;
}

}  // namespace ambf::model
