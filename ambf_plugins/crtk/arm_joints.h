// The joints of an arm in a scene: where they are in frames, and what commands them. One thread at a time. C++17.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "adf/crtk_arms.h"
#include "crtk/arm_control.h"
#include "state/command.h"
#include "state/frame.h"

namespace ambf::crtk {

class ArmJoints {
 public:
  enum class Found { all, no_base, no_joint };
  // Searches them anew; `problem` says what is missing.
  Found find(const adf::CrtkArm& arm, const state::Structure& structure, std::string& problem);

  state::ObjectId base() const { return base_; }
  bool same_as(const ArmJoints& other) const;
  Measured read(const state::Frame& frame) const;
  std::optional<double> gripper(const state::Frame& frame) const;  // opening, rad
  // The command of the base that does what the targets say.
  void fill(const std::vector<Target>& targets, const Measured& measured, state::RigidBodyCommand& command) const;

 private:
  // Position of the kinematics' joint = sign x position of this one + offset; of half a jaw: sign = wrist.
  struct Joint {
    std::uint32_t slot = state::kNone;
    std::size_t index = 0;  // in the base's commands
    double sign = 1.0, offset = 0.0;
  };
  std::size_t size() const { return joints_.size() + (halves_.empty() ? 0 : 1); }

  state::ObjectId base_;
  std::vector<Joint> joints_, halves_;
  std::uint32_t gripper_ = state::kNone;
  double gripper_scale_ = 1.0, gripper_offset_ = 0.0;
};

}  // namespace ambf::crtk
