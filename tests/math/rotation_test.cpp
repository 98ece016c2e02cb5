// Properties of rotations; formulas of section 11 of the equation sheet (Alg. 2).
#include "math/rotation.h"

#include <gtest/gtest.h>

#include <random>

namespace ambf::math {
namespace {

constexpr double kPi = 3.14159265358979323846;

Vec3 random_unit(std::mt19937& rng) {
  std::normal_distribution<double> n;
  return normalized(Vec3{n(rng), n(rng), n(rng)});
}

double distance(const Quat& a, const Quat& b) { return norm(log(inverse(a) * b)); }

TEST(RotationBetween, MapsFirstVectorOntoSecondForRandomPairs) {
  std::mt19937 rng(1);
  for (int i = 0; i < 20000; ++i) {
    const Vec3 a = random_unit(rng), b = random_unit(rng);
    const Quat r = rotation_between(a, b);
    ASSERT_LT(norm(rotate(r, a) - b), 1e-9);
    ASSERT_NEAR(norm(r), 1.0, 1e-12);
    ASSERT_LT(distance(inverse(r), rotation_between(b, a)), 1e-9);
    ASSERT_LT(distance(r, rotation_between(-a, -b)), 1e-9);
  }
}

TEST(RotationBetween, HandlesAllPairsOfCoordinateAxes) {
  const Vec3 axes[] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  for (const Vec3& a : axes) {
    for (const Vec3& b : axes) {
      EXPECT_LT(norm(rotate(rotation_between(a, b), a) - b), 1e-9);
    }
  }
}

TEST(RotationBetween, IsAccurateNearAntiparallel) {
  std::mt19937 rng(2);
  for (double eps : {1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 0.0}) {
    const Vec3 a = random_unit(rng);
    const Vec3 k = normalized(cross(a, random_unit(rng)));
    const Vec3 b = rotate(from_axis_angle(k, kPi - eps), a);
    EXPECT_LT(norm(rotate(rotation_between(a, b), a) - b), 1.1e-7) << "pi - " << eps;
  }
}

TEST(RotationBetween, TurnsRoundedOppositeAxesAsOppositeOnes) {
  const Quat exact = rotation_between({0, 1, 0}, {0, -1, 0});
  std::mt19937 rng(3);
  std::uniform_real_distribution<double> noise(-1e-3, 1e-3);
  for (int i = 0; i < 1000; ++i) {
    const Vec3 a = normalized(Vec3{noise(rng) / 4, 1.0, noise(rng) / 4});
    const Vec3 b = normalized(Vec3{noise(rng) / 4, -1.0, noise(rng) / 4});
    const Quat r = rotation_between(a, b);
    ASSERT_LT(norm(rotate(r, a) - b), 1e-12);
    ASSERT_LT(distance(r, exact), 2e-3) << "not about the noise's axis";
  }
}

TEST(Rotation, LogAndExpAreInverse) {
  std::mt19937 rng(3);
  std::uniform_real_distribution<double> angle(0.0, kPi - 1e-6);
  for (int i = 0; i < 2000; ++i) {
    const Vec3 w = random_unit(rng) * angle(rng);
    EXPECT_LT(norm(log(exp(w)) - w), 1e-9);
  }
  EXPECT_LT(norm(log(exp({1e-13, 0, 0}))), 1e-12);
}

TEST(Rotation, RollPitchYawRoundTripsAndIsFixedAxis) {
  std::mt19937 rng(4);
  std::uniform_real_distribution<double> u(-1.5, 1.5);
  for (int i = 0; i < 2000; ++i) {
    const Vec3 rpy{u(rng), u(rng), u(rng)};
    EXPECT_LT(norm(to_rpy(from_rpy(rpy.x, rpy.y, rpy.z)) - rpy), 1e-9);
  }
  // A fixed-axis turn: first roll about x, then yaw about the outer z.
  const Vec3 y = rotate(from_rpy(kPi / 2, 0, kPi / 2), {0, 1, 0});
  EXPECT_LT(norm(y - Vec3{0, 0, 1}), 1e-12);
}

TEST(Rotation, RollPitchYawAtTheSingularityGivesTheSameRotation) {
  for (double pitch : {kPi / 2, -kPi / 2}) {
    const Quat q = from_rpy(0.3, pitch, -0.8);
    const Vec3 rpy = to_rpy(q);
    EXPECT_LT(distance(q, from_rpy(rpy.x, rpy.y, rpy.z)), 1e-6);
  }
}

TEST(Rotation, MatrixRoundTripsInEveryBranch) {
  std::mt19937 rng(5);
  std::uniform_real_distribution<double> angle(-kPi, kPi);
  for (int i = 0; i < 5000; ++i) {
    const Quat q = from_axis_angle(random_unit(rng), angle(rng));
    double m[9];
    to_matrix(q, m);
    EXPECT_LT(distance(q, from_matrix(m)), 1e-9);
  }
}

TEST(Pose, InverseUndoesComposition) {
  const Pose a{{1, 2, 3}, from_rpy(0.1, 0.2, 0.3)}, b{{-1, 0.5, 2}, from_rpy(-1, 0.4, 2)};
  const Pose c = inverse(a) * (a * b);
  EXPECT_LT(norm(c.position - b.position), 1e-12);
  EXPECT_LT(distance(c.orientation, b.orientation), 1e-12);
}

}  // namespace
}  // namespace ambf::math
