// The list of a frame's columns.
#include "state/columns.h"

#include <algorithm>
#include <limits>

#include "state/kind_rows.h"

namespace ambf::state {
namespace {

// A single value: one that the simulation computes, so that it is hashed as a number.
template <class Value>
class ValueColumn final : public FrameColumn {
 public:
  ValueColumn(ColumnTraits traits, Value Frame::*member) : FrameColumn(std::move(traits)), member_(member) {}

  void make(const Structure&, Frame&) const override {}
  void copy(const Frame& from, Frame& to) const override { to.*member_ = from.*member_; }
  void keep(const Frame& good, Frame& frame) const override { copy(good, frame); }
  void keep_row(const Frame&, std::uint32_t, Frame&, std::uint32_t) const override {}
  void clear(Frame& frame) const override { frame.*member_ = {}; }
  void hash(const Frame& frame, StateHash& hash) const override {
    if constexpr (std::is_integral_v<Value>) {
      hash(static_cast<std::uint64_t>(frame.*member_));
    } else {
      hash(frame.*member_);
    }
  }
  void fill_nan(Frame& frame) const override {
    if constexpr (!std::is_integral_v<Value>) set_nan(frame.*member_);
  }

 private:
  Value Frame::*member_;
};

template <class Row>
struct Member {
  std::vector<Row> Frame::*member;
  std::vector<Row>& operator()(Frame& frame) const { return frame.*member; }
  const std::vector<Row>& operator()(const Frame& frame) const { return frame.*member; }
};

struct Columns {
  std::vector<std::unique_ptr<FrameColumn>> all;
  std::size_t registered = 0;

  template <class Value>
  void value(ColumnTraits traits, Value Frame::*member) {
    all.push_back(std::make_unique<ValueColumn<Value>>(std::move(traits), member));
  }
  template <class Row>
  void rows(ColumnTraits traits, std::vector<Row> Frame::*member) {
    all.push_back(std::make_unique<VectorColumn<Row, Member<Row>>>(std::move(traits), Member<Row>{member}));
  }

  // In the order in which they are hashed. Traits: name, kind, capacity, hashed, while diverged, rows per object.
  Columns() {
    const auto world = ObjectKind::world, body = ObjectKind::rigid_body, joint = ObjectKind::joint;
    const auto live = WhileDiverged::live, good = WhileDiverged::last_good;
    const auto good_structure = WhileDiverged::last_good_structure;
    value({"sim_step", world, 0, true, good}, &Frame::sim_step);
    value({"sim_time", world, 0, true, good}, &Frame::sim_time);
    value({"epoch", world, 0, false, good}, &Frame::epoch);
    value({"frozen_bodies", world, 0, true, good}, &Frame::frozen_bodies);
    rows({"bodies", body, 0, true, good}, &Frame::bodies);
    rows({"joints", joint, 0, true, good}, &Frame::joints);
    rows({"cameras", ObjectKind::camera, 0, false, good}, &Frame::cameras);
    rows({"lights", ObjectKind::light, 0, false, good}, &Frame::lights);
    rows({"body_parameters", body, 0, false, live}, &Frame::body_parameters);
    rows({"joint_parameters", joint, 0, false, live}, &Frame::joint_parameters);
    value({"gravity_world", world, 0, false, live}, &Frame::gravity_world);
    rows({"contacts", world, base::kMaxContactsInFrame, true, good_structure}, &Frame::contacts);
    value({"contacts_total", world, 0, true, good_structure}, &Frame::contacts_total);
    rows({"picks", world, base::kMaxPicks, false, good_structure}, &Frame::picks);
    rows({"law_shares", world, base::kSpareLaws, true, good_structure, 1}, &Frame::law_shares);
    value({"law_shares_total", world, 0, true, good_structure}, &Frame::law_shares_total);
    rows({"effectors", world, base::kMaxEffectors, true, good_structure}, &Frame::effectors);
    rows({"commands", world, 0, false, live, 1}, &Frame::commands);
  }
};

Columns& columns_table() {
  static Columns table;
  return table;
}

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

// visit(index in `good`, index in `frame`) of each object that both structures have: surviving objects keep their
// relative order and precede new ones.
template <class Visit>
void for_each_survivor(const Structure& good, const Structure& now, Visit&& visit) {
  std::size_t from = 0;
  for (std::size_t object = 0; object < now.objects.size(); ++object) {
    std::size_t same = from;
    while (same < good.objects.size() && good.objects[same].id != now.objects[object].id) ++same;
    if (same == good.objects.size()) return;
    visit(same, object);
    from = same + 1;
  }
}

}  // namespace

const std::vector<std::unique_ptr<FrameColumn>>& columns() { return columns_table().all; }

std::size_t next_registered_column() { return columns_table().registered; }

void append_column(std::unique_ptr<FrameColumn> column) {
  require_open_registration("column " + column->traits().name);
  columns_table().all.push_back(std::move(column));
  ++columns_table().registered;
}

std::size_t rows_needed(const Structure& structure, const ColumnTraits& traits) {
  if (traits.kind != ObjectKind::world) return rows_of(traits.kind).count(structure);
  const std::size_t own = traits.rows_of == nullptr ? 0 : traits.rows_of(structure);
  return traits.capacity + traits.rows_per_object * structure.objects.size() + own;
}

void keep_last_good(const Frame& good, Frame& frame) {
  const bool same_structure = good.structure.get() == frame.structure.get();
  for_each_column([&](const FrameColumn& column) {
    const ColumnTraits& traits = column.traits();
    if (traits.while_diverged == WhileDiverged::live) return;
    if (same_structure) {
      column.keep(good, frame);
    } else if (traits.while_diverged == WhileDiverged::last_good_structure) {
      column.clear(frame);
    } else if (traits.kind == ObjectKind::world) {
      column.keep(good, frame);
    } else {
      for_each_survivor(*good.structure, *frame.structure, [&](std::size_t before, std::size_t now) {
        const ObjectInfo& object = frame.structure->objects[now];
        if (object.kind == traits.kind) column.keep_row(good, good.structure->objects[before].slot, frame, object.slot);
      });
    }
  });
}

void fill_nan(Frame& frame) {
  for_each_column([&](const FrameColumn& column) { column.fill_nan(frame); });
}

void set_nan(double& value) { value = kNan; }
void set_nan(math::Vec3& value) { value = {kNan, kNan, kNan}; }
void set_nan(math::Pose& value) { value = {{kNan, kNan, kNan}, {kNan, kNan, kNan, kNan}}; }

}  // namespace ambf::state
