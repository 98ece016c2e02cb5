#include "mesh/detail/hull_flat.h"

#include <algorithm>
#include <cmath>

#include "math/rotation.h"
#include "mesh/mesh.h"

namespace ambf::mesh {

namespace {

using math::Vec3;

struct Flat {
  double u = 0.0, v = 0.0;
  std::uint32_t point = 0;
};

// Height of c left of the line from a to b (m).
double height(const Flat& a, const Flat& b, const Flat& c) {
  const double du = b.u - a.u, dv = b.v - a.v;
  return (du * (c.v - a.v) - dv * (c.u - a.u)) / std::max(std::hypot(du, dv), 1e-300);
}

double turn(const Flat& a, const Flat& b, const Flat& c) {
  return (b.u - a.u) * (c.v - a.v) - (b.v - a.v) * (c.u - a.u);
}

// Andrew's monotone chain, counter-clockwise, without points on the edges.
std::vector<Flat> outline_of(std::vector<Flat> p) {
  std::sort(p.begin(), p.end(), [](const Flat& a, const Flat& b) {
    return a.u != b.u ? a.u < b.u : (a.v != b.v ? a.v < b.v : a.point < b.point);
  });
  std::vector<Flat> chain;
  for (int pass = 0; pass < 2; ++pass) {
    const std::size_t base = chain.size();
    for (const Flat& q : p) {
      while (chain.size() >= base + 2 && turn(chain[chain.size() - 2], chain.back(), q) <= 0.0) chain.pop_back();
      chain.push_back(q);
    }
    chain.pop_back();  // the first point of the other chain
    std::reverse(p.begin(), p.end());
  }
  return chain;
}

}  // namespace

ReducedHull reduce_flat_hull(const std::vector<Vec3>& points, std::size_t limit, double tolerance) {
  ReducedHull out;
  // Axes of the plane: to the farthest point, and to the one farthest from that line.
  Vec3 a = points[0], b = points[0], c = points[0];
  for (const Vec3& p : points) a = math::norm(p - points[0]) > math::norm(a - points[0]) ? p : a;
  for (const Vec3& p : points) b = math::norm(p - a) > math::norm(b - a) ? p : b;
  const Vec3 axis_u = math::normalized(b - a, {1.0, 0.0, 0.0});
  const auto off_axis = [&a, &axis_u](const Vec3& p) { return (p - a) - axis_u * math::dot(p - a, axis_u); };
  c = a;
  for (const Vec3& p : points) c = math::norm(off_axis(p)) > math::norm(off_axis(c)) ? p : c;
  const double diagonal = bounds_of(points).diagonal();
  if (diagonal == 0.0) {
    out.points = {points[0]};
    return out;
  }
  if (math::norm(off_axis(c)) <= 1e-9 * diagonal) {  // on a line
    out.points = {a, b};
    return out;
  }
  const Vec3 axis_v = math::normalized(off_axis(c));
  std::vector<Flat> flat;
  flat.reserve(points.size());
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    flat.push_back({math::dot(points[i] - a, axis_u), math::dot(points[i] - a, axis_v), i});
  }
  const std::vector<Flat> outline = outline_of(flat);
  const std::size_t n = outline.size();

  // Greedy again: between two points taken, the one farthest off their line is next.
  std::vector<std::size_t> taken = {0};
  std::size_t opposite = 0;
  for (std::size_t i = 1; i < n; ++i) {
    const auto far = [&](std::size_t k) {
      return std::hypot(outline[k].u - outline[0].u, outline[k].v - outline[0].v);
    };
    if (far(i) > far(opposite)) opposite = i;
  }
  if (opposite != 0) taken.push_back(opposite);
  double most = 0.0;
  while (true) {
    most = 0.0;
    std::size_t best = 0, gap = 0;
    for (std::size_t k = 0; k < taken.size(); ++k) {
      const std::size_t end = k + 1 < taken.size() ? taken[k + 1] : n;
      for (std::size_t i = taken[k] + 1; i < end; ++i) {
        // Counter-clockwise: what lies outside is right of the edge.
        const double out_by = -height(outline[taken[k]], outline[end % n], outline[i]);
        if (out_by > most) most = out_by, best = i, gap = k;
      }
    }
    if (most <= tolerance || taken.size() >= limit) break;
    taken.insert(taken.begin() + static_cast<std::ptrdiff_t>(gap) + 1, best);
  }
  for (std::size_t k : taken) out.points.push_back(points[outline[k].point]);
  out.max_deviation = most;
  return out;
}

}  // namespace ambf::mesh
