// Joints: they connect two bodies. Their commands come with those of a body above them (model/live_commands.cpp).
#include "math/rotation.h"
#include "model/kinds/placed.h"
#include "model/kinds/registry.h"
#include "model/kinds/saved_controllers.h"

namespace ambf::model {
namespace {

using state::JointCommandType;
using state::JointType;
using state::ObjectKind;

bool has_coordinate(JointType type) {
  return type == JointType::revolute || type == JointType::prismatic || type == JointType::linear_spring ||
         type == JointType::torsion_spring;
}

// Reaction of a joint, at the COM in world axes, added to a body's published wrench in body axes.
void add_reaction(state::BodyState& body, const math::Wrench& reaction_world) {
  const math::Quat R_body_world = math::inverse(body.T_world_body.orientation);
  body.wrench_body.force += math::rotate(R_body_world, reaction_world.force);
  body.wrench_body.torque += math::rotate(R_body_world, reaction_world.torque);
}

struct SavedJoint final : SavedObject {
  state::JointParameters parameters;
  bool hold = false;
  JointController::State controller;
  JointCommandType type = JointCommandType::none;
  double value = 0.0;
  std::uint64_t order = 0;  // of the leading slot; 0: no source leads
};

class JointKind final : public Kind {
 public:
  JointKind() : Kind(ObjectKind::joint) {}

  void load(Catalogue::Impl& all, const LoadedModel& model, const LoadOptions& options,
            Findings& findings) const override {
    std::vector<std::pair<const scene::Joint*, Entry*>> followers;
    for (const scene::Joint& joint : model.description.joints) {
      Entry* entry = load_joint(all, joint, model, options, findings);
      if (entry != nullptr && !joint.mimic.joint.empty()) followers.emplace_back(&joint, entry);
    }
    // A leader may be described after its follower.
    for (const auto& [joint, entry] : followers) follow(all, *joint, *entry, findings);
  }
  void erase_block(scene::Model& model, const std::string& identifier) const override {
    model::erase_block(model.joints, identifier);
  }
  void add_row(const Entry& entry, const StructureDraft& draft, state::Structure& structure) const override {
    state::JointInfo row = entry.row_as<state::JointInfo>();
    row.object = draft.object(&entry);
    row.parent_body = entry.parent->info.slot;
    row.child_body = entry.child->info.slot;
    structure.joints.push_back(std::move(row));
  }

  void link(LiveWorld::Impl& live, std::uint32_t slot, bool is_new) const override {
    if (is_new) live.physics->add(*self(live, slot).joint);
  }
  void unlink(LiveWorld::Impl& live, std::uint32_t slot) const override {
    live.physics->remove(*self(live, slot).joint);
  }

  // After the bodies, to whose wrenches it adds.
  void fill(const LiveWorld::Impl& live, state::Frame& frame) const override {
    for (std::uint32_t slot = 0; slot < frame.joints.size(); ++slot) {
      const LiveJoint& joint = self(live, slot);
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
  }
  void fill_parameters(const LiveWorld::Impl& live, state::Frame& frame) const override {
    for (std::uint32_t slot = 0; slot < frame.joint_parameters.size(); ++slot)
      frame.joint_parameters[slot] = parameters_of(self(live, slot));
  }
  std::optional<math::Vec3> set_parameter(LiveWorld::Impl& live, std::uint32_t slot, state::Parameter parameter,
                                          const math::Vec3& value) const override {
    LiveJoint& joint = self(live, slot);
    state::JointParameters parameters = parameters_of(joint);
    set_value(parameters, parameter, value);
    set_parameters(joint, parameters);
    return value_of(parameters_of(joint), parameter);
  }

  void reset_parameters(LiveWorld::Impl& live, std::uint32_t slot) const override {
    set_parameters(self(live, slot), live.structure->joints[slot].parameters);
    self(live, slot).hold = self(live, slot).hold_loaded;
  }
  void reset(LiveWorld::Impl& live, std::uint32_t slot) const override { LiveWorld::Impl::let_idle(self(live, slot)); }

  std::unique_ptr<SavedObject> make_saved() const override { return std::make_unique<SavedJoint>(); }
  void save(const LiveWorld::Impl& live, std::uint32_t slot, SavedObject& saved) const override {
    const LiveJoint& joint = self(live, slot);
    auto& to = static_cast<SavedJoint&>(saved);
    to.parameters = parameters_of(joint);
    to.hold = joint.hold;
    to.controller = joint.controller.state();
    to.type = joint.order.type;
    to.value = joint.order.value;
    to.order = joint.order.led == nullptr ? 0 : joint.order.led->order;
  }
  void transfer(StateArchive& archive, SavedObject& saved, const SavedContext& context) const override {
    auto& joint = static_cast<SavedJoint&>(saved);
    transfer_parameters(archive, joint.parameters, number());
    archive.flag(joint.hold, "whether it holds its target");
    transfer_controller(archive, joint.controller);
    archive.choice(joint.type, static_cast<int>(JointCommandType::none), static_cast<int>(JointCommandType::velocity),
                   "the type of the joint's command");
    archive.number(joint.value, -kMaxCommanded, kMaxCommanded, "the joint's command");
    archive.count(joint.order, 0, context.last_order, "the order of the joint's command");
  }
  using Kind::transfer;
  // After the bodies, whose commands lead it.
  void restore(LiveWorld::Impl& live, std::uint32_t slot, const SavedObject& saved) const override {
    LiveJoint& joint = self(live, slot);
    const auto& from = static_cast<const SavedJoint&>(saved);
    set_parameters(joint, from.parameters);
    joint.hold = from.hold;
    joint.controller.set_state(from.controller);
    joint.order = {from.type, from.value, live.commands.leading_slot(from.order)};
  }

 private:
  LiveJoint& self(const LiveWorld::Impl& live, std::uint32_t slot) const { return live.tables.joints()[slot]; }

  // Null: it is left out.
  Entry* load_joint(Catalogue::Impl& all, const scene::Joint& joint, const LoadedModel& model, const LoadOptions& load,
                    Findings& findings) const {
    Entry* entry =
        all.add_entry(number(), joint.identity, model.info.id, all.full_namespace(joint.identity, load), findings);
    if (entry == nullptr) return nullptr;
    const auto leave_out = [&] {
      all.names.release(number(), entry->info.identifier, entry->info.name);
      all.free_indices.push_back(entry->info.id.index);
      all.entries.pop_back();
      return static_cast<Entry*>(nullptr);
    };
    Entry* parent = all.find_body(joint.parent, *entry, "parent", joint.identity, findings);
    Entry* child = all.find_body(joint.child, *entry, "child", joint.identity, findings);
    if (parent == nullptr || child == nullptr) return leave_out();
    if (parent == child) {
      findings.error(joint.identity, "child", "parent and child are the same body: " + parent->info.identifier,
                     "a joint needs two bodies; it is left out");
      return leave_out();
    }
    if (parent->row_as<state::BodyInfo>().mass == 0.0 && child->row_as<state::BodyInfo>().mass == 0.0)
      findings.warning(joint.identity, "parent", "both bodies are static: the joint moves nothing",
                       "give one of them a mass");
    scene::Joint described = joint;
    for (math::Vec3* axis : {&described.parent_axis, &described.child_axis}) {
      if (joint.type == JointType::p2p || math::norm(*axis) > 1e-9) {
        *axis = math::normalized(*axis);
        continue;
      }
      findings.error(joint.identity, axis == &described.parent_axis ? "parent axis" : "child axis", "has no length",
                     "give a direction; the joint is left out");
      return leave_out();
    }

    physics::JointOptions physics_options;
    physics_options.parent_scale = parent->scale;
    physics_options.child_scale = child->scale;
    physics_options.erp = model.description.joint_erp.value_or(physics_options.erp);
    physics_options.cfm = model.description.joint_cfm.value_or(physics_options.cfm);
    auto physics_joint =
        std::make_unique<physics::Joint>(described, *parent->physics_body, *child->physics_body, physics_options);

    entry->parent = parent;
    entry->child = child;
    entry->physics_joint = physics_joint.get();
    state::JointInfo row;
    row.type = joint.type;
    row.name = joint.identity.name;
    row.passive = joint.identity.passive;
    row.has_limits = joint.limits.has_value();
    if (joint.limits) {
      row.lower = (*joint.limits)[0];
      row.upper = (*joint.limits)[1];
    }
    row.pivot_parent = joint.parent_pivot * parent->scale;
    row.axis_parent = described.parent_axis;

    if (joint.type == JointType::cone_twist || joint.type == JointType::six_dof ||
        joint.type == JointType::six_dof_spring) {
      const scene::SixDofLimits& range = joint.six_dof;
      row.span = std::make_shared<const state::JointSpan>(
          state::JointSpan{physics_joint->frame_in_parent(), physics_joint->frame_in_child(), joint.cone_limits,
                           range.linear_low, range.linear_high, range.angular_low, range.angular_high});
    }

    const bool continuous = joint.type == JointType::revolute && !joint.limits;
    auto made = std::make_unique<LiveJoint>(std::move(physics_joint), JointController(joint.controller, continuous));
    LiveJoint& live = *made;
    live.feedback = joint.enable_feedback;
    live.hold = live.hold_loaded = joint.hold;
    row.parameters = parameters_of(live);
    row.output = joint.controller.output;
    // A joint that is controlled through its motor is held by it from the start; one that is controlled by effort, or
    // is passive, follows another joint, or is a spring, moves freely until it is commanded.
    live.motor_holds = joint.enable_motor && !joint.identity.passive && has_coordinate(joint.type) &&
                       (joint.type == JointType::revolute || joint.type == JointType::prismatic) &&
                       joint.controller.output != scene::ControllerOutput::force && joint.mimic.joint.empty();
    if (live.motor_holds) live.joint->set_motor_velocity(0.0);
    if (joint.controller.output == scene::ControllerOutput::position)
      findings.information(joint.identity, "controller output type",
                           "joints have no position output; velocity does it");
    entry->row = std::move(row);
    entry->live = std::move(made);
    all.lineage.add(entry->info.id.index, parent->info.id.index, child->info.id.index);
    return entry;
  }

  void follow(Catalogue::Impl& all, const scene::Joint& joint, Entry& entry, Findings& findings) const {
    const auto refuse = [&](const std::string& why, const std::string& hint) {
      findings.error(joint.identity, "mimic", why, hint + "; it moves freely");
    };
    Entry* leader = all.find_joint(joint.mimic.joint, entry);
    if (leader == nullptr || !has_coordinate(leader->row_as<state::JointInfo>().type))
      return refuse("there is no joint with one coordinate \"" + joint.mimic.joint + "\", or several fit",
                    "give the name of its block");
    for (const Entry* above = leader; above != nullptr; above = above->followed) {
      if (above == &entry) return refuse("it would follow itself", "let one joint of the circle lead");
    }
    entry.followed = leader;
    // Of other files there are but names where a load is only checked.
    if (leader->physics_joint == nullptr) return;
    static_cast<LiveJoint&>(*entry.live)
        .joint->follow(*leader->physics_joint, joint.mimic.multiplier, joint.mimic.offset);
  }
};

}  // namespace

std::unique_ptr<Kind> make_joint_kind() { return std::make_unique<JointKind>(); }

TypedTable<LiveJoint> LiveTables::joints() const { return TypedTable<LiveJoint>(of(ObjectKind::joint)); }

}  // namespace ambf::model
