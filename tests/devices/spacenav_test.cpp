// The driver `spacenav` against a socket that sends spacenavd's packets.
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <sys/wait.h>

#include <array>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <thread>

#include "base/clock.h"
#include "base/spawn.h"
#include "devices/driver.h"
#include "math/rotation.h"
#include "tests/devices/input_records.h"
#include "tests/support/compat_models.h"

namespace ambf::devices {
namespace {

using namespace std::chrono_literals;

// A daemon that sends what a test wants.
class Daemon {
 public:
  explicit Daemon(const std::string& path) : listener_(socket(AF_UNIX, SOCK_STREAM, 0)) {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    std::strncpy(address.sun_path, path.c_str(), sizeof(address.sun_path) - 1);
    EXPECT_EQ(bind(listener_, reinterpret_cast<sockaddr*>(&address), sizeof(address)), 0);
    EXPECT_EQ(listen(listener_, 1), 0);
  }
  ~Daemon() {
    hang_up();
    close(listener_);
  }
  void answer() { client_ = accept(listener_, nullptr, nullptr); }
  void hang_up() {
    if (client_ >= 0) close(client_);
    client_ = -1;
  }
  void send(const std::array<std::int32_t, 8>& packet, std::size_t from = 0, std::size_t to = 32) {
    EXPECT_EQ(::send(client_, reinterpret_cast<const char*>(packet.data()) + from, to - from, MSG_NOSIGNAL),
              static_cast<ssize_t>(to - from));
  }

 private:
  int listener_, client_ = -1;
};

class SpacenavTest : public testing::Test {
 protected:
  std::unique_ptr<Driver> make(std::map<std::string, std::string> options) {
    DriverRequest request;
    request.hardware_name = "SpaceNavigator";
    request.options = std::move(options);
    return find_driver(request)->make(request);
  }
  std::unique_ptr<Driver> opened() {
    auto driver = make({{"path", path}, {"full", "100"}, {"speed", "0.2"}, {"turn speed", "2"}, {"dead zone", "0"}});
    EXPECT_EQ(driver->open(), "");
    daemon.answer();
    return driver;
  }
  Sample sample(Driver& driver) {
    Sample sample;
    EXPECT_EQ(driver.read(sample, 0.0), Reading::sample);
    return sample;
  }
  // Velocity over 10 ms after the packet.
  math::Twist motion(Driver& driver) {
    const Sample before = sample(driver);
    std::this_thread::sleep_for(10ms);
    const Sample after = sample(driver);
    const double dt = base::to_seconds(after.stamp_ns - before.stamp_ns);
    return {(after.T_u_tip.position - before.T_u_tip.position) / dt,
            math::log(after.T_u_tip.orientation * math::inverse(before.T_u_tip.orientation)) / dt};
  }

  TemporaryFolder folder;
  std::string path = folder.file("spnav.sock");
  Daemon daemon{path};
};

void expect_near(const math::Vec3& a, const math::Vec3& b) { EXPECT_LT(math::norm(a - b), 1e-6); }

TEST_F(SpacenavTest, PuckMovesTheHandInTheOperatorsFrame) {
  const auto puck = opened();
  daemon.send({0, 100, 0, 0, 0, 0, 0, 8});  // to the right
  expect_near(motion(*puck).linear, {0.0, 0.2, 0.0});
  daemon.send({0, 0, 50, 0, 0, 0, 0, 8});  // lifted
  expect_near(motion(*puck).linear, {0.0, 0.0, 0.1});
  daemon.send({0, 0, 0, 100, 0, 0, 0, 8});  // pushed away
  expect_near(motion(*puck).linear, {-0.2, 0.0, 0.0});
  daemon.send({0, 0, 0, 0, 0, 0, 100, 8});  // turned about the axis that points away
  expect_near(motion(*puck).angular, {-2.0, 0.0, 0.0});
  daemon.send({0, 0, 0, 0, 100, 0, 0, 8});
  expect_near(motion(*puck).angular, {0.0, 2.0, 0.0});
  daemon.send({0, 0, 0, 0, 0, 100, 0, 8});
  expect_near(motion(*puck).angular, {0.0, 0.0, 2.0});
  daemon.send({0, 0, 0, 0, 0, 0, 0, 8});
  const math::Pose rest = sample(*puck).T_u_tip;
  std::this_thread::sleep_for(5ms);
  EXPECT_EQ(sample(*puck).T_u_tip, rest) << "it drifts";
}

TEST_F(SpacenavTest, ButtonsAndPacketsInPieces) {
  const auto puck = opened();
  daemon.send({1, 3, 0, 0, 0, 0, 0, 0}, 0, 10);
  EXPECT_EQ(sample(*puck).buttons, 0U);
  daemon.send({1, 3, 0, 0, 0, 0, 0, 0}, 10, 32);
  daemon.send({1, 0, 0, 0, 0, 0, 0, 0});
  daemon.send({1, -1, 0, 0, 0, 0, 0, 0});
  daemon.send({1, 64, 0, 0, 0, 0, 0, 0});
  daemon.send({77, 1, 0, 0, 0, 0, 0, 0});
  EXPECT_EQ(sample(*puck).buttons, 9U);
  daemon.send({2, 3, 0, 0, 0, 0, 0, 0});
  EXPECT_EQ(sample(*puck).buttons, 1U);
}

TEST_F(SpacenavTest, IsLostWithTheDaemonAndFoundAgainAtRest) {
  const auto puck = opened();
  daemon.send({0, 100, 0, 0, 0, 0, 0, 8});
  daemon.send({1, 0, 0, 0, 0, 0, 0, 0});
  sample(*puck);
  daemon.hang_up();
  Sample last;
  EXPECT_EQ(puck->read(last, 0.0), Reading::lost);
  EXPECT_EQ(puck->open(), "");
  daemon.answer();
  EXPECT_EQ(motion(*puck).linear, math::Vec3{});
  EXPECT_EQ(sample(*puck).buttons, 0U);
}

TEST_F(SpacenavTest, SaysWhereItSearched) {
  const std::string absent = make({{"path", folder.file("other.sock")}})->open();
  EXPECT_NE(absent.find("nothing answers at the socket " + folder.file("other.sock")), std::string::npos) << absent;
  EXPECT_NE(absent.find("SPNAV_SOCKET"), std::string::npos);
  EXPECT_NE(make({{"axes/x", "up"}})->open().find("'axes/x' is 'up'"), std::string::npos);
}

// Our reading of the protocol against one that others wrote, found by SPNAV_SOCKET.
TEST_F(SpacenavTest, MovesWithAnotherDaemonThatTheEnvironmentNames) {
  const auto program = compat::folder().parent_path() / "tools" / "fakespnav.py";
  if (!std::filesystem::exists(program)) GTEST_SKIP() << "no other daemon at " << program;
  const std::string socket_path = folder.file("fake.sock");
  std::string problem;
  const pid_t child =
      base::spawn({base::find_program("python3"), program.string(), socket_path, "200", "20"}, {}, problem);
  ASSERT_GT(child, 0) << problem;
  setenv("SPNAV_SOCKET", socket_path.c_str(), 1);
  const auto puck = make({{"full", "100"}});
  std::string absent = "not opened";
  for (int i = 0; i < 1000 && !absent.empty(); ++i) {
    absent = puck->open();
    std::this_thread::sleep_for(10ms);
  }
  unsetenv("SPNAV_SOCKET");
  EXPECT_EQ(absent, "");
  // It sends 100 sin(t) along x and 50 cos(t) about z, which points away, and presses button 3 now and then.
  math::Pose T_u_tip;
  for (int i = 0; i < 1000 && T_u_tip.position.y < 0.002; ++i) {
    T_u_tip = sample(*puck).T_u_tip;
    std::this_thread::sleep_for(5ms);
  }
  kill(child, SIGKILL);
  waitpid(child, nullptr, 0);
  EXPECT_GE(T_u_tip.position.y, 0.002);
  EXPECT_EQ(T_u_tip.position.x, 0.0);
  EXPECT_LT(math::log(T_u_tip.orientation).x, 0.0);
}

}  // namespace
}  // namespace ambf::devices
