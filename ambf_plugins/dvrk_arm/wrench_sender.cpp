#include "dvrk_arm/wrench_sender.h"

#include <chrono>
#include <filesystem>

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

WrenchSender::WrenchSender(ros_comm::Node& node, const std::string& topic, std::string& problem)
    : publisher_(node, topic, kQueueSize) {
  guard_.start({guard_program(), topic}, problem);
  thread_ = std::thread([this] { run(); });
}

WrenchSender::~WrenchSender() {
  stop_ = true;
  thread_.join();
}

void WrenchSender::run() {
  base::set_thread_name("arm forces");
  base::request_precise_timers();
  auto due = std::chrono::steady_clock::now();
  while (!stop_) {
    newest_.refresh();
    const bool alive = newest_.sequence() != 0 && base::steady_ns() - newest_.time_ns() < kLife_ns;
    publish(alive ? newest_.value() : math::Wrench{});
    due = std::max(due + kPeriod, std::chrono::steady_clock::now() - kPeriod);
    std::this_thread::sleep_until(due);
  }
  for (int i = 0; i < kLastZeros; ++i) {
    publish({});
    std::this_thread::sleep_for(kDelivery / kLastZeros);
  }
}

void WrenchSender::publish(const math::Wrench& wrench) {
  message_.header.stamp.fromNSec(static_cast<std::uint64_t>(base::system_ns()));
  message_.wrench.force.x = wrench.force.x;
  message_.wrench.force.y = wrench.force.y;
  message_.wrench.force.z = wrench.force.z;
  message_.wrench.torque.x = wrench.torque.x;
  message_.wrench.torque.y = wrench.torque.y;
  message_.wrench.torque.z = wrench.torque.z;
  publisher_.publish(message_);
}

}  // namespace ambf::dvrk_arm
