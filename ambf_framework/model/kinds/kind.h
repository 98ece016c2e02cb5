// What a kind of objects does: on the loader thread it makes live objects from blocks of a description, on the physics
// thread it links, commands, fills, resets, saves and restores them. One object for each kind, without state of its
// own; the core walks the table of kinds (model/kinds/registry.h) and names none. A kind whose objects hang on a parent
// derives from PlacedKind (model/kinds/placed.h).
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "model/detail/catalogue_impl.h"
#include "model/detail/live_impl.h"
#include "model/detail/state_bytes.h"
#include "model/saved_state.h"
#include "state/frame.h"
#include "state/kinds.h"

namespace ambf::model {

// What a kind needs to make its row of a new structure.
struct StructureDraft {
  const std::vector<Relatives>& relatives;            // by ObjectId::index
  const std::vector<std::uint32_t>& object_of_index;  // index into Structure::objects

  std::uint32_t object(const Entry* entry) const {
    return entry == nullptr ? state::kNone : object_of_index[entry->info.id.index];
  }
};

// Whose state is written or read.
struct SavedContext {
  const state::Structure& structure;
  std::uint32_t slot = 0;
  double step_s = 0.0;
  std::uint64_t last_order = 0;  // of commands
};

class Kind {
 public:
  explicit Kind(state::ObjectKind number) : number_(number) {}
  virtual ~Kind() = default;
  Kind(const Kind&) = delete;
  Kind& operator=(const Kind&) = delete;

  state::ObjectKind number() const { return number_; }
  const state::KindInfo& info() const { return state::info_of(number_); }

  // ---- Loader thread ----
  // Adds an entry with its live object for each block of this kind, in their order.
  virtual void load(Catalogue::Impl& all, const LoadedModel& model, const LoadOptions& options,
                    Findings& findings) const = 0;
  // Copies the world file's blocks of this kind, or a default where it has none, into the description of model 0.
  virtual void describe_world(const scene::World&, LoadedModel&) const {}
  virtual void erase_block(scene::Model& model, const std::string& identifier) const = 0;
  // visit(identity, parent as written) for each block, where the kind has a parent.
  using ParentVisit = std::function<void(const scene::Identity&, const std::string&)>;
  virtual void each_parent(const scene::Model&, const ParentVisit&) const {}
  // Objects that are there for this one alone: they are removed with it.
  virtual std::vector<state::ObjectId> belongings(const Entry&) const { return {}; }
  // Appends the entry's row to the kind's table in a new structure.
  virtual void add_row(const Entry& entry, const StructureDraft& draft, state::Structure& structure) const = 0;

  // ---- Any thread ----
  virtual bool accepts(const state::Command&) const { return false; }

  // ---- Physics thread ----
  // After a swap, in load order: every object, new or not. Unlinking goes through the kinds in reverse order.
  virtual void link(LiveWorld::Impl&, std::uint32_t /*slot*/, bool /*is_new*/) const {}
  virtual void unlink(LiveWorld::Impl&, std::uint32_t /*slot*/) const {}
  // The pose in the world.
  virtual math::Pose pose(const LiveWorld::Impl&, std::uint32_t /*slot*/) const { return {}; }
  // Of kinds with a parent: the pose in the world of the frame that poses in this parent (index into
  // Structure::objects, state::kNone: the world) are in.
  virtual math::Pose parent_frame(const LiveWorld::Impl& live, std::uint32_t parent_object) const {
    return parent_object == state::kNone ? math::Pose{} : live.pose_of(parent_object);
  }
  // Recomputes the effect of all commands in force; returns whether a frame would show it before the next step.
  virtual bool merge(LiveWorld::Impl&, std::uint32_t /*slot*/, const CommandSlots&) const { return false; }
  // Whether a command of this kind, while it is in force, keeps other masters from the object (LiveCommands).
  virtual bool excludes_others(const state::Command&) const { return false; }
  // A new command, while something is frozen: what it commands is released, unless the command asks for too much.
  virtual void release_frozen(LiveWorld::Impl&, std::uint32_t /*slot*/, const state::Command&) const {}
  // The next step obeys its commands; else they are obeyed when they are taken.
  virtual bool obeys_in_step() const { return false; }
  // Adds what acts in each step (model/step_actors.h). Once, when the world is made.
  virtual void add_actors(LiveWorld::Impl&) const {}
  // Writes the rows of all its objects.
  virtual void fill(const LiveWorld::Impl& live, state::Frame& frame) const = 0;
  virtual void fill_parameters(const LiveWorld::Impl&, state::Frame&) const {}
  // In force afterwards; nothing when the kind has no such parameter.
  virtual std::optional<math::Vec3> set_parameter(LiveWorld::Impl&, std::uint32_t /*slot*/, state::Parameter,
                                                  const math::Vec3&) const {
    return std::nullopt;
  }
  // A reset of the world: parameters as loaded first, then, once physics is reset, the rest.
  virtual void reset_parameters(LiveWorld::Impl&, std::uint32_t /*slot*/) const {}
  virtual void reset(LiveWorld::Impl& live, std::uint32_t slot) const = 0;
  // Of both resets, of the world and of its bodies: what outlives them is noted first, and made anew at the end.
  virtual void before_reset(LiveWorld::Impl&, std::uint32_t /*slot*/) const {}
  virtual void after_reset(LiveWorld::Impl&, std::uint32_t /*slot*/) const {}
  // Whether its commands in force outlive a reset of the world; they outlive one of bodies in any case.
  virtual bool commands_outlive_reset() const { return false; }
  // Bodies were put where they were loaded, without a reset of the world.
  virtual void bodies_reset(LiveWorld::Impl&, std::uint32_t /*slot*/) const {}
  // Objects of all kinds are where they are to be, after a swap, a reset or a restore.
  virtual void all_placed(LiveWorld::Impl&, std::uint32_t /*slot*/) const {}

  // The kind's part of a whole state; commands are added by the caller.
  virtual std::unique_ptr<SavedObject> make_saved() const = 0;
  virtual void save(const LiveWorld::Impl& live, std::uint32_t slot, SavedObject& saved) const = 0;
  // Writes, or reads and checks.
  virtual void transfer(StateArchive& archive, SavedObject& saved, const SavedContext& context) const = 0;
  virtual void transfer(StateArchive&, state::Command&) const {}
  // The same of a command that names other objects; most kinds' commands name none.
  virtual void transfer(StateArchive& archive, state::Command& command, const SavedContext&) const {
    transfer(archive, command);
  }
  // How many physics::Grasp its objects have in the world; those of each object are added when it is linked.
  virtual std::size_t grasps(const state::Structure&) const { return 0; }
  // Its commands are in force again already.
  virtual void restore(LiveWorld::Impl& live, std::uint32_t slot, const SavedObject& saved) const = 0;

 private:
  const state::ObjectKind number_;
};

}  // namespace ambf::model
