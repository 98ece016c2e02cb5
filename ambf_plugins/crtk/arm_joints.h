// What an arm needs of a scene: the body through which its joints are commanded, and its gripper. One thread at a time.
// C++17.
#pragma once

#include <optional>
#include <string>

#include "adf/crtk_arms.h"
#include "state/frame.h"
#include "state/structure.h"

namespace ambf::crtk {

class ArmJoints {
 public:
  enum class Found { all, no_base, no_joint };
  // Searches them anew; `problem` says what is missing.
  Found find(const adf::CrtkArm& arm, const state::Structure& structure, std::string& problem);

  std::uint32_t base() const { return base_; }                     // index into Structure::objects
  std::optional<double> gripper(const state::Frame& frame) const;  // opening, rad

 private:
  std::uint32_t base_ = state::kNone;
  std::uint32_t gripper_ = state::kNone;
  double gripper_scale_ = 1.0, gripper_offset_ = 0.0;
};

}  // namespace ambf::crtk
