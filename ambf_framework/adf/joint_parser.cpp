#include "adf/detail/joint_parser.h"

#include <cmath>

#include "adf/detail/bind.h"

namespace ambf::adf {

namespace {

using state::JointType;

bool has_one_axis(JointType type) {
  return type == JointType::revolute || type == JointType::prismatic || type == JointType::linear_spring ||
         type == JointType::torsion_spring;
}

bool check_bodies(const Block& block, const scene::Joint& joint, Report& report) {
  if (joint.parent == joint.child) {
    report.error(block.fields.mark("child"), "child", "parent and child are the same body: " + in_quotes(joint.child),
                 "a joint needs two bodies");
    return false;
  }
  return true;
}

bool parse_axes(const Fields& fields, scene::Joint& joint, Report& report) {
  for (const char* key : {"parent axis", "child axis"}) {
    if (!fields.has(key) && joint.type != JointType::p2p) {
      report.error(fields.mark(), key, "missing; expected a vector {x, y, z}", std::string("add `") + key + "`");
      return false;
    }
    // A point to point joint has no direction: whatever stands there does no harm.
    if (joint.type == JointType::p2p && math::norm(fields.vector(key, {})) == 0.0) continue;
    const auto axis = parse_axis(fields, key, {0.0, 0.0, 1.0}, report);
    if (!axis) return false;
    (key[0] == 'p' ? joint.parent_axis : joint.child_axis) = *axis;
  }
  return true;
}

void parse_single_limits(const Fields& limits, scene::Joint& joint, Report& report) {
  const auto low = limits.number("low"), high = limits.number("high");
  if (!low && !high && !limits.has("x") && !limits.has("linear") && !limits.has("angular")) return;
  if (!low || !high) {
    report.warning(limits.mark(), "joint limits", "expected both low and high", "the joint moves freely");
  } else if (*low > *high) {
    report.warning(limits.mark(), "joint limits",
                   "reversed: low " + std::to_string(*low) + " is above high " + std::to_string(*high),
                   "the joint moves freely; exchange the two");
  } else {
    joint.limits = {*low, *high};
  }
}

// A range whose low is above its high leaves that axis free, as Bullet has it.
void parse_range(const Fields& limits, const char* key, math::Vec3& low, math::Vec3& high, Report& report) {
  if (!limits.has(key)) return;
  const Fields range = limits.map(key);
  low = range.vector("low", low);
  high = range.vector("high", high);
  if (low.x > high.x || low.y > high.y || low.z > high.z) {
    report.warning(range.mark(), std::string("joint limits/") + key, "low is above high", "such an axis moves freely");
  }
}

void parse_limits(const Fields& fields, scene::Joint& joint, Report& report) {
  if (!fields.has("joint limits")) return;
  const Fields limits = fields.map("joint limits");
  if (has_one_axis(joint.type)) {
    parse_single_limits(limits, joint, report);
  } else if (joint.type == JointType::six_dof || joint.type == JointType::six_dof_spring) {
    parse_range(limits, "linear", joint.six_dof.linear_low, joint.six_dof.linear_high, report);
    parse_range(limits, "angular", joint.six_dof.angular_low, joint.six_dof.angular_high, report);
  }
}

// One number for all six axes, or {linear: {x, y, z}, angular: {x, y, z}}.
void parse_six(const Fields& fields, const char* key, math::Vec3& linear, math::Vec3& angular) {
  if (const auto all = fields.number(key)) linear = angular = {*all, *all, *all};
  const Fields map = fields.map(key);
  linear = map.vector("linear", linear);
  angular = map.vector("angular", angular);
}

void parse_spring(const Fields& fields, scene::Joint& joint, Report& report) {
  const char* equilibrium = fields.has("equilibrium point") ? "equilibrium point" : "equiblirium point";
  if (joint.type == JointType::six_dof_spring) {
    parse_six(fields, "stiffness", joint.spring.linear_stiffness, joint.spring.angular_stiffness);
    parse_six(fields, equilibrium, joint.spring.linear_equilibrium, joint.spring.angular_equilibrium);
    parse_six(fields, "damping", joint.spring.linear_damping, joint.spring.angular_damping);
    return;
  }
  for (const char* key : {"stiffness", equilibrium, "damping"}) {
    const auto value = fields.find(key);
    if (value && value->is_map())
      report.warning(value->mark(), key, "expected a number for this type of joint, found a map", "the default counts");
  }
  joint.stiffness = fields.number("stiffness", 0.0);
  joint.equilibrium = fields.number(equilibrium);
  joint.damping = fields.number("damping", 0.0);
}

// Keys that only joints of other types have: without a word somebody would wait for their effect. Exporters give fixed
// joints limits.
void report_no_effect(const Fields& fields, JointType type, Report& report) {
  const std::string on = "has no effect on a joint of type " + in_quotes(fields.text("type", "revolute"));
  const bool spring = type == JointType::linear_spring || type == JointType::torsion_spring;
  if (!spring && type != JointType::six_dof_spring) {
    for (const char* key : {"stiffness", "equilibrium point", "equiblirium point"}) {
      if (fields.has(key) && fields.number(key) != 0.0)
        report.warning(fields.mark(key), key, on,
                       "springs have it: `linear spring`, `torsion spring`, `six dof spring`");
    }
  }
  if (type == JointType::fixed || type == JointType::p2p || !fields.has("joint limits")) return;
  const Fields limits = fields.map("joint limits");
  const auto report_others = [&](std::initializer_list<const char*> others, const char* expected) {
    for (const char* key : others) {
      if (limits.has(key)) report.warning(limits.mark(key), std::string("joint limits/") + key, on, expected);
    }
  };
  if (has_one_axis(type)) {
    report_others({"x", "y", "z", "linear", "angular"}, "it has `low` and `high`");
  } else if (type == JointType::cone_twist) {
    report_others({"low", "high", "linear", "angular"}, "it has `x`, `y` and `z`");
  } else {
    report_others({"low", "high", "x", "y", "z"}, "it has `linear` and `angular`, each with `low` and `high`");
  }
}

void report_degrees(const Fields& fields, JointType type, Report& report) {
  const auto look = [&report](const Fields& in, const char* key, const std::string& path) {
    if (std::abs(in.number(key, 0.0)) > kManyTurns) report.warning(in.mark(key), path + key, kInRadians);
  };
  for (const char* key : {"offset", "child offset", "joint offset"}) look(fields, key, "");
  if (type != JointType::revolute && type != JointType::torsion_spring) return;
  const Fields limits = fields.map("joint limits");
  for (const char* key : {"low", "high"}) look(limits, key, "joint limits/");
}

// With a controller the output is force, unless a key says otherwise.
void finish_gains(const Fields& fields, scene::Joint& joint, Report& report) {
  if (!fields.has("controller")) return;
  const Fields gains = fields.map("controller");
  for (const char* key : {"P", "I", "D"}) {
    if (gains.number(key, 0.0) < 0.0) report.warning(gains.mark(key), std::string("controller/") + key, kDrivesAway);
  }
  if (!fields.has("controller output type")) joint.controller.output = scene::ControllerOutput::force;
}

void check_mimic(const Fields& fields, scene::Joint& joint, Report& report) {
  if (!fields.has("mimic")) return;
  if (!has_one_axis(joint.type)) {
    report.warning(fields.mark("mimic"), "mimic",
                   "has no effect on a joint of type " + in_quotes(fields.text("type", "revolute")),
                   "joints with one coordinate follow others: revolute, prismatic and springs");
    joint.mimic = {};
  }
}

}  // namespace

std::optional<scene::Joint> parse_joint(const Block& block, const FileContext& file, NameBook& names) {
  const Fields& fields = block.fields;
  Report& report = file.report;
  auto joint = read<scene::Joint>(fields.value(), scene::group::kJoint, file.options.defaults);
  if (!fields.has("type")) report.information(block.where, "type", "missing; revolute is assumed");
  if (!check_bodies(block, joint, report) || !parse_axes(fields, joint, report)) return std::nullopt;
  finish_gains(fields, joint, report);
  report_no_effect(fields, joint.type, report);
  report_degrees(fields, joint.type, report);
  parse_limits(fields, joint, report);
  parse_spring(fields, joint, report);
  check_mimic(fields, joint, report);
  joint.identity = parse_identity(block, file, names);
  return joint;
}

}  // namespace ambf::adf
