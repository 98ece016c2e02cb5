// What lives in the simulation: built by the loader, then touched by the physics thread only, freed by the loader.
// Plain structs; kinds (model/kinds/), LiveWorld and LiveCommands act on them. For use inside model/ only.
#pragma once

#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "math/types.h"
#include "model/cartesian_controller.h"
#include "model/detail/command_slots.h"
#include "model/detail/laws.h"
#include "model/detail/stable_gains.h"
#include "model/joint_controller.h"
#include "physics/body.h"
#include "physics/joint.h"
#include "state/command.h"
#include "state/ids.h"
#include "state/kinds.h"
#include "state/parameters.h"

namespace ambf::model {

struct LiveObject {
  LiveObject() = default;
  virtual ~LiveObject() = default;
  LiveObject(const LiveObject&) = delete;
  LiveObject& operator=(const LiveObject&) = delete;

  std::shared_ptr<CommandSlots> slots;  // null: takes no commands
  bool active = false;                  // a source has a command in force
  // Of bodies and joints: position targets stay in force when their command expires. As now, and as loaded.
  bool hold = false, hold_loaded = false;
};

// What joints connect a moving body with, itself included (model/command_bounds.cpp).
struct Mechanism {
  std::uint32_t root = 0;    // slot of the body that stands for all
  std::uint32_t bodies = 0;  // moving ones
  double mass = 0.0;         // kg, of all
  double inertia = 0.0;      // kg m^2, of all about their centre of mass; an upper bound for every axis
  math::Vec3 first_moment;   // kg m
};

struct LiveBody final : LiveObject {
  LiveBody(std::unique_ptr<physics::Body> made, const CartesianController& control)
      : body(std::move(made)), controller(control) {}

  std::unique_ptr<physics::Body> body;
  CartesianController controller;

  // Commands of all sources, merged.
  math::Wrench wrench_world;                                             // at the COM
  state::CartesianCommandType mode = state::CartesianCommandType::none;  // none, position or velocity
  math::Pose T_world_target;
  math::Twist twist_world;
  state::Source target_source = state::Source::ros;  // of the pose or the twist

  GainScale gain_scale;  // what input devices on the body leave of its controller's gains

  SharesOfBody shares;
  state::Push push;
  std::uint64_t push_steps = 0;  // that it still lasts

  Mechanism mechanism;
  state::SourceSet bounds_logged = 0;  // sources whose laws and pushes were cut
  bool gains_logged = false;           // that the gains of devices and controller were cut
};

// What is in force.
state::BodyParameters parameters_of(const LiveBody& live);
void set_parameters(LiveBody& live, const state::BodyParameters& parameters, double h_s);

// A joint's command; persistent.
struct JointOrder {
  state::JointCommandType type = state::JointCommandType::none;
  double value = 0.0;
  CommandSlot* led = nullptr;     // the slot that leads; null: none any more
  const LiveBody* jaw = nullptr;  // an input device commands it as part of the jaw of this body
};

struct LiveJoint final : LiveObject {
  LiveJoint(std::unique_ptr<physics::Joint> made, const JointController& control)
      : joint(std::move(made)), controller(control) {}

  std::unique_ptr<physics::Joint> joint;
  JointController controller;
  bool motor_holds = false;  // before its first command, its motor keeps it where it is
  bool feedback = false;
  JointOrder order;
};

state::JointParameters parameters_of(const LiveJoint& live);
void set_parameters(LiveJoint& live, const state::JointParameters& parameters);

// An object with a pose in a parent (KindInfo::has_parent). Kinds with values of their own derive from it.
struct LivePlaced : LiveObject {
  math::Pose T_parent_loaded;             // in the parent that its file names
  math::Pose T_parent_initial, T_parent;  // in the present one: where a reset puts it, and now
  bool orphaned = false;                  // its parent is gone: it stays where it was, reset or not
};

// Where a live object is: its kind and its slot among its kind.
struct ObjectRef {
  state::ObjectKind kind{};  // the world: no object
  std::uint32_t slot = state::kNone;
};

using LiveTable = std::vector<std::unique_ptr<LiveObject>>;

// A table whose objects are all of one type.
template <class Live>
class TypedTable {
 public:
  explicit TypedTable(const LiveTable& table) : table_(&table) {}

  std::size_t size() const { return table_->size(); }
  Live& operator[](std::size_t slot) const { return static_cast<Live&>(*(*table_)[slot]); }

  class Iterator {
   public:
    explicit Iterator(LiveTable::const_iterator at) : at_(at) {}
    Live& operator*() const { return static_cast<Live&>(**at_); }
    Iterator& operator++() {
      ++at_;
      return *this;
    }
    bool operator!=(const Iterator& other) const { return at_ != other.at_; }

   private:
    LiveTable::const_iterator at_;
  };
  Iterator begin() const { return Iterator(table_->begin()); }
  Iterator end() const { return Iterator(table_->end()); }

 private:
  const LiveTable* table_;
};

// Everything alive, by kind and slot. Joints are destroyed before the bodies that they connect: kinds in reverse order.
struct LiveTables {
  LiveTables() : by_kind(state::kind_count()) {}
  ~LiveTables() {
    while (!by_kind.empty()) by_kind.pop_back();
  }
  LiveTables(LiveTables&&) noexcept = default;
  LiveTables& operator=(LiveTables&&) noexcept = default;

  LiveTable& of(state::ObjectKind kind) { return by_kind[static_cast<std::size_t>(kind)]; }
  const LiveTable& of(state::ObjectKind kind) const { return by_kind[static_cast<std::size_t>(kind)]; }
  LiveObject& at(ObjectRef object) const { return *by_kind[static_cast<std::size_t>(object.kind)][object.slot]; }

  // What Bullet simulates (model/kinds/rigid_body.cpp, joint.cpp).
  TypedTable<LiveBody> bodies() const;
  TypedTable<LiveJoint> joints() const;

  std::vector<LiveTable> by_kind;
  std::vector<ObjectRef> by_index;   // ObjectId::index -> object; only what takes commands is in it
  std::vector<ObjectRef> commanded;  // objects with a source in force; room for all
  std::vector<ObjectRef> noted;      // objects that were ever sent a command; room for all
};

}  // namespace ambf::model
