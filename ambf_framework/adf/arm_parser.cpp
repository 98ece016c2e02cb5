#include "adf/detail/arm_parser.h"

#include <algorithm>
#include <cmath>

#include "adf/detail/scalars.h"
#include "math/rotation.h"

namespace ambf::adf {

namespace {

using kinematics::Arm;
using kinematics::Convention;
using kinematics::Row;
using kinematics::Solver;

constexpr double kDegree = 3.14159265358979323846 / 180.0;
constexpr int kMaxInheritance = 8;

// Whether the solver suits the rows: it finds a pose that they reach.
bool leads_back(const Arm& arm) {
  kinematics::Joints joints = arm.home;
  for (std::size_t i = 0; i < joints.size(); ++i) joints[i] += 0.1 * (arm.upper[i] - joints[i]);
  const math::Pose pose = kinematics::forward(arm, joints);
  const auto missing = kinematics::difference(kinematics::forward(arm, inverse(arm, pose, joints).joints), pose);
  return missing.distance < 1e-6 && missing.angle < 1e-6;
}

}  // namespace

bool ArmReader::read_arm(Value own, ArmDraft& draft, int depth) {
  if (!expect(own.is_map(), own, "an arm is a map of keys")) return false;
  if (const auto base = own.find("same_as")) {
    const auto found = root_.find(base->is_scalar() ? base->text() : std::string());
    if (!expect(found && depth < kMaxInheritance, *base, "same_as must name another arm")) return false;
    if (!read_arm(*found, draft, depth + 1)) return false;
  }
  return apply(own, draft);
}

bool ArmReader::finish(Value own, ArmDraft& draft) {
  Arm& arm = draft.arm;
  const std::size_t n = arm.size();
  if (!expect(n > 0 && !arm.rows.empty(), own, "an arm needs joints and rows")) return false;
  for (std::size_t i = 0; i < n; ++i) {
    if (!expect(arm.lower[i] <= arm.upper[i], own, arm.names[i] + " needs limits, the lower one first")) return false;
    arm.home[i] = std::clamp(arm.home[i], arm.lower[i], arm.upper[i]);
  }
  for (const Row& row : arm.rows) {
    const bool exists = row.joint >= 0 && static_cast<std::size_t>(row.joint) < n;
    if (!expect(exists, own, "a row names a joint that does not exist")) return false;
  }
  const bool shaft = arm.solver == Solver::remote_center;
  const bool numeric = arm.solver == Solver::numeric;
  const bool at_origin = math::norm(draft.foot.position) == 0.0 && draft.foot.orientation.w == 1.0;
  if (!expect(at_origin || numeric, own, "only the numeric solver knows a foot", "use solver: numeric")) return false;
  const bool fits = numeric || (arm.rows.size() == n && (shaft ? n == 4 || n == 6 : n == 7));
  if (!expect(fits, own, "the solver does not fit the number of joints and rows")) return false;
  kinematics::build_steps(arm, draft.convention, draft.foot, draft.tip);
  return expect(leads_back(arm), own, "the solver does not fit the shape of the rows", "use solver: numeric");
}

bool ArmReader::apply(Value changes, ArmDraft& draft) {
  for (std::size_t i = 0; i < changes.size(); ++i) {
    const auto [key, value] = changes.entry(i);
    if (!apply(key, value, draft)) return false;
  }
  return true;
}

bool ArmReader::expect(bool right, Value where, const std::string& message, const std::string& hint) {
  if (!right) mistake_ = {where.mark(), message, hint};
  return right;
}

bool ArmReader::number(Value value, double& out, double unit) {
  const double read = value.is_scalar() ? to_number(value.text()).value_or(NAN) : NAN;
  if (!expect(std::isfinite(read), value, "expected a number")) return false;
  out = read * unit;
  return true;
}

bool ArmReader::numbers(Value value, std::vector<double>& out, std::size_t count, double unit) {
  if (!expect(value.is_list() && value.size() == count, value, "expected " + std::to_string(count) + " numbers"))
    return false;
  out.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    if (!number(value.item(i), out[i], unit)) return false;
  }
  return true;
}

bool ArmReader::apply(Value key, Value value, ArmDraft& draft) {
  const std::string& name = key.text();
  Arm& arm = draft.arm;
  if (name == "same_as") return true;
  if (name == "dh")
    return choice(value, draft.convention, {{"modified", Convention::modified}, {"standard", Convention::standard}});
  if (name == "solver") {
    return choice(value, arm.solver,
                  {{"remote_center", Solver::remote_center},
                   {"gimbal", Solver::gimbal},
                   {"spherical_shoulder_and_wrist", Solver::spherical_shoulder_and_wrist},
                   {"numeric", Solver::numeric}});
  }
  if (name == "joints") return joints(value, arm);
  if (name == "rows") return rows(value, arm);
  if (name == "foot") return pose(value, draft.foot);
  if (name == "tip") return pose(value, draft.tip);
  if (name == "jaw") return jaw(value, arm);
  if (name == "coupling") return coupling(value, arm);
  if (name == "limits_deg" || name == "max_effort") return changed_joints(name, value, arm);
  if (name == "adf") return adf(value, arm);
  if (name == "default_tool") {
    draft.default_tool = value.text();
    return expect(value.is_scalar(), value, "default_tool is a name");
  }
  if (name == "tools") {
    draft.tools = value;
    return expect(value.is_map(), value, "tools is a map of names");
  }
  return expect(false, key, "unknown key '" + printable(name) + "'", "docs/kinematics.md lists the keys");
}

bool ArmReader::limits(Value owner, double& lower, double& upper) {
  const auto plain = owner.find("limits");
  const auto degrees = owner.find("limits_deg");
  if (!expect(plain.has_value() != degrees.has_value(), owner, "expected limits or limits_deg")) return false;
  std::vector<double> both;
  if (!numbers(plain ? *plain : *degrees, both, 2, plain ? 1.0 : kDegree)) return false;
  lower = both[0];
  upper = both[1];
  return true;
}

bool ArmReader::joints(Value list, Arm& arm) {
  if (!expect(list.is_list(), list, "joints is a list")) return false;
  arm.names.clear();
  const std::size_t n = list.size();
  for (auto* each : {&arm.lower, &arm.upper, &arm.home, &arm.max_effort}) each->assign(n, 0.0);
  arm.prismatic.assign(n, false);
  for (std::size_t i = 0; i < n; ++i) {
    const Value joint = list.item(i);
    const auto name = joint.find("name"), type = joint.find("type"), home = joint.find("home");
    if (!expect(name && type && name->is_scalar(), joint, "a joint needs name and type")) return false;
    bool prismatic = false;
    if (!choice(*type, prismatic, {{"revolute", false}, {"prismatic", true}})) return false;
    arm.prismatic[i] = prismatic;
    arm.names.push_back(name->text());
    if (!limits(joint, arm.lower[i], arm.upper[i])) return false;
    if (home && !number(*home, arm.home[i])) return false;
    const auto effort = joint.find("max_effort");
    if (effort && !number(*effort, arm.max_effort[i])) return false;
  }
  return true;
}

bool ArmReader::index(Value key, std::size_t size, std::size_t& out) {
  const auto read = key.is_scalar() ? to_integer(key.text()).value_or(-1) : -1;
  if (!expect(read >= 0 && static_cast<std::size_t>(read) < size, key, "no entry has this index")) return false;
  out = static_cast<std::size_t>(read);
  return true;
}

bool ArmReader::changed_joints(const std::string& name, Value map, Arm& arm) {
  if (!expect(map.is_map(), map, name + " is a map of indices here")) return false;
  for (std::size_t i = 0; i < map.size(); ++i) {
    const auto [key, value] = map.entry(i);
    std::size_t at = 0;
    if (!index(key, arm.size(), at)) return false;
    if (name == "max_effort") {
      if (!number(value, arm.max_effort[at])) return false;
      continue;
    }
    std::vector<double> both;
    if (!numbers(value, both, 2, kDegree)) return false;
    arm.lower[at] = both[0];
    arm.upper[at] = both[1];
  }
  return true;
}

bool ArmReader::row(Value map, Row& row) {
  if (!expect(map.is_map(), map, "a row is a map")) return false;
  double joint = row.joint;
  struct Key {
    const char* name;
    double* member;
    double unit;
  };
  for (const Key& key : {Key{"joint", &joint, 1.0}, Key{"alpha_deg", &row.alpha, kDegree}, Key{"a", &row.a, 1.0},
                         Key{"d", &row.d, 1.0}, Key{"theta_deg", &row.theta, kDegree}, Key{"ratio", &row.ratio, 1.0}}) {
    const auto value = map.find(key.name);
    if (value && !number(*value, *key.member, key.unit)) return false;
  }
  row.joint = std::abs(joint) < 1e6 ? static_cast<int>(joint) : -1;
  return true;
}

bool ArmReader::rows(Value value, Arm& arm) {
  if (value.is_list()) {
    arm.rows.assign(value.size(), {});
    for (std::size_t i = 0; i < value.size(); ++i) {
      if (!row(value.item(i), arm.rows[i])) return false;
    }
    return true;
  }
  if (!expect(value.is_map(), value, "rows is a list, or a map of indices")) return false;
  for (std::size_t i = 0; i < value.size(); ++i) {
    const auto [key, changes] = value.entry(i);
    std::size_t at = 0;
    if (!index(key, arm.rows.size() + 1, at)) return false;
    if (at == arm.rows.size()) arm.rows.emplace_back();
    if (!row(changes, arm.rows[at])) return false;
  }
  return true;
}

bool ArmReader::pose(Value map, math::Pose& out) {
  out = {};
  std::vector<double> xyz, rpy;
  if (const auto given = map.find("xyz")) {
    if (!numbers(*given, xyz, 3)) return false;
    out.position = {xyz[0], xyz[1], xyz[2]};
  }
  if (const auto given = map.find("matrix")) {
    double matrix[9];
    if (!expect(given->is_list() && given->size() == 3, *given, "matrix has three rows")) return false;
    for (std::size_t i = 0; i < 3; ++i) {
      std::vector<double> line;
      if (!numbers(given->item(i), line, 3)) return false;
      std::copy(line.begin(), line.end(), matrix + 3 * i);
    }
    out.orientation = math::normalized(math::from_matrix(matrix));
  }
  if (const auto given = map.find("rpy_deg")) {
    if (!numbers(*given, rpy, 3, kDegree)) return false;
    out.orientation = out.orientation * math::from_rpy(rpy[0], rpy[1], rpy[2]);
  }
  return true;
}

bool ArmReader::jaw(Value map, Arm& arm) {
  kinematics::Jaw jaw;
  const auto name = map.find("name"), effort = map.find("max_effort");
  if (!expect(name && name->is_scalar(), map, "a jaw needs a name")) return false;
  jaw.name = name->text();
  if (effort && !number(*effort, jaw.max_effort)) return false;
  if (!limits(map, jaw.lower, jaw.upper)) return false;
  arm.jaw = std::move(jaw);
  return true;
}

bool ArmReader::coupling(Value value, Arm& arm) {
  arm.coupling.clear();
  if (value.is_absent()) return true;
  if (!expect(value.is_list(), value, "coupling is a matrix, or null")) return false;
  for (std::size_t i = 0; i < value.size(); ++i) {
    arm.coupling.emplace_back();
    if (!numbers(value.item(i), arm.coupling.back(), value.size())) return false;
  }
  return true;
}

bool ArmReader::adf(Value map, Arm& arm) {
  arm.adf_joints.clear();
  arm.adf_jaw.clear();
  for (const char* part : {"joints", "jaw"}) {
    const auto list = map.find(part);
    if (!list) continue;
    if (!expect(list->is_list(), *list, std::string(part) + " is a list")) return false;
    for (std::size_t i = 0; i < list->size(); ++i) {
      const Value entry = list->item(i);
      const auto joint = entry.find("joint");
      if (!expect(joint && joint->is_scalar(), entry, "expected the name of a joint")) return false;
      double sign = 1.0, offset = 0.0;
      const auto given = entry.find(std::string_view(part) == "jaw" ? "wrist" : "sign");
      if (given && !number(*given, sign)) return false;
      const auto shifted = entry.find("offset");
      if (shifted && !number(*shifted, offset)) return false;
      if (std::string_view(part) == "jaw") {
        arm.adf_jaw.push_back({joint->text(), sign});
      } else {
        arm.adf_joints.push_back({joint->text(), sign, offset});
      }
    }
  }
  return true;
}

}  // namespace ambf::adf
