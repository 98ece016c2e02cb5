// Incremental convex hull that always takes the farthest point next (quickhull's choice, but over all faces), so that
// stopping early leaves the best hull so far.
#include "mesh/hull.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "mesh/detail/hull_flat.h"
#include "mesh/mesh.h"

namespace ambf::mesh {

namespace {

using math::Vec3;
constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

struct Face {
  std::array<std::uint32_t, 3> corners{};  // indices of the cloud, counter-clockwise from outside
  Vec3 normal;                             // unit, outward
  double offset = 0.0;                     // dot(normal, any corner)
  std::vector<std::uint32_t> outside;      // cloud points above this face, each on one face's list
  std::uint32_t highest = kNone;
  double max_height = 0.0;
  bool alive = true;
};

class Hull {
 public:
  Hull(const std::vector<Vec3>& cloud, double epsilon) : cloud_(cloud), epsilon_(epsilon) {}

  // A first tetrahedron of four extreme points; false when the cloud is flat.
  bool begin() {
    const std::array<std::uint32_t, 4> t = extreme_four();
    const Vec3 &a = cloud_[t[0]], &b = cloud_[t[1]], &c = cloud_[t[2]], &d = cloud_[t[3]];
    const Vec3 n = math::cross(b - a, c - a);
    // Of points on a line the cross product is rounding, its direction means nothing.
    if (!(math::norm(n) > 4.0 * epsilon_ * math::norm(b - a))) return false;
    const double height = math::dot(n, d - a) / math::norm(n);
    if (!(std::abs(height) > 4.0 * epsilon_)) return false;
    const bool above = height > 0.0;  // then a b c, seen from d, must face away
    add_face(t[0], above ? t[2] : t[1], above ? t[1] : t[2]);
    add_face(t[0], above ? t[1] : t[3], above ? t[3] : t[1]);
    add_face(t[1], above ? t[2] : t[3], above ? t[3] : t[2]);
    add_face(t[2], above ? t[0] : t[3], above ? t[3] : t[0]);
    used_.insert(t.begin(), t.end());
    std::vector<std::uint32_t> all(cloud_.size());
    for (std::uint32_t i = 0; i < all.size(); ++i) all[i] = i;
    distribute(all, 0);
    return true;
  }

  std::size_t point_count() const { return used_.size(); }

  // The height of the highest outside point; its face in `out_face`.
  double max_height(std::size_t& out_face) const {
    double height = 0.0;
    for (std::size_t f = 0; f < faces_.size(); ++f) {
      if (faces_[f].alive && faces_[f].highest != kNone && faces_[f].max_height > height) {
        height = faces_[f].max_height;
        out_face = f;
      }
    }
    return height;
  }

  // Adds the highest point of `face`. False, with nothing changed, when rounding makes the horizon no simple ring.
  bool add_highest(std::size_t face) {
    const std::uint32_t apex = faces_[face].highest;
    const Vec3& p = cloud_[apex];
    std::vector<std::size_t> visible;
    std::set<std::array<std::uint32_t, 2>> edges;
    for (std::size_t f = 0; f < faces_.size(); ++f) {
      if (!faces_[f].alive || math::dot(faces_[f].normal, p) - faces_[f].offset <= epsilon_) continue;
      visible.push_back(f);
      for (std::size_t k = 0; k < 3; ++k) edges.insert({faces_[f].corners[k], faces_[f].corners[(k + 1) % 3]});
    }
    std::vector<std::array<std::uint32_t, 2>> horizon;
    std::set<std::uint32_t> starts;
    for (const auto& e : edges) {
      if (edges.count({e[1], e[0]}) != 0) continue;
      if (!starts.insert(e[0]).second) return drop_highest(face);
      horizon.push_back(e);
    }
    if (horizon.size() < 3) return drop_highest(face);

    const std::size_t first_new = faces_.size();
    for (const auto& e : horizon) add_face(e[0], e[1], apex);
    std::vector<std::uint32_t> orphans;
    for (std::size_t f : visible) {
      faces_[f].alive = false;
      orphans.insert(orphans.end(), faces_[f].outside.begin(), faces_[f].outside.end());
      faces_[f].outside = {};
      faces_[f].highest = kNone;
    }
    std::sort(orphans.begin(), orphans.end());
    used_.insert(apex);
    distribute(orphans, first_new);
    return true;
  }

  void result(ReducedHull& out) const {
    // Only corners of living faces: a point taken early can end up inside.
    std::vector<std::uint32_t> number(cloud_.size(), kNone);
    for (const Face& f : faces_) {
      if (!f.alive) continue;
      std::array<std::uint32_t, 3> triangle{};
      for (std::size_t k = 0; k < 3; ++k) {
        std::uint32_t& n = number[f.corners[k]];
        if (n == kNone) {
          n = static_cast<std::uint32_t>(out.points.size());
          out.points.push_back(cloud_[f.corners[k]]);
        }
        triangle[k] = n;
      }
      out.triangles.push_back(triangle);
    }
  }

 private:
  std::array<std::uint32_t, 4> extreme_four() const {
    std::array<std::uint32_t, 4> t{};
    const auto point_of_max = [this](const auto& measure) {
      std::uint32_t best = 0;
      double max = -1.0;
      for (std::uint32_t i = 0; i < cloud_.size(); ++i) {
        const double value = measure(cloud_[i]);
        if (value > max) max = value, best = i;
      }
      return best;
    };
    const Vec3 origin = cloud_[0];
    t[0] = point_of_max([&](const Vec3& p) { return math::norm(p - origin); });
    const Vec3 a = cloud_[t[0]];
    t[1] = point_of_max([&](const Vec3& p) { return math::norm(p - a); });
    const Vec3 along = cloud_[t[1]] - a;
    t[2] = point_of_max([&](const Vec3& p) { return math::norm(math::cross(along, p - a)); });
    const Vec3 n = math::cross(along, cloud_[t[2]] - a);
    t[3] = point_of_max([&](const Vec3& p) { return std::abs(math::dot(n, p - a)); });
    return t;
  }

  void add_face(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    Face f;
    f.corners = {a, b, c};
    const Vec3 n = math::cross(cloud_[b] - cloud_[a], cloud_[c] - cloud_[a]);
    const double length = math::norm(n);
    f.normal = length > 0.0 ? n / length : Vec3{};
    f.offset = math::dot(f.normal, cloud_[a]);
    faces_.push_back(std::move(f));
  }

  // Each point goes to the face, from `first` on, above which it is highest; points above none are inside.
  void distribute(const std::vector<std::uint32_t>& points, std::size_t first) {
    for (std::uint32_t i : points) {
      if (used_.count(i) != 0) continue;
      std::size_t best = faces_.size();
      double max = epsilon_;
      for (std::size_t f = first; f < faces_.size(); ++f) {
        const double height = math::dot(faces_[f].normal, cloud_[i]) - faces_[f].offset;
        if (height > max) max = height, best = f;
      }
      if (best == faces_.size()) continue;
      Face& face = faces_[best];
      face.outside.push_back(i);
      if (max > face.max_height) face.max_height = max, face.highest = i;
    }
  }

  // Gives a point up that rounding does not let us add; true so that the next highest is tried.
  bool drop_highest(std::size_t face) {
    Face& f = faces_[face];
    f.outside.erase(std::find(f.outside.begin(), f.outside.end(), f.highest));
    f.highest = kNone;
    f.max_height = 0.0;
    for (std::uint32_t i : f.outside) {
      const double height = math::dot(f.normal, cloud_[i]) - f.offset;
      if (height > f.max_height) f.max_height = height, f.highest = i;
    }
    return true;
  }

  const std::vector<Vec3>& cloud_;
  double epsilon_;
  std::vector<Face> faces_;
  std::set<std::uint32_t> used_;
};

double distance_to_segment(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Vec3 ab = b - a;
  const double length2 = math::dot(ab, ab);
  const double t = length2 > 0.0 ? std::clamp(math::dot(p - a, ab) / length2, 0.0, 1.0) : 0.0;
  return math::norm(p - (a + ab * t));
}

double distance_to_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 n = math::cross(b - a, c - a);
  const bool over = math::dot(math::cross(b - a, p - a), n) >= 0.0 && math::dot(math::cross(c - b, p - b), n) >= 0.0 &&
                    math::dot(math::cross(a - c, p - c), n) >= 0.0;
  if (over && math::norm(n) > 0.0) return std::abs(math::dot(n, p - a)) / math::norm(n);
  return std::min({distance_to_segment(p, a, b), distance_to_segment(p, b, c), distance_to_segment(p, c, a)});
}

}  // namespace

double hull_deviation(const ReducedHull& hull, const std::vector<Vec3>& points) {
  const double epsilon = 1e-9 * bounds_of(points).diagonal();  // points in the plane of a face are not outside
  double max = 0.0;
  for (const Vec3& p : points) {
    double nearest = std::numeric_limits<double>::infinity();
    bool outside = false;
    for (const auto& t : hull.triangles) {
      const Vec3 &a = hull.points[t[0]], &b = hull.points[t[1]], &c = hull.points[t[2]];
      const Vec3 n = math::cross(b - a, c - a);
      if (math::dot(n, p - a) <= epsilon * math::norm(n)) continue;  // below this face
      outside = true;
      // The nearest point of a convex hull lies on a face that sees p.
      nearest = std::min(nearest, distance_to_triangle(p, a, b, c));
    }
    if (outside) max = std::max(max, nearest);
  }
  return max;
}

ReducedHull reduce_hull(const std::vector<Vec3>& points, const HullOptions& options) {
  ReducedHull out;
  if (points.empty()) return out;
  const double diagonal = bounds_of(points).diagonal();
  const double epsilon = 1e-9 * diagonal;
  const auto limit = static_cast<std::size_t>(std::max(4, options.max_points));

  Hull hull(points, epsilon);
  if (!hull.begin()) return reduce_flat_hull(points, limit, options.tolerance_relative * diagonal);
  const double tolerance = std::max(epsilon, options.tolerance_relative * diagonal);
  std::size_t face = 0;
  while (hull.point_count() < limit && hull.max_height(face) > tolerance) hull.add_highest(face);
  hull.result(out);
  out.max_deviation = hull_deviation(out, points);
  return out;
}

}  // namespace ambf::mesh
