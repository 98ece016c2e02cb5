// Drivers in shared libraries, found by AMBF_PLUGIN_PATH or by name; the example is the one under test.
#include "devices/driver_library.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>

#include "tests/devices/input_records.h"

namespace ambf::devices {
namespace {

const std::string kLibraries = AMBF_DRIVER_LIBRARIES;

class DriverLibraryTest : public testing::Test {
 protected:
  ~DriverLibraryTest() override { unsetenv("AMBF_PLUGIN_PATH"); }
  DriverRequest named(const std::string& hardware) {
    DriverRequest request;
    request.device = "Other hand";
    request.hardware_name = hardware;
    return request;
  }
};

TEST_F(DriverLibraryTest, IsFoundByThePluginPathAndWorksAsABuiltInOne) {
  EXPECT_EQ(find_driver(named("Circle")), nullptr);
  const std::string before = why_no_driver(named("Circle"));
  EXPECT_NE(before.find("no driver answers to the hardware name 'Circle'"), std::string::npos) << before;
  EXPECT_NE(before.find("gamepad (Gamepad"), std::string::npos) << before;
  EXPECT_NE(before.find("AMBF_PLUGIN_PATH"), std::string::npos) << before;

  setenv("AMBF_PLUGIN_PATH", ("/not there:" + kLibraries).c_str(), 1);
  DriverRequest request = named("Circle");
  request.options["radius"] = "0.2";
  const DriverKind* kind = find_driver(request);
  ASSERT_NE(kind, nullptr) << why_no_driver(request);
  EXPECT_EQ(kind->type, "circle");
  const auto driver = kind->make(request);
  ASSERT_EQ(driver->open(), "");
  EXPECT_TRUE(driver->traits().force);
  Sample sample;
  ASSERT_EQ(driver->read(sample, 0.0), Reading::sample);
  EXPECT_NEAR(math::norm(sample.T_u_tip.position), 0.2, 1e-12);
  driver->write({{1.0, 0.0, 0.0}, {}});
  driver->close();

  request.options["radius"] = "wide";
  EXPECT_NE(find_driver(request)->make(request)->open().find("'radius' is 'wide'"), std::string::npos);
}

TEST_F(DriverLibraryTest, OneMadeForAnotherVersionIsRefusedWithTheReason) {
  setenv("AMBF_PLUGIN_PATH", kLibraries.c_str(), 1);
  EXPECT_EQ(find_driver(named("Never")), nullptr);
  const std::string why = why_no_driver(named("Never"));
  EXPECT_NE(why.find("libambf_driver_version_0.so: it was made for version 0 of the driver interface"),
            std::string::npos)
      << why;
}

TEST_F(DriverLibraryTest, OneThatADeviceNamesIsLoadedFromBesideItsFile) {
  const TemporaryFolder folder;
  std::ofstream(folder.file("broken.so")) << "no library";
  DriverRequest request = named("Something");
  request.folder = folder.file("");
  request.options["library"] = "broken.so";
  EXPECT_EQ(find_driver(request), nullptr);
  EXPECT_NE(why_no_driver(request).find("broken.so: "), std::string::npos) << why_no_driver(request);
  EXPECT_NE(load_driver_library(folder.file("absent.so")), "");
}

}  // namespace
}  // namespace ambf::devices
