// Actuators: each holds bodies on the body that it sits on (its holder), with physics::Grasp, and nodes of soft bodies,
// with physics::SoftGrip, or pulls bodies there, as its command or trigger (actuator/triggers.cpp) says. The watchdog,
// the end of either body and a reset let go, unless a command is in force: a held needle stays held, as in AMBF 3.0.
// Long: one class, what the kind of actuators does.
// What is held is chosen before a step, from the poses that it begins with. While an actuator holds anything, it
// ignores which body a command names, as the original does: it must let go first.
#include <any>

#include "model/kinds/actuator/detail/live_actuator.h"
#include "model/kinds/placed.h"
#include "model/kinds/registry.h"
#include "model/kinds/soft_body.h"
#include "physics/soft_body.h"
#include "state/sensors.h"
#include "state/soft_bodies.h"

namespace ambf::model {
namespace {

using state::ActuatorCommand;
using state::ObjectKind;

static_assert(state::kMaxHeldNodes == physics::SoftGrip::kMaxNodes);
static_assert(state::kMaxHeldNodes >= physics::Needle::kMaxPunctures);
constexpr std::size_t kMaxEdge = std::max(physics::Blade::kMaxState, physics::Needle::kMaxState);

constexpr double kDefaultErp = physics::JointOptions{}.erp;

const ActuatorCommand& command_of(const state::Command& command) {
  return std::any_cast<const ActuatorCommand&>(std::get<state::KindCommand>(command).value);
}

// What a row of the catalogue holds.
struct ActuatorRow {
  state::ActuatorInfo info;
  std::string sensor, jaw, thread;  // as written
};

struct SavedActuator final : SavedPlaced {
  struct Node {
    std::uint64_t soft_body = 0, node = 0;
    math::Vec3 place;  // m, in the holder's COM frame
  };
  bool closed = false;
  std::vector<Node> nodes;
  std::vector<double> edge;  // of a blade; of a needle its tip, punctures and stitches
};

using Either = std::array<ObjectKind, 2>;  // kinds that an id may be of

class ActuatorKind final : public DescribedKind<scene::Actuator> {
 public:
  ActuatorKind() : DescribedKind(state::actuator_kind().kind, scene::kind::kActuator) {}

  Made make(const scene::Actuator& described) const override {
    physics::GraspOptions options;
    options.erp = std::min(1.0, kDefaultErp * described.tau.value_or(1.0));
    options.max_impulse = described.max_impulse.value_or(options.max_impulse);
    ActuatorRow row;
    row.sensor = described.sensor;
    row.jaw = described.jaw;
    row.thread = described.thread;
    row.info.type = described.type;
    row.info.trigger = described.trigger;
    row.info.visible = described.visible;
    row.info.visible_size_m = described.visible_size_m;
    return {std::make_unique<LiveActuator>(described, options), std::move(row), described.T_parent_actuator};
  }
  void add_row(const Entry& entry, const StructureDraft& draft, state::Structure& structure) const override {
    const auto& [info, sensor, jaw, thread] = entry.row_as<ActuatorRow>();
    state::ActuatorInfo row = info;
    set_placed(row, entry, draft);
    row.sensor_object = find_named(structure, entry, sensor, state::sensor_kind().kind);
    const std::uint32_t body = find_named(structure, entry, jaw, ObjectKind::rigid_body);
    row.jaw_body = body == state::kNone ? state::kNone : structure.objects[body].slot;
    row.thread_object = find_named(structure, entry, thread, state::soft_body_kind().kind);
    state::table<state::ActuatorInfo>(structure, number()).push_back(std::move(row));
  }

  void link(LiveWorld::Impl& live, std::uint32_t slot, bool is_new) const override {
    LiveActuator& actuator = self(live, slot);
    actuator.pulled.clear();
    actuator.pull_world = {};
    if (!is_new) return;
    if (actuator.blade != nullptr) physics::add(*live.physics, *actuator.blade);
    if (actuator.needle != nullptr) physics::add(*live.physics, *actuator.needle);
    for (const auto& grasp : actuator.grasps)
      if (grasp != nullptr) live.physics->add(*grasp);
  }
  void unlink(LiveWorld::Impl& live, std::uint32_t slot) const override {
    for (const auto& grasp : self(live, slot).grasps)
      if (grasp != nullptr) live.physics->remove(*grasp);
    if (self(live, slot).soft != nullptr) self(live, slot).soft->release();
    if (self(live, slot).blade != nullptr) physics::remove(*live.physics, *self(live, slot).blade);
    if (self(live, slot).needle != nullptr) physics::remove(*live.physics, *self(live, slot).needle);
  }
  std::size_t grasps(const state::Structure& structure) const override {
    std::size_t count = 0;
    for (const state::ActuatorInfo& actuator : state::actuators(structure))
      if (actuator.type == state::ActuatorType::constraint) count += base::kMaxHeldBodies;
    return count;
  }

  // The frame of the parent's centre of mass, as in the original.
  math::Pose parent_frame(const LiveWorld::Impl& live, std::uint32_t parent_object) const override {
    if (parent_object == state::kNone || live.structure->objects[parent_object].kind != ObjectKind::rigid_body)
      return PlacedKind::parent_frame(live, parent_object);
    return live.tables.bodies()[live.structure->objects[parent_object].slot].body->com_pose();
  }

  bool accepts(const state::Command& command) const override {
    const auto* own = std::get_if<state::KindCommand>(&command);
    return own != nullptr && std::any_cast<ActuatorCommand>(&own->value) != nullptr;
  }
  bool obeys_in_step() const override { return true; }
  bool merge(LiveWorld::Impl& live, std::uint32_t slot, const CommandSlots& slots) const override {
    LiveActuator& actuator = self(live, slot);
    std::uint64_t newest = 0;
    actuator.wanted = {};
    actuator.commanded = false;
    slots.each([&](int, const CommandSlot& source) {
      if (!source.in_force || source.order < newest) return;
      actuator.commanded = true;
      newest = source.order;
      actuator.wanted = command_of(source.command());
    });
    const bool names_body = actuator.wanted.actuate && !actuator.wanted.use_sensor;
    if (newest > actuator.newest && names_body && is_held_by(live, live.body_slot(actuator.wanted.body), slot))
      actuator.slots->count_refused();
    actuator.newest = std::max(actuator.newest, newest);
    return false;
  }

  void add_actors(LiveWorld::Impl& live) const override {
    live.actors.add(StepPhase::forces, "actuators", [this, &live](double h_s) {
      for (std::uint32_t slot = 0; slot < live.tables.of(number()).size(); ++slot) act(live, slot, h_s);
    });
  }

  void fill(const LiveWorld::Impl& live, state::Frame& frame) const override {
    auto& rows = state::rows(frame, state::actuator_kind().column);
    std::vector<state::HeldNode>& nodes = state::held_nodes(frame);
    nodes.clear();
    for (std::uint32_t slot = 0; slot < rows.size(); ++slot) {
      const LiveActuator& actuator = self(live, slot);
      state::ActuatorState& row = rows[slot];
      row = {{actuator.T_parent, pose(live, slot), actuator.active}, {}, 0, 0, 0, 0, 0, actuator.pull_world};
      for (const physics::Body* body : actuator.pulled) row.held[row.held_count++] = body->user_index();
      for (std::size_t i = 0; i < actuator.used; ++i) {
        const physics::Grasp& grasp = *actuator.grasps[i];
        if (!grasp.holds()) continue;
        row.held[row.held_count++] = grasp.held()->user_index();
        row.force_world += grasp.reaction_on_held().force;
      }
      if (actuator.blade != nullptr) row.force_world = actuator.blade->force_world();
      if (actuator.needle != nullptr) {
        row.force_world = actuator.needle->force_world();
        row.bites = static_cast<std::uint32_t>(actuator.needle->bites());
        row.stitches = static_cast<std::uint32_t>(actuator.needle->stitches());
        row.tied = static_cast<std::uint32_t>(actuator.needle->tied());
        for (const physics::SurfacePuncture& each : actuator.needle->on_surfaces()) {
          if (row.held_nodes == state::kMaxHeldNodes) break;
          nodes.push_back({slot, each.body->user_index(), static_cast<std::uint32_t>(each.node), each.needle,
                           each.force_world, each.out ? state::HeldNode::Puncture::out : state::HeldNode::Puncture::in,
                           each.rest});
          ++row.held_nodes;
        }
      }
      if (actuator.soft == nullptr) continue;
      for (const physics::HeldNode& node : actuator.soft->held()) {
        nodes.push_back({slot,
                         node.body->user_index(),
                         static_cast<std::uint32_t>(node.node),
                         actuator.soft->target(node),
                         node.force_world,
                         state::HeldNode::Puncture::none,
                         {}});
        row.force_world += node.force_world;
        ++row.held_nodes;
      }
    }
  }

  // Physics has ended what it held.
  void reset(LiveWorld::Impl& live, std::uint32_t slot) const override {
    PlacedKind::reset(live, slot);
    LiveActuator& actuator = self(live, slot);
    if (actuator.soft != nullptr) actuator.soft->release();
    if (actuator.blade != nullptr) actuator.blade->use(nullptr);
    if (actuator.needle != nullptr) actuator.needle->use(nullptr);
    actuator.used = 0;
    actuator.closed = false;
    actuator.pulled.clear();
    actuator.pull_world = {};
  }

  // What is sewn goes back without its needle, or the needle without it.
  void bodies_reset(LiveWorld::Impl& live, std::uint32_t slot) const override {
    if (self(live, slot).needle != nullptr) self(live, slot).needle->use(nullptr);
  }

  bool commands_outlive_reset() const override { return true; }
  void before_reset(LiveWorld::Impl& live, std::uint32_t slot) const override {
    LiveActuator& actuator = self(live, slot);
    for (std::size_t i = 0; i < actuator.used; ++i)
      actuator.outlives[i] = actuator.commanded ? actuator.grasps[i]->current() : std::nullopt;
  }
  void after_reset(LiveWorld::Impl& live, std::uint32_t slot) const override {
    LiveActuator& actuator = self(live, slot);
    actuator.used = 0;
    for (auto& hold : actuator.outlives)
      if (hold && actuator.grasps[actuator.used]->resume(*hold)) ++actuator.used;
    actuator.outlives.fill(std::nullopt);
  }

  std::unique_ptr<SavedObject> make_saved() const override { return std::make_unique<SavedActuator>(); }
  // The world that goes on shows no pull either until it has made a step, as the one that is restored.
  void save(const LiveWorld::Impl& live, std::uint32_t slot, SavedObject& saved) const override {
    PlacedKind::save(live, slot, saved);
    LiveActuator& actuator = self(live, slot);
    auto& to = static_cast<SavedActuator&>(saved);
    to.closed = actuator.closed;
    to.nodes.clear();
    if (actuator.soft != nullptr) {
      for (const physics::HeldNode& node : actuator.soft->held())
        to.nodes.push_back({node.body->user_index(), node.node, node.place});
      hold_again(live, slot, to.nodes);  // physics goes through actuators in the order in which they began to hold
    }
    if (actuator.blade != nullptr) {
      actuator.blade->get_state(to.edge);
      actuator.blade->set_state(*live.physics, to.edge);
    }
    if (actuator.needle != nullptr) {
      actuator.needle->get_state(to.edge);
      actuator.needle->set_state(*live.physics, to.edge);
    }
    actuator.pulled.clear();
    actuator.pull_world = {};
  }
  using PlacedKind::transfer;
  void transfer(StateArchive& archive, SavedObject& saved, const SavedContext& context) const override {
    PlacedKind::transfer(archive, saved, context);
    auto& own = static_cast<SavedActuator&>(saved);
    archive.flag(own.closed, "whether its jaw is closed");
    archive.size(own.nodes, state::kMaxHeldNodes, 5 * sizeof(double), "nodes that it holds");
    const auto& soft_bodies = state::soft_bodies(context.structure);
    archive.require(own.nodes.empty() || !soft_bodies.empty(), "it holds nodes, and there is no soft body");
    if (soft_bodies.empty()) own.nodes.clear();
    for (SavedActuator::Node& each : own.nodes) {
      archive.count(each.soft_body, 0, soft_bodies.size() - 1, "the soft body of a held node");
      const std::uint32_t nodes = soft_bodies[each.soft_body].nodes;
      archive.count(each.node, 0, std::max(nodes, 1U) - 1, "a held node");
      transfer_vector(archive, each.place, kMaxSaved, "where a node is held");
    }
    archive.size(own.edge, kMaxEdge, sizeof(double), "numbers of a blade's edge");
    for (double& value : own.edge) archive.number(value, -kMaxSaved, kMaxSaved, "where a blade's edge is");
  }
  void transfer(StateArchive& archive, state::Command& command, const SavedContext& context) const override {
    transfer_command(archive, command, [&](state::ObjectId& id, Either kinds, const char* what) {
      transfer_id(archive, id, kinds, context.structure, what);
    });
  }
  // Of a recording of inputs: ids as they are, since a replay gives objects the same ones.
  void transfer(StateArchive& archive, state::Command& command) const override {
    transfer_command(archive, command, [&](state::ObjectId& id, Either, const char* what) {
      std::uint64_t index = id.index, generation = id.generation;
      archive.count(index, 0, UINT32_MAX, what);
      archive.count(generation, 0, UINT32_MAX, what);
      if (archive.reads()) id = {static_cast<std::uint32_t>(index), static_cast<std::uint32_t>(generation)};
    });
  }
  // Physics has restored what it holds.
  void restore(LiveWorld::Impl& live, std::uint32_t slot, const SavedObject& saved) const override {
    PlacedKind::restore(live, slot, saved);
    LiveActuator& actuator = self(live, slot);
    actuator.closed = static_cast<const SavedActuator&>(saved).closed;
    actuator.pulled.clear();
    actuator.pull_world = {};
    if (actuator.soft != nullptr) hold_again(live, slot, static_cast<const SavedActuator&>(saved).nodes);
    if (actuator.blade != nullptr)
      actuator.blade->set_state(*live.physics, static_cast<const SavedActuator&>(saved).edge);
    if (actuator.needle != nullptr) {
      const std::uint32_t holder = holder_of(live, slot);
      if (holder != state::kNone) actuator.needle->use(live.tables.bodies()[holder].body.get());
      actuator.needle->draw(thread_of(live, slot));
      actuator.needle->set_state(*live.physics, static_cast<const SavedActuator&>(saved).edge);
    }
    actuator.used = actuator.grasps[0] == nullptr ? 0 : actuator.grasps.size();
    while (actuator.used > 0 && !actuator.grasps[actuator.used - 1]->holds()) --actuator.used;
  }

 private:
  void hold_again(const LiveWorld::Impl& live, std::uint32_t slot,
                  const std::vector<SavedActuator::Node>& nodes) const {
    physics::SoftGrip& grip = *self(live, slot).soft;
    grip.release();
    const std::uint32_t holder = holder_of(live, slot);
    if (holder == state::kNone) return;
    for (const SavedActuator::Node& each : nodes)
      grip.hold_at(*live.tables.bodies()[holder].body, soft_body_at(live, static_cast<std::uint32_t>(each.soft_body)),
                   each.node, each.place);
  }

  LiveActuator& self(const LiveWorld::Impl& live, std::uint32_t slot) const {
    return static_cast<LiveActuator&>(placed(live, slot));
  }

  std::uint32_t holder_of(const LiveWorld::Impl& live, std::uint32_t slot) const {
    return state::holder_of(*live.structure, state::rows_of(number()).object(*live.structure, slot));
  }

  // Exactly that block of the same file, else what the text means in the world; state::kNone: nothing yet.
  static std::uint32_t find_named(const state::Structure& structure, const Entry& entry, const std::string& name,
                                  ObjectKind kind) {
    if (name.empty()) return state::kNone;
    const std::string own = entry.name_space + name + entry.conflict_number;
    for (std::uint32_t i = 0; i < structure.objects.size(); ++i)
      if (structure.objects[i].kind == kind && structure.objects[i].identifier == own) return i;
    return state::find(structure, name, kind);
  }

  template <class TransferId>
  static void transfer_command(StateArchive& archive, state::Command& command, TransferId transfer_id_of) {
    ActuatorCommand own;
    if (!archive.reads()) own = command_of(command);
    archive.flag(own.actuate, "whether an actuator is to hold something");
    transfer_id_of(own.body, {ObjectKind::rigid_body, state::soft_body_kind().kind}, "what an actuator is to hold");
    archive.flag(own.use_sensor, "whether an actuator is to hold what a sensor senses");
    transfer_id_of(own.sensor, {state::sensor_kind().kind, state::sensor_kind().kind}, "the sensor of an actuator");
    archive.flag(own.use_offset, "whether an actuator has an offset");
    transfer_pose(archive, own.T_held_grasp, 1e6, "an actuator's offset");
    if (archive.reads()) command = state::KindCommand{own};
  }

  // An object by its place in the structure; as many as there are stand for none.
  static void transfer_id(StateArchive& archive, state::ObjectId& id, Either kinds, const state::Structure& structure,
                          const char* what) {
    std::uint64_t place = structure.objects.size();
    if (!archive.reads())
      if (const std::uint32_t found = state::find(structure, id); found != state::kNone) place = found;
    archive.count(place, 0, structure.objects.size(), what);
    const bool is_one = place < structure.objects.size();
    const bool fits =
        is_one && (structure.objects[place].kind == kinds[0] || structure.objects[place].kind == kinds[1]);
    archive.require(!is_one || fits, what + std::string(" is of another kind"));
    if (archive.reads()) id = is_one ? structure.objects[place].id : state::ObjectId{};
  }

  // Whether the holder of this actuator is itself held on the body of that slot: the two cannot hold each other.
  bool is_held_by(const LiveWorld::Impl& live, std::uint32_t other, std::uint32_t slot) const {
    const std::uint32_t holder = holder_of(live, slot);
    if (other == state::kNone || holder == state::kNone) return false;
    const auto is = [](const physics::Body* which, std::uint32_t number) {
      return which != nullptr && which->user_index() == number;
    };
    for (std::uint32_t each = 0; each < live.tables.of(number()).size(); ++each) {
      const LiveActuator& actuator = self(live, each);
      for (std::size_t i = 0; i < actuator.used; ++i)
        if (is(actuator.grasps[i]->holder(), other) && is(actuator.grasps[i]->held(), holder)) return true;
    }
    return false;
  }

  void act(LiveWorld::Impl& live, std::uint32_t slot, double h_s) const {
    LiveActuator& actuator = self(live, slot);
    const std::uint32_t holder_slot = holder_of(live, slot);
    physics::Body* holder = holder_slot == state::kNone ? nullptr : live.tables.bodies()[holder_slot].body.get();
    if (actuator.blade != nullptr) return cut(live, slot, holder, actuator);
    if (actuator.needle != nullptr) return sew(live, slot, holder, actuator);
    const Intent intent = intent_of(live, slot, actuator);
    if (actuator.grasps[0] == nullptr) {
      if (intent.grasp && intent.sensor != state::kNone && holder != nullptr)
        return pull(live, intent.sensor, *holder, h_s, actuator);
      actuator.pulled.clear();
      actuator.pull_world = {};
      return;
    }
    for (std::size_t i = 0; i < actuator.used; ++i)  // it may hang on another body now
      if (actuator.grasps[i]->holder() != holder) actuator.grasps[i]->release();
    if (actuator.soft->holder() != nullptr && actuator.soft->holder() != holder) actuator.soft->release();
    if (!intent.hold || !actuator.holds()) actuator.release();
    if (intent.grasp && !actuator.holds() && holder != nullptr) grasp(live, slot, actuator, intent, *holder);
  }

  void grasp(LiveWorld::Impl& live, std::uint32_t slot, LiveActuator& actuator, const Intent& intent,
             physics::Body& holder) const {
    BodyList found;
    const std::uint32_t named = live.body_slot(actuator.wanted.body);
    if (intent.sensor != state::kNone)
      list_sensed(live, intent.sensor, holder, found);
    else if (named != state::kNone)
      found.add(*live.tables.bodies()[named].body);
    if (intent.sensor != state::kNone)
      hold_sensed_faces(live, intent.sensor, holder, *actuator.soft);
    else if (const std::uint32_t soft = soft_body_slot(live, actuator.wanted.body); soft != state::kNone)
      hold_nearest_node(live, soft, pose(live, slot).position, holder, *actuator.soft);
    const math::Pose T_com_grasp = math::inverse(holder.com_pose()) * pose(live, slot);
    std::optional<math::Pose> T_held_grasp;
    if (intent.sensor == state::kNone && actuator.wanted.use_offset) T_held_grasp = actuator.wanted.T_held_grasp;
    for (const physics::Body* each : found) {
      physics::Body& body = *live.tables.bodies()[each->user_index()].body;
      if (is_held_by(live, each->user_index(), slot)) continue;
      if (actuator.grasps[actuator.used]->hold(holder, body, T_com_grasp, T_held_grasp)) ++actuator.used;
    }
  }
};

}  // namespace

std::unique_ptr<Kind> make_actuator_kind() { return std::make_unique<ActuatorKind>(); }

}  // namespace ambf::model
