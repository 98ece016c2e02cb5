// Gains that cannot be stable: a damping force D v acts for one step dt, so beyond D dt = inertia it turns the velocity round.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <set>

#include "adf/check.h"
#include "adf/report.h"
#include "scene/lookup.h"

namespace ambf::adf {

namespace {

constexpr double kStep = 0.001;  // s, the step when nobody asks for another

double largest(const math::Vec3& v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }

std::string short_number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", value);
  return text;
}

void warn(Report& report, const scene::Identity& identity, const std::string& key, double gain, double inertia,
          const char* unit) {
  report.warning({identity.where.line, identity.where.column}, key,
                 "cannot be stable: D of " + short_number(gain) + " times the step of 0.001 s is more than " +
                     short_number(inertia) + " " + unit,
                 "D below " + short_number(inertia / kStep) + " is slow enough for this step");
}

void check_body(const scene::Body& body, Report& report) {
  if (body.mass <= 0.0) return;
  const double linear = largest(body.linear.d);
  if (body.linear.output == scene::ControllerOutput::force && linear * kStep > body.mass) {
    warn(report, body.identity, "controller/linear/D", linear, body.mass, "kg");
  }
  if (body.angular.output != scene::ControllerOutput::force || !body.inertia) return;
  const double smallest = std::min({body.inertia->x, body.inertia->y, body.inertia->z});
  const double angular = largest(body.angular.d);
  if (smallest > 0.0 && angular * kStep > smallest)
    warn(report, body.identity, "controller/angular/D", angular, smallest, "kg m^2");
}

// Of the body about the joint's axis, in its own frame: I_axis + m d^2.
double inertia_about(const scene::Body& body, const scene::Joint& joint) {
  const math::Pose com = body.inertial_offset.value_or(math::Pose{});
  const math::Vec3 axis = math::rotate(math::inverse(com.orientation), joint.child_axis);
  const math::Vec3 arm = com.position - joint.child_pivot * body.scale;
  const math::Vec3 across = arm - joint.child_axis * math::dot(arm, joint.child_axis);
  return body.inertia->x * axis.x * axis.x + body.inertia->y * axis.y * axis.y + body.inertia->z * axis.z * axis.z +
         body.mass * math::dot(across, across);
}

}  // namespace

base::Diagnostics check_gains(const scene::Model& model) {
  Report report(model.file);
  std::vector<std::string> names;
  for (const scene::Body& body : model.bodies) {
    report.set_block(body.identity.identifier);
    check_body(body, report);
    names.push_back(body.identity.name_space + body.identity.identifier);
  }
  if (too_many_pairs(model)) return report.take();
  const auto body_of = [&](const scene::Joint& joint, const std::string& name) {
    return scene::find_joint_body(names, {}, name, joint.identity.name_space, "").index;
  };
  // Only the last body of a chain: behind any other there is more to move.
  std::set<std::size_t> parents;
  for (const scene::Joint& joint : model.joints) {
    if (const auto parent = body_of(joint, joint.parent)) parents.insert(*parent);
  }
  for (const scene::Joint& joint : model.joints) {
    if (joint.controller.output != scene::ControllerOutput::force) continue;
    const auto child = body_of(joint, joint.child);
    if (!child || parents.contains(*child)) continue;
    const scene::Body& body = model.bodies[*child];
    if (body.mass <= 0.0) continue;
    report.set_block(joint.identity.identifier);
    const double gain = std::abs(joint.controller.d);
    if (joint.type == state::JointType::prismatic && gain * kStep > body.mass) {
      warn(report, joint.identity, "controller/D", gain, body.mass, "kg");
    }
    if (joint.type == state::JointType::revolute && body.inertia) {
      const double inertia = inertia_about(body, joint);
      if (inertia > 0.0 && gain * kStep > inertia)
        warn(report, joint.identity, "controller/D", gain, inertia, "kg m^2");
    }
  }
  return report.take();
}

}  // namespace ambf::adf
