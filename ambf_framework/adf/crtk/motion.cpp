#include "adf/crtk/motion.h"

#include <cstdio>

#include "kinematics/agreement.h"

namespace ambf::adf {

namespace {

constexpr double kDegrees = 180.0 / 3.14159265358979323846;

std::string quoted(const std::string& name) { return "'" + name + "'"; }

std::string amount(double distance, double angle) {
  char text[80];
  std::snprintf(text, sizeof text, "%.3g mm and %.3g degrees", distance * 1e3, angle * kDegrees);
  return text;
}

// As it is written: with its tool, where that is named.
std::string rows_of(const CrtkArm& arm) {
  const kinematics::Arm& rows = arm.kinematics;
  return quoted(rows.name) + (rows.tool.empty() ? "" : " with " + quoted(rows.tool));
}

}  // namespace

std::optional<base::Diagnostic> check_motion(const CrtkArm& arm, const std::vector<kinematics::MechanismJoint>& joints,
                                             std::size_t base) {
  using Verdict = kinematics::Agreement::Verdict;
  const kinematics::Agreement found = kinematics::compare(arm.kinematics, joints, base);
  base::Diagnostic said{
      base::Severity::error, arm.file, arm.kinematics_line, arm.kinematics_column, arm.name, "kinematics", {}, {}};
  switch (found.verdict) {
    case Verdict::agrees: {
      // Poses in another arm's view, and the view itself, are worked out with the body's pose.
      const bool here =
          found.base_distance <= kinematics::kAgreedDistance && found.base_angle <= kinematics::kAgreedAngle;
      if (here || (arm.view.empty() && !arm.is_endoscope())) return std::nullopt;
      said.message = "the rows of " + rows_of(arm) + " do not start in the frame of the body " + quoted(arm.base) +
                     ": " + amount(found.base_distance, found.base_angle) + " from there";
      said.hint =
          "of an endoscope, and of an arm with `view`, both frames are the same: is `base` right, and the offset of "
          "the "
          "first joint?";
      return said;
    }
    case Verdict::differs:
      said.message = "the joints below " + quoted(arm.base) + " do not move as the rows of " + rows_of(arm) +
                     " say: the tip is up to " + amount(found.distance, found.angle) + " elsewhere, as the motion of " +
                     quoted(found.joint) + " shows";
      said.hint =
          "look at the order of `joints`, at their signs and offsets in the file of the kinematics, and at `tool`";
      return said;
    case Verdict::not_the_way:
      said.message = quoted(found.joint) + " does not lead from the body " + quoted(arm.base) + " to the arm's tip";
      said.hint = "the kinematics' joints, in `joints` or in their file, lie between the body `base` and the tip";
      return said;
    case Verdict::not_closed:
      said.message =
          "the model's loops do not close when " + quoted(found.joint) + " moves as " + rows_of(arm) + " may";
      said.hint = "look at the signs and offsets of the joints, and at their limits, in the file of the kinematics";
      return said;
    case Verdict::unknown: break;
  }
  said.severity = base::Severity::warning;
  said.message = "whether the model moves as the rows of " + rows_of(arm) +
                 " say cannot be checked: " + quoted(found.joint) +
                 " moves the tip, too, and is none of the arm's joints";
  said.hint = "poses are right only as long as that joint stays where the rows have it";
  return said;
}

}  // namespace ambf::adf
