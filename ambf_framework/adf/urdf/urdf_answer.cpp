#include "adf/detail/urdf_answer.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include "math/rotation.h"

namespace ambf::adf::urdf {

namespace {

constexpr std::size_t kMaxName = 1000, kMaxMessage = 1000, kMaxParts = 10000;

bool clean(const std::string& name) {
  return name.size() <= kMaxName &&
         std::none_of(name.begin(), name.end(), [](char c) { return static_cast<unsigned char>(c) < 0x20; });
}

// Of a name, what a line of the log takes.
std::string shown(const std::string& name) {
  std::string text = name.substr(0, 100);
  std::replace_if(
      text.begin(), text.end(), [](unsigned char c) { return c < ' '; }, '?');
  return text;
}

bool finite(const math::Vec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

bool finite(math::Pose& pose) {
  const math::Quat& q = pose.orientation;
  const double length = q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w;
  if (!finite(pose.position) || !(std::abs(length - 1.0) < 1e-6)) return false;
  pose.orientation = math::normalized(q);
  return true;
}

bool good(std::vector<Shape>& shapes) {
  return std::all_of(shapes.begin(), shapes.end(), [](Shape& s) {
    return s.kind <= ShapeKind::mesh && finite(s.size) && finite(s.origin) && clean(s.file) && clean(s.texture) &&
           std::all_of(s.rgba.begin(), s.rgba.end(), [](float v) { return std::isfinite(v); });
  });
}

bool good(Link& l) {
  return !l.name.empty() && clean(l.name) && std::isfinite(l.mass) && finite(l.inertial) &&
         std::all_of(l.inertia.begin(), l.inertia.end(), [](double v) { return std::isfinite(v); }) &&
         good(l.visuals) && good(l.collisions);
}

bool good(Joint& j) {
  const auto numbers = {j.lower, j.upper, j.effort, j.damping, j.mimic_multiplier, j.mimic_offset};
  return !j.name.empty() && clean(j.name) && clean(j.mimic_joint) && j.kind > JointKind::unknown &&
         j.kind <= JointKind::fixed && finite(j.origin) && finite(j.axis) &&
         std::all_of(numbers.begin(), numbers.end(), [](double v) { return std::isfinite(v); });
}

}  // namespace

std::string check(Robot& robot) {
  robot.error.resize(std::min(robot.error.size(), kMaxMessage));
  std::replace_if(
      robot.error.begin(), robot.error.end(), [](unsigned char c) { return c < ' '; }, ' ');
  if (!robot.error.empty()) return {};
  if (!clean(robot.name)) return "the robot's name";
  if (robot.links.size() > kMaxParts || robot.joints.size() > kMaxParts) return "more than 10000 links or joints";
  std::map<std::string, std::string> parent_of;
  const auto at = [&robot](std::int32_t line, const std::string& why) {
    robot.error_line = line;
    return why;
  };
  for (Link& link : robot.links) {
    if (!good(link))
      return at(link.line, "link '" + shown(link.name) + "' has a number that is not finite, or a wrong name");
    if (!parent_of.emplace(link.name, "").second) return at(link.line, "two links have one name");
  }
  for (Joint& joint : robot.joints) {
    if (!good(joint))
      return at(joint.line,
                "joint '" + shown(joint.name) + "' has a number that is not finite, or a wrong type or name");
    const auto child = parent_of.find(joint.child);
    if (child == parent_of.end() || parent_of.count(joint.parent) == 0)
      return at(joint.line, "joint '" + shown(joint.name) + "' names a link that is not there");
    if (!child->second.empty())
      return at(joint.line, "link '" + shown(joint.child) + "' is the child of two joints; a tree has one for each");
    child->second = joint.parent;
  }
  if (robot.joints.size() + 1 != robot.links.size()) return "links and joints make no tree";
  // Each link but one has a parent, so a loop would leave links that the root does not reach.
  std::multimap<std::string, std::string> children;
  for (const auto& [child, parent] : parent_of) children.emplace(parent, child);
  std::vector<std::string> reached{robot.root};
  for (std::size_t i = 0; i < reached.size() && reached.size() <= robot.links.size(); ++i) {
    const auto [first, last] = children.equal_range(reached[i]);
    for (auto each = first; each != last; ++each) reached.push_back(each->second);
  }
  const bool whole = reached.size() == robot.links.size() && parent_of.count(robot.root) != 0;
  if (!whole) return "links and joints make no tree";
  for (const Unused& unused : robot.unused) {
    if (!clean(unused.what)) return "a name";
  }
  return {};
}

}  // namespace ambf::adf::urdf
