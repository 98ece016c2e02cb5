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

void ServedArm::serve(const std::atomic<bool>& stopping) {
  has_work_ = false;
  if (judge_.judge(log_)) {
    const std::lock_guard<std::mutex> lock(mutex_);
    structure_version_ = 0;  // the next frame shows what that means
  }
  exchange(stopping);
}

void ServedArm::exchange(const std::atomic<bool>& stopping) {
  std::optional<ArmControl::Exchange> wanted;
  std::optional<adf::CrtkArm> arm;
  state::ObjectId base_body;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    wanted = control_.take_exchange();
    if (!wanted) return;
    arm = control_.description();
    base_body = base_id_;
  }
  const auto instrument = std::find_if(arm->instruments.begin(), arm->instruments.end(),
                                       [&](const adf::CrtkInstrument& each) { return each.tool == wanted->tool; });
  if (instrument == arm->instruments.end()) return;
  const auto rests = [this] {
    const std::lock_guard<std::mutex> lock(mutex_);
    return control_.may_exchange();
  };
  const std::int64_t until_ns = base::steady_ns() + kSettle_ns;
  while (!stopping && !rests() && base::steady_ns() < until_ns) std::this_thread::sleep_for(kPoll);
  const ExchangeResult result = exchange_tool(simulation_, *arm, base_body, *instrument, stopping);
  const std::lock_guard<std::mutex> lock(mutex_);
  if (!control_.exchanging(wanted->number)) return;  // its model went meanwhile, and all know
  if (result.problem.empty()) {
    tool_version_ = simulation_.observe.structure()->version;
    structure_version_ = 0;
  } else if (result.removed) {
    bound_ = false;
    port_.reset();
    control_.fault("the tool could not be exchanged for " + wanted->tool + ": " + result.problem);
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
