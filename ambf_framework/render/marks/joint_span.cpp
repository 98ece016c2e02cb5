#include "render/marks/joint_span.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "math/rotation.h"

namespace ambf::render {

namespace {

constexpr double kPi = std::numbers::pi;
constexpr DebugColor kAtLimit = {0.95F, 0.22F, 0.18F, 1.0F};
constexpr std::array<DebugColor, 3> kAxisColors = {
    {{0.92F, 0.30F, 0.28F, 1.0F}, {0.35F, 0.75F, 0.35F, 1.0F}, {0.35F, 0.55F, 0.95F, 1.0F}}};

DebugColor faint(DebugColor color, float alpha) {
  color[3] = alpha;
  return color;
}

double at(const math::Vec3& v, int i) { return i == 0 ? v.x : (i == 1 ? v.y : v.z); }

math::Vec3 unit(int i) { return {i == 0 ? 1.0 : 0.0, i == 1 ? 1.0 : 0.0, i == 2 ? 1.0 : 0.0}; }

// The child's joint frame in the parent's.
math::Pose relative_of(const state::JointSpan& span, const math::Pose& T_world_parent,
                       const math::Pose& T_world_child) {
  return math::inverse(T_world_parent * span.T_parent_joint) * (T_world_child * span.T_child_joint);
}

// A turn is a twist about z first and then a swing about an axis across z.
struct SwingTwist {
  double twist = 0.0, swing = 0.0;  // rad
  math::Vec3 about{1, 0, 0};        // of the swing, in the parent's joint frame; unit
};
SwingTwist parts_of(const math::Quat& rotation) {
  SwingTwist parts;
  parts.twist = std::remainder(2.0 * std::atan2(rotation.z, rotation.w), 2.0 * kPi);
  const math::Vec3 swing = math::log(rotation * math::from_axis_angle({0, 0, 1}, -parts.twist));
  parts.swing = math::norm(swing);
  if (parts.swing > 1e-9) parts.about = swing / parts.swing;
  return parts;
}

// How far the cone lets it swing about this axis.
double widest_swing(const math::Vec3& cone, const math::Vec3& about) {
  const double x = about.x / std::max(cone.x, 1e-6), y = about.y / std::max(cone.y, 1e-6);
  return std::min(kPi, 1.0 / std::max(1e-9, std::sqrt(x * x + y * y)));
}

// Of R = Rx Ry Rz.
std::array<double, 3> angles_of(const math::Quat& r) {
  const math::Vec3 x = math::rotate(r, {1, 0, 0}), y = math::rotate(r, {0, 1, 0}), z = math::rotate(r, {0, 0, 1});
  return {std::atan2(-z.y, z.z), std::asin(std::clamp(z.x, -1.0, 1.0)), std::atan2(-y.x, x.x)};
}

DebugColor color_at(const SpanCoordinate& coordinate, const DebugColor& color) {
  return coordinate.at_limit() ? kAtLimit : color;
}

// A turn about `axis`: the arc it may go through and a needle where it is. `zero` is where it points at 0; all in the
// world.
void draw_turn(const SpanCoordinate& turn, const math::Vec3& pivot, const math::Vec3& axis, const math::Vec3& zero,
               double radius, const SpanMarks& marks, const DebugColor& color, WorldShapes& out) {
  if (turn.locked()) return;
  const auto to = [&](double angle) { return math::rotate(math::from_axis_angle(axis, angle), radius * zero); };
  const double range = turn.high - turn.low;
  if (turn.free() || range >= 2.0 * kPi) {
    out.arc(pivot, axis, radius * zero, 2.0 * kPi, faint(color, 0.6F), 1.0 * marks.ui, Seen::through);
  } else {
    out.sector(pivot, axis, to(turn.low), range, faint(color, 0.18F), Seen::through);
    out.arc(pivot, axis, to(turn.low), range, color, 1.5 * marks.ui, Seen::through);
  }
  out.line(pivot, pivot + 1.1 * to(turn.value), color_at(turn, color), 3.0 * marks.ui, Seen::through);
}

void draw_cone(const state::JointSpan& span, const math::Pose& T_world_joint, const math::Quat& relative,
               const std::vector<SpanCoordinate>& coordinates, const SpanMarks& marks, WorldShapes& out) {
  constexpr int kParts = 36, kSpokes = 4;
  const auto edge = [&](int i) {
    const double way = 2.0 * kPi * i / kParts;
    const math::Vec3 about{std::cos(way), std::sin(way), 0.0};
    return T_world_joint *
           math::rotate(math::from_axis_angle(about, widest_swing(span.cone, about)), {0, 0, marks.radius});
  };
  const math::Vec3& pivot = T_world_joint.position;
  for (int i = 0; i < kParts; ++i) {
    out.line(edge(i), edge(i + 1), marks.color, 1.5 * marks.ui, Seen::through);
    out.triangle(pivot, edge(i), edge(i + 1), faint(marks.color, 0.10F), Seen::through);
    if (i % (kParts / kSpokes) == 0) out.line(pivot, edge(i), faint(marks.color, 0.7F), 1.0 * marks.ui, Seen::through);
  }
  const SwingTwist parts = parts_of(relative);
  const math::Quat swung = T_world_joint.orientation * math::from_axis_angle(parts.about, parts.swing);
  const math::Vec3 axis = math::rotate(swung, {0, 0, 1});
  out.arrow(pivot, pivot + 1.25 * marks.radius * axis, color_at(coordinates[0], marks.color), 10.0 * marks.pixel,
            3.0 * marks.ui, Seen::through);
  draw_turn(coordinates[1], pivot + 0.6 * marks.radius * axis, axis, math::rotate(swung, {1, 0, 0}), 0.4 * marks.radius,
            marks, marks.color, out);
}

void draw_six(const state::JointSpan& span, const math::Pose& T_world_joint, const math::Pose& relative,
              const std::vector<SpanCoordinate>& coordinates, const SpanMarks& marks, WorldShapes& out) {
  math::Vec3 middle, size;
  const auto fill = [&](int i, double& at_middle, double& at_size) {
    const bool free = coordinates[static_cast<std::size_t>(i)].free();
    const double low = free ? -marks.radius : at(span.linear_low, i),
                 high = free ? marks.radius : at(span.linear_high, i);
    at_middle = 0.5 * (low + high);
    at_size = high - low;
  };
  fill(0, middle.x, size.x), fill(1, middle.y, size.y), fill(2, middle.z, size.z);
  out.box({T_world_joint * middle, T_world_joint.orientation}, size, marks.color, 1.5 * marks.ui, Seen::through);
  const math::Vec3 pivot = T_world_joint * relative.position;
  const bool shifted =
      std::any_of(coordinates.begin(), coordinates.begin() + 3, [](const auto& c) { return c.at_limit(); });
  out.line(T_world_joint.position, pivot, faint(marks.color, 0.6F), 1.0 * marks.ui, Seen::through);
  out.point(pivot, shifted ? kAtLimit : marks.color, 9.0 * marks.ui, Seen::through);
  math::Quat frame = T_world_joint.orientation;
  for (int i = 0; i < 3; ++i) {
    const auto at = static_cast<std::size_t>(i);
    const SpanCoordinate& turn = coordinates[at + 3];
    draw_turn(turn, pivot, math::rotate(frame, unit(i)), math::rotate(frame, unit((i + 1) % 3)),
              (1.0 - 0.18 * i) * marks.radius, marks, kAxisColors[at], out);
    frame = frame * math::from_axis_angle(unit(i), turn.value);
  }
}

}  // namespace

bool SpanCoordinate::at_limit() const {
  constexpr double kNear = 0.01;  // of the range
  if (free() || locked()) return false;
  const double margin = kNear * (high - low);
  // A swing has no lower limit: it is zero in the middle.
  return value > high - margin || (low < 0.0 && value < low + margin);
}

std::vector<SpanCoordinate> span_coordinates(const state::JointInfo& joint, const math::Pose& T_world_parent,
                                             const math::Pose& T_world_child) {
  if (joint.span == nullptr) return {};
  const state::JointSpan& span = *joint.span;
  const math::Pose relative = relative_of(span, T_world_parent, T_world_child);
  if (joint.type == state::JointType::cone_twist) {
    const SwingTwist parts = parts_of(relative.orientation);
    return {{"Swing", true, parts.swing, 0.0, widest_swing(span.cone, parts.about)},
            {"Twist", true, parts.twist, -span.cone.z, span.cone.z}};
  }
  constexpr const char* kNames[] = {"Shift x", "Shift y", "Shift z", "Turn x", "Turn y", "Turn z"};
  const std::array<double, 3> angles = angles_of(relative.orientation);
  std::vector<SpanCoordinate> coordinates;
  for (int i = 0; i < 3; ++i) {
    coordinates.push_back(
        {kNames[i], false, at(relative.position, i), at(span.linear_low, i), at(span.linear_high, i)});
  }
  for (int i = 0; i < 3; ++i) {
    coordinates.push_back(
        {kNames[i + 3], true, angles[static_cast<std::size_t>(i)], at(span.angular_low, i), at(span.angular_high, i)});
  }
  return coordinates;
}

void draw_span(const state::JointInfo& joint, const math::Pose& T_world_parent, const math::Pose& T_world_child,
               const SpanMarks& marks, WorldShapes& out) {
  const std::vector<SpanCoordinate> coordinates = span_coordinates(joint, T_world_parent, T_world_child);
  if (coordinates.empty()) return;
  const math::Pose T_world_joint = T_world_parent * joint.span->T_parent_joint;
  const math::Pose relative = relative_of(*joint.span, T_world_parent, T_world_child);
  if (joint.type == state::JointType::cone_twist) {
    draw_cone(*joint.span, T_world_joint, relative.orientation, coordinates, marks, out);
  } else {
    draw_six(*joint.span, T_world_joint, relative, coordinates, marks, out);
  }
}

}  // namespace ambf::render
