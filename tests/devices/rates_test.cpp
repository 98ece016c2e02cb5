// The dissertation's Fig. 3.20 through devices and mapping, in lockstep: an ellipse (Eq. 3.10) at rates of the physics
// thread from 1000 to 10 Hz, with one and two users, and with devices whose samples are slow or late. Prints the table
// of docs/effectors.md, which tests/benchmarks/plot_rates.py draws.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <map>
#include <random>

#include "tests/devices/session_rig.h"

namespace ambf::devices::testing {
namespace {

using math::Vec3;

constexpr double kSeconds = 4.0, kSettled_s = 1.5;

// From where the hand rests, without a jump: up to 0.89 m/s.
Vec3 ellipse(double t_s) {
  constexpr double kRate = 4.0, kScale = 0.1;
  return {kScale * std::sin(kRate * t_s), kScale * (std::cos(kRate * t_s) - 1.0), 2 * kScale * std::sin(kRate * t_s)};
}

struct Course {
  double mass_kg = 1.0;
  int users = 1;
  unsigned steps = 1;         // an iteration
  double device_hz = 1000.0;  // the device's own
  double delay_s = 0.0;       // each sample is late by up to this
};
struct Followed {
  double rms_m = 0.0;   // from the reference, at the ends of iterations
  double tool_N = 0.0;  // largest pull of the first user
  double hand_N = 0.0;  // largest force on the first user's hand
};

scene::Model scene_of(double mass_kg) {
  scene::Model model = shared_tool_scene();
  model.bodies.front().mass = mass_kg;
  return model;
}

// Fig. 3.8, by which also Fig. 3.20 was made; angular gains that 0.1 kg bears.
scene::InputDevice thesis_device(const char* camera) {
  scene::InputDevice device;
  device.root_link = "right_gripper";
  device.cameras = {camera};
  device.controller_linear.p = Vec3{500.0, 500.0, 500.0};
  device.controller_linear.d = Vec3{10.0, 10.0, 10.0};
  device.controller_angular.p = Vec3{0.3, 0.3, 0.3};
  device.controller_angular.d = Vec3{0.006, 0.006, 0.006};
  device.haptic_linear.p = Vec3{0.03, 0.03, 0.03};
  device.haptic_gain_kind = scene::HapticGainKind::ratio;
  device.workspace_scaling = 5.0;
  device.ramp_s = 0.05;
  return device;
}

Followed follow(const Course& course) {
  Session session(scene_of(course.mass_kg));
  for (int i = 0; i < course.users; ++i) {
    User& user = session.join(thesis_device(i == 0 ? "main_camera" : "close_camera"), course.device_hz);
    user.driver.traits_.max_force_N = 0.0;  // what the law asks for is what is judged
  }
  session.run_until_all_engaged();
  session.run(0.1);
  std::vector<Vec3> rest;
  for (const auto& user : session.users) rest.push_back(user->hand().position);
  const Vec3 start = session.tool(*session.users[0]).position;
  std::mt19937 random(3);
  std::uniform_real_distribution<double> delay(0.0, course.delay_s);
  std::vector<double> late(session.users.size(), 0.0), due(session.users.size(), 0.0);

  Followed out;
  double sum = 0.0;
  int count = 0;
  double now_s = 0.0;  // since the ellipse began
  session.before_cycle = [&] {
    now_s += Session::kStep_s;
    for (std::size_t i = 0; i < session.users.size(); ++i) {
      User& user = *session.users[i];
      user.driver.reading = now_s < due[i] ? Reading::nothing_new : Reading::sample;
      if (now_s < due[i]) continue;
      // A late sample shows where the hand was when it should have come.
      const Vec3 way = ellipse(std::max(0.0, now_s - late[i]));
      user.hand().position =
          rest[i] + rotate(inverse(session.camera(user).orientation), way) / user.file.workspace_scaling;
      if (course.delay_s <= 0.0) continue;
      late[i] = delay(random);
      due[i] = now_s + late[i];
    }
    if (now_s > kSettled_s) out.hand_N = std::max(out.hand_N, norm(session.users[0]->driver.written.force));
  };
  while (now_s < kSeconds) {
    session.iterate(course.steps);
    if (now_s < kSettled_s) continue;
    const Vec3 error = start + ellipse(now_s) - session.tool(*session.users[0]).position;
    sum += dot(error, error);
    ++count;
    for (const state::LawShare& row : session.frame.law_shares)
      if (row.source == state::Source::device_0) out.tool_N = std::max(out.tool_N, norm(row.wrench_world.force));
  }
  out.rms_m = std::sqrt(sum / count);
  return out;
}

// What made Fig. 3.20: the force computed once an iteration and held over its steps.
double rms_of_held_force(double mass_kg, unsigned steps) {
  Session session(scene_of(mass_kg));
  const auto structure = session.simulation.structure();
  const std::uint32_t object = state::find(*structure, "/test/right_gripper", state::ObjectKind::rigid_body);
  const auto port = session.simulation.bind(structure->objects[object].id, state::Source::ros);
  const auto body = [&] { return session.frame.bodies[structure->objects[object].slot]; };
  const Vec3 start = body().T_world_body.position;
  double sum = 0.0;
  int count = 0;
  for (double t_s = steps * Session::kStep_s; t_s < kSeconds; t_s += steps * Session::kStep_s) {
    const Vec3 error = start + ellipse(t_s) - body().T_world_body.position;
    const Vec3 v_ref = (ellipse(t_s) - ellipse(t_s - steps * Session::kStep_s)) / (steps * Session::kStep_s);
    port->post(model::test::force(error * 500.0 + (v_ref - body().twist_world.linear) * 10.0));
    session.iterate(steps);
    const Vec3 after = start + ellipse(t_s) - body().T_world_body.position;
    if (norm(after) > 0.3) return INFINITY;  // it is gone
    if (t_s < kSettled_s) continue;
    sum += dot(after, after);
    ++count;
  }
  return std::sqrt(sum / count);
}

TEST(Rates, TheToolFollowsAtAnyRateOfThePhysicsThread) {
  constexpr unsigned kSteps[] = {1, 4, 10, 20, 40, 100};
  std::printf("rms, mm");
  for (const unsigned steps : kSteps) std::printf(" | %u Hz", 1000 / steps);
  std::printf("\n");
  for (const double mass : {1.0, 0.1}) {
    for (const int users : {1, 2}) {
      std::map<unsigned, Followed> at;
      for (const unsigned steps : kSteps) at[steps] = follow({.mass_kg = mass, .users = users, .steps = steps});
      std::printf("%g kg, %d device%s", mass, users, users == 1 ? "" : "s");
      for (const unsigned steps : kSteps) {
        std::printf(" | %.2f", 1e3 * at[steps].rms_m);
        EXPECT_LE(at[steps].rms_m, 1.2 * at[1].rms_m) << 1000 / steps << " Hz, " << mass << " kg, " << users;
        EXPECT_LT(at[steps].tool_N, 2.0 * at[1].tool_N) << 1000 / steps << " Hz, " << mass << " kg, " << users;
      }
      std::printf("\n");
    }
    std::printf("%g kg, a force held over the iteration", mass);
    for (const unsigned steps : kSteps) std::printf(" | %.2f", 1e3 * rms_of_held_force(mass, steps));
    std::printf("\n");
  }
  EXPECT_EQ(rms_of_held_force(1.0, 100), INFINITY) << "the comparison is the dissertation's";
}

TEST(Rates, DevicesOfAnyRateAreFeltAndPullAlike) {
  for (const double mass : {1.0, 0.1}) {
    const Followed fast = follow({.mass_kg = mass});
    std::printf("%g kg, largest force on tool and hand: %.2f N and %.3f N at 1000 Hz", mass, fast.tool_N, fast.hand_N);
    for (const double device_hz : {300.0, 100.0}) {
      const Followed slow = follow({.mass_kg = mass, .device_hz = device_hz});
      std::printf(", %.2f and %.3f at %.0f", slow.tool_N, slow.hand_N, device_hz);
      EXPECT_LT(slow.tool_N, 2.0 * fast.tool_N) << device_hz;
      EXPECT_LT(slow.hand_N, 2.0 * fast.hand_N) << device_hz;
    }
    const Followed delayed = follow({.mass_kg = mass, .delay_s = 0.02});
    std::printf("; late by up to 20 ms: %.2f and %.3f, rms %.1f mm\n", delayed.tool_N, delayed.hand_N,
                1e3 * delayed.rms_m);
    EXPECT_LT(delayed.rms_m, 0.03) << "it is stable, and no farther off than the hand moves meanwhile";
  }
}

}  // namespace
}  // namespace ambf::devices::testing
