// Samples that no hand makes are refused.
#include "devices/sample_check.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "math/rotation.h"

namespace ambf::devices {
namespace {

using state::DeviceFault;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

Sample sample_at(double seconds) {
  Sample sample;
  sample.stamp_ns = static_cast<std::int64_t>(seconds * 1e9);
  return sample;
}

TEST(SampleCheck, NumbersAndRotationsPassAndAreNormalised) {
  SampleCheck check;
  Sample sample = sample_at(1.0);
  sample.T_u_tip.orientation.w = 1.05;
  EXPECT_EQ(check.check(sample), DeviceFault::none);
  EXPECT_EQ(sample.T_u_tip.orientation.w, 1.0);
}

TEST(SampleCheck, NoNumbersAndNoRotationsAreBad) {
  SampleCheck check;
  Sample sample = sample_at(1.0);
  sample.T_u_tip.position.y = kNan;
  EXPECT_EQ(check.check(sample), DeviceFault::bad_sample);
  sample = sample_at(1.0);
  sample.T_u_tip.orientation = {0.0, 0.0, 0.0, 0.0};
  EXPECT_EQ(check.check(sample), DeviceFault::bad_sample);
  sample = sample_at(1.0);
  sample.jaw = kNan;
  EXPECT_EQ(check.check(sample), DeviceFault::bad_sample);
  sample = sample_at(1.0);
  sample.T_u_tip.position.x = std::numeric_limits<double>::infinity();
  EXPECT_EQ(check.check(sample), DeviceFault::bad_sample);
}

TEST(SampleCheck, TimeDoesNotGoBack) {
  SampleCheck check;
  Sample sample = sample_at(1.0), older = sample_at(0.9);
  EXPECT_EQ(check.check(sample), DeviceFault::none);
  EXPECT_EQ(check.check(older), DeviceFault::backward_stamp);
  check.restart();
  EXPECT_EQ(check.check(older), DeviceFault::none);
}

TEST(SampleCheck, AJumpIsOneAndTheNextSampleGoesOnFromThere) {
  SampleCheck check;
  Sample sample = sample_at(1.0);
  EXPECT_EQ(check.check(sample), DeviceFault::none);
  sample = sample_at(1.001);
  sample.T_u_tip.position.x = 0.1;
  EXPECT_EQ(check.check(sample), DeviceFault::jump);
  sample = sample_at(1.002);
  sample.T_u_tip.position.x = 0.1;
  EXPECT_EQ(check.check(sample), DeviceFault::none);
  sample = sample_at(1.003);
  sample.T_u_tip.position.x = 0.1;
  sample.T_u_tip.orientation = math::from_axis_angle({0.0, 0.0, 1.0}, 1.0);
  EXPECT_EQ(check.check(sample), DeviceFault::jump);
}

}  // namespace
}  // namespace ambf::devices
