#include "state/kinds.h"

#include <atomic>
#include <stdexcept>
#include <vector>

#include "state/detail/built_in_kinds.h"
#include "state/kind_rows.h"

namespace ambf::state {
namespace {

// The built-in kinds' tables and columns are members of Structure and Frame.
class WorldRows final : public KindRows {
 public:
  std::size_t count(const Structure&) const override { return 1; }
  std::uint32_t object(const Structure&, std::uint32_t) const override { return kNone; }
  const PlacedInfo* placed(const Structure&, std::uint32_t) const override { return nullptr; }
  const math::Pose* T_world(const Frame&, std::uint32_t) const override { return nullptr; }
  const math::Pose* T_parent(const Frame&, std::uint32_t) const override { return nullptr; }
  bool active(const Frame& frame, std::uint32_t) const override { return frame.run.throttled; }
};

class BodyRows final : public KindRows {
 public:
  std::size_t count(const Structure& structure) const override { return structure.bodies.size(); }
  std::uint32_t object(const Structure& structure, std::uint32_t slot) const override {
    return structure.bodies[slot].object;
  }
  const PlacedInfo* placed(const Structure&, std::uint32_t) const override { return nullptr; }
  const math::Pose* T_world(const Frame& frame, std::uint32_t slot) const override {
    return &frame.bodies[slot].T_world_body;
  }
  const math::Pose* T_parent(const Frame&, std::uint32_t) const override { return nullptr; }
  bool active(const Frame& frame, std::uint32_t slot) const override { return frame.bodies[slot].active; }
};

class JointRows final : public KindRows {
 public:
  std::size_t count(const Structure& structure) const override { return structure.joints.size(); }
  std::uint32_t object(const Structure& structure, std::uint32_t slot) const override {
    return structure.joints[slot].object;
  }
  const PlacedInfo* placed(const Structure&, std::uint32_t) const override { return nullptr; }
  const math::Pose* T_world(const Frame&, std::uint32_t) const override { return nullptr; }
  const math::Pose* T_parent(const Frame&, std::uint32_t) const override { return nullptr; }
  bool active(const Frame&, std::uint32_t) const override { return false; }
};

template <class Info, class State>
class ViewRows final : public KindRows {
 public:
  ViewRows(std::vector<Info> Structure::*table, std::vector<State> Frame::*column, math::Pose State::*T_world,
           math::Pose State::*T_parent)
      : table_(table), column_(column), T_world_(T_world), T_parent_(T_parent) {}

  std::size_t count(const Structure& structure) const override { return (structure.*table_).size(); }
  std::uint32_t object(const Structure& structure, std::uint32_t slot) const override {
    return (structure.*table_)[slot].object;
  }
  const PlacedInfo* placed(const Structure& structure, std::uint32_t slot) const override {
    return &(structure.*table_)[slot];
  }
  const math::Pose* T_world(const Frame& frame, std::uint32_t slot) const override {
    return &((frame.*column_)[slot].*T_world_);
  }
  const math::Pose* T_parent(const Frame& frame, std::uint32_t slot) const override {
    return &((frame.*column_)[slot].*T_parent_);
  }
  bool active(const Frame& frame, std::uint32_t slot) const override { return (frame.*column_)[slot].active; }

 private:
  std::vector<Info> Structure::*table_;
  std::vector<State> Frame::*column_;
  math::Pose State::*T_world_;
  math::Pose State::*T_parent_;
};

struct Entry {
  KindInfo info;
  std::unique_ptr<KindRows> rows;
};

struct Registry {
  std::vector<Entry> entries;
  std::atomic<bool> closed{false};  // worlds may be made on several threads at a time

  Registry() {  // in the order of ObjectKind's enumerators
    add({"world", "world", "worlds", true, false, false, false}, std::make_unique<WorldRows>());
    add({"rigid_body", "body", "bodies", true, false, true, false}, std::make_unique<BodyRows>());
    add({"joint", "joint", "joints", false, false, false, true}, std::make_unique<JointRows>());
    add({"camera", "camera", "cameras", true, true, false, false},
        std::make_unique<ViewRows<CameraInfo, CameraState>>(
            &Structure::cameras, &Frame::cameras, &CameraState::T_world_camera, &CameraState::T_parent_camera));
    add({"light", "light", "lights", true, true, false, false},
        std::make_unique<ViewRows<LightInfo, LightState>>(&Structure::lights, &Frame::lights,
                                                          &LightState::T_world_light, &LightState::T_parent_light));
  }
  void add(KindInfo info, std::unique_ptr<KindRows> rows) { entries.push_back({std::move(info), std::move(rows)}); }
};

Registry& registry() {
  static Registry table;
  return table;
}

}  // namespace

ObjectKind register_kind(KindInfo info, std::unique_ptr<KindRows> rows) {
  register_built_in_kinds();
  require_open_registration("kind " + info.name);
  if (find_kind(info.name)) throw std::logic_error("there is a kind " + info.name + " already");
  if (registry().entries.size() > 0xff) throw std::logic_error("kind " + info.name + ": there are 256 kinds already");
  registry().add(std::move(info), std::move(rows));
  return static_cast<ObjectKind>(registry().entries.size() - 1);
}

std::size_t kind_count() { return registry().entries.size(); }

const KindInfo& info_of(ObjectKind kind) { return registry().entries[static_cast<std::size_t>(kind)].info; }

const KindRows& rows_of(ObjectKind kind) { return *registry().entries[static_cast<std::size_t>(kind)].rows; }

std::optional<ObjectKind> find_kind(const std::string& name) {
  for (std::size_t i = 0; i < kind_count(); ++i)
    if (registry().entries[i].info.name == name) return static_cast<ObjectKind>(i);
  return std::nullopt;
}

void make_tables(Structure& structure) {
  structure.registered.resize(kind_count());
  for (const Entry& entry : registry().entries) entry.rows->make_table(structure);
}

void close_registration() { registry().closed = true; }

void require_open_registration(const std::string& name) {
  if (registry().closed) throw std::logic_error(name + " was registered after the first world was made");
}

}  // namespace ambf::state
