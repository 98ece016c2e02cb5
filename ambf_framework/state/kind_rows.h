// How the rows of one kind of objects are read and made: its table in a Structure, its column in a Frame. A registered
// kind derives its structure row from PlacedInfo and its frame row from PlacedState, and registers both with
// register_placed_kind. C++17.
#pragma once

#include <any>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "state/columns.h"
#include "state/frame.h"
#include "state/kinds.h"
#include "state/structure.h"

namespace ambf::state {

class KindRows {
 public:
  virtual ~KindRows() = default;
  virtual std::size_t count(const Structure& structure) const = 0;
  // Index into Structure::objects.
  virtual std::uint32_t object(const Structure& structure, std::uint32_t slot) const = 0;
  // Of kinds with KindInfo::has_parent, else null.
  virtual const PlacedInfo* placed(const Structure& structure, std::uint32_t slot) const = 0;
  // Pose in the world; null for kinds without one (joints).
  virtual const math::Pose* T_world(const Frame& frame, std::uint32_t slot) const = 0;
  // Pose in the parent; null for kinds without KindInfo::has_parent.
  virtual const math::Pose* T_parent(const Frame& frame, std::uint32_t slot) const = 0;
  // A command is in force.
  virtual bool active(const Frame& frame, std::uint32_t slot) const = 0;
  // Makes an empty table, or column, in what was just constructed. Built-in kinds have members instead.
  virtual void make_table(Structure&) const {}
};

const KindRows& rows_of(ObjectKind kind);

// A registered kind's table in a structure.
template <class Info>
const std::vector<Info>& table(const Structure& structure, ObjectKind kind) {
  return std::any_cast<const std::vector<Info>&>(structure.registered.at(static_cast<std::size_t>(kind)));
}
template <class Info>
std::vector<Info>& table(Structure& structure, ObjectKind kind) {
  return std::any_cast<std::vector<Info>&>(structure.registered.at(static_cast<std::size_t>(kind)));
}

// The same table is empty in a structure that was made by hand.
void make_tables(Structure& structure);

// What register_placed_kind returns: the kind and its column.
template <class State>
struct PlacedKind {
  ObjectKind kind = ObjectKind::world;
  ColumnId<State> column;
};

template <class Info, class State>
class PlacedRows final : public KindRows {
 public:
  void bind(PlacedKind<State> registered) { registered_ = registered; }

  std::size_t count(const Structure& structure) const override {
    return has_table(structure) ? infos(structure).size() : 0;
  }
  std::uint32_t object(const Structure& structure, std::uint32_t slot) const override {
    return infos(structure)[slot].object;
  }
  const PlacedInfo* placed(const Structure& structure, std::uint32_t slot) const override {
    return &infos(structure)[slot];
  }
  const math::Pose* T_world(const Frame& frame, std::uint32_t slot) const override {
    return &rows(frame, registered_.column)[slot].T_world_object;
  }
  const math::Pose* T_parent(const Frame& frame, std::uint32_t slot) const override {
    return &rows(frame, registered_.column)[slot].T_parent_object;
  }
  bool active(const Frame& frame, std::uint32_t slot) const override {
    return rows(frame, registered_.column)[slot].active;
  }
  void make_table(Structure& structure) const override {
    structure.registered[static_cast<std::size_t>(registered_.kind)] = std::vector<Info>();
  }

 private:
  bool has_table(const Structure& structure) const {
    const auto number = static_cast<std::size_t>(registered_.kind);
    return number < structure.registered.size() && structure.registered[number].has_value();
  }
  const std::vector<Info>& infos(const Structure& structure) const { return table<Info>(structure, registered_.kind); }

  PlacedKind<State> registered_;
};

// Registers a kind whose objects have a pose in a parent. Its column is named as its plural, is hashed, and shows last
// good values while the world is diverged.
template <class Info, class State>
PlacedKind<State> register_placed_kind(KindInfo info) {
  auto rows = std::make_unique<PlacedRows<Info, State>>();
  PlacedRows<Info, State>& bound = *rows;
  info.has_parent = true;
  std::string column = info.plural;
  PlacedKind<State> registered;
  registered.kind = register_kind(std::move(info), std::move(rows));
  registered.column = register_column<State>({std::move(column), registered.kind, 0, true, WhileDiverged::last_good});
  bound.bind(registered);
  return registered;
}

}  // namespace ambf::state
