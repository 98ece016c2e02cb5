#include <cmath>

#include "mesh/formats/raw_mesh.h"

namespace ambf::mesh {

namespace {

using math::Vec3;

struct Point {
  double x = 0.0, y = 0.0;
};

double turn(const Point& a, const Point& b, const Point& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

// The polygon seen along its normal, so that it runs counter-clockwise. Newell's method gives the normal of uneven
// polygons too.
std::vector<Point> flatten(const std::vector<Vec3>& points) {
  Vec3 n;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vec3 a = points[i] - points[0], b = points[(i + 1) % points.size()] - points[0];
    n += math::cross(a, b);
  }
  const double ax = std::abs(n.x), ay = std::abs(n.y), az = std::abs(n.z);
  std::vector<Point> flat;
  flat.reserve(points.size());
  for (const Vec3& p : points) {
    if (az >= ax && az >= ay) {
      flat.push_back(n.z >= 0.0 ? Point{p.x, p.y} : Point{p.y, p.x});
    } else if (ax >= ay) {
      flat.push_back(n.x >= 0.0 ? Point{p.y, p.z} : Point{p.z, p.y});
    } else {
      flat.push_back(n.y >= 0.0 ? Point{p.z, p.x} : Point{p.x, p.z});
    }
  }
  return flat;
}

bool convex(const std::vector<Point>& p) {
  const std::size_t n = p.size();
  double total = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    if (turn(p[i], p[(i + 1) % n], p[(i + 2) % n]) < 0.0) return false;
    total += turn(p[0], p[i], p[(i + 1) % n]);
  }
  return total > 0.0;
}

// Nothing of the polygon lies in the ear a b c.
bool is_ear(const std::vector<Point>& p, const std::vector<std::uint32_t>& left, std::size_t a, std::size_t b,
            std::size_t c) {
  const Point &pa = p[left[a]], &pb = p[left[b]], &pc = p[left[c]];
  if (turn(pa, pb, pc) <= 0.0) return false;
  for (std::size_t k = 0; k < left.size(); ++k) {
    if (k == a || k == b || k == c) continue;
    const Point& q = p[left[k]];
    const bool corner = (q.x == pa.x && q.y == pa.y) || (q.x == pb.x && q.y == pb.y) || (q.x == pc.x && q.y == pc.y);
    if (!corner && turn(pa, pb, q) >= 0.0 && turn(pb, pc, q) >= 0.0 && turn(pc, pa, q) >= 0.0) return false;
  }
  return true;
}

}  // namespace

void triangulate(const std::vector<Vec3>& points, std::vector<std::uint32_t>& out_triangles) {
  constexpr std::size_t kMaxCornersForEars = 512;  // clipping is cubic at worst
  const auto n = static_cast<std::uint32_t>(points.size());
  out_triangles.clear();
  const auto fan = [&out_triangles](const std::vector<std::uint32_t>& left) {
    for (std::size_t k = 2; k < left.size(); ++k)
      out_triangles.insert(out_triangles.end(), {left[0], left[k - 1], left[k]});
  };
  std::vector<std::uint32_t> left(n);
  for (std::uint32_t i = 0; i < n; ++i) left[i] = i;
  if (n > 3 && n <= kMaxCornersForEars) {
    const std::vector<Point> flat = flatten(points);
    bool progress = !convex(flat);
    while (progress && left.size() > 3) {
      progress = false;
      for (std::size_t b = 0; b < left.size() && !progress; ++b) {
        const std::size_t a = (b + left.size() - 1) % left.size(), c = (b + 1) % left.size();
        if (!is_ear(flat, left, a, b, c)) continue;
        out_triangles.insert(out_triangles.end(), {left[a], left[b], left[c]});
        left.erase(left.begin() + static_cast<std::ptrdiff_t>(b));
        progress = true;
      }
    }
  }
  fan(left);  // all of a convex polygon, the last triangle of a clipped one, what is left of one that crosses itself
}

}  // namespace ambf::mesh
