#include "physics/soft/detail/tissue_seams.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "physics/soft/detail/weights.h"

namespace ambf::physics::detail {

using math::Vec3;

namespace {

constexpr double kInwards = 1e-6;    // of an element: a surface that lies in a face of elements is of the inner one
constexpr double kSamePlace = 1e-6;  // of an element
constexpr double kSmallest = 1e-5;   // of an element's side, squared: smaller pieces are left out
constexpr double kPi = 3.14159265358979323846;

// The faces of an element, each opposite to the corner of its number and seen from outside.
constexpr std::uint8_t kSides[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};

bool apart(const Tetrahedron& t, const std::array<Vec3, 3>& face, double slack) {
  for (const auto axis : {&Vec3::x, &Vec3::y, &Vec3::z}) {
    const auto [low, high] = std::minmax({t[0].*axis, t[1].*axis, t[2].*axis, t[3].*axis});
    const auto [least, most] = std::minmax({face[0].*axis, face[1].*axis, face[2].*axis});
    if (most < low - slack || least > high + slack) return true;
  }
  return false;
}

// What of a triangle is within; judged a little inwards.
std::vector<Vec3> within(const Tetrahedron& t, const std::array<Vec3, 3>& face, const Vec3& inwards) {
  std::vector<Vec3> polygon(face.begin(), face.end());
  for (std::size_t side = 0; side < 4; ++side) {
    std::vector<Vec3> kept;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Vec3 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
      const double wa = weights_in(t, a + inwards)[side], wb = weights_in(t, b + inwards)[side];
      if (wa >= 0.0) kept.push_back(a);
      if ((wa >= 0.0) != (wb >= 0.0)) kept.push_back(a + (b - a) * (wa / (wa - wb)));
    }
    polygon = std::move(kept);
  }
  return polygon;
}

Vec3 normal_of(const std::array<Vec3, 3>& face) { return math::cross(face[1] - face[0], face[2] - face[0]); }

Vec3 nearest_on(const std::array<Vec3, 3>& face, const Vec3& p) {
  const Vec3 n = normal_of(face);
  const double size = math::dot(n, n);
  if (size > 0.0) {
    const Vec3 foot = p - n * (math::dot(p - face[0], n) / size);
    bool inside = true;
    for (std::size_t k = 0; k < 3; ++k)
      inside = inside && math::dot(math::cross(face[(k + 1) % 3] - face[k], foot - face[k]), n) >= 0.0;
    if (inside) return foot;
  }
  Vec3 best = face[0];
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3 along = face[(k + 1) % 3] - face[k];
    const double length = math::dot(along, along);
    const double share = length > 0.0 ? std::clamp(math::dot(p - face[k], along) / length, 0.0, 1.0) : 0.0;
    const Vec3 at = face[k] + along * share;
    if (math::norm(p - at) < math::norm(p - best)) best = at;
  }
  return best;
}

class Maker {
 public:
  Maker(TissueGrid& grid, const TissueSurface& surface) : grid_(grid), small_(grid.element_size) {
    for (const auto& t : surface.triangles)
      triangles_.push_back({surface.vertices[t[0]], surface.vertices[t[1]], surface.vertices[t[2]]});
    for (const TissueElement& e : grid.elements)
      shapes_.push_back(
          {grid.corners[e.corner[0]], grid.corners[e.corner[1]], grid.corners[e.corner[2]], grid.corners[e.corner[3]]});
    points_of_.resize(shapes_.size());
  }

  void add_surface(const std::vector<Tetrahedron>& left_out, const std::function<TissuePoint(const Vec3&)>& embed) {
    for (const std::array<Vec3, 3>& face : triangles_) {
      const Vec3 n = normal_of(face);
      const double size = math::norm(n);
      if (!(size > 0.0)) continue;
      const Vec3 inwards = n * (-kInwards * small_ / size);
      for (std::uint32_t e = 0; e < shapes_.size(); ++e)
        if (!apart(shapes_[e], face, kInwards * small_)) add(e, within(shapes_[e], face, inwards));
      for (const Tetrahedron& t : left_out) {
        if (apart(t, face, kInwards * small_)) continue;
        const std::vector<Vec3> piece = within(t, face, inwards);
        if (piece.size() < 3) continue;
        Vec3 middle{};
        for (const Vec3& p : piece) middle += p / static_cast<double>(piece.size());
        add(embed(middle).element, piece);
      }
    }
  }

  void add_inner() {
    grid_.first_inner_face = grid_.faces.size();
    grid_.first_inner_point = grid_.points.size();
    std::vector<Vec3> moved(grid_.corners.size());
    for (std::size_t i = 0; i < moved.size(); ++i) moved[i] = kept_within(grid_.corners[i]);
    for (std::uint32_t e = 0; e < shapes_.size(); ++e)
      for (const std::uint32_t corner : grid_.elements[e].corner)
        grid_.points.push_back({grid_.elements[e].corner, weights_in(shapes_[e], moved[corner]), e});
    std::map<std::array<std::uint32_t, 3>, std::pair<std::uint32_t, std::uint8_t>> known;
    for (std::uint32_t e = 0; e < shapes_.size(); ++e)
      for (std::uint8_t side = 0; side < 4; ++side) {
        std::array<std::uint32_t, 3> key{};
        for (std::size_t k = 0; k < 3; ++k) key[k] = grid_.elements[e].corner[kSides[side][k]];
        std::sort(key.begin(), key.end());
        const auto [found, is_new] = known.try_emplace(key, e, side);
        if (!is_new) add_seam(found->second.first, found->second.second, e);
      }
  }

 private:
  void add(std::uint32_t element, const std::vector<Vec3>& polygon) {
    Vec3 area{};
    for (std::size_t i = 2; i < polygon.size(); ++i)
      area += math::cross(polygon[i - 1] - polygon[0], polygon[i] - polygon[0]) * 0.5;
    if (!(math::norm(area) > kSmallest * small_ * small_)) return;
    std::vector<std::uint32_t> numbers;
    for (const Vec3& p : polygon) {
      const std::uint32_t number = point(element, p);
      if (numbers.empty() || (numbers.back() != number && numbers.front() != number)) numbers.push_back(number);
    }
    for (std::size_t i = 2; i < numbers.size(); ++i) grid_.faces.push_back({numbers[0], numbers[i - 1], numbers[i]});
  }
  std::uint32_t point(std::uint32_t element, const Vec3& p) {
    for (const std::uint32_t each : points_of_[element])
      if (math::norm(place(each) - p) < kSamePlace * small_) return each;
    const auto number = static_cast<std::uint32_t>(grid_.points.size());
    grid_.points.push_back({grid_.elements[element].corner, weights_in(shapes_[element], p), element});
    points_of_[element].push_back(number);
    return number;
  }
  Vec3 place(std::uint32_t number) const {
    const TissuePoint& point = grid_.points[number];
    Vec3 at{};
    for (std::size_t k = 0; k < 4; ++k) at += grid_.corners[point.corner[k]] * point.weight[k];
    return at;
  }
  // Outside of the surface: the nearest place on it. By the solid angle of all triangles (van Oosterom and Strackee).
  Vec3 kept_within(const Vec3& p) const {
    double angle = 0.0, least = std::numeric_limits<double>::infinity();
    Vec3 nearest = p;
    for (const std::array<Vec3, 3>& face : triangles_) {
      const Vec3 a = face[0] - p, b = face[1] - p, c = face[2] - p, on = nearest_on(face, p);
      const double la = math::norm(a), lb = math::norm(b), lc = math::norm(c);
      angle += 2.0 * std::atan2(math::dot(a, math::cross(b, c)),
                                la * lb * lc + math::dot(a, b) * lc + math::dot(b, c) * la + math::dot(c, a) * lb);
      if (const double distance = math::norm(on - p); distance < least) least = distance, nearest = on;
    }
    return angle > 2.0 * kPi || least < kSamePlace * small_ ? p : nearest;
  }
  void add_seam(std::uint32_t a, std::uint8_t side, std::uint32_t b) {
    TissueSeam seam;
    seam.element = {a, b};
    for (std::size_t k = 0; k < 3; ++k) {
      seam.corner[0][k] = kSides[side][k];
      const auto& other = grid_.elements[b].corner;
      const auto found = std::find(other.begin(), other.end(), grid_.elements[a].corner[kSides[side][k]]);
      seam.corner[1][k] = static_cast<std::uint8_t>(found - other.begin());
    }
    const auto first = static_cast<std::uint32_t>(grid_.first_inner_point);
    const auto& [of_a, of_b] = seam.corner;
    grid_.faces.push_back({first + 4 * a + of_a[0], first + 4 * a + of_a[1], first + 4 * a + of_a[2]});
    grid_.faces.push_back({first + 4 * b + of_b[0], first + 4 * b + of_b[2], first + 4 * b + of_b[1]});
    grid_.seams.push_back(seam);
  }

  TissueGrid& grid_;
  double small_;  // m, an element's side
  std::vector<std::array<Vec3, 3>> triangles_;
  std::vector<Tetrahedron> shapes_;
  std::vector<std::vector<std::uint32_t>> points_of_;  // of the surface, of each element
};

}  // namespace

void add_cut_faces(TissueGrid& grid, const TissueSurface& surface, const std::vector<Tetrahedron>& left_out,
                   const std::function<TissuePoint(const Vec3&)>& embed) {
  for (const Vec3& vertex : surface.vertices) grid.points.push_back(embed(vertex));
  Maker maker(grid, surface);
  maker.add_surface(left_out, embed);
  maker.add_inner();
}

}  // namespace ambf::physics::detail
