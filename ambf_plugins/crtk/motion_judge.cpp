#include "crtk/motion_judge.h"

#include "adf/crtk/motion.h"
#include "crtk/model_joints.h"

namespace ambf::crtk {

MotionJudge::Verdict MotionJudge::of(const adf::CrtkArm& arm, const state::Frame& frame, std::uint32_t base) {
  const state::ObjectInfo& object = frame.structure->objects[base];
  const std::lock_guard<std::mutex> lock(mutex_);
  if (judged_ == object.id) return verdict_;
  if (asked_ == object.id) return Verdict::pending;
  if (frame.run.diverged) return Verdict::unknowable;
  std::vector<kinematics::MechanismJoint> joints = mechanism_joints(frame);
  if (joints.empty()) return Verdict::unknowable;  // not all is finite
  asked_ = object.id;
  question_ = Question{arm, std::move(joints), object.id, object.slot};
  return Verdict::pending;
}

bool MotionJudge::judge(base::Log& log) {
  std::optional<Question> question;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    question.swap(question_);
  }
  if (!question) return false;
  const auto problem = adf::check_motion(question->arm, question->joints, question->slot);
  if (problem) log.report(*problem);
  const std::lock_guard<std::mutex> lock(mutex_);
  judged_ = question->base;
  verdict_ = problem && problem->severity == base::Severity::error ? Verdict::differs : Verdict::fits;
  return true;
}

}  // namespace ambf::crtk
