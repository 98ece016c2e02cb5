// Drivers behind ROS against an emulated arm, with a real master and roscpp, in this process.
#include "dvrk_arm/ros_driver.h"

#include <geometry_msgs/PoseStamped.h>
#include <geometry_msgs/TransformStamped.h>
#include <geometry_msgs/TwistStamped.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sensor_msgs/JointState.h>
#include <sensor_msgs/Joy.h>
#include <std_msgs/String.h>
#include <sys/socket.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

#include "base/clock.h"
#include "math/rotation.h"
#include "tests/support/judged_log.h"

namespace ambf::dvrk_arm {
namespace {

using namespace std::chrono_literals;
using devices::Reading;
using devices::Sample;

bool until(const std::function<bool()>& condition, std::chrono::seconds patience = 30s) {
  const auto end = std::chrono::steady_clock::now() + patience;
  while (!condition()) {
    if (std::chrono::steady_clock::now() > end) return false;
    std::this_thread::sleep_for(1ms);
  }
  return true;
}

std::string free_port() {
  const int listener = socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof(address);
  EXPECT_EQ(bind(listener, reinterpret_cast<sockaddr*>(&address), size), 0);
  EXPECT_EQ(getsockname(listener, reinterpret_cast<sockaddr*>(&address), &size), 0);
  close(listener);
  return std::to_string(ntohs(address.sin_port));
}

// One ROS node for all tests: roscpp cannot be started twice. It starts a master of its own.
class RosDriverTest : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    setenv("ROS_MASTER_URI", ("http://127.0.0.1:" + free_port()).c_str(), 1);
    setenv("ROS_IP", "127.0.0.1", 1);
    node_log = new base::Log;
    node = new ros_comm::Node(*node_log, 0);
    ASSERT_TRUE(until([] { return node->connected(); })) << "no master";
    host = new RosHost;
    host->attach(*node);
  }
  static void TearDownTestSuite() {
    delete host;
    delete node;
    delete node_log;
  }

  std::unique_ptr<RosDriver> arm(std::map<std::string, std::string> options = {}) {
    devices::DriverRequest request;
    request.device = "Right";
    request.hardware_name = "MTMR";
    request.options = std::move(options);
    return std::make_unique<RosDriver>(*host, log, arm_topics(request));
  }
  std::unique_ptr<RosDriver> generic(std::map<std::string, std::string> options) {
    devices::DriverRequest request;
    request.device = "Any";
    request.options = std::move(options);
    return std::make_unique<RosDriver>(*host, log, generic_topics(request));
  }
  // The next sample that fulfils the condition.
  Sample next(RosDriver& driver, const std::function<bool(const Sample&)>& wanted) {
    Sample sample, read;
    EXPECT_TRUE(until([&] {
      if (driver.read(read, 0.0) == Reading::sample) sample = read;
      return sample.stamp_ns != 0 && wanted(sample);
    }));
    return sample;
  }

  static base::Log* node_log;
  static ros_comm::Node* node;
  static RosHost* host;
  JudgedLog log;
};
base::Log* RosDriverTest::node_log = nullptr;
ros_comm::Node* RosDriverTest::node = nullptr;
RosHost* RosDriverTest::host = nullptr;

// Publishes the pose of an arm in its base as often as asked.
template <class PoseMessage>
class EmulatedArm {
 public:
  EmulatedArm(ros_comm::Node& node, double rate_hz) : pose_(node.handle().advertise<PoseMessage>(kTopic, 1)) {
    thread_ = std::thread([this, rate_hz] {
      auto due = std::chrono::steady_clock::now();
      while (!stop_) {
        publish();
        due += std::chrono::nanoseconds(base::to_ns(1.0 / rate_hz));
        std::this_thread::sleep_until(due);
      }
    });
  }
  ~EmulatedArm() {
    stop_ = true;
    thread_.join();
  }
  void move(const math::Pose& T_base_tip) {
    const std::lock_guard<std::mutex> lock(mutex_);
    T_base_tip_ = T_base_tip;
  }
  std::atomic<bool> silent{false}, stamped{true};

 private:
  static constexpr const char* kTopic = "/MTMR/local/measured_cp";

  void publish() {
    if (silent) return;
    PoseMessage message;
    if (stamped) message.header.stamp = ros::Time::now();
    const std::lock_guard<std::mutex> lock(mutex_);
    fill(message);
    pose_.publish(message);
  }
  void fill(geometry_msgs::PoseStamped& m) const { fill(m.pose.position, m.pose.orientation); }
  void fill(geometry_msgs::TransformStamped& m) const { fill(m.transform.translation, m.transform.rotation); }
  template <class Position>
  void fill(Position& p, geometry_msgs::Quaternion& q) const {
    p.x = T_base_tip_.position.x;
    p.y = T_base_tip_.position.y;
    p.z = T_base_tip_.position.z;
    q.x = T_base_tip_.orientation.x;
    q.y = T_base_tip_.orientation.y;
    q.z = T_base_tip_.orientation.z;
    q.w = T_base_tip_.orientation.w;
  }

  std::mutex mutex_;
  math::Pose T_base_tip_;
  ros::Publisher pose_;
  std::atomic<bool> stop_{false};
  std::thread thread_;
};

// The wrenches that an arm receives, on roscpp's own queue.
class WrenchEar {
 public:
  WrenchEar(ros_comm::Node& node, const std::string& topic) {
    subscriber_ = node.handle().subscribe<geometry_msgs::WrenchStamped>(
        topic, 100, [this](const geometry_msgs::WrenchStamped::ConstPtr& message) {
          const std::lock_guard<std::mutex> lock(mutex_);
          const auto& w = message->wrench;
          newest_ = {{w.force.x, w.force.y, w.force.z}, {w.torque.x, w.torque.y, w.torque.z}};
          ++count_;
        });
    spinner_.start();
  }
  unsigned publishers() const { return subscriber_.getNumPublishers(); }
  std::uint64_t count() {
    const std::lock_guard<std::mutex> lock(mutex_);
    return count_;
  }
  math::Wrench newest() {
    const std::lock_guard<std::mutex> lock(mutex_);
    return newest_;
  }

 private:
  std::mutex mutex_;
  std::uint64_t count_ = 0;
  math::Wrench newest_;
  ros::Subscriber subscriber_;
  ros::AsyncSpinner spinner_{1};
};

const math::Pose kHome{{-0.181, -0.0163, -0.262},
                       math::from_rpy(0.0, 0.0, -M_PI / 2) * math::inverse(math::from_rpy(0.0, M_PI / 2, 0.0))};

template <class PoseMessage>
void expect_operators_frame(ros_comm::Node& node, RosDriver& driver,
                            const std::function<Sample(const std::function<bool(const Sample&)>&)>& next) {
  EmulatedArm<PoseMessage> arm(node, 1000.0);
  arm.move(kHome);
  ASSERT_EQ(driver.open(), "");
  EXPECT_GT(driver.traits().rate_hz, 1.0);
  const auto near = [](const math::Vec3& wanted) {
    return [wanted](const Sample& sample) { return math::norm(sample.T_u_tip.position - wanted) < 1e-9; };
  };
  EXPECT_LT(math::norm(math::log(next(near({})).T_u_tip.orientation)), 1e-9);
  math::Pose moved = kHome;
  moved.position.x += 0.02;  // the base's x axis points to the operator's right
  arm.move(moved);
  next(near({0.0, 0.02, 0.0}));
  driver.close();
}

TEST_F(RosDriverTest, PosesOfBothReleasesAreTurnedIntoTheOperatorsFrame) {
  log.allow("samples a second");  // on a busy machine
  const auto driver = arm({{"operator present", "none"}});
  const auto read = [&](const std::function<bool(const Sample&)>& wanted) { return next(*driver, wanted); };
  expect_operators_frame<geometry_msgs::PoseStamped>(*node, *driver, read);
  expect_operators_frame<geometry_msgs::TransformStamped>(*node, *driver, read);
}

TEST_F(RosDriverTest, ForcesArriveInTheAxesOfTheTipAndEndByThemselves) {
  log.allow("samples a second");
  EmulatedArm<geometry_msgs::PoseStamped> emulated(*node, 1000.0);
  math::Pose tilted = kHome;
  tilted.orientation = math::exp({0.3, -0.7, 0.2}) * kHome.orientation;
  emulated.move(tilted);
  WrenchEar ear(*node, "/MTMR/body/servo_cf");
  const auto driver = arm();
  ASSERT_EQ(driver->open(), "");
  EXPECT_TRUE(driver->traits().force);
  next(*driver, [](const Sample&) { return true; });
  const math::Wrench wrench_u{{1.0, 2.0, 3.0}, {0.1, 0.0, -0.1}};
  const math::Quat R_tip_u = math::inverse(tilted.orientation) * math::from_rpy(0.0, 0.0, -M_PI / 2);
  EXPECT_TRUE(until([&] {
    driver->write(wrench_u);
    const math::Wrench at_tip = ear.newest();
    return math::norm(at_tip.force - math::rotate(R_tip_u, wrench_u.force)) < 1e-9 &&
           math::norm(at_tip.torque - math::rotate(R_tip_u, wrench_u.torque)) < 1e-9;
  }));
  EXPECT_TRUE(until([&] { return ear.newest().force == math::Vec3{}; })) << "nobody renews it";
  EXPECT_TRUE(until([&] {
    driver->write(wrench_u);
    return ear.newest().force != math::Vec3{};
  }));
  driver->write(wrench_u);
  driver->close();
  EXPECT_TRUE(until([&] { return ear.newest().force == math::Vec3{}; })) << "the end sends zero";
  const std::uint64_t sent = ear.count();
  std::this_thread::sleep_for(30ms);
  EXPECT_EQ(ear.count(), sent) << "and then nothing";
}

TEST_F(RosDriverTest, NullSpaceSendsEffortsThatAlsoTurnThePlatform) {
  log.allow("samples a second");
  EmulatedArm<geometry_msgs::PoseStamped> emulated(*node, 1000.0);
  auto joints = node->handle().advertise<sensor_msgs::JointState>("/MTMR/measured_js", 1, true);
  sensor_msgs::JointState state;
  state.position = {0.2, 0.3, -0.2, 0.4, 0.5, 0.4, 0.6};
  joints.publish(state);
  std::mutex mutex;
  std::vector<double> newest;
  const boost::function<void(const sensor_msgs::JointState::ConstPtr&)> on_efforts =
      [&](const sensor_msgs::JointState::ConstPtr& message) {
        const std::lock_guard<std::mutex> lock(mutex);
        newest = message->effort;
      };
  ros::AsyncSpinner spinner(1);
  spinner.start();
  const ros::Subscriber efforts = node->handle().subscribe<sensor_msgs::JointState>("/MTMR/servo_jf", 100, on_efforts);
  const auto driver = arm({{"null space", "true"}, {"operator present", "none"}});
  ASSERT_EQ(driver->open(), "");
  MtmJoints q;
  std::copy(state.position.begin(), state.position.end(), q.begin());
  const math::Vec3 force_u{0.0, 1.0, 0.5};
  const math::Vec3 force_base = math::rotate(math::from_rpy(0.0, 0.0, -M_PI / 2), force_u);
  MtmJoints wanted = mtm_efforts(mtm_frames(q), {force_base, {}});
  wanted[3] += mtm_platform_effort(q, {});
  wanted = mtm_bounded(wanted);
  Sample sample;
  EXPECT_TRUE(until([&] {
    driver->read(sample, 0.0);
    driver->write({force_u, {}});
    const std::lock_guard<std::mutex> lock(mutex);
    bool same = newest.size() == kMtmJoints;
    for (std::size_t i = 0; same && i < kMtmJoints; ++i) same = std::abs(newest[i] - wanted[i]) < 1e-9;
    return same;
  }));
  driver->close();
  EXPECT_TRUE(until([&] {
    const std::lock_guard<std::mutex> lock(mutex);
    return newest == std::vector<double>(kMtmJoints, 0.0);
  })) << "the end sends zero";
}

TEST_F(RosDriverTest, AnArmThatCannotBeUsedAndAnAbsentOperatorAreNotReady) {
  log.allow("samples a second");
  EmulatedArm<geometry_msgs::PoseStamped> emulated(*node, 500.0);
  auto state = node->handle().advertise<std_msgs::String>("/MTMR/operating_state", 1, true);
  auto present = node->handle().advertise<sensor_msgs::Joy>("/console/operator_present", 1, true);
  auto clutch = node->handle().advertise<sensor_msgs::Joy>("/footpedals/clutch", 1, true);
  auto gripper = node->handle().advertise<sensor_msgs::JointState>("/MTMR/gripper/measured_js", 1, true);
  const auto driver = arm({{"gripper closed", "0"}, {"gripper open", "0.5"}, {"wrench", "none"}});
  ASSERT_EQ(driver->open(), "");
  EXPECT_FALSE(driver->traits().force);
  const auto not_ready = [&](const std::string& why) {
    next(*driver, [&](const Sample& sample) { return !sample.ready && sample.not_ready == why; });
  };
  not_ready("the operator is absent");  // somebody would say if one were there
  std_msgs::String text;
  text.data = "DISABLED";
  state.publish(text);
  not_ready("the arm is not enabled");
  sensor_msgs::Joy pressed;
  pressed.buttons = {1};
  present.publish(pressed);
  text.data = "ENABLED";
  state.publish(text);
  clutch.publish(pressed);
  sensor_msgs::JointState half;
  half.position = {0.25};
  gripper.publish(half);
  const Sample sample = next(*driver, [](const Sample& s) { return s.ready && s.has_jaw && s.buttons != 0; });
  EXPECT_EQ(sample.buttons, 2U);
  EXPECT_DOUBLE_EQ(sample.jaw, 0.5);
  pressed.buttons = {0};
  present.publish(pressed);
  not_ready("the operator is absent");
}

TEST_F(RosDriverTest, SlowArmsAreNamedWithWhatToChange) {
  log.expect_warning("start its ROS program with -p 0.001");
  EmulatedArm<geometry_msgs::PoseStamped> emulated(*node, 100.0);
  const auto driver = arm();
  ASSERT_EQ(driver->open(), "");
  EXPECT_LT(driver->traits().rate_hz, 150.0);
}

TEST_F(RosDriverTest, StampZeroIsNoDataAndSilenceIsALoss) {
  log.allow("samples a second");
  EmulatedArm<geometry_msgs::PoseStamped> emulated(*node, 1000.0);
  emulated.stamped = false;
  const auto driver = arm();
  EXPECT_NE(driver->open().find("stamp 0"), std::string::npos);
  emulated.stamped = true;
  ASSERT_EQ(driver->open(), "");
  next(*driver, [](const Sample&) { return true; });
  emulated.silent = true;
  Sample last;
  EXPECT_TRUE(until([&] { return driver->read(last, 0.0) == Reading::lost; }));
  EXPECT_NE(driver->open().find("nothing arrives on /MTMR/local/measured_cp"), std::string::npos);
  emulated.silent = false;
  EXPECT_EQ(driver->open(), "");
  emulated.move({{}, {0.0, 0.0, 0.0, 0.5}});
  next(*driver, [](const Sample& sample) { return std::isnan(sample.T_u_tip.orientation.w); });
}

TEST_F(RosDriverTest, TwistsAndJoysMoveTheHand) {
  auto twists = node->handle().advertise<geometry_msgs::TwistStamped>("/somewhere/twist", 1);
  auto joys = node->handle().advertise<sensor_msgs::Joy>("/joy", 1, true);
  const auto by_twist = generic({{"twist", "/somewhere/twist"}, {"speed", "0.5"}});
  ASSERT_EQ(by_twist->open(), "");
  geometry_msgs::TwistStamped twist;
  twist.twist.linear.y = 0.2;
  next(*by_twist, [&](const Sample& sample) {
    twists.publish(twist);
    return sample.T_u_tip.position.y > 0.01;
  });
  math::Pose rest;
  EXPECT_TRUE(until([&] {
    const math::Pose before = rest;
    rest = next(*by_twist, [](const Sample&) { return true; }).T_u_tip;
    return rest == before;
  })) << "it goes on without twists";

  const auto by_joy = generic({{"joy", "/joy"}, {"axes/z", "-1"}, {"dead zone", "0"}});
  ASSERT_EQ(by_joy->open(), "");
  sensor_msgs::Joy joy;
  joy.axes = {0.0F, -1.0F};
  joy.buttons = {0, 1};
  joys.publish(joy);
  const Sample sample = next(*by_joy, [](const Sample& s) { return s.T_u_tip.position.z > 0.005; });
  EXPECT_EQ(sample.buttons, 2U);
  EXPECT_EQ(sample.T_u_tip.position.y, 0.0);
  joys.shutdown();
  Sample last;
  EXPECT_TRUE(until([&] { return by_joy->read(last, 0.0) == Reading::lost; })) << "its publisher is gone";
}

// Devices are made before ROS is started, and may outlive it.
TEST_F(RosDriverTest, TheEndOfRosIsALossThatSendsZeroFirst) {
  log.allow("samples a second");
  EmulatedArm<geometry_msgs::PoseStamped> emulated(*node, 1000.0);
  WrenchEar ear(*node, "/MTMR/body/servo_cf");
  const auto driver = arm();
  host->detach();
  EXPECT_NE(driver->open().find("ROS is not running"), std::string::npos);
  Sample last;
  EXPECT_EQ(driver->read(last, 0.0), Reading::lost);
  host->attach(*node);
  ASSERT_EQ(driver->open(), "");
  next(*driver, [](const Sample&) { return true; });
  EXPECT_TRUE(until([&] {
    driver->write({{1.0, 2.0, 3.0}, {}});
    return ear.newest().force != math::Vec3{};
  }));
  driver->write({{1.0, 2.0, 3.0}, {}});
  host->detach();
  EXPECT_EQ(driver->read(last, 0.0), Reading::lost);
  driver->write({{1.0, 2.0, 3.0}, {}});  // the device's thread goes on
  EXPECT_TRUE(until([&] { return ear.newest().force == math::Vec3{}; }));
  host->attach(*node);
}

TEST_F(RosDriverTest, MistakesInTheOptionsAreNamed) {
  EXPECT_NE(generic({})->open().find("needs 'driver: {pose: TOPIC}'"), std::string::npos);
  EXPECT_NE(arm({{"max force", "strong"}})->open().find("'max force' is 'strong'"), std::string::npos);
}

// What ends it when this program is killed is the closing of a pipe, as here.
TEST_F(RosDriverTest, TheGuardSendsZeroWhenItsSimulatorEnds) {
  WrenchEar ear(*node, "/guarded/body/servo_cf");
  ros_comm::ChildProgram guard;
  std::string problem;
  const auto program = std::filesystem::read_symlink("/proc/self/exe").parent_path() / "ambf_arm_guard";
  ASSERT_TRUE(guard.start({program.string(), "/guarded/body/servo_cf"}, problem)) << problem;
  ASSERT_TRUE(until([&] { return ear.publishers() > 0; }));
  EXPECT_EQ(ear.count(), 0U) << "silent while the simulator runs";
  guard.stop();
  EXPECT_TRUE(until([&] { return ear.count() > 0; }));
  EXPECT_EQ(ear.newest().force, math::Vec3{});
}

}  // namespace
}  // namespace ambf::dvrk_arm
