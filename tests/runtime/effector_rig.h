// Bodies that devices hold, in a simulation without threads. What a device's thread would post is posted between two
// calls of step. One thread.
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <optional>
#include <string>

#include "math/rotation.h"
#include "runtime/local_simulation.h"
#include "tests/model/rig.h"
#include "tests/runtime/simulation_rig.h"

namespace ambf::runtime::test {

inline constexpr double kStep_s = 1e-3;

// Above the floor; positions in these tests are from here.
inline constexpr math::Vec3 kCentre{0, 0, 1};

// Neither gravity nor damping: what devices do is all that moves it.
inline scene::Body floating_box(const std::string& name, double mass, const math::Vec3& position = {}) {
  scene::Body body = model::test::box(name, mass, kCentre + position);
  body.gravity = math::Vec3{};
  body.surface.linear_damping = body.surface.angular_damping = 0.0;
  return body;
}

// Gains of Fig. 3.8, linear; angular ones that a box of 1 kg and 0.1 m bears.
inline state::EffectorGains thesis_gains() { return {{500, 500, 500}, {10, 10, 10}, {2, 2, 2}, {0.05, 0.05, 0.05}}; }

// One device on one body.
struct Hand {
  std::unique_ptr<state::EffectorPort> port;
  state::SetPoint set_point;

  void at(const math::Vec3& position) {
    set_point.T_world_ref.position = kCentre + position;
    post();
  }
  void post() {
    ++set_point.sample;
    port->post(set_point);
  }
};

struct EffectorRig {
  explicit EffectorRig(const scene::Model& model) { EXPECT_TRUE(simulation.load(model).success); }
  explicit EffectorRig(std::vector<scene::Body> bodies) : EffectorRig(model::test::model("scene", std::move(bodies))) {}

  state::ObjectId id(const std::string& name) const {
    const auto structure = simulation.structure();
    return structure->objects.at(state::find(*structure, "/test/" + name, state::ObjectKind::rigid_body)).id;
  }
  std::uint32_t slot(const std::string& name, state::ObjectKind kind = state::ObjectKind::rigid_body) const {
    const auto structure = simulation.structure();
    return structure->objects.at(state::find(*structure, "/test/" + name, kind)).slot;
  }
  Hand hand(const std::string& body, int device = 0) {
    Hand made;
    const auto source = static_cast<state::Source>(static_cast<int>(state::Source::device_0) + device);
    made.port = simulation.hold(id(body), source);
    EXPECT_NE(made.port, nullptr);
    made.set_point.gains = thesis_gains();
    made.set_point.pulls = made.set_point.engaged = true;
    made.set_point.epoch = simulation.frame().epoch;
    made.set_point.T_world_ref = pose(body);
    return made;
  }
  math::Pose pose(const std::string& body) const { return simulation.frame().bodies[slot(body)].T_world_body; }
  math::Vec3 position(const std::string& body) const { return pose(body).position - kCentre; }
  math::Twist twist(const std::string& body) const { return simulation.frame().bodies[slot(body)].twist_world; }
  std::optional<math::Wrench> share(int device, const std::string& body) const {
    for (const state::LawShare& row : simulation.frame().law_shares)
      if (row.body == slot(body) && static_cast<int>(row.source) == static_cast<int>(state::Source::device_0) + device)
        return row.wrench_world;
    return std::nullopt;
  }
  const state::EffectorState* row(int device, const std::string& body) const {
    for (const state::EffectorState& row : simulation.frame().effectors)
      if (row.body == slot(body) && static_cast<int>(row.source) == static_cast<int>(state::Source::device_0) + device)
        return &row;
    return nullptr;
  }

  JudgedLog log;
  mutable LocalSimulation simulation{free_running(), empty_world(), {}, log};
};

inline void expect_near(const math::Vec3& a, const math::Vec3& b, double tolerance, const char* what = "") {
  EXPECT_NEAR(a.x, b.x, tolerance) << what;
  EXPECT_NEAR(a.y, b.y, tolerance) << what;
  EXPECT_NEAR(a.z, b.z, tolerance) << what;
}

}  // namespace ambf::runtime::test
