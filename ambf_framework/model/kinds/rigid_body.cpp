// Rigid bodies: what Bullet moves. Commands and controllers act on them in each step (model/live_commands.cpp).
#include <algorithm>
#include <cmath>
#include <limits>

#include "math/rotation.h"
#include "model/detail/view_builder.h"
#include "model/kinds/placed.h"
#include "model/kinds/registry.h"
#include "model/kinds/saved_controllers.h"

namespace ambf::model {
namespace {

using state::CartesianCommandType;
using state::JointCommandType;
using state::ObjectKind;

constexpr std::size_t kMaxEntries = 1u << 20;  // joints in one command
constexpr double kMaxPush_s = 1e5;             // state::check(Push)
constexpr double kFinite = std::numeric_limits<double>::max();

struct SavedBody final : SavedObject {
  state::BodyParameters parameters;
  bool hold = false;
  state::Push push;
  std::uint64_t push_steps = 0;  // 0: nothing pushes
  CartesianController::State controller;
  struct Share {
    state::Source source;
    math::Wrench wrench_world;
  };
  std::vector<Share> shares;  // of the last step
};

// Only what counts is kept; the rest may be anything.
void transfer_body_command(StateArchive& archive, state::RigidBodyCommand& command) {
  archive.choice(command.type, 0, static_cast<int>(CartesianCommandType::velocity), "the type of a command");
  switch (command.type) {
    case CartesianCommandType::none: break;
    case CartesianCommandType::force:
      transfer_vector(archive, command.wrench_world.force, kMaxCommanded, "a commanded force");
      transfer_vector(archive, command.wrench_world.torque, kMaxCommanded, "a commanded torque");
      break;
    case CartesianCommandType::position: transfer_pose(archive, command.T_world_body, 1e6, "a commanded pose"); break;
    case CartesianCommandType::velocity:
      transfer_vector(archive, command.twist_world.linear, 1e6, "a commanded velocity");
      transfer_vector(archive, command.twist_world.angular, 1e6, "a commanded velocity");
      break;
  }
  archive.size(command.joints, kMaxEntries, 1 + sizeof(double), "the number of commanded joints");
  for (state::JointCommand& joint : command.joints) {
    archive.choice(joint.type, static_cast<int>(JointCommandType::none), static_cast<int>(JointCommandType::velocity),
                   "the type of a joint's command");
    double value = joint.type == JointCommandType::none ? 0.0 : joint.value;
    archive.number(value, -kMaxCommanded, kMaxCommanded, "a joint's command");
    joint.value = value;
  }
}

class RigidBodyKind final : public Kind {
 public:
  RigidBodyKind() : Kind(ObjectKind::rigid_body) {}

  void load(Catalogue::Impl& all, const LoadedModel& model, const LoadOptions& options,
            Findings& findings) const override {
    all.bodies.prefetch(model.description.bodies);
    for (const scene::Body& body : model.description.bodies) load_body(all, body, model, options, findings);
  }
  void erase_block(scene::Model& model, const std::string& identifier) const override {
    model::erase_block(model.bodies, identifier);
  }
  void add_row(const Entry& entry, const StructureDraft& draft, state::Structure& structure) const override {
    state::BodyInfo row = entry.row_as<state::BodyInfo>();
    row.object = draft.object(&entry);
    row.children = draft.relatives[entry.info.id.index].children;
    row.joints = draft.relatives[entry.info.id.index].joints;
    structure.bodies.push_back(std::move(row));
  }

  bool accepts(const state::Command& command) const override {
    return std::holds_alternative<state::RigidBodyCommand>(command);
  }
  bool obeys_in_step() const override { return true; }

  void link(LiveWorld::Impl& live, std::uint32_t slot, bool is_new) const override {
    physics::Body& body = *self(live, slot).body;
    body.set_user_index(slot);
    if (is_new) live.physics->add(body);
  }
  void unlink(LiveWorld::Impl& live, std::uint32_t slot) const override {
    physics::Body& body = *self(live, slot).body;
    live.picks.end_of(body);
    live.effectors.end_of(self(live, slot));
    live.laws.end_of(self(live, slot));
    live.physics->remove(body);
  }
  math::Pose pose(const LiveWorld::Impl& live, std::uint32_t slot) const override {
    return self(live, slot).body->pose();
  }

  // Wrenches add; pose and twist follow the source that wrote last.
  bool merge(LiveWorld::Impl& live, std::uint32_t slot, const CommandSlots& slots) const override {
    LiveBody& body = self(live, slot);
    const CartesianCommandType mode_before = body.mode;
    std::uint64_t newest = 0;
    body.wrench_world = {};
    body.mode = CartesianCommandType::none;
    slots.each([&](int number, const CommandSlot& source) {
      if (!source.in_force) return;
      const auto& command = std::get<state::RigidBodyCommand>(source.command());
      if (command.type == CartesianCommandType::force) {
        body.wrench_world.force += command.wrench_world.force;
        body.wrench_world.torque += command.wrench_world.torque;
      } else if (command.type != CartesianCommandType::none && source.order >= newest) {
        newest = source.order;
        body.mode = command.type;
        body.target_source = static_cast<state::Source>(number);
        body.T_world_target = command.T_world_body;
        body.twist_world = command.twist_world;
      }
    });
    if (body.mode != mode_before) body.controller.reset();
    return false;
  }

  void add_actors(LiveWorld::Impl& live) const override {
    live.actors.add(StepPhase::laws, "references of devices", [&live](double h_s) { live.prepare_effectors(h_s); });
    live.actors.add(StepPhase::laws, "commands", [&live](double h_s) { live.commands.act(h_s); });
    live.actors.add(StepPhase::laws, "pushes", [&live](double h_s) { live.act_pushes(h_s); });
    live.actors.add(StepPhase::laws, "devices", [&live](double h_s) { live.act_effectors(h_s); });
    live.actors.add(StepPhase::laws, "held laws", [&live](double h_s) {
      live.laws.act(h_s, [&live](LiveBody& body, state::Source source) { live.report_cut(body, source); });
    });
    live.actors.add(StepPhase::readings, "pulls",
                    [&live](double) { live.picks.report(live.laws, live.tables.bodies()); });
  }

  void fill(const LiveWorld::Impl& live, state::Frame& frame) const override {
    frame.frozen_bodies = static_cast<std::uint32_t>(live.physics->frozen_count());
    frame.law_shares.clear();
    frame.law_shares_total = live.laws.shares_without_room();
    for (std::uint32_t slot = 0; slot < frame.bodies.size(); ++slot) {
      const LiveBody& body = self(live, slot);
      state::BodyState& out = frame.bodies[slot];
      out.T_world_body = body.body->pose();
      out.twist_world = body.body->twist();
      out.wrench_body = {};
      out.active = body.active;
      out.asleep = body.body->asleep();
      out.frozen = body.body->frozen();
      live.laws.each_share(body.shares, [&](state::Source source, const math::Wrench& wrench_world) {
        ++frame.law_shares_total;
        if (frame.law_shares.size() < frame.law_shares.capacity())
          frame.law_shares.push_back({slot, source, wrench_world});
      });
    }
  }
  void fill_parameters(const LiveWorld::Impl& live, state::Frame& frame) const override {
    for (std::uint32_t slot = 0; slot < frame.body_parameters.size(); ++slot)
      frame.body_parameters[slot] = parameters_of(self(live, slot));
  }
  std::optional<math::Vec3> set_parameter(LiveWorld::Impl& live, std::uint32_t slot, state::Parameter parameter,
                                          const math::Vec3& value) const override {
    LiveBody& body = self(live, slot);
    state::BodyParameters parameters = parameters_of(body);
    set_value(parameters, parameter, value);
    set_parameters(body, parameters, live.physics->options().step);
    return value_of(parameters_of(body), parameter);
  }

  void reset_parameters(LiveWorld::Impl& live, std::uint32_t slot) const override {
    set_parameters(self(live, slot), live.structure->bodies[slot].parameters, live.physics->options().step);
    self(live, slot).hold = self(live, slot).hold_loaded;
  }
  void reset(LiveWorld::Impl& live, std::uint32_t slot) const override { self(live, slot).controller.reset(); }

  std::unique_ptr<SavedObject> make_saved() const override { return std::make_unique<SavedBody>(); }
  void save(const LiveWorld::Impl& live, std::uint32_t slot, SavedObject& saved) const override {
    const LiveBody& body = self(live, slot);
    auto& to = static_cast<SavedBody&>(saved);
    to.parameters = parameters_of(body);
    to.hold = body.hold;
    to.push = body.push;
    to.push_steps = body.push_steps;
    to.controller = body.controller.state();
    live.laws.each_share(body.shares, [&](state::Source source, const math::Wrench& wrench_world) {
      to.shares.push_back({source, wrench_world});
    });
  }
  void transfer(StateArchive& archive, SavedObject& saved, const SavedContext& context) const override {
    auto& body = static_cast<SavedBody&>(saved);
    transfer_parameters(archive, body.parameters, number());
    archive.flag(body.hold, "whether it holds its target");
    const bool is_static = context.structure.bodies[context.slot].mass == 0.0;
    const auto max_steps = static_cast<std::uint64_t>(kMaxPush_s / context.step_s);
    archive.count(body.push_steps, 0, is_static ? 0 : max_steps, "what is left of a push");
    if (body.push_steps > 0) {
      transfer_vector(archive, body.push.force_world, kMaxCommanded, "the force of a push");
      transfer_vector(archive, body.push.torque_world, kMaxCommanded, "the torque of a push");
      transfer_vector(archive, body.push.point_body, 1e6, "the point of a push");
      archive.number(body.push.seconds, 0.0, kMaxPush_s, "the length of a push");
      archive.choice(body.push.source, 0, base::kMaxSources - 1, "the source of a push");
    }
    transfer_controller(archive, body.controller);
    archive.size(body.shares, base::kMaxSources, 1 + 6 * sizeof(double), "the number of a body's laws");
    for (SavedBody::Share& share : body.shares) {
      archive.choice(share.source, 0, base::kMaxSources - 1, "the source of a law");
      transfer_vector(archive, share.wrench_world.force, kFinite, "the force of a law");
      transfer_vector(archive, share.wrench_world.torque, kFinite, "the torque of a law");
    }
  }
  void transfer(StateArchive& archive, state::Command& command) const override {
    if (archive.reads()) command.emplace<state::RigidBodyCommand>();
    transfer_body_command(archive, std::get<state::RigidBodyCommand>(command));
  }
  void restore(LiveWorld::Impl& live, std::uint32_t slot, const SavedObject& saved) const override {
    LiveBody& body = self(live, slot);
    const auto& from = static_cast<const SavedBody&>(saved);
    set_parameters(body, from.parameters, live.physics->options().step);
    body.hold = from.hold;
    body.push = from.push;
    body.push_steps = from.push_steps;
    body.controller.set_state(from.controller);  // merge() reset it
    for (const SavedBody::Share& share : from.shares) live.laws.add_share(body, share.source, share.wrench_world);
  }

 private:
  LiveBody& self(const LiveWorld::Impl& live, std::uint32_t slot) const { return live.tables.bodies()[slot]; }

  void load_body(Catalogue::Impl& all, const scene::Body& body, const LoadedModel& model, const LoadOptions& load,
                 Findings& findings) const {
    Entry* entry =
        all.add_entry(number(), body.identity, model.info.id, all.full_namespace(body.identity, load), findings);
    if (entry == nullptr) return;
    all.loaded_bodies.try_emplace(entry->own_identifier, entry);
    BodySurroundings surroundings;
    surroundings.T_world_model = load.T_world_model;
    surroundings.gravity = model.description.gravity;
    surroundings.no_collision_set = model.description.ignore_inter_collision ? model.info.id : 0;
    surroundings.step_s = all.options.step_s;
    surroundings.shaders = shader_files(model.description.shaders);
    BuiltBody built = all.bodies.build(body, surroundings, findings);

    entry->physics_body = built.live->body.get();
    entry->scale = body.scale;
    state::BodyInfo row;
    row.mass = built.live->body->mass();
    row.inertia = built.live->body->inertia();
    row.T_body_com = built.live->body->T_body_com();
    row.parameters = parameters_of(*built.live);
    row.linear_output = body.linear.output;
    row.angular_output = body.angular.output;
    row.publish_children_names = body.publish_children_names;
    row.publish_joint_names = body.publish_joint_names;
    row.publish_joint_positions = body.publish_joint_positions;
    row.appearance = std::move(built.appearance);
    row.collision_appearance = std::move(built.collision_appearance);
    entry->row = std::move(row);
    built.live->hold = built.live->hold_loaded = body.hold;
    built.live->slots = all.commands.add(entry->info.id, number());
    entry->live = std::move(built.live);
  }
};

}  // namespace

std::unique_ptr<Kind> make_rigid_body_kind() { return std::make_unique<RigidBodyKind>(); }

TypedTable<LiveBody> LiveTables::bodies() const { return TypedTable<LiveBody>(of(ObjectKind::rigid_body)); }

}  // namespace ambf::model
