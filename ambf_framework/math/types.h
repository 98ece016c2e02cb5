// Plain geometric values that all layers and threads share: vectors, unit quaternions, rigid transforms, twists,
// wrenches. They are aggregates of doubles so that frames and commands can be copied, hashed and compared bit for bit;
// parsed as C++17. Names: `T_A_B` is the pose of frame B expressed in frame A; `v_A` is a vector expressed in A. SI
// units, radians.
#pragma once

#include <cmath>

namespace ambf::math {

struct Vec3 {
  double x = 0.0, y = 0.0, z = 0.0;
};

// Unit quaternion, Hamilton convention, scalar last as in geometry_msgs/Quaternion.
struct Quat {
  double x = 0.0, y = 0.0, z = 0.0, w = 1.0;
};

// Rigid transform T_A_B: position of B's origin in A and the rotation R_A_B.
struct Pose {
  Vec3 position;
  Quat orientation;
};

// Linear (m/s) and angular (rad/s) velocity; frame and point are said where it is used.
struct Twist {
  Vec3 linear, angular;
};

// Force (N) and torque (Nm); frame and point are said where it is used.
struct Wrench {
  Vec3 force, torque;
};

inline bool operator==(const Vec3& a, const Vec3& b) { return a.x == b.x && a.y == b.y && a.z == b.z; }
inline bool operator!=(const Vec3& a, const Vec3& b) { return !(a == b); }
inline bool operator==(const Quat& a, const Quat& b) { return a.x == b.x && a.y == b.y && a.z == b.z && a.w == b.w; }
inline bool operator!=(const Quat& a, const Quat& b) { return !(a == b); }
inline bool operator==(const Pose& a, const Pose& b) {
  return a.position == b.position && a.orientation == b.orientation;
}
inline bool operator!=(const Pose& a, const Pose& b) { return !(a == b); }

inline Vec3 operator+(const Vec3& a, const Vec3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Vec3 operator-(const Vec3& a, const Vec3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Vec3 operator-(const Vec3& a) { return {-a.x, -a.y, -a.z}; }
inline Vec3 operator*(const Vec3& a, double s) { return {a.x * s, a.y * s, a.z * s}; }
inline Vec3 operator*(double s, const Vec3& a) { return a * s; }
inline Vec3 operator/(const Vec3& a, double s) { return {a.x / s, a.y / s, a.z / s}; }
inline Vec3& operator+=(Vec3& a, const Vec3& b) { return a = a + b; }
inline Vec3& operator-=(Vec3& a, const Vec3& b) { return a = a - b; }

inline double dot(const Vec3& a, const Vec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Vec3 cross(const Vec3& a, const Vec3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double norm(const Vec3& a) { return std::sqrt(dot(a, a)); }
inline double norm(const Quat& q) { return std::sqrt(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w); }
// Components multiplied one by one.
inline Vec3 scaled(const Vec3& a, const Vec3& b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }

inline bool is_finite(const Vec3& a) { return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z); }
inline bool is_finite(const Quat& q) {
  return std::isfinite(q.x) && std::isfinite(q.y) && std::isfinite(q.z) && std::isfinite(q.w);
}
inline bool is_finite(const Pose& p) { return is_finite(p.position) && is_finite(p.orientation); }
inline bool is_finite(const Twist& t) { return is_finite(t.linear) && is_finite(t.angular); }
inline bool is_finite(const Wrench& w) { return is_finite(w.force) && is_finite(w.torque); }

// Rotation composition: R_A_C = R_A_B * R_B_C.
inline Quat operator*(const Quat& a, const Quat& b) {
  return {a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y, a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x,
          a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w, a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z};
}
inline Quat inverse(const Quat& q) { return {-q.x, -q.y, -q.z, q.w}; }
// v_A = R_A_B v_B.
inline Vec3 rotate(const Quat& q, const Vec3& v) {
  const Vec3 u{q.x, q.y, q.z};
  const Vec3 t = 2.0 * cross(u, v);
  return v + q.w * t + cross(u, t);
}
// T_A_C = T_A_B * T_B_C.
inline Pose operator*(const Pose& a, const Pose& b) {
  return {a.position + rotate(a.orientation, b.position), a.orientation * b.orientation};
}
// p_A = T_A_B p_B.
inline Vec3 operator*(const Pose& a, const Vec3& p) { return a.position + rotate(a.orientation, p); }
inline Pose inverse(const Pose& a) {
  const Quat inv = inverse(a.orientation);
  return {rotate(inv, -a.position), inv};
}

}  // namespace ambf::math
