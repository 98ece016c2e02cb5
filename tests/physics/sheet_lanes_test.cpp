// Four triangles of a sheet at a time, or two: the same bits, and forces that are those of what they come from.
#include "physics/soft/detail/sheet_lanes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace ambf::physics::detail {
namespace {

using math::Vec3;

constexpr std::size_t kCorners = 8;

// A strip of six triangles.
SheetLanes strip() {
  SheetLanes made;
  made.resize(kCorners - 2);
  for (std::uint32_t t = 0; t < kCorners - 2; ++t) {
    SheetLanes::Hot& hot = made.hot[t / 4];
    const bool odd = t % 2 == 1;
    hot.corner[0][t % 4] = t, hot.corner[1][t % 4] = t + (odd ? 2 : 1), hot.corner[2][t % 4] = t + (odd ? 1 : 2);
    hot.ax[t % 4] = 100.0, hot.ay[t % 4] = -40.0, hot.by[t % 4] = 110.0;
    hot.shear[t % 4] = 0.02, hot.even[t % 4] = 0.005;
    for (std::size_t k = 0; k < 3; ++k) hot.moment[k][t % 4] = 2e-5, hot.moment[k + 3][t % 4] = 5e-6;
  }
  for (std::uint32_t t = 0; t + 3 < kCorners; ++t) {  // along the corners that both have
    made.add_hinge({t, t + 1}, {0U, t % 2 == 0 ? 1U : 2U}, 1.0);
    for (std::size_t k = 0; k < 2; ++k) made.hinges[t / 4].corner[k][t % 4] = made.hot[t / 4].corner[k + 1][t % 4];
  }
  for (std::uint32_t t = 0; t < kCorners - 2; ++t)
    for (std::size_t k = 0; k < 3; ++k)
      if (made.hot[t / 4].beyond[k][t % 4] == made.no_slot())  // no moment acts there
        for (const std::size_t of_it : {k, 3 + k, 3 + (k + 2) % 3}) made.hot[t / 4].moment[of_it][t % 4] = 0.0;
  return made;
}

std::vector<Vec3> random_places(unsigned seed, double size) {
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> unit(-size, size);
  std::vector<Vec3> made;
  for (std::size_t i = 0; i < kCorners; ++i) made.push_back({unit(generator), unit(generator), unit(generator)});
  return made;
}

std::vector<Vec3> corners() {
  std::vector<Vec3> made = random_places(3, 0.002);
  for (std::size_t i = 0; i < kCorners; ++i)
    made[i] += Vec3{0.005 * static_cast<double>(i), i % 2 == 0 ? 0.0 : 0.009, 0.0};
  return made;
}

struct Forces {
  std::vector<Vec3> held = std::vector<Vec3>(kCorners), back = held;  // as they are, and against a displacement
};

Forces forces_of(bool wide, const SheetLanes::Relaxing& relaxing) {
  SheetLanes lanes = strip();
  lanes.wide = wide;
  Forces made;
  for (int step = 0; step < 2; ++step) {
    made = {};
    lanes.turn_to(corners().data(), relaxing);
    lanes.pull(made.held.data());
  }
  lanes.stretch(random_places(9, 0.001).data(), 1.0, made.back.data());
  return made;
}

TEST(SheetLanes, FourAtATimeAreAsTwo) {
  if (!has_wide_vectors()) GTEST_SKIP() << "two are all there are";
  for (const double memory : {0.0, 0.4}) {
    const Forces two = forces_of(false, {0.1, memory}), four = forces_of(true, {0.1, memory});
    for (std::size_t i = 0; i < kCorners; ++i) {
      EXPECT_EQ(two.held[i], four.held[i]) << i;
      EXPECT_EQ(two.back[i], four.back[i]) << i;
    }
  }
}

// What is within a sheet moves it nowhere and turns it nowhere.
TEST(SheetLanes, ForcesAreInBalance) {
  const Forces made = forces_of(has_wide_vectors(), {0.0, 0.0});
  const std::vector<Vec3> at = corners();
  Vec3 force{}, torque{}, back{};
  double size = 0.0;
  for (std::size_t i = 0; i < kCorners; ++i) {
    force += made.held[i], back += made.back[i];
    torque += math::cross(at[i], made.held[i]);
    size += math::norm(made.held[i]);
  }
  EXPECT_GT(size, 1e-3);
  EXPECT_LT(math::norm(force), 1e-14 * size);
  EXPECT_LT(math::norm(back), 1e-14 * size);
  EXPECT_LT(math::norm(torque), 1e-15 * size);
}

// The stiffness against bending is what forces grow by as corners move.
TEST(SheetLanes, AnglesGrowAsCornersLeaveThePlane) {
  SheetLanes lanes = strip();
  for (SheetLanes::Hot& hot : lanes.hot) hot.shear = {}, hot.even = {};
  std::vector<Vec3> at = corners(), moved = at;
  const std::vector<Vec3> u = random_places(9, 1.0);
  constexpr double kSmall = 1e-7;
  for (std::size_t i = 0; i < kCorners; ++i) moved[i] += u[i] * kSmall;
  lanes.set_rest_angles(at.data());
  std::vector<Vec3> expected(kCorners), found(kCorners);
  lanes.turn_to(moved.data(), {});
  lanes.pull(found.data());
  lanes.turn_to(at.data(), {});
  lanes.stretch(u.data(), 1.0, expected.data());
  double size = 0.0;
  for (const Vec3& each : expected) size = std::max(size, math::norm(each));
  EXPECT_GT(size, 0.0);
  for (std::size_t i = 0; i < kCorners; ++i) EXPECT_LT(math::norm(found[i] / kSmall - expected[i]), 1e-4 * size) << i;
}

}  // namespace
}  // namespace ambf::physics::detail
