// Ghost objects: shapes at their parents that feel every body and every other ghost that overlaps them, and push none.
// Nothing of them is in the physics world, and what they feel is computed from the poses whenever a frame is filled, so
// that there is nothing to keep, to wake or to forget.
#include <cmath>

#include "math/rotation.h"
#include "model/detail/view_builder.h"
#include "model/kinds/placed.h"
#include "model/kinds/registry.h"
#include "physics/proximity.h"
#include "scene/ghost.h"
#include "state/ghosts.h"

namespace ambf::model {
namespace {

constexpr double kDragInterval_s = 0.001;

struct LiveGhost final : LivePlaced {
  std::unique_ptr<physics::Body> shape;  // in no world
  double drag = 0.0;
};

// The velocity of a body inside after one step (scene::Ghost::drag).
math::Twist dragged(const math::Twist& twist, const math::Vec3& parent_velocity, double kept) {
  const double squared = math::dot(parent_velocity, parent_velocity);
  const math::Vec3 along =
      squared > 0.0 ? parent_velocity * (math::dot(twist.linear, parent_velocity) / squared) : math::Vec3{};
  return {parent_velocity + (twist.linear - along) * kept, twist.angular * kept};
}

bool is_zero(const math::Twist& twist) { return twist.linear == math::Vec3{} && twist.angular == math::Vec3{}; }

class GhostKind final : public PlacedKind {
 public:
  GhostKind() : PlacedKind(state::ghost_kind().kind) {}

  void load(Catalogue::Impl& all, const LoadedModel& model, const LoadOptions& options,
            Findings& findings) const override {
    each_block(model.description, [&](const scene::KindBlock& block) {
      const auto& ghost = block.as<scene::Ghost>();
      BuiltBody built = all.bodies.build(as_body(block), surroundings(all, model), findings);
      if (built.collision_appearance == nullptr)
        findings.warning(block.identity, "collision shape", "it has none: the ghost object feels nothing",
                         "give `collision shape` and `collision geometry`, or `collision mesh`");
      auto live = std::make_unique<LiveGhost>();
      live->shape = std::move(built.live->body);
      live->drag = ghost.drag;
      state::GhostInfo row;
      row.appearance = std::move(built.appearance);
      row.collision_appearance = std::move(built.collision_appearance);
      row.drag = ghost.drag;
      Entry* entry =
          add(all, std::move(live), block.identity, ghost.parent, ghost.T_parent_ghost, model, options, findings);
      if (entry != nullptr) entry->row = std::move(row);
    });
  }
  void erase_block(scene::Model& model, const std::string& identifier) const override {
    std::erase_if(model.blocks, [&](const scene::KindBlock& block) {
      return block.kind == &scene::kind::kGhostObject && block.identity.identifier == identifier;
    });
  }
  void each_parent(const scene::Model& model, const ParentVisit& visit) const override {
    each_block(model, [&](const scene::KindBlock& block) { visit(block.identity, block.as<scene::Ghost>().parent); });
  }
  void add_row(const Entry& entry, const StructureDraft& draft, state::Structure& structure) const override {
    state::GhostInfo row = entry.row_as<state::GhostInfo>();
    set_placed(row, entry, draft);
    state::table<state::GhostInfo>(structure, number()).push_back(std::move(row));
  }

  // Of a body: its centre of mass, as in AMBF 2.0 and 3.0.
  math::Pose parent_frame(const LiveWorld::Impl& live, std::uint32_t parent) const override {
    const physics::Body* body = body_of(live, parent);
    return body == nullptr ? PlacedKind::parent_frame(live, parent) : body->com_pose();
  }

  void add_actors(LiveWorld::Impl& live) const override {
    live.actors.add(StepPhase::forces, "drag of ghost objects", [this, &live](double h_s) { drag(live, h_s); });
  }

  void fill(const LiveWorld::Impl& live, state::Frame& frame) const override {
    auto& rows = state::rows(frame, state::ghost_kind().column);
    std::vector<state::GhostTouch>& touches = state::ghost_touches(frame);
    touches.clear();
    place(live);
    for (std::uint32_t slot = 0; slot < rows.size(); ++slot) {
      const LiveGhost& ghost = self(live, slot);
      const auto first = static_cast<std::uint32_t>(touches.size());
      each_felt(live, slot, [&](std::uint32_t object) {
        if (touches.size() < touches.capacity()) touches.push_back({object});
      });
      rows[slot] = {{ghost.T_parent, ghost.shape->pose(), ghost.active},
                    first,
                    static_cast<std::uint32_t>(touches.size()) - first};
    }
  }

  std::unique_ptr<SavedObject> make_saved() const override { return std::make_unique<SavedPlaced>(); }

 private:
  LiveGhost& self(const LiveWorld::Impl& live, std::uint32_t slot) const {
    return static_cast<LiveGhost&>(placed(live, slot));
  }

  template <class Visit>
  static void each_block(const scene::Model& model, Visit visit) {
    for (const scene::KindBlock& block : model.blocks)
      if (block.kind == &scene::kind::kGhostObject) visit(block);
  }

  // What builds a body builds its shape and its looks.
  static scene::Body as_body(const scene::KindBlock& block) {
    const auto& ghost = block.as<scene::Ghost>();
    scene::Body body;
    body.identity = block.identity;
    body.visual = ghost.visual;
    body.collision = ghost.collision;
    body.mass = 0.0;
    return body;
  }
  static BodySurroundings surroundings(const Catalogue::Impl& all, const LoadedModel& model) {
    BodySurroundings result;
    result.step_s = all.options.step_s;
    result.shaders = shader_files(model.description.shaders);
    return result;
  }

  // The body that is this object; null where it is another kind.
  static const physics::Body* body_of(const LiveWorld::Impl& live, std::uint32_t object) {
    if (object == state::kNone) return nullptr;
    const state::ObjectInfo& info = live.structure->objects[object];
    return state::info_of(info.kind).has_mass ? live.tables.bodies()[info.slot].body.get() : nullptr;
  }
  // The body that it hangs on, on other objects in between or not; null: it hangs in the world.
  const physics::Body* carrier(const LiveWorld::Impl& live, std::uint32_t slot) const {
    std::uint32_t parent = state::ghosts(*live.structure)[slot].parent_object;
    while (parent != state::kNone && body_of(live, parent) == nullptr) {
      const state::ObjectInfo& info = live.structure->objects[parent];
      parent = state::rows_of(info.kind).placed(*live.structure, info.slot)->parent_object;
    }
    return body_of(live, parent);
  }

  // Puts all shapes where their ghosts are now.
  void place(const LiveWorld::Impl& live) const {
    for (std::uint32_t slot = 0; slot < live.tables.of(number()).size(); ++slot)
      self(live, slot).shape->set_pose(pose(live, slot));
  }

  static bool feels(const LiveGhost& ghost, const physics::Body& other) {
    return physics::within_reach(*ghost.shape, other, 0.0) && physics::groups_meet(*ghost.shape, other) &&
           physics::overlap(*ghost.shape, other);
  }
  // visit(index into Structure::objects) for all that a ghost feels: bodies, then ghosts. After place().
  template <class Visit>
  void each_felt(const LiveWorld::Impl& live, std::uint32_t slot, Visit visit) const {
    const LiveGhost& ghost = self(live, slot);
    const TypedTable<LiveBody> bodies = live.tables.bodies();
    for (std::uint32_t other = 0; other < bodies.size(); ++other)
      if (feels(ghost, *bodies[other].body)) visit(live.structure->bodies[other].object);
    const std::vector<state::GhostInfo>& ghosts = state::ghosts(*live.structure);
    for (std::uint32_t other = 0; other < ghosts.size(); ++other)
      if (other != slot && feels(ghost, *self(live, other).shape)) visit(ghosts[other].object);
  }

  bool any_drags(const LiveWorld::Impl& live) const {
    for (const state::GhostInfo& ghost : state::ghosts(*live.structure))
      if (ghost.drag > 0.0) return true;
    return false;
  }
  // Before physics steps. As forces, so that joints and contacts hold against it, and nothing stays behind when a body
  // or a ghost leaves.
  void drag(LiveWorld::Impl& live, double h_s) const {
    if (!any_drags(live)) return;
    place(live);
    for (const LiveBody& each : live.tables.bodies()) {
      physics::Body& body = *each.body;
      if (body.is_static() || body.frozen()) continue;
      const std::optional<math::Twist> wanted = twist_inside(live, body, h_s);
      if (!wanted || (body.asleep() && is_zero(*wanted))) continue;
      math::Wrench wrench = body.wrench_of_set_twist(*wanted);
      wrench.force -= body.gravity() * body.mass();
      body.apply_wrench(wrench);
    }
  }
  // What all ghosts that drag and feel the body make of its velocity, one after the other; none where none does.
  std::optional<math::Twist> twist_inside(const LiveWorld::Impl& live, const physics::Body& body, double h_s) const {
    std::optional<math::Twist> twist;
    for (std::uint32_t slot = 0; slot < live.tables.of(number()).size(); ++slot) {
      const LiveGhost& ghost = self(live, slot);
      if (ghost.drag <= 0.0) continue;
      const physics::Body* parent = carrier(live, slot);
      if (parent == &body || !feels(ghost, body)) continue;
      const math::Vec3 parent_velocity = parent == nullptr ? math::Vec3{} : parent->twist().linear;
      twist = dragged(twist.value_or(body.twist()), parent_velocity, std::pow(ghost.drag, h_s / kDragInterval_s));
    }
    return twist;
  }
};

}  // namespace

std::unique_ptr<Kind> make_ghost_kind() { return std::make_unique<GhostKind>(); }

}  // namespace ambf::model
