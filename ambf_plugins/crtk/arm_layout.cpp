#include "crtk/arm_layout.h"

#include <algorithm>
#include <limits>
#include <locale>
#include <sstream>

namespace ambf::crtk {

namespace {

std::string quoted(const std::string& text) {
  std::string made = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') made += '\\';
    made += c;
  }
  return made + "\"";
}

std::ostringstream numbers() {
  std::ostringstream out;
  out.imbue(std::locale::classic());
  out.precision(std::numeric_limits<double>::max_digits10);
  return out;
}

std::string axis_text(const AxisLimits& axis, const char* how) {
  std::ostringstream out = numbers();
  out << axis.lower << ' ' << axis.upper << ' ' << axis.max_velocity << ' ' << axis.max_acceleration << ' ' << how;
  return "    - " + quoted(out.str()) + "\n";
}

std::string joint_text(std::size_t axis, double ratio, double offset, const char* how, const std::string& name) {
  std::ostringstream out = numbers();
  out << axis << ' ' << ratio << ' ' << offset << ' ' << how << ' ' << name;
  return "    - " + quoted(out.str()) + "\n";
}

}  // namespace

ArmLimits limits_of(const adf::CrtkArm& arm) {
  ArmLimits made;
  made.joints = std::min(arm.kinematics.size(), kMaxJoints);
  made.has_jaw = arm.has_jaw();
  for (std::size_t i = 0; i < made.joints; ++i) {
    AxisLimits& axis = made.axes[i];
    axis = {arm.kinematics.lower[i], arm.kinematics.upper[i], arm.max_velocity[i], arm.max_acceleration[i],
            arm.kinematics.prismatic[i]};
    for (const kinematics::Arm& tool : arm.tools) {
      axis.lower = std::min(axis.lower, tool.lower[i]);
      axis.upper = std::max(axis.upper, tool.upper[i]);
    }
  }
  if (!made.has_jaw) return made;
  AxisLimits& jaw = made.axes[made.joints];
  jaw = {arm.kinematics.jaw->lower, arm.kinematics.jaw->upper, arm.jaw_max_velocity, arm.jaw_max_acceleration, false};
  for (const kinematics::Arm& tool : arm.tools) {
    if (!tool.jaw) continue;
    jaw.lower = std::min(jaw.lower, tool.jaw->lower);
    jaw.upper = std::max(jaw.upper, tool.jaw->upper);
  }
  return made;
}

std::string model_text(const adf::CrtkArm& arm, const std::string& base) {
  const ArmLimits limits = limits_of(arm);
  std::string name = arm.name;  // of an object, which has no namespaces of its own
  std::replace(name.begin(), name.end(), '/', '_');
  std::string made = "namespace: /ambf/env/\narms: [" + quoted("ARM " + name) + "]\n" + quoted("ARM " + name) +
                     ":\n  name: " + quoted(name) + "\n  parent: " + quoted(base) + "\n  arm: " + quoted(arm.name) +
                     "\n  axes:\n";
  for (std::size_t i = 0; i < limits.joints; ++i) {
    made += axis_text(limits.axes[i], limits.axes[i].prismatic ? "slides" : "turns");
  }
  if (limits.has_jaw) made += axis_text(limits.axes[limits.joints], "jaw");
  made += "  moved joints:\n";
  std::size_t axis = 0;
  for (const kinematics::AdfJoint& joint : arm.kinematics.adf_joints) {
    made += joint_text(axis++, joint.sign, joint.offset, "joint", joint.name);
  }
  for (const kinematics::JawHalf& half : arm.kinematics.adf_jaw) {
    made += joint_text(axis, half.wrist, 0.0, "half", half.name);
  }
  return made;
}

}  // namespace ambf::crtk
