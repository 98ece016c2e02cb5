// Jaws: all limited joints below a body that a device holds open and close together (EQUATIONS 8):
// q = lower + opening (upper - lower), through the joints' own controllers.
//
// One device leads the jaw of a body: the one whose hand opened or closed last. It leads once its opening meets the
// jaw's, so that neither its arrival nor a change of the lead opens a grasp. Within a joint the newest command wins: a
// joint command of another source, or the jaw of another body, ends the lead; the hand gets it back by meeting the jaw
// again. The jaw then stays as it is until the next command.
#include <algorithm>
#include <cmath>

#include "model/detail/live_effectors.h"

namespace ambf::model {
namespace {

constexpr double kMeets = 0.02;  // of the way from closed to open
constexpr double kMoved = 0.01;  // further than hands and sensors tremble

bool takes_part(const LiveEffector& effector) { return effector.is.set_point.pulls && effector.is.set_point.moves_jaw; }

double at_opening(const physics::Joint& joint, double opening) {
  const auto& [lower, upper] = *joint.limits();
  return lower + opening * (upper - lower);
}

}  // namespace

// The jaw is as open as its commands ask for; a joint without one, as it is. Nothing: the body has no jaw.
std::optional<double> LiveEffectors::opening(const state::Structure& structure, const LiveBody& body) const {
  double sum = 0.0;
  int count = 0;
  each_jaw_joint(structure, body, [&](const LiveJoint& live) {
    const auto& [lower, upper] = *live.joint->limits();
    const bool commanded = live.order.type == state::JointCommandType::position;
    const double q = commanded ? live.order.value : live.joint->position();
    sum += std::clamp((q - lower) / (upper - lower), 0.0, 1.0);
    ++count;
  });
  return count == 0 ? std::nullopt : std::optional(sum / count);
}

bool LiveEffectors::taken_over(const state::Structure& structure, const LiveBody& body) const {
  bool taken = false;
  each_jaw_joint(structure, body, [&](const LiveJoint& live) { taken |= live.order.jaw != &body; });
  return taken;
}

void LiveEffectors::command_jaw(const state::Structure& structure, const LiveBody& body, double opening) {
  each_jaw_joint(structure, body, [&](LiveJoint& live) {
    if (live.order.type != state::JointCommandType::position) live.controller.reset();
    live.order = {state::JointCommandType::position, at_opening(*live.joint, opening), nullptr, &body};
  });
}

void LiveEffectors::choose_leader(const state::Structure& structure, std::span<LiveEffector> of_body) {
  for (LiveEffector& effector : of_body)
    if (!takes_part(effector)) effector.is.jaw_seen = effector.is.jaw_mark = effector.is.set_point.jaw;
  const auto concerned = [](const LiveEffector& each) { return takes_part(each) || each.is.leads_jaw; };
  if (std::none_of(of_body.begin(), of_body.end(), concerned)) return;
  const LiveBody& body = *of_body.front().body;
  const auto change_lead = [&](LiveEffector* leader) {
    for (LiveEffector& effector : of_body) {
      effector.is.leads_jaw = &effector == leader;
      effector.is.jaw_mark = effector.is.set_point.jaw;
    }
  };
  const auto leading = std::find_if(of_body.begin(), of_body.end(), [](const auto& each) { return each.is.leads_jaw; });
  LiveEffector* leader = leading == of_body.end() ? nullptr : &*leading;
  if (leader != nullptr && (!takes_part(*leader) || taken_over(structure, body))) change_lead(leader = nullptr);

  const std::optional<double> commanded = opening(structure, body);
  if (!commanded) return;
  const double now = leader != nullptr ? leader->is.jaw_in_force : *commanded;
  LiveEffector* next = nullptr;
  for (LiveEffector& effector : of_body) {
    SavedEffector& is = effector.is;
    const double before = is.jaw_seen - now, after = is.set_point.jaw - now;
    is.jaw_seen = is.set_point.jaw;
    if (&effector == leader || !takes_part(effector)) continue;
    const bool meets = std::min(std::abs(before), std::abs(after)) <= kMeets || (before < 0.0) != (after < 0.0);
    if (meets && std::abs(is.set_point.jaw - is.jaw_mark) > kMoved) next = &effector;
  }
  if (next == nullptr) return;
  change_lead(next);
  next->is.jaw_in_force = now;  // and goes to the hand's opening as its samples do
  next->is.jaw_steps_left = std::max<std::uint64_t>(next->is.jaw_steps_left, 1);
  command_jaw(structure, body, now);
}

void LiveEffectors::drive_jaw(const state::Structure& structure, std::span<LiveEffector> of_body) {
  for (LiveEffector& effector : of_body) {
    if (!effector.is.leads_jaw) continue;
    if (taken_over(structure, *effector.body)) {
      for (LiveEffector& each : of_body) {
        each.is.leads_jaw = false;
        each.is.jaw_mark = each.is.set_point.jaw;
      }
      return;
    }
    command_jaw(structure, *effector.body, effector.is.jaw_in_force);
    return;
  }
}

}  // namespace ambf::model
