// ServedArm: what is at the end of the arm in the simulation.
#include <algorithm>
#include <chrono>
#include <thread>

#include "base/clock.h"
#include "crtk/arm_topics.h"
#include "crtk/served_arm.h"
#include "crtk/tool_exchange.h"

namespace ambf::crtk {

namespace {

constexpr std::int64_t kSettle_ns = 1'000'000'000;  // given to an arm before its tool goes
constexpr auto kPoll = std::chrono::milliseconds(2);

}  // namespace

void ServedArm::exchange(const std::atomic<bool>& stopping) {
  std::optional<std::string> tool;
  std::optional<adf::CrtkArm> arm;
  state::ObjectId base_body;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    tool = control_.take_exchange();
    if (!tool) return;
    arm = control_.description();
    base_body = base_id_;
  }
  const auto instrument = std::find_if(arm->instruments.begin(), arm->instruments.end(),
                                       [&](const adf::CrtkInstrument& each) { return each.tool == *tool; });
  if (instrument == arm->instruments.end()) return;
  const auto rests = [this] {
    const std::lock_guard<std::mutex> lock(mutex_);
    return control_.may_exchange();
  };
  const std::int64_t until_ns = base::steady_ns() + kSettle_ns;
  while (!stopping && !rests() && base::steady_ns() < until_ns) std::this_thread::sleep_for(kPoll);
  const ExchangeResult result = exchange_tool(simulation_, *arm, base_body, *instrument, stopping);
  const std::lock_guard<std::mutex> lock(mutex_);
  if (!control_.exchanging()) return;  // its model went meanwhile, and all know
  if (result.problem.empty()) {
    tool_version_ = simulation_.observe.structure()->version;
    structure_version_ = 0;
  } else if (result.removed) {
    bound_ = false;
    port_.reset();
    control_.fault("the tool could not be exchanged for " + *tool + ": " + result.problem);
  } else {
    control_.not_exchanged(result.problem);
  }
  post();
  announce(base::steady_ns());
}

void ServedArm::turn_camera(const state::Frame& frame) {
  const adf::CrtkArm& arm = control_.description();
  if (arm.camera.empty()) return;
  const auto straight = std::find_if(arm.tools.begin(), arm.tools.end(),
                                     [](const kinematics::Arm& each) { return each.tool == "STRAIGHT"; });
  camera_.follow(frame, simulation_.command, arm.camera, joints_.base(), *straight, arm.kinematics);
}

}  // namespace ambf::crtk
