// Vectors in space of several things at a time, one thing a lane (lanes.h). Private to physics/. Any thread.
#pragma once

#include <cstddef>

#include "physics/detail/lanes.h"

namespace ambf::physics::detail {

// A vector of each of several things, one thing a lane of T: double, Pair or Quad.
template <class T>
struct Lanes3 {
  T x, y, z;
};
template <class T>
AMBF_INLINED Lanes3<T> operator+(const Lanes3<T>& a, const Lanes3<T>& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class T>
AMBF_INLINED Lanes3<T> operator-(const Lanes3<T>& a, const Lanes3<T>& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class T>
AMBF_INLINED Lanes3<T> operator*(const Lanes3<T>& a, const Lanes3<T>& b) {
  return {a.x * b.x, a.y * b.y, a.z * b.z};
}
template <class T>
AMBF_INLINED Lanes3<T> operator/(const Lanes3<T>& a, const Lanes3<T>& b) {
  return {a.x / b.x, a.y / b.y, a.z / b.z};
}
template <class T>
AMBF_INLINED Lanes3<T> scaled(const Lanes3<T>& a, const T& scale) {
  return {a.x * scale, a.y * scale, a.z * scale};
}
template <class T>
AMBF_INLINED Lanes3<T> scaled_by(const Lanes3<T>& a, double scale) {
  return {a.x * scale, a.y * scale, a.z * scale};
}
template <class T>
AMBF_INLINED void dot(const Lanes3<T>& a, const Lanes3<T>& b, T& out) {
  out = a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class T>
AMBF_INLINED Lanes3<T> cross(const Lanes3<T>& a, const Lanes3<T>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

template <class T>
constexpr std::size_t kLanes = sizeof(T) / sizeof(double);
AMBF_INLINED double lane(double value, std::size_t) { return value; }
AMBF_INLINED double lane(const Pair& value, std::size_t i) { return value[i]; }
AMBF_INLINED double lane(const Quad& value, std::size_t i) { return value[i]; }
AMBF_INLINED void set_lane(double& value, std::size_t, double number) { value = number; }
AMBF_INLINED void set_lane(Pair& value, std::size_t i, double number) { value[i] = number; }
AMBF_INLINED void set_lane(Quad& value, std::size_t i, double number) { value[i] = number; }

}  // namespace ambf::physics::detail
