// A triangle that leaves its plane turns the edges that it shares: the angle at an edge grows by
//   da = n . (c_k u_k + c_p u_p + c_q u_q),
//   c_k = l / 2A,  c_p = (x_k - x_q) . e / (2A l),  c_q = (x_p - x_k) . e / (2A l)
// with e from x_p to x_q, of length l, opposite to corner k, and of the triangle beyond in the same way. The c add up
// to 0: what corners 1 and 2 leave the plane by, beyond what corner 0 does, is all there is to know.
#include "physics/soft/detail/sheet_lanes.h"

#include <algorithm>
#include <cstddef>

#include "physics/soft/detail/sheet_lane_numbers.h"

namespace ambf::physics::detail {

using math::Vec3;

namespace {

constexpr double kFlat = 1e-18;  // m^2: the area below which a triangle has no plane

static_assert(offsetof(SheetLanes::Hot, along) % sizeof(SheetLanes::Four) == 0,
              "vectors are read where they are aligned");

}  // namespace

void SheetLanes::resize(std::size_t triangles) {
  count = triangles;
  const std::size_t fours = (triangles + kCount - 1) / kCount;
  hot.assign(fours, {});
  cold.assign(fours, {});
  rooms.assign(fours, {});
  bends.assign(fours + 1, {});
  moments.assign(fours + 1, {});
  for (Hot& four : hot)
    for (Numbers& beyond : four.beyond) beyond.fill(no_slot());
  for (Cold& four : cold)
    for (Four& side : four.side) side.fill(1.0);
}

Vec3 SheetLanes::normal_of(std::size_t triangle) const {
  const Four3& normal = hot[triangle / kCount].normal;
  const std::size_t lane = triangle % kCount;
  return {normal[0][lane], normal[1][lane], normal[2][lane]};
}

void SheetLanes::add_hinge(const std::array<std::uint32_t, 2>& triangle, const std::array<std::uint32_t, 2>& edge,
                           double side) {
  const std::size_t i = hinge_count++, n = i / kCount, lane = i % kCount;
  if (n == hinges.size()) {
    hinges.push_back({});
    for (Numbers& each : hinges.back().slot) each.fill(no_slot());
  }
  for (std::size_t k = 0; k < 2; ++k) {
    hinges[n].triangle[k][lane] = triangle[k];
    hinges[n].slot[k][lane] = slot(triangle[k], edge[k]);
    const std::size_t here = triangle[0] / kCount, there = triangle[1] / kCount;
    apart = std::max(apart, std::max(here, there) - std::min(here, there));
    hot[triangle[k] / kCount].beyond[edge[k]][triangle[k] % kCount] = slot(triangle[1 - k], edge[1 - k]);
  }
  hinges[n].side[lane] = cold[triangle[1] / kCount].side[edge[1]][triangle[1] % kCount] = side;
  hinges[n].closed[lane] = 1.0;
}

void SheetLanes::set_rest_angles(const Vec3* x) {
  turn_to(x, {});
  const double* const bend_at = &bends[0].at[0][0];
  for (Hinges& four : hinges)
    for (std::size_t lane = 0; lane < kCount; ++lane) four.angle[lane] += bend_at[four.slot[0][lane]];
}

// At an edge of a triangle without an area nothing turns.
void SheetLanes::leave_out_flat() {
  const auto plain = [&](std::uint32_t triangle) { return cold[triangle / kCount].plain[triangle % kCount] > 0.0; };
  for (const Hinges& four : hinges)
    for (std::size_t lane = 0; lane < kCount; ++lane) {
      if (plain(four.triangle[0][lane]) && plain(four.triangle[1][lane])) continue;
      for (std::size_t k = 0; k < 2; ++k) {
        const std::uint32_t slot = four.slot[k][lane];
        if (slot == no_slot()) continue;
        auto& turn = hot[slot / (3 * kCount)].turn[slot / kCount % 3];
        turn[0][slot % kCount] = turn[1][slot % kCount] = 0.0;
      }
    }
}

template <class T>
AMBF_INLINED void SheetLanes::turn_by(const Vec3* x, const Relaxing& relaxing) {
  T plain_ones{};
  for (std::size_t n = 0; n < hot.size(); ++n)
    for (std::size_t first = 0; first < kCount; first += detail::kLanes<T>) {
      Hot& t = hot[n];
      Cold& rest = cold[n];
      const Lanes3<T> x0 = gathered<T>(x, &t.corner[0][first]), x1 = gathered<T>(x, &t.corner[1][first]),
                      x2 = gathered<T>(x, &t.corner[2][first]);
      const Lanes3<T> d1 = x1 - x0, d2 = x2 - x0, d3 = x2 - x1, out = cross(d1, d2);
      T square, size, length1, length2, length3, square1, square2, square3, inner;
      dot(out, out, square), dot(d1, d1, square1), dot(d2, d2, square2), dot(d3, d3, square3), dot(d1, d2, inner);
      root(square, size), root(square1, length1), root(square2, length2), root(square3, length3);
      const T zero{}, one = zero + 1.0;
      const auto plain = square > kFlat * kFlat;  // else as it was: it has no plane of its own
      const T over = one / (plain ? size : one);
      const Lanes3<T> normal = chosen(plain, scaled(out, over), load<T>(t.normal, first));
      const T ax = as<T>(&t.ax[first]), ay = as<T>(&t.ay[first]), by = as<T>(&t.by[first]);
      // In the plane, from axes that follow its first edge, by the angle that makes the deformation symmetric.
      const T over1 = one / (plain ? length1 : one);
      const Lanes3<T> edge = scaled(d1, over1), beside = cross(normal, edge);
      T q, r;
      dot(edge, d2, q), dot(beside, d2, r);
      const T even = length1 * ax + r * by, turn = -(length1 * ay + q * by);
      T sum = even * even + turn * turn, radius;
      root(sum, radius);
      const auto turned = radius > 0.0;
      const T over_radius = one / (turned ? radius : one);
      const T c = turned ? even * over_radius : one, s = turned ? turn * over_radius : zero;
      const Lanes3<T> along = chosen(plain, scaled(edge, c) + scaled(beside, s), load<T>(t.along, first));
      const Lanes3<T> across = chosen(plain, scaled(beside, c) - scaled(edge, s), load<T>(t.across, first));
      store(normal, t.normal, first), store(along, t.along, first), store(across, t.across, first);
      T u1, v1, u2, v2;
      dot(along, d1, u1), dot(across, d1, v1), dot(along, d2, u2), dot(across, d2, v2);
      T xx = u1 * ax - 1.0, yy = v1 * ay + v2 * by - 1.0, xy = 0.5 * (u1 * ay + u2 * by + v1 * ax);
      if (relaxing.memory > 0.0) {
        T &qx = as<T>(&rest.relaxed[0][first]), &qy = as<T>(&rest.relaxed[1][first]),
          &qs = as<T>(&rest.relaxed[2][first]);
        qx += relaxing.pace * (xx - qx), qy += relaxing.pace * (yy - qy), qs += relaxing.pace * (xy - qs);
        xx -= relaxing.memory * qx, yy -= relaxing.memory * qy, xy -= relaxing.memory * qs;
      }
      const T shear = as<T>(&t.shear[first]), both = as<T>(&t.even[first]) * (xx + yy);
      xx = shear * xx + both, yy = shear * yy + both, xy = shear * xy;
      store(scaled(along, xx * ax + xy * ay) + scaled(across, xy * ax + yy * ay), rooms[n].force[0], first);
      store(scaled(along, xy * by) + scaled(across, yy * by), rooms[n].force[1], first);
      // Of the stress, what pulls: without it in the solver, a taut sheet would tremble like an explicit string.
      const T middle = 0.5 * (xx + yy), half = 0.5 * (xx - yy), sheared = half * half + xy * xy;
      T spread;
      root(sheared, spread);
      const T most = middle + spread, least = middle - spread;
      const T high = most > 0.0 ? most : zero, low = least > 0.0 ? least : zero;
      // The tensor with these eigenvalues along the same axes: a sum of it and of the identity.
      const auto differs = spread > 0.0;
      const T slope = differs ? (high - low) / (2.0 * (differs ? spread : one)) : zero, base = 0.5 * (high + low);
      const T pull_x = base + slope * (xx - middle), pull_y = base + slope * (yy - middle), pull_s = slope * xy;
      const T to_across = pull_s * ax + pull_y * ay;
      as<T>(&t.taut[0][first]) = ax * (pull_x * ax + pull_s * ay) + ay * to_across;
      as<T>(&t.taut[1][first]) = by * to_across;
      as<T>(&t.taut[2][first]) = by * pull_y * by;
      // What each edge turns by.
      const T by0 = plain ? as<T>(&rest.side[0][first]) * over / (plain ? length3 : one) : zero;
      const T by1 = plain ? as<T>(&rest.side[1][first]) * over / (plain ? length2 : one) : zero;
      const T by2 = plain ? as<T>(&rest.side[2][first]) * over * over1 : zero;
      as<T>(&t.turn[0][0][first]) = by0 * (inner - square2), as<T>(&t.turn[0][1][first]) = by0 * (inner - square1);
      as<T>(&t.turn[1][0][first]) = by1 * square2, as<T>(&t.turn[1][1][first]) = -by1 * inner;
      as<T>(&t.turn[2][0][first]) = -by2 * inner, as<T>(&t.turn[2][1][first]) = by2 * square1;
      for (Four& bend : bends[n].at) as<T>(&bend[first]) = zero;  // those at no hinge
      as<T>(&rest.plain[first]) = plain ? one : zero;
      plain_ones += as<T>(&rest.plain[first]);
    }
  double plain_count = 0.0;
  for (std::size_t i = 0; i < detail::kLanes<T>; ++i) plain_count += plain_ones[i];
  bend_by<T>(x, relaxing);
  if (plain_count < static_cast<double>(count)) leave_out_flat();
}

template <class T>
AMBF_INLINED void SheetLanes::bend_by(const Vec3* x, const Relaxing& relaxing) {
  double* const bend_at = &bends[0].at[0][0];
  for (Hinges& t : hinges)
    for (std::size_t first = 0; first < kCount; first += detail::kLanes<T>) {
      const auto of_triangle = [&](std::size_t k, const double* zero, std::size_t stride) AMBF_INLINED_LAMBDA {
        return gathered<T>(zero, [&](std::size_t i) AMBF_INLINED_LAMBDA {
          const std::uint32_t triangle = t.triangle[k][first + i];
          return triangle / kCount * (stride / sizeof(double)) + triangle % kCount;
        });
      };
      const auto normal_of = [&](std::size_t k) AMBF_INLINED_LAMBDA -> Lanes3<T> {
        const Four3& zero = hot[0].normal;
        return {of_triangle(k, &zero[0][0], sizeof(Hot)).v, of_triangle(k, &zero[1][0], sizeof(Hot)).v,
                of_triangle(k, &zero[2][0], sizeof(Hot)).v};
      };
      const auto plain_of = [&](std::size_t k)
                                AMBF_INLINED_LAMBDA { return of_triangle(k, &cold[0].plain[0], sizeof(Cold)); };
      const Lanes3<T> normal = normal_of(0), second = scaled(normal_of(1), as<T>(&t.side[first]));
      T length, cosine, sine, angle;
      const Lanes3<T> edge = gathered<T>(x, &t.corner[1][first]) - gathered<T>(x, &t.corner[0][first]);
      dot(edge, edge, cosine);
      root(cosine, length);
      dot(cross(second, normal), edge, sine);
      dot(normal, second, cosine);
      const T zero{}, one = zero + 1.0;
      angle_of(cosine, T(sine / (length > 0.0 ? length : one)), angle);
      const auto closed = as<T>(&t.closed[first]) > 0.0,
                 turns = as<T>(&t.closed[first]) * plain_of(0).v * plain_of(1).v > 0.0;
      T bend = turns ? angle - as<T>(&t.angle[first]) : zero;
      if (relaxing.memory > 0.0) {
        T& relaxed = as<T>(&t.relaxed[first]);
        relaxed += relaxing.pace * (closed ? bend - relaxed : zero);
        bend = closed ? bend - relaxing.memory * relaxed : zero;
      }
      for (std::size_t i = 0; i < detail::kLanes<T>; ++i)
        bend_at[t.slot[0][first + i]] = bend[i], bend_at[t.slot[1][first + i]] = 0.0;
    }
}

template <class T>
AMBF_INLINED void SheetLanes::stretch_four(std::size_t n, const Vec3* u, double taut) {
  for (std::size_t first = 0; first < kCount; first += detail::kLanes<T>) {
    const Hot& t = hot[n];
    const Lanes3<T> u0 = gathered<T>(u, &t.corner[0][first]), d1 = gathered<T>(u, &t.corner[1][first]) - u0,
                    d2 = gathered<T>(u, &t.corner[2][first]) - u0;
    const Lanes3<T> along = load<T>(t.along, first), across = load<T>(t.across, first),
                    normal = load<T>(t.normal, first);
    T u1, v1, w1, u2, v2, w2;
    dot(along, d1, u1), dot(across, d1, v1), dot(normal, d1, w1);
    dot(along, d2, u2), dot(across, d2, v2), dot(normal, d2, w2);
    for (std::size_t k = 0; k < 3; ++k)
      as<T>(&bends[n].at[k][first]) = as<T>(&t.turn[k][0][first]) * w1 + as<T>(&t.turn[k][1][first]) * w2;
    const T ax = as<T>(&t.ax[first]), ay = as<T>(&t.ay[first]), by = as<T>(&t.by[first]);
    const T shear = as<T>(&t.shear[first]);
    const T ex = u1 * ax, ey = v1 * ay + v2 * by, even = as<T>(&t.even[first]) * (ex + ey);
    const T xx = shear * ex + even, yy = shear * ey + even, xy = 0.5 * shear * (u1 * ay + u2 * by + v1 * ax);
    w1 *= taut, w2 *= taut;
    const T between = as<T>(&t.taut[1][first]);
    store(scaled(along, xx * ax + xy * ay) + scaled(across, xy * ax + yy * ay) +
              scaled(normal, as<T>(&t.taut[0][first]) * w1 + between * w2),
          rooms[n].force[0], first);
    store(
        scaled(along, xy * by) + scaled(across, yy * by) + scaled(normal, between * w1 + as<T>(&t.taut[2][first]) * w2),
        rooms[n].force[1], first);
  }
}

template <class T>
AMBF_INLINED void SheetLanes::bear_four(std::size_t n) {
  for (std::size_t first = 0; first < kCount; first += detail::kLanes<T>) {
    const Hot& t = hot[n];
    T bend[3];
    for (std::size_t k = 0; k < 3; ++k)
      bend[k] = as<T>(&bends[n].at[k][first]) + at_slots<T>(bends, &t.beyond[k][first]).v;
    const auto moment = [&](std::size_t k) AMBF_INLINED_LAMBDA -> const T& { return as<T>(&t.moment[k][first]); };
    as<T>(&moments[n].at[0][first]) = moment(0) * bend[0] + moment(3) * bend[1] + moment(5) * bend[2];
    as<T>(&moments[n].at[1][first]) = moment(3) * bend[0] + moment(1) * bend[1] + moment(4) * bend[2];
    as<T>(&moments[n].at[2][first]) = moment(5) * bend[0] + moment(4) * bend[1] + moment(2) * bend[2];
  }
}

// Of the first `some` of four.
template <class T>
AMBF_INLINED void SheetLanes::pull_four(std::size_t n, std::size_t some, Vec3* to) {
  for (std::size_t first = 0; first < some; first += detail::kLanes<T>) {
    const Hot& t = hot[n];
    T of1{}, of2{};
    for (std::size_t k = 0; k < 3; ++k) {
      const T moment = as<T>(&moments[n].at[k][first]) + at_slots<T>(moments, &t.beyond[k][first]).v;
      of1 += as<T>(&t.turn[k][0][first]) * moment, of2 += as<T>(&t.turn[k][1][first]) * moment;
    }
    const Lanes3<T> none{}, normal = load<T>(t.normal, first);
    const Lanes3<T> on1 = load<T>(rooms[n].force[0], first) + scaled(normal, of1),
                    on2 = load<T>(rooms[n].force[1], first) + scaled(normal, of2);
    scatter(none - on1, to, &t.corner[1][first], some - first);
    scatter(none - on2, to, &t.corner[2][first], some - first);
    scatter(on1 + on2, to, &t.corner[0][first], some - first);
  }
}

// What is borne follows what stretches by as many fours as neighbours are apart, and what pulls follows that: of large
// sheets, most is read once and still near when it is read again.
template <class T>
AMBF_INLINED void SheetLanes::pass_by(const Vec3* u, double taut, Vec3* to) {
  const std::size_t all = hot.size();
  for (std::size_t n = 0; n < all + 2 * apart; ++n) {
    if (u != nullptr && n < all) stretch_four<T>(n, u, taut);
    if (n >= apart && n - apart < all) bear_four<T>(n - apart);
    if (n < 2 * apart) continue;
    const std::size_t last = n - 2 * apart;
    if (last < count / kCount) {
      pull_four<T>(last, kCount, to);
    } else {
      pull_four<T>(last, count % kCount, to);
    }
  }
}

AMBF_WIDE void SheetLanes::turn_wide(const Vec3* x, const Relaxing& relaxing) { turn_by<Quad>(x, relaxing); }
AMBF_WIDE void SheetLanes::pass_wide(const Vec3* u, double taut, Vec3* to) { pass_by<Quad>(u, taut, to); }

void SheetLanes::turn_to(const Vec3* x, const Relaxing& relaxing) {
  wide ? turn_wide(x, relaxing) : turn_by<Pair>(x, relaxing);
}

void SheetLanes::pull(Vec3* to) { wide ? pass_wide(nullptr, 0.0, to) : pass_by<Pair>(nullptr, 0.0, to); }

void SheetLanes::stretch(const Vec3* u, double taut, Vec3* to) {
  wide ? pass_wide(u, taut, to) : pass_by<Pair>(u, taut, to);
}

}  // namespace ambf::physics::detail
