// The scripted device: moves as its options say, and says what is wrong with them.
#include "devices/drivers/scripted.h"

#include <gtest/gtest.h>

#include <thread>

#include "base/clock.h"

namespace ambf::devices {
namespace {

std::unique_ptr<Driver> scripted(std::map<std::string, std::string> options) {
  DriverRequest request;
  request.type = "scripted";
  request.options = std::move(options);
  return find_driver(request)->make(request);
}

TEST(Scripted, StartsAtTheOriginAndMovesAlongItsAxis) {
  const auto driver = scripted({{"motion", "line"}, {"axis", "y"}, {"size", "0.1"}, {"rate", "20"}});
  ASSERT_EQ(driver->open(), "");
  Sample sample;
  double farthest = 0.0;
  ASSERT_EQ(driver->read(sample, 0.0), Reading::sample);
  EXPECT_LT(norm(sample.T_u_tip.position), 0.02);
  for (int i = 0; i < 100; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    ASSERT_EQ(driver->read(sample, 0.0), Reading::sample);
    EXPECT_EQ(sample.T_u_tip.position.x, 0.0);
    EXPECT_EQ(sample.T_u_tip.position.z, 0.0);
    EXPECT_LE(std::abs(sample.T_u_tip.position.y), 0.1);
    farthest = std::max(farthest, sample.T_u_tip.position.y);
  }
  EXPECT_GT(farthest, 0.05);
  EXPECT_EQ(sample.jaw, 0.5);
}

TEST(Scripted, FallsSilentAsItsOptionsSay) {
  const auto driver = scripted({{"dropout every", "0.01"}, {"dropout", "1"}});
  ASSERT_EQ(driver->open(), "");
  Sample sample;
  EXPECT_EQ(driver->read(sample, 0.0), Reading::sample);
  std::this_thread::sleep_for(std::chrono::milliseconds(12));
  EXPECT_EQ(driver->read(sample, 0.0), Reading::nothing_new);
}

TEST(Scripted, SaysWhatIsWrongWithItsOptions) {
  EXPECT_NE(scripted({{"motion", "spiral"}})->open(), "");
  EXPECT_NE(scripted({{"sise", "1"}})->open(), "");
}

}  // namespace
}  // namespace ambf::devices
