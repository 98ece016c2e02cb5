#include "dvrk_arm/force_sender.h"

#include <chrono>
#include <filesystem>
#include <vector>

#include "base/clock.h"
#include "base/realtime.h"

namespace ambf::dvrk_arm {

namespace {

using namespace std::chrono_literals;

constexpr auto kPeriod = 1ms;
constexpr std::int64_t kLife_ns = 100'000'000;  // of a wrench that nobody renews
constexpr int kLastZeros = 10;
constexpr auto kDelivery = 20ms;  // roscpp sends later, on a thread of its own
constexpr std::uint32_t kQueueSize = 1;

std::string guard_program() {
  std::error_code none;
  return (std::filesystem::read_symlink("/proc/self/exe", none).parent_path() / "ambf_arm_guard").string();
}

}  // namespace

ForceSender::ForceSender(ros_comm::Node& node, const std::string& topic, Kind kind, exchange::LatestSlot<Force>& newest,
                         std::string& problem)
    : newest_(newest) {
  std::vector<std::string> guard = {guard_program(), topic};
  if (kind == Kind::wrench) {
    wrenches_ = std::make_unique<ros_comm::TopicPublisher<geometry_msgs::WrenchStamped>>(node, topic, kQueueSize);
  } else {
    efforts_ = std::make_unique<ros_comm::TopicPublisher<sensor_msgs::JointState>>(node, topic, kQueueSize);
    guard.insert(guard.begin() + 1, "--efforts");
  }
  guard_.start(guard, problem);
  thread_ = std::thread([this] { run(); });
}

ForceSender::~ForceSender() {
  stop_ = true;
  thread_.join();
}

void ForceSender::run() {
  base::set_thread_name("arm forces");
  base::request_precise_timers();
  auto due = std::chrono::steady_clock::now();
  while (!stop_) {
    newest_.refresh();
    const bool alive = newest_.sequence() != 0 && base::steady_ns() - newest_.time_ns() < kLife_ns;
    publish(alive ? newest_.value() : Force{});
    due = std::max(due + kPeriod, std::chrono::steady_clock::now() - kPeriod);
    std::this_thread::sleep_until(due);
  }
  for (int i = 0; i < kLastZeros; ++i) {
    publish({});
    std::this_thread::sleep_for(kDelivery / kLastZeros);
  }
}

void ForceSender::publish(const Force& force) {
  const auto now_ns = static_cast<std::uint64_t>(base::system_ns());
  if (efforts_ != nullptr) {
    effort_message_.header.stamp.fromNSec(now_ns);
    effort_message_.effort.assign(force.efforts.begin(), force.efforts.end());
    efforts_->publish(effort_message_);
    return;
  }
  wrench_message_.header.stamp.fromNSec(now_ns);
  wrench_message_.wrench.force.x = force.wrench.force.x;
  wrench_message_.wrench.force.y = force.wrench.force.y;
  wrench_message_.wrench.force.z = force.wrench.force.z;
  wrench_message_.wrench.torque.x = force.wrench.torque.x;
  wrench_message_.wrench.torque.y = force.wrench.torque.y;
  wrench_message_.wrench.torque.z = force.wrench.torque.z;
  wrenches_->publish(wrench_message_);
}

}  // namespace ambf::dvrk_arm
