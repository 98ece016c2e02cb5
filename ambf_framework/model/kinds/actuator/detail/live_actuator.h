// An actuator in the simulation: what it holds, what makes it hold, what a magnet pulls. Physics thread. For use inside
// model/kinds/actuator* only.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>

#include "base/limits.h"
#include "model/detail/live_impl.h"
#include "physics/blade.h"
#include "physics/grasp.h"
#include "physics/needle.h"
#include "physics/soft_grip.h"
#include "physics/thread.h"
#include "scene/actuator.h"
#include "state/actuators.h"

namespace ambf::model {

// Bodies, each once, in the order in which they were added; what there is no room for is left out.
class BodyList {
 public:
  void clear() { size_ = 0; }
  void add(const physics::Body& body) {
    if (size_ < bodies_.size() && std::find(begin(), end(), &body) == end()) bodies_[size_++] = &body;
  }
  const physics::Body* const* begin() const { return bodies_.data(); }
  const physics::Body* const* end() const { return bodies_.data() + size_; }
  std::size_t size() const { return size_; }

 private:
  std::array<const physics::Body*, base::kMaxHeldBodies> bodies_{};
  std::size_t size_ = 0;
};

struct LiveActuator final : LivePlaced {
  LiveActuator(const scene::Actuator& from, const physics::GraspOptions& options)
      : below(from.below), strength_N(from.strength_N), range_m(from.range_m) {
    if (from.type == state::ActuatorType::blade)
      blade = std::make_unique<physics::Blade>(physics::BladeOptions{from.edge, from.sharpness});
    if (from.type == state::ActuatorType::needle)
      needle = std::make_unique<physics::Needle>(
          physics::NeedleOptions{from.arc, from.puncture_force, from.needle_friction, from.strength_N});
    if (from.type != state::ActuatorType::constraint) return;
    soft = std::make_unique<physics::SoftGrip>(physics::SoftGripOptions{from.hardness, from.damping});
    for (auto& grasp : grasps) grasp = std::make_unique<physics::Grasp>(options);
  }

  // As loaded.
  const double below, strength_N, range_m;
  std::array<std::unique_ptr<physics::Grasp>, base::kMaxHeldBodies> grasps;  // null: a magnet
  std::unique_ptr<physics::SoftGrip> soft;                                   // likewise

  std::unique_ptr<physics::Blade> blade;                    // null: it is none
  std::unique_ptr<physics::Needle> needle;                  // likewise
  bool uncuttable_reported = false, full_reported = false;  // of a blade
  // Of a needle.
  bool untied_reported = false, knots_reported = false, stitches_reported = false, holders_reported = false;

  bool commanded = false;         // a command is in force
  state::ActuatorCommand wanted;  // of the source that wrote last
  std::uint64_t newest = 0;       // number of the newest command so far
  // The jaw that triggers it, since it was last below or above its bounds. Of a needle: it has tied as commanded.
  bool closed = false;

  std::size_t used = 0;  // the first so many grasps may hold something
  std::array<std::optional<physics::Hold>, base::kMaxHeldBodies> outlives;  // a reset that is being made

  // Magnets, in the last step. Forgotten whenever bodies come or go.
  BodyList pulled;
  math::Vec3 pull_world;  // N, on all of them

  bool holds() const {
    return !soft->held().empty() || std::any_of(grasps.begin(), grasps.begin() + static_cast<std::ptrdiff_t>(used),
                                                [](const auto& grasp) { return grasp->holds(); });
  }
  void release() {
    for (std::size_t i = 0; i < used; ++i) grasps[i]->release();
    used = 0;
    soft->release();
  }
};

// What an actuator is to do in the coming step.
struct Intent {
  bool hold = false;                    // what it holds stays held
  bool grasp = false;                   // if it holds nothing, it takes what it finds
  std::uint32_t sensor = state::kNone;  // slot of the sensor whose bodies it takes; kNone: the one that is named
};
// Moves LiveActuator::closed along.
Intent intent_of(const LiveWorld::Impl& live, std::uint32_t slot, LiveActuator& actuator);

// How far all limited joints below a body are open, 0 closed .. 1 open: their mean, as measured (EQUATIONS 8 inverted).
// Negative: it has none.
double jaw_opening(const LiveWorld::Impl& live, std::uint32_t body_slot);

// Whether the sensor senses the body.
bool senses(const LiveWorld::Impl& live, std::uint32_t sensor, const physics::Body& body);
// The bodies that the sensor senses, without `holder`.
void list_sensed(const LiveWorld::Impl& live, std::uint32_t sensor, const physics::Body& holder, BodyList& out);

// Takes the corners of each face that the sensor senses.
void hold_sensed_faces(const LiveWorld::Impl& live, std::uint32_t sensor, physics::Body& holder,
                       physics::SoftGrip& grip);
// Takes the node that is nearest to a place, if any is within reach.
void hold_nearest_node(const LiveWorld::Impl& live, std::uint32_t soft_body, const math::Vec3& place_world,
                       physics::Body& holder, physics::SoftGrip& grip);

// What a blade does in the coming step.
void cut(LiveWorld::Impl& live, std::uint32_t slot, physics::Body* holder, LiveActuator& actuator);

// What a needle does in the coming step, and whose thread it draws (null: none).
void sew(LiveWorld::Impl& live, std::uint32_t slot, physics::Body* holder, LiveActuator& actuator);
physics::Thread* thread_of(const LiveWorld::Impl& live, std::uint32_t slot);

// A magnet pulls each body that the sensor senses towards the nearest hit's ray, and the holder towards it, with forces
// at that one point.
void pull(const LiveWorld::Impl& live, std::uint32_t sensor, physics::Body& holder, double h_s, LiveActuator& actuator);

}  // namespace ambf::model
