// The columns of a frame: one table that for_each_column visits, so that making, copying, hashing and keeping a frame
// are written once. A column is a single value, one row for each object of a kind, or a list. Built-in columns are
// members of Frame; others are registered before the first world is made and read with rows(frame, id). C++17.
#pragma once

#include <any>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "base/hash.h"
#include "math/types.h"
#include "state/frame.h"
#include "state/ids.h"

namespace ambf::state {

// What frames of a diverged world show.
enum class WhileDiverged : std::uint8_t {
  live,                // what it is now
  last_good,           // as it was before; of rows: those of the objects that are still there
  last_good_structure  // as it was before; empty or 0 once the structure has changed
};

struct ColumnTraits {
  std::string name;
  ObjectKind kind = ObjectKind::world;  // one row for each object of it; world: a list or a single value
  std::size_t capacity = 0;             // of a list: filling a frame must not exceed it and rows_per_object together
  bool hashed = false;                  // part of state_hash: the visit_computed values of each row
  WhileDiverged while_diverged = WhileDiverged::live;
  std::size_t rows_per_object = 0;  // of a list: further capacity for each object, of whatever kind
  // Of a list whose length follows from the structure (one row for each ray of all sensors): further capacity.
  std::size_t (*rows_of)(const Structure& structure) = nullptr;
};

class StateHash {
 public:
  void operator()(double value) { hash_.add_bytes(&value, sizeof value); }
  void operator()(std::uint64_t value) { hash_.add_bytes(&value, sizeof value); }
  void operator()(const math::Vec3& v) { (*this)(v.x), (*this)(v.y), (*this)(v.z); }
  void operator()(const math::Pose& p) {
    (*this)(p.position);
    (*this)(p.orientation.x), (*this)(p.orientation.y), (*this)(p.orientation.z), (*this)(p.orientation.w);
  }
  std::uint64_t value() const { return hash_.value(); }

 private:
  base::Fnv1a hash_;
};

// What the simulation computes of a row, for hashes and for the NaN of new frames: overload it beside the row's type
// (its namespace is searched); visit takes double&, math::Vec3& and math::Pose&.
template <class Row, class Visit>
void visit_computed(Row&, Visit&) {}
template <class Visit>
void visit_computed(double& value, Visit& visit) {
  visit(value);
}
template <class Visit>
void visit_computed(BodyState& row, Visit& visit) {
  visit(row.T_world_body);
  visit(row.twist_world.linear), visit(row.twist_world.angular);
  visit(row.wrench_body.force), visit(row.wrench_body.torque);
}
template <class Visit>
void visit_computed(JointState& row, Visit& visit) {
  visit(row.position), visit(row.velocity), visit(row.effort);
}
template <class Visit>
void visit_computed(CameraState& row, Visit& visit) {
  visit(row.T_parent_camera), visit(row.T_world_camera);
}
template <class Visit>
void visit_computed(LightState& row, Visit& visit) {
  visit(row.T_parent_light), visit(row.T_world_light);
}
template <class Visit>
void visit_computed(ContactState& row, Visit& visit) {
  visit(row.point_world), visit(row.normal_world), visit(row.impulse);
}
template <class Visit>
void visit_computed(LawShare& row, Visit& visit) {
  visit(row.wrench_world.force), visit(row.wrench_world.torque);
}

template <class Visit>
void visit_computed(EffectorState& row, Visit& visit) {
  visit(row.T_world_ref);
  visit(row.twist_ref_world.linear), visit(row.twist_ref_world.angular);
  visit(row.gains.linear_stiffness), visit(row.gains.linear_damping);
  visit(row.gains.angular_stiffness), visit(row.gains.angular_damping);
  visit(row.jaw);
}

// The part of a kept row that stays live: which command is in force is no result of physics.
template <class Row>
auto keep_active(Row& kept, const Row& live, int) -> decltype(void(live.active)) {
  kept.active = live.active;
}
template <class Row>
void keep_active(Row&, const Row&, long) {}

class FrameColumn {
 public:
  explicit FrameColumn(ColumnTraits traits) : traits_(std::move(traits)) {}
  virtual ~FrameColumn() = default;
  const ColumnTraits& traits() const { return traits_; }

  // Gives a new frame its rows, or the room for them.
  virtual void make(const Structure& structure, Frame& frame) const = 0;
  // All of it, between frames of one structure; allocates nothing.
  virtual void copy(const Frame& from, Frame& to) const = 0;
  // Last good values over live ones: all of a value or a list; with kinds, one row.
  virtual void keep(const Frame& good, Frame& frame) const = 0;
  virtual void keep_row(const Frame& good, std::uint32_t good_slot, Frame& frame, std::uint32_t slot) const = 0;
  // Of a list or a value: none.
  virtual void clear(Frame& frame) const = 0;
  virtual void hash(const Frame& frame, StateHash& hash) const = 0;
  virtual void fill_nan(Frame& frame) const = 0;

 private:
  const ColumnTraits traits_;
};

const std::vector<std::unique_ptr<FrameColumn>>& columns();

// visit(const FrameColumn&), in a fixed order: Frame's own columns, then the registered ones as they came.
template <class Visit>
void for_each_column(Visit&& visit) {
  for (const auto& column : columns()) visit(*column);
}

// Overwrites what a diverged world computed with the last good values, as the columns' traits say, in a frame filled
// for the same structure or a later one.
void keep_last_good(const Frame& good, Frame& frame);

// Debug builds: whatever a frame's first filling forgets is NaN.
void fill_nan(Frame& frame);

// A registered column of rows of one type.
template <class Row>
struct ColumnId {
  std::size_t index = static_cast<std::size_t>(-1);
};

template <class Row>
const std::vector<Row>& rows(const Frame& frame, ColumnId<Row> column) {
  return std::any_cast<const std::vector<Row>&>(frame.registered.at(column.index));
}
template <class Row>
std::vector<Row>& rows(Frame& frame, ColumnId<Row> column) {
  return std::any_cast<std::vector<Row>&>(frame.registered.at(column.index));
}

std::size_t rows_needed(const Structure& structure, const ColumnTraits& traits);
std::size_t next_registered_column();
void append_column(std::unique_ptr<FrameColumn> column);
void set_nan(double& value);
void set_nan(math::Vec3& value);
void set_nan(math::Pose& value);

// A column that is a vector of rows; Access(frame) returns it.
template <class Row, class Access>
class VectorColumn : public FrameColumn {
 public:
  VectorColumn(ColumnTraits traits, Access access) : FrameColumn(std::move(traits)), access_(access) {}

  void make(const Structure& structure, Frame& frame) const override {
    const std::size_t count = rows_needed(structure, traits());
    if (is_list()) {
      access_(frame).reserve(count);
    } else {
      access_(frame).resize(count);
    }
  }
  void copy(const Frame& from, Frame& to) const override { access_(to) = access_(from); }
  void keep(const Frame& good, Frame& frame) const override {
    if (is_list()) return copy(good, frame);
    for (std::uint32_t slot = 0; slot < access_(frame).size(); ++slot) keep_row(good, slot, frame, slot);
  }
  void keep_row(const Frame& good, std::uint32_t good_slot, Frame& frame, std::uint32_t slot) const override {
    const Row live = access_(frame)[slot];
    access_(frame)[slot] = access_(good)[good_slot];
    keep_active(access_(frame)[slot], live, 0);
  }
  void clear(Frame& frame) const override {
    if (is_list()) access_(frame).clear();
  }
  void hash(const Frame& frame, StateHash& hash) const override {
    for (Row row : access_(frame)) visit_computed(row, hash);
  }
  void fill_nan(Frame& frame) const override {
    const auto set = [](auto& value) { set_nan(value); };
    for (Row& row : access_(frame)) visit_computed(row, set);
  }

 private:
  bool is_list() const { return traits().kind == ObjectKind::world; }
  Access access_;
};

// Appends a column of rows; as register_kind. Rows must be copyable without allocation once their vector has its room.
template <class Row>
ColumnId<Row> register_column(ColumnTraits traits) {
  const ColumnId<Row> id{next_registered_column()};
  struct Access {
    ColumnId<Row> id;
    std::vector<Row>& operator()(Frame& frame) const {
      if (frame.registered.size() <= id.index) frame.registered.resize(id.index + 1);
      std::any& column = frame.registered[id.index];
      if (!column.has_value()) column = std::vector<Row>();
      return rows(frame, id);
    }
    const std::vector<Row>& operator()(const Frame& frame) const { return rows(frame, id); }
  };
  append_column(std::make_unique<VectorColumn<Row, Access>>(std::move(traits), Access{id}));
  return id;
}

}  // namespace ambf::state
