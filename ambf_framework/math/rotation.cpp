#include "math/rotation.h"

#include <algorithm>

namespace ambf::math {

Vec3 normalized(const Vec3& v, const Vec3& fallback) {
  const double n = norm(v);
  return n < 1e-12 ? fallback : v / n;
}

Quat normalized(const Quat& q) {
  const double n = norm(q);
  if (n < 1e-12) return {};
  return {q.x / n, q.y / n, q.z / n, q.w / n};
}

Quat from_axis_angle(const Vec3& axis, double angle_rad) {
  const double s = std::sin(0.5 * angle_rad);
  return {axis.x * s, axis.y * s, axis.z * s, std::cos(0.5 * angle_rad)};
}

Quat from_rpy(double roll, double pitch, double yaw) {
  return from_axis_angle({0, 0, 1}, yaw) * from_axis_angle({0, 1, 0}, pitch) * from_axis_angle({1, 0, 0}, roll);
}

Vec3 to_rpy(const Quat& q) {
  const double sin_pitch = std::clamp(2.0 * (q.w * q.y - q.z * q.x), -1.0, 1.0);
  if (std::abs(sin_pitch) > 1.0 - 1e-12) {
    // Gimbal lock: roll and yaw turn about the same axis, all of it is put into yaw.
    const double yaw = std::atan2(-2.0 * (q.x * q.y - q.w * q.z), 1.0 - 2.0 * (q.x * q.x + q.z * q.z));
    return {0.0, std::asin(sin_pitch), yaw};
  }
  return {std::atan2(2.0 * (q.w * q.x + q.y * q.z), 1.0 - 2.0 * (q.x * q.x + q.y * q.y)), std::asin(sin_pitch),
          std::atan2(2.0 * (q.w * q.z + q.x * q.y), 1.0 - 2.0 * (q.y * q.y + q.z * q.z))};
}

Vec3 log(const Quat& q_in) {
  const Quat q = q_in.w < 0.0 ? Quat{-q_in.x, -q_in.y, -q_in.z, -q_in.w} : q_in;
  const Vec3 v{q.x, q.y, q.z};
  const double s = norm(v);
  // Below 1e-9 the series 2/w is exact to rounding and avoids 0/0.
  const double factor = s < 1e-9 ? 2.0 / q.w : 2.0 * std::atan2(s, q.w) / s;
  return v * factor;
}

Quat exp(const Vec3& w) {
  const double angle = norm(w);
  if (angle < 1e-12) return normalized(Quat{0.5 * w.x, 0.5 * w.y, 0.5 * w.z, 1.0});
  return from_axis_angle(w / angle, angle);
}

// Sine of the angle to the opposite direction. The exporter whose files have such axes takes what is beyond 3.14 rad
// for opposite, and its offsets belong to that choice (docs/decisions/0040-third-generation.md).
constexpr double kOpposite = 1.5926e-3;

Quat rotation_between(const Vec3& a, const Vec3& b) {
  const Vec3 v = cross(a, b);
  const double s = norm(v);
  const double c = dot(a, b);
  if (c > 0.0) return normalized(Quat{v.x, v.y, v.z, 1.0 + c});
  if (s > kOpposite) return from_axis_angle(v / s, std::atan2(s, c));
  // Rounded axes of files are never quite opposite: v would be noise. Half a turn about the axis that is chosen for
  // opposite vectors, then the little that is left.
  Vec3 k = cross(a, {1, 0, 0});
  if (norm(k) < 1e-3) k = cross(b, {0, 1, 0});
  const Quat half = from_axis_angle(normalized(k), M_PI);
  const Vec3 turned = rotate(half, a), rest = cross(turned, b);
  return normalized(Quat{rest.x, rest.y, rest.z, 1.0 + dot(turned, b)}) * half;
}

void to_matrix(const Quat& q, double m[9]) {
  const Vec3 x = rotate(q, {1, 0, 0});
  const Vec3 y = rotate(q, {0, 1, 0});
  const Vec3 z = rotate(q, {0, 0, 1});
  m[0] = x.x, m[1] = y.x, m[2] = z.x;
  m[3] = x.y, m[4] = y.y, m[5] = z.y;
  m[6] = x.z, m[7] = y.z, m[8] = z.z;
}

Quat from_matrix(const double m[9]) {
  // Shepperd's method: divide by the largest of the four components.
  const double trace = m[0] + m[4] + m[8];
  Quat q;
  if (trace > 0.0) {
    q = {m[7] - m[5], m[2] - m[6], m[3] - m[1], 1.0 + trace};
  } else if (m[0] >= m[4] && m[0] >= m[8]) {
    q = {1.0 + m[0] - m[4] - m[8], m[1] + m[3], m[2] + m[6], m[7] - m[5]};
  } else if (m[4] >= m[8]) {
    q = {m[1] + m[3], 1.0 - m[0] + m[4] - m[8], m[5] + m[7], m[2] - m[6]};
  } else {
    q = {m[2] + m[6], m[5] + m[7], 1.0 - m[0] - m[4] + m[8], m[3] - m[1]};
  }
  return normalized(q);
}

}  // namespace ambf::math
