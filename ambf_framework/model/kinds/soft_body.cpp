// Soft bodies: physics moves their nodes; here they are loaded, commanded, shown and saved.
#include "model/kinds/soft_body.h"

#include <algorithm>
#include <any>

#include "base/bounds.h"
#include "base/limits.h"
#include "model/kinds/placed.h"
#include "model/kinds/soft_body/detail/builder.h"
#include "physics/soft_grip.h"
#include "physics/thread.h"
#include "physics/tissue.h"

namespace ambf::model {
namespace {

using state::SoftBodyCommand;

constexpr std::size_t kMaxNodeForces = 8000;  // as many as nodes
constexpr double kMaxSaved = 1e12;            // m and m/s: more is damage
constexpr physics::SoftGripOptions kAttached{.hardness = 1e4, .damping = 2.0, .first = true};  // of nodes of links

const SoftBodyCommand& command_of(const state::Command& command) {
  return std::any_cast<const SoftBodyCommand&>(std::get<state::KindCommand>(command).value);
}

// Nodes of links that hang on a body.
struct Attachment {
  std::vector<std::uint32_t> nodes;
  std::vector<math::Vec3> at;  // m, world, as loaded
  physics::Body* body = nullptr;
  std::vector<std::unique_ptr<physics::SoftGrip>> grips;  // as many as they need

  // What let go, as resets do, holds again.
  void hold(physics::SoftBody& soft) {
    if (body == nullptr || soft.frozen() || body->frozen()) return;
    const math::Pose T_com_world = math::inverse(body->initial_com_pose());
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      physics::SoftGrip& grip = *grips[i / physics::SoftGrip::kMaxNodes];
      if (i % physics::SoftGrip::kMaxNodes == 0 && grip.holder() == body)
        i += physics::SoftGrip::kMaxNodes - 1;
      else
        grip.hold_at(*body, soft, nodes[i], T_com_world * at[i]);
    }
  }
};

bool leaves_touches_out(const physics::SoftBody& soft) {
  if (soft.is_tissue()) return static_cast<const physics::Tissue&>(soft).touches_left_out();
  return soft.is_thread() && static_cast<const physics::Thread&>(soft).crossings_left_out();
}

struct LiveSoftBody final : LivePlaced {
  std::unique_ptr<physics::SoftBody> body;
  std::vector<Attachment> attachments;  // of links
  math::Wrench wrench_world;            // of all commands in force
  std::optional<math::Pose> carried_to;
  // Of all commands in force: they lie in the slots of their sources, and stay there until merge() is called again.
  std::vector<const std::vector<state::NodeForce>*> node_forces;
  bool touches_reported = false;
};

struct SavedSoftBody final : SavedPlaced {
  std::vector<double> nodes;
  bool frozen = false;
};

class SoftBodyKind final : public PlacedKind {
 public:
  SoftBodyKind() : PlacedKind(state::soft_body_kind().kind) {}

  void load(Catalogue::Impl& all, const LoadedModel& model, const LoadOptions& options,
            Findings& findings) const override {
    for (const scene::KindBlock& block : model.description.blocks) {
      if (block.kind != &scene::kind::kSoftBody) continue;
      BuiltSoftBody built = build_soft_body(block, all, model, options.T_world_model, findings);
      if (built.body == nullptr) continue;
      auto live = std::make_unique<LiveSoftBody>();
      live->body = std::move(built.body);
      live->node_forces.reserve(base::kMaxSources);
      for (std::size_t group = 0; group < built.attached_nodes.size(); ++group) {
        Attachment& made = live->attachments.emplace_back();
        made.nodes = std::move(built.attached_nodes[group]);
        made.at = std::move(built.attached_at[group]);
        for (std::size_t i = 0; i < made.nodes.size(); i += physics::SoftGrip::kMaxNodes)
          made.grips.push_back(std::make_unique<physics::SoftGrip>(kAttached));
      }
      Entry* entry = add(all, std::move(live), block.identity, "", block.as<scene::SoftBody>().T_model_body, model,
                         options, findings);
      if (entry == nullptr) continue;
      for (const std::string& name : built.row.attach_to)
        if (!is_a_body(all, *entry, name))
          findings.information(
              block.identity, block.as<scene::SoftBody>().is_tissue ? "tissue/regions" : "config/regions",
              "there is no body \"" + name + "\" yet", "what is to be attached to it hangs on nothing until it comes");
      entry->row = std::move(built.row);
    }
  }
  void erase_block(scene::Model& model, const std::string& identifier) const override {
    std::erase_if(model.blocks, [&](const scene::KindBlock& block) {
      return block.kind == &scene::kind::kSoftBody && block.identity.identifier == identifier;
    });
  }
  void add_row(const Entry& entry, const StructureDraft& draft, state::Structure& structure) const override {
    state::SoftBodyInfo row = entry.row_as<state::SoftBodyInfo>();
    set_placed(row, entry, draft);
    auto& rows = state::table<state::SoftBodyInfo>(structure, number());
    for (const std::string& name : row.attach_to) row.attached.push_back(find_body(structure, entry, name));
    row.first_node = rows.empty() ? 0 : rows.back().first_node + rows.back().nodes;
    rows.push_back(std::move(row));
  }

  void link(LiveWorld::Impl& live, std::uint32_t slot, bool is_new) const override {
    physics::SoftBody& body = *self(live, slot).body;
    body.set_user_index(slot);
    if (is_new) physics::add(*live.physics, body);
    const std::vector<std::uint32_t>& attached = state::soft_bodies(*live.structure)[slot].attached;
    for (std::size_t group = 0; group < attached.size(); ++group) {
      physics::Body* holder =
          attached[group] == state::kNone ? nullptr : live.tables.bodies()[attached[group]].body.get();
      if (!body.is_of_links()) {
        attach(body, group, holder);
        continue;
      }
      Attachment& own = self(live, slot).attachments[group];
      if (own.body != holder)
        for (const auto& grip : own.grips) grip->release();
      own.body = holder;
    }
  }
  void unlink(LiveWorld::Impl& live, std::uint32_t slot) const override {
    physics::remove(*live.physics, *self(live, slot).body);
  }

  bool accepts(const state::Command& command) const override {
    const auto* own = std::get_if<state::KindCommand>(&command);
    return own != nullptr && std::any_cast<SoftBodyCommand>(&own->value) != nullptr;
  }
  bool obeys_in_step() const override { return true; }
  bool merge(LiveWorld::Impl& live, std::uint32_t slot, const CommandSlots& slots) const override {
    LiveSoftBody& soft = self(live, slot);
    soft.wrench_world = {};
    soft.carried_to.reset();
    soft.node_forces.clear();
    std::uint64_t newest = 0;
    slots.each([&](int, const CommandSlot& source) {
      if (!source.in_force) return;
      const SoftBodyCommand& command = command_of(source.command());
      soft.wrench_world.force += command.wrench_world.force;
      soft.wrench_world.torque += command.wrench_world.torque;
      if (!command.node_forces.empty()) soft.node_forces.push_back(&command.node_forces);
      if (!command.carries || source.order < newest) return;
      newest = source.order;
      soft.carried_to = command.T_world_body;
    });
    return false;
  }
  void add_actors(LiveWorld::Impl& live) const override {
    live.actors.add(StepPhase::laws, "commands of soft bodies", [this, &live](double) {
      for (std::uint32_t slot = 0; slot < live.tables.of(number()).size(); ++slot) {
        LiveSoftBody& soft = self(live, slot);
        for (Attachment& each : soft.attachments) each.hold(*soft.body);
        if (soft.carried_to) soft.body->carry_fixed(*soft.carried_to, base::kMaxCommandedSpeed);
        if (soft.wrench_world.force != math::Vec3{} || soft.wrench_world.torque != math::Vec3{})
          soft.body->apply_wrench(soft.wrench_world);
        for (const auto* forces : soft.node_forces)
          for (const state::NodeForce& each : *forces)
            if (each.node < soft.body->node_count()) soft.body->apply_force(each.node, each.force_world);
        if (!soft.touches_reported && leaves_touches_out(*soft.body))
          soft.touches_reported = live.report_soft_body(slot, CutReport::Of::touches);
      }
    });
  }

  math::Pose pose(const LiveWorld::Impl& live, std::uint32_t slot) const override {
    return self(live, slot).body->centre();
  }
  void fill(const LiveWorld::Impl& live, state::Frame& frame) const override {
    auto& rows = state::rows(frame, state::soft_body_kind().column);
    std::vector<state::SoftNode>& nodes = state::soft_nodes(frame);
    nodes.clear();
    for (std::uint32_t slot = 0; slot < rows.size(); ++slot) {
      const LiveSoftBody& soft = self(live, slot);
      const math::Pose centre = soft.body->centre();
      rows[slot] = {{centre, centre, soft.active}, soft.body->frozen()};
      for (std::size_t node = 0; node < soft.body->node_count(); ++node) nodes.push_back({soft.body->position(node)});
    }
  }

  void bodies_reset(LiveWorld::Impl& live, std::uint32_t slot) const override { self(live, slot).body->reset(); }

  std::unique_ptr<SavedObject> make_saved() const override { return std::make_unique<SavedSoftBody>(); }
  void save(const LiveWorld::Impl& live, std::uint32_t slot, SavedObject& saved) const override {
    PlacedKind::save(live, slot, saved);
    auto& to = static_cast<SavedSoftBody&>(saved);
    self(live, slot).body->get_state(to.nodes);
    to.frozen = self(live, slot).body->frozen();
  }
  using PlacedKind::transfer;
  void transfer(StateArchive& archive, SavedObject& saved, const SavedContext& context) const override {
    PlacedKind::transfer(archive, saved, context);
    auto& soft = static_cast<SavedSoftBody&>(saved);
    if (archive.reads()) soft.nodes.resize(state::soft_bodies(context.structure)[context.slot].saved);
    for (double& value : soft.nodes) archive.number(value, -kMaxSaved, kMaxSaved, "where a node is, or its velocity");
    archive.flag(soft.frozen, "whether it is frozen");
  }
  void transfer(StateArchive& archive, state::Command& command) const override {
    SoftBodyCommand own;
    if (!archive.reads()) own = command_of(command);
    transfer_vector(archive, own.wrench_world.force, base::kMaxForce, "a force on a soft body");
    transfer_vector(archive, own.wrench_world.torque, base::kMaxForce, "a torque on a soft body");
    archive.flag(own.carries, "whether its fixed nodes are commanded");
    if (own.carries) transfer_pose(archive, own.T_world_body, 1e6, "where its fixed nodes go");
    archive.size(own.node_forces, kMaxNodeForces, 4 * sizeof(double), "forces on nodes");
    for (state::NodeForce& each : own.node_forces) {
      std::uint64_t node = each.node;
      archive.count(node, 0, kMaxNodeForces - 1, "a node on which a force acts");
      each.node = static_cast<std::uint32_t>(node);
      transfer_vector(archive, each.force_world, base::kMaxForce, "a force on a node");
    }
    if (archive.reads()) command = state::KindCommand{std::move(own)};
  }
  void restore(LiveWorld::Impl& live, std::uint32_t slot, const SavedObject& saved) const override {
    PlacedKind::restore(live, slot, saved);
    const auto& from = static_cast<const SavedSoftBody&>(saved);
    physics::SoftBody& body = *self(live, slot).body;
    body.set_state(from.nodes);
    if (from.frozen) body.freeze();
  }

 private:
  static void attach(physics::SoftBody& soft, std::size_t group, physics::Body* body) {
    if (soft.is_thread())
      static_cast<physics::Thread&>(soft).attach(group, body);
    else
      static_cast<physics::Tissue&>(soft).attach(group, body);
  }
  // Exactly that block of the same file, else what the text means in the world; its slot, or state::kNone.
  static std::uint32_t find_body(const state::Structure& structure, const Entry& entry, const std::string& name) {
    const std::string own = entry.name_space + name + entry.conflict_number;
    for (const state::ObjectInfo& object : structure.objects)
      if (object.kind == state::ObjectKind::rigid_body && object.identifier == own) return object.slot;
    const std::uint32_t found = state::find(structure, name, state::ObjectKind::rigid_body);
    return found == state::kNone ? found : structure.objects[found].slot;
  }
  // Whether the above will find it, or several.
  static bool is_a_body(const Catalogue::Impl& all, const Entry& entry, const std::string& name) {
    const std::string own = entry.name_space + name + entry.conflict_number;
    return std::any_of(all.entries.begin(), all.entries.end(), [&](const auto& other) {
      const state::ObjectInfo& info = other->info;
      return info.kind == state::ObjectKind::rigid_body &&
             (info.identifier == own || info.identifier.find(name) != std::string::npos ||
              info.name.find(name) != std::string::npos);
    });
  }
  LiveSoftBody& self(const LiveWorld::Impl& live, std::uint32_t slot) const {
    return static_cast<LiveSoftBody&>(placed(live, slot));
  }
};

}  // namespace

physics::SoftBody& soft_body_at(const LiveWorld::Impl& live, std::uint32_t slot) {
  return *static_cast<LiveSoftBody&>(*live.tables.of(state::soft_body_kind().kind)[slot]).body;
}

std::uint32_t soft_body_slot(const LiveWorld::Impl& live, state::ObjectId id) {
  const std::uint32_t object = state::find(*live.structure, id);
  if (object == state::kNone || live.structure->objects[object].kind != state::soft_body_kind().kind)
    return state::kNone;
  return live.structure->objects[object].slot;
}

std::unique_ptr<Kind> make_soft_body_kind() { return std::make_unique<SoftBodyKind>(); }

}  // namespace ambf::model
