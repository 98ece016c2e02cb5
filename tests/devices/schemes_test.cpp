// The six shipped schemes of sharing a tool (dissertation Fig. 3.22), in lockstep with the real physics: who moves the
// tool and who feels it, on each axis, with cameras turned differently, alone, against a partner and against walls.
#include <gtest/gtest.h>

#include <array>
#include <string_view>

#include "adf/adf.h"
#include "tests/devices/session_rig.h"

namespace ambf::devices::testing {
namespace {

using math::Vec3;

// Axes: x, y, z of the world; a, b, c: rotations about them.
constexpr std::string_view kAxes = "xyzabc", kAll = kAxes, kPosition = "xyz", kRotation = "abc", kNone = "";

struct Scheme {
  const char* name;  // of the device file
  std::array<std::string_view, 2> moves, feels;
};
constexpr Scheme kSchemes[] = {
    {"siso", {kAll, kAll}, {kAll, kAll}},           {"siao", {kAll, kAll}, {"xy", "zabc"}},
    {"aiso", {kPosition, kRotation}, {kAll, kAll}}, {"aiao", {kPosition, kRotation}, {kPosition, kRotation}},
    {"sino", {kAll, kAll}, {kNone, kNone}},         {"aino", {kPosition, kRotation}, {kNone, kNone}},
};

bool has(std::string_view axes, char axis) { return axes.find(axis) != std::string_view::npos; }

// The haptic gains and reaches of the test, by position and rotation.
struct Kind {
  double reach, stiffness;  // m, N/m; rad, N m/rad
};
constexpr Kind kLinear{0.01, 200.0}, kAngular{0.2, 0.3};
const Kind& kind_of(char axis) { return has(kPosition, axis) ? kLinear : kAngular; }

Vec3 unit(char axis) {
  const std::size_t i = kAxes.find(axis) % 3;
  return {i == 0 ? 1.0 : 0.0, i == 1 ? 1.0 : 0.0, i == 2 ? 1.0 : 0.0};
}

class SchemeTest : public ::testing::TestWithParam<Scheme> {
 protected:
  // Both users of the scheme, engaged, with all of their forces.
  void start(const scene::Model& model) {
    session_.emplace(model);
    const std::string folder = AMBF_SOURCE_DIR "/ambf_models/descriptions/input_devices/";
    const auto file = adf::load_input_devices(folder + "input_devices_" + GetParam().name + ".yaml");
    ASSERT_TRUE(file.devices);
    ASSERT_EQ(file.devices->devices.size(), 2u);
    for (scene::InputDevice device : file.devices->devices) {
      device.ramp_s = 0.05;
      session_->join(device);
    }
    session_->run_until_all_engaged();
    session_->run(0.1);
    rest_ = session_->tool(user(0));
  }
  User& user(int number) { return *session_->users[static_cast<std::size_t>(number)]; }

  // Evenly, then until all is at rest.
  void reach(User& by, char axis, double amount) {
    constexpr int kCycles = 50;
    const Vec3 part = unit(axis) * (amount / kCycles);
    for (int i = 0; i < kCycles; ++i) {
      session_->displace(by, has(kPosition, axis) ? part : Vec3{}, has(kPosition, axis) ? Vec3{} : part);
      session_->iterate();
    }
    session_->run(0.3);
  }
  // What the tool moved along this axis, m or rad.
  double moved(char axis) const {
    const math::Pose& now = session_->tool(*session_->users.front());
    const Vec3 way =
        has(kPosition, axis) ? now.position - rest_.position : math::log(now.orientation * inverse(rest_.orientation));
    return dot(way, unit(axis));
  }
  double felt(const User& by, char axis) const {
    const math::Wrench felt = by.felt_world();
    return dot(has(kPosition, axis) ? felt.force : felt.torque, unit(axis));
  }

  std::optional<Session> session_;
  math::Pose rest_;
};

TEST_P(SchemeTest, EachAxisIsMovedAndFeltByThoseWhomTheSchemeNames) {
  const Scheme& scheme = GetParam();
  start(shared_tool_scene());
  for (int mover = 0; mover < 2; ++mover) {
    const std::size_t own = static_cast<std::size_t>(mover), other = 1 - own;
    for (const char axis : kAxes) {
      const Kind& kind = kind_of(axis);
      reach(user(mover), axis, kind.reach);
      // A partner whose hand rests pulls back as much.
      const double share = !has(scheme.moves[own], axis) ? 0.0 : has(scheme.moves[other], axis) ? 0.5 : 1.0;
      EXPECT_NEAR(moved(axis), share * kind.reach, 0.01 * kind.reach) << "user " << mover << ", axis " << axis;
      for (const char across : kAxes) {
        if (across == axis) continue;
        EXPECT_NEAR(moved(across), 0.0, 0.01 * kind_of(across).reach) << axis << " moves " << across;
      }
      // The deadband is 0.01 N. The hand that moves is drawn back, that of the partner after the tool.
      const double mine = has(scheme.feels[own], axis) ? -kind.stiffness * (kind.reach - moved(axis)) : 0.0;
      const double theirs = has(scheme.feels[other], axis) ? kind.stiffness * moved(axis) : 0.0;
      EXPECT_NEAR(felt(user(mover), axis), mine, 0.02 * kind.stiffness * kind.reach) << mover << axis;
      EXPECT_NEAR(felt(user(1 - mover), axis), theirs, 0.02 * kind.stiffness * kind.reach) << mover << axis;
      reach(user(mover), axis, -kind.reach);
    }
  }
}

TEST_P(SchemeTest, AWallIsFeltByThoseWhomTheSchemeNames) {
  const Scheme& scheme = GetParam();
  scene::Model model = shared_tool_scene();
  // A box just large enough for the tool: it can neither move nor turn.
  constexpr double kGap_m = 3e-4;
  for (const char axis : kPosition)
    for (const double side : {-1.0, 1.0})
      model.bodies.push_back(
          wall_beside(std::string("wall_") + axis + (side > 0 ? "p" : "m"), unit(axis) * side, kGap_m));
  start(model);
  for (int mover = 0; mover < 2; ++mover) {
    const std::size_t own = static_cast<std::size_t>(mover);
    for (const char axis : kAxes) {
      const Kind& kind = kind_of(axis);
      reach(user(mover), axis, kind.reach);
      EXPECT_LT(std::abs(moved(axis)), 0.1 * kind.reach) << "the wall gives way on " << axis;
      const double full = kind.stiffness * kind.reach;
      if (has(scheme.feels[own], axis)) {
        EXPECT_LT(felt(user(mover), axis), -0.85 * full) << mover << axis;
      } else {
        EXPECT_NEAR(felt(user(mover), axis), 0.0, 0.02 * full) << mover << axis;
      }
      reach(user(mover), axis, -kind.reach);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, SchemeTest, ::testing::ValuesIn(kSchemes),
                         [](const auto& parameter) { return parameter.param.name; });

}  // namespace
}  // namespace ambf::devices::testing
