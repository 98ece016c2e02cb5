#include "devices/jaw.h"

#include <algorithm>
#include <cmath>

namespace ambf::devices {

void Jaw::step(const JawInput& in) {
  double hand = std::clamp(0.5 + in.offset, 0.0, 1.0);
  if (in.has_gripper) {
    hand = std::clamp(in.gripper, 0.0, 1.0);
  } else if (in.has_button) {
    hand = in.button ? 0.0 : 1.0;
  }
  const double held = ever_ ? tool_ : in.tool;
  const bool met = std::abs(hand - held) <= kMeets;
  const bool crossed = known_ && (hand_ - held) * (hand - held) < 0.0;
  // What has neither gripper nor button changes its value only when its user says so: there is nothing to meet.
  const bool chosen = !in.has_gripper && !in.has_button;
  follows_ = in.engaged && (follows_ || met || crossed || chosen);
  if (follows_) {
    tool_ = hand;
    ever_ = true;
  }
  hand_ = hand;
  known_ = true;
}

}  // namespace ambf::devices
