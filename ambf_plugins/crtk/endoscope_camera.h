// The camera at the tip of an endoscope's arm: it is turned as the type of the endoscope says. One thread. C++17.
#pragma once

#include <memory>
#include <string>

#include "kinematics/arm.h"
#include "state/abilities/abilities.h"

namespace ambf::crtk {

class EndoscopeCamera {
 public:
  // `straight`, `now`: the arm's kinematics with a straight endoscope, and with the one that it has. `base`: index into
  // objects of the body that the arm's joints hang on. As the scene has the camera when it is first seen, it looks
  // straight ahead. Once turned it is let go: others may move it.
  void follow(const state::Frame& frame, state::CommandAbility& command, const std::string& name, std::uint32_t base,
              const kinematics::Arm& straight, const kinematics::Arm& now);
  // Whether the scene has the camera on this arm.
  bool found() const { return slot_ != state::kNone; }

 private:
  void find(const state::Structure& structure, const std::string& name, std::uint32_t base);

  std::uint64_t structure_version_ = 0, epoch_ = 0;
  std::uint32_t slot_ = state::kNone;
  state::ObjectId camera_;
  math::Pose T_parent_straight_, wanted_;
  std::string tool_ = "STRAIGHT";
  bool pending_ = false;
  std::unique_ptr<state::CommandPort> port_;
};

}  // namespace ambf::crtk
