// How numbers of SheetLanes and of corners become vectors and come back, T lanes at a time (lanes.h): Pair or Quad.
// Only for sheet_lanes.cpp. Physics thread.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "physics/detail/lanes3.h"
#include "physics/soft/detail/sheet_lanes.h"

#if defined(__x86_64__) && !defined(AMBF_PLAIN_LANES)
#include <immintrin.h>
#define AMBF_VECTOR_ROOTS
#endif

namespace ambf::physics::detail {

AMBF_INLINED void root(const Pair& of, Pair& out) {
#if defined(AMBF_VECTOR_ROOTS)
  out = _mm_sqrt_pd(of);
#else
  for (std::size_t i = 0; i < 2; ++i) out[i] = std::sqrt(of[i]);
#endif
}
#if defined(AMBF_VECTOR_ROOTS)
AMBF_WIDE inline void root(const Quad& of, Quad& out) { out = _mm256_sqrt_pd(of); }
#else
inline void root(const Quad& of, Quad& out) {
  for (std::size_t i = 0; i < 4; ++i) out[i] = std::sqrt(of[i]);
}
#endif

template <class T>
AMBF_INLINED const T& as(const double* from) {
  return *reinterpret_cast<const T*>(from);
}
template <class T>
AMBF_INLINED T& as(double* to) {
  return *reinterpret_cast<T*>(to);
}
template <class T>
AMBF_INLINED Lanes3<T> load(const SheetLanes::Four3& from, std::size_t first) {
  return {as<T>(&from[0][first]), as<T>(&from[1][first]), as<T>(&from[2][first])};
}
template <class T>
AMBF_INLINED void store(const Lanes3<T>& v, SheetLanes::Four3& to, std::size_t first) {
  as<T>(&to[0][first]) = v.x, as<T>(&to[1][first]) = v.y, as<T>(&to[2][first]) = v.z;
}

// Of math::Vec3, which begins at any multiple of 8 bytes: a reference to such a vector is read as if it were aligned.
AMBF_INLINED Pair xy(const math::Vec3& v) {
  Pair both;
  __builtin_memcpy(&both, &v, sizeof both);
  return both;
}
AMBF_INLINED void add_xy(const Pair& more, math::Vec3& to) {
  const Pair sum = xy(to) + more;
  __builtin_memcpy(static_cast<void*>(&to), &sum, sizeof sum);
}

template <class T>
AMBF_INLINED Lanes3<T> gathered(const math::Vec3* from, const std::uint32_t* at) {
  const math::Vec3 &a = from[at[0]], &b = from[at[1]];
  const Pair of_a = xy(a), of_b = xy(b);
  if constexpr (kLanes<T> == 2) {
    return {__builtin_shufflevector(of_a, of_b, 0, 2), __builtin_shufflevector(of_a, of_b, 1, 3), T{a.z, b.z}};
  } else {
    const math::Vec3 &c = from[at[2]], &d = from[at[3]];
    const Pair of_c = xy(c), of_d = xy(d);
    const T even = __builtin_shufflevector(of_a, of_c, 0, 1, 2, 3),
            odd = __builtin_shufflevector(of_b, of_d, 0, 1, 2, 3);
    return {__builtin_shufflevector(even, odd, 0, 4, 2, 6), __builtin_shufflevector(even, odd, 1, 5, 3, 7),
            T{a.z, b.z, c.z, d.z}};
  }
}
// A number of each lane; by itself it cannot be returned where there are no vectors as long.
template <class T>
struct Lanes1 {
  T v;
};
template <class T, class Number>
AMBF_INLINED Lanes1<T> gathered(const double* from, const Number& number) {
  if constexpr (kLanes<T> == 2) {
    return {T{from[number(0)], from[number(1)]}};
  } else {
    return {T{from[number(0)], from[number(1)], from[number(2)], from[number(3)]}};
  }
}

template <class T>
AMBF_INLINED Lanes1<T> at_slots(const std::vector<SheetLanes::Edges>& edges, const std::uint32_t* slot) {
  return gathered<T>(&edges[0].at[0][0], [slot](std::size_t i) AMBF_INLINED_LAMBDA { return slot[i]; });
}

// to[at[i]] += the vector in lane i, one after the other: several may be at one corner.
template <class T>
AMBF_INLINED void scatter(const Lanes3<T>& v, math::Vec3* to, const std::uint32_t* at, std::size_t count) {
  const auto add = [&](const Pair& more, std::size_t i) AMBF_INLINED_LAMBDA {
    if (i < count) add_xy(more, to[at[i]]), to[at[i]].z += v.z[i];
  };
  if constexpr (kLanes<T> == 2) {
    add(__builtin_shufflevector(v.x, v.y, 0, 2), 0);
    add(__builtin_shufflevector(v.x, v.y, 1, 3), 1);
  } else {
    const T even = __builtin_shufflevector(v.x, v.y, 0, 4, 2, 6), odd = __builtin_shufflevector(v.x, v.y, 1, 5, 3, 7);
    add(__builtin_shufflevector(even, even, 0, 1), 0);
    add(__builtin_shufflevector(odd, odd, 0, 1), 1);
    add(__builtin_shufflevector(even, even, 2, 3), 2);
    add(__builtin_shufflevector(odd, odd, 2, 3), 3);
  }
}

// Rad, of a direction (c, s): twice the angle of its half, which is at most a right angle, and of that by a fraction
// that is exact to rounding up to 0.66 (Cephes).
template <class T>
AMBF_INLINED void angle_of(const T& c, const T& s, T& out) {
  const T zero{}, one = zero + 1.0, square = c * c + s * s;
  T size;
  root(square, size);
  const T side = s < 0.0 ? -one : one, height = s < 0.0 ? -s : s, length = (c < 0.0 ? -c : c) + size;
  const T whole = height / (length > 0.0 ? length : one);
  const auto large = whole > 0.66;
  const T t = large ? (whole - 1.0) / (whole + 1.0) : whole, z = t * t;
  const T above = (((-8.750608600031904122785e-1 * z - 1.615753718733365076637e1) * z - 7.500855792314704667340e1) * z -
                   1.228866684490136173410e2) *
                      z -
                  6.485021904942025371773e1;
  const T below =
      ((((z + 2.485846490142306297962e1) * z + 1.650270098316988542046e2) * z + 4.328810604912902668951e2) * z +
       4.853903996359136964868e2) *
          z +
      1.945506571482613964425e2;
  const T half = (large ? zero + 0.25 * M_PI : zero) + (t + t * (z * above / below));
  out = side * (c < 0.0 ? M_PI - 2.0 * half : 2.0 * half);
}

// Where `which` is so in a lane: `yes`, else `no`.
template <class Mask, class T>
AMBF_INLINED Lanes3<T> chosen(const Mask& which, const Lanes3<T>& yes, const Lanes3<T>& no) {
  return {which ? yes.x : no.x, which ? yes.y : no.y, which ? yes.z : no.z};
}

}  // namespace ambf::physics::detail
