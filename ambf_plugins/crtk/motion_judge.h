// Whether the scene's joints move an arm's tip as its kinematics say (docs/crtk.md). That takes many milliseconds: who
// reads frames only asks, and another thread judges. Once for each model that brings the base: tools are exchanged
// later. C++17.
#pragma once

#include <cstdint>
#include <mutex>
#include <optional>
#include <vector>

#include "adf/crtk_arms.h"
#include "base/log.h"
#include "kinematics/mechanism.h"
#include "state/frame.h"

namespace ambf::crtk {

class MotionJudge {
 public:
  enum class Verdict {
    pending,     // judge() says when there is one
    unknowable,  // the world has diverged, so that its joints say nothing: ask again once it is reset
    fits,
    differs
  };
  // `base`: index into objects of the body that the arm's joints hang on. Never waits for judge().
  Verdict of(const adf::CrtkArm& arm, const state::Frame& frame, std::uint32_t base);
  // Judges what of() has asked about and reports what is wrong; true: there is a verdict. Takes milliseconds; one
  // thread.
  bool judge(base::Log& log);

 private:
  struct Question {
    adf::CrtkArm arm;
    std::vector<kinematics::MechanismJoint> joints;
    state::ObjectId base;
    std::size_t slot = 0;
  };

  std::mutex mutex_;  // guards all below, and is held for microseconds
  std::optional<Question> question_;
  state::ObjectId asked_, judged_;  // the base that the question, that the verdict is about
  Verdict verdict_ = Verdict::pending;
};

}  // namespace ambf::crtk
