#include "physics/soft/detail/cut_surface.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "math/rotation.h"
#include "physics/detail/bullet.h"
#include "physics/soft/detail/weights.h"

namespace ambf::physics::detail {

using math::Vec3;

namespace {

constexpr double kLone = 1e-9;       // of a weight: a point is at a corner
constexpr double kOnSide = 1e-4;     // of a weight: it is on a side of its element
constexpr double kSamePlace = 1e-5;  // elements
constexpr double kCrease = 0.08;     // of eigenvalues: surfaces that meet at more than some 30 degrees have an edge
constexpr double kCrossing = 0.15;   // likewise: planes that meet at more than some 40 degrees are of two cuts
constexpr double kAlong = 0.2;       // sine: a plane that is less aslant to the outer surface moves nothing along it
constexpr double kFurthest = 1.0;    // elements, that a point may go

std::array<double, 4> weights_in(const TissueGrid& grid, const std::uint32_t* corner, std::size_t sides,
                                 const Vec3& at) {
  const Vec3 &o = grid.corners[corner[0]], &a = grid.corners[corner[1]], &b = grid.corners[corner[2]];
  if (sides == 4) return detail::weights_in({o, a, b, grid.corners[corner[3]]}, at);
  const Vec3 across = math::cross(a - o, b - o), p = at - o;
  const double size = math::dot(a - o, math::cross(b - o, across));
  const double wa = math::dot(p, math::cross(b - o, across)) / size,
               wb = math::dot(p, math::cross(across, a - o)) / size;
  return {1.0 - wa - wb, wa, wb, 0.0};
}

}  // namespace

void Principal::add(const Vec3& v) {
  xx_ += v.x * v.x, yy_ += v.y * v.y, zz_ += v.z * v.z;
  yz_ += v.y * v.z, zx_ += v.z * v.x, xy_ += v.x * v.y;
}

void Principal::solve(double (&values)[3], Vec3 (&axes)[3]) const {
  btMatrix3x3 a(xx_, xy_, zx_, xy_, yy_, yz_, zx_, yz_, zz_), turned;
  a.diagonalize(turned, 1e-12, 30);
  for (int k = 0; k < 3; ++k) {
    values[k] = a[k][k];
    axes[k] = from_bullet(turned.getColumn(k));
  }
}

CutSurface::CutSurface(const TissueGrid& grid, const std::vector<std::uint32_t>& loaded, std::size_t max_corners)
    : loaded_(loaded), sides_(grid.triangles.empty() ? 4 : 3), size_(grid.element_size) {
  for (const TissuePoint& point : grid.points) weight_.push_back(point.weight);
  find_places(grid);
  find_seams(grid);
  find_free(grid);
  for (Place& place : places_) place.moved = place.loaded;
  known_.assign(grid.seams.size(), 0);
  best_.resize(max_corners);
  min_weight_.resize(max_corners);
}

void CutSurface::find_places(const TissueGrid& grid) {
  home_.assign(grid.points.size(), kNone);
  place_.assign(grid.points.size(), kNone);
  places_.resize(grid.corners.size());
  for (std::size_t i = 0; i < places_.size(); ++i) places_[i].loaded = grid.corners[i];
  if (sides_ == 3) {
    for (std::uint32_t slot = 0; slot < loaded_.size(); ++slot) home_[grid.faces[slot / 3][slot % 3]] = slot;
  } else {
    for (std::size_t i = 0; i < grid.points.size(); ++i)
      for (std::uint32_t k = 0; k < 4; ++k)
        if (i < grid.first_inner_point ? weight_[i][k] > 1.0 - kLone : (i - grid.first_inner_point) % 4 == k)
          home_[i] = 4 * grid.points[i].element + k;
  }
  std::map<std::array<long long, 3>, std::uint32_t> known;
  const double cell = kSamePlace * size_;
  for (std::size_t i = 0; i < grid.points.size(); ++i) {
    Vec3 at{};
    for (std::size_t k = 0; k < 4; ++k) at += grid.corners[grid.points[i].corner[k]] * weight_[i][k];
    if (home_[i] != kNone) {
      place_[i] = loaded_[home_[i]];
      places_[place_[i]].loaded = at;  // of corners outside of the surface, the nearest place on it
      continue;
    }
    if (std::none_of(weight_[i].begin(), weight_[i].end(), [](double w) { return std::abs(w) < kOnSide; })) continue;
    const auto [found, is_new] =
        known.try_emplace({std::llround(at.x / cell), std::llround(at.y / cell), std::llround(at.z / cell)},
                          static_cast<std::uint32_t>(places_.size()));
    if (is_new) {
      places_.emplace_back();
      places_.back().loaded = at;
    }
    place_[i] = found->second;
  }
}

void CutSurface::find_seams(const TissueGrid& grid) {
  std::vector<std::vector<std::uint32_t>> of(places_.size());
  std::vector<std::uint32_t> at_side(loaded_.size(), kNone);  // the seam on the side opposite to that corner
  for (std::uint32_t s = 0; s < grid.seams.size(); ++s) {
    const TissueSeam& seam = grid.seams[s];
    for (std::size_t side = 0; side < 2; ++side) {
      std::size_t opposite = sides_ == 4 ? 6 : 3;
      for (std::size_t k = 0; k + 1 < sides_; ++k) opposite -= seam.corner[side][k];
      at_side[sides_ * seam.element[side] + opposite] = s;
    }
    for (std::size_t k = 0; k + 1 < sides_; ++k) of[loaded_[sides_ * seam.element[0] + seam.corner[0][k]]].push_back(s);
    middle_.push_back({});
    for (std::size_t k = 0; k < sides_; ++k)
      middle_.back() += grid.corners[loaded_[sides_ * seam.element[0] + k]] / static_cast<double>(sides_);
  }
  for (std::size_t i = 0; i < grid.points.size(); ++i) {
    if (place_[i] == kNone || home_[i] != kNone) continue;
    for (std::size_t k = 0; k < sides_; ++k)
      if (const std::uint32_t s = at_side[sides_ * grid.points[i].element + k];
          s != kNone && std::abs(weight_[i][k]) < kOnSide)
        of[place_[i]].push_back(s);
  }
  for (std::size_t i = 0; i < places_.size(); ++i) {
    std::sort(of[i].begin(), of[i].end());
    of[i].erase(std::unique(of[i].begin(), of[i].end()), of[i].end());
    places_[i].first_seam = static_cast<std::uint32_t>(seams_.size());
    places_[i].seams = static_cast<std::uint32_t>(of[i].size());
    seams_.insert(seams_.end(), of[i].begin(), of[i].end());
  }
}

// Within the tissue all ways are free; on its outer surface those along that, and on edges of it those along them.
void CutSurface::find_free(const TissueGrid& grid) {
  std::vector<Principal> across(places_.size());
  const auto at = [&](std::uint32_t point) {
    Vec3 sum{};
    for (std::size_t k = 0; k < 4; ++k) sum += grid.corners[grid.points[point].corner[k]] * weight_[point][k];
    return sum;
  };
  std::map<std::array<std::uint32_t, 2>, std::pair<int, Vec3>> rim;  // of a sheet: edges by how many faces have them
  for (std::size_t f = 0; f < grid.first_inner_face; ++f) {
    const auto& face = grid.faces[f];
    const Vec3 p[3] = {at(face[0]), at(face[1]), at(face[2])};
    const Vec3 area = math::cross(p[1] - p[0], p[2] - p[0]);
    const double root = std::sqrt(math::norm(area));
    if (!(root > 0.0)) continue;
    for (std::size_t k = 0; k < 3; ++k) {
      if (place_[face[k]] != kNone) across[place_[face[k]]].add(area / root);
      if (sides_ != 3) continue;
      const std::uint32_t a = place_[face[k]], b = place_[face[(k + 1) % 3]];
      auto& edge = rim[{std::min(a, b), std::max(a, b)}];
      ++edge.first;
      edge.second = math::cross(p[(k + 1) % 3] - p[k], math::normalized(area));
    }
  }
  for (const auto& [places, edge] : rim)
    if (edge.first == 1)
      for (const std::uint32_t place : places) across[place].add(edge.second);
  for (std::size_t i = 0; i < places_.size(); ++i) {
    Place& place = places_[i];
    const Vec3 out = i < grid.corners.size() ? grid.corners[i] - place.loaded : Vec3{};
    if (math::norm(out) > kSamePlace * size_) across[i].add(math::normalized(out) * size_);
    double values[3];
    Vec3 axes[3];
    across[i].solve(values, axes);
    const double largest = std::max({values[0], values[1], values[2]});
    for (int k = 0; k < 3; ++k) {
      if (largest > 0.0 && values[k] > kCrease * largest) continue;
      place.free[0] += axes[k] * axes[k].x;
      place.free[1] += axes[k] * axes[k].y;
      place.free[2] += axes[k] * axes[k].z;
    }
  }
}

void CutSurface::look_at_all() { std::fill(known_.begin(), known_.end(), std::uint8_t{2}); }

// To the planes of its open seams, by least squares; of planes that are nearly one, across their mean.
void CutSurface::move(Place& place, const std::vector<std::uint8_t>& open, const std::vector<Vec3>& swept) const {
  place.away = false;
  place.moved = place.loaded;
  Principal planes;
  Vec3 ways{};
  for (std::size_t i = 0; i < place.seams; ++i) {
    const std::uint32_t s = seams_[place.first_seam + i];
    if (open[s] == 0) continue;
    place.away = true;
    const Vec3 normal = math::normalized(swept[s]);
    const Vec3 along{math::dot(place.free[0], normal), math::dot(place.free[1], normal),
                     math::dot(place.free[2], normal)};
    if (!(math::norm(along) > kAlong)) continue;
    planes.add(along);
    ways += along * math::dot(normal, middle_[s] + swept[s] - place.loaded);
  }
  double values[3];
  Vec3 axes[3];
  planes.solve(values, axes);
  const double largest = std::max({values[0], values[1], values[2]});
  Vec3 way{};
  for (int k = 0; k < 3 && largest > 0.0; ++k)
    if (values[k] > kCrossing * largest) way += axes[k] * (math::dot(axes[k], ways) / values[k]);
  if (const double far = math::norm(way); far > kFurthest * size_) way = way * (kFurthest * size_ / far);
  place.moved += way;
}

void CutSurface::follow(const std::vector<std::uint8_t>& open, const std::vector<Vec3>& swept,
                        const std::vector<std::uint32_t>& corner_of, const TissueSolid& solid, TissueGrid& grid) {
  for (Place& place : places_)
    for (std::size_t i = 0; i < place.seams; ++i)
      if (const std::uint32_t s = seams_[place.first_seam + i]; open[s] != known_[s]) {
        move(place, open, swept);
        break;
      }
  known_ = open;
  // The elements that hang together at a corner carry its place as one: no crack opens between them.
  std::fill(min_weight_.begin(), min_weight_.end(), -std::numeric_limits<double>::infinity());
  for (std::uint32_t slot = 0; slot < loaded_.size(); ++slot) {
    const Place& place = places_[loaded_[slot]];
    if (!place.away) continue;
    const auto element = static_cast<std::uint32_t>(slot / sides_);
    const auto weight = weights_in(grid, solid.corners_of(element), sides_, place.moved);
    const double least = std::min({weight[0], weight[1], weight[2], sides_ == 4 ? weight[3] : 1.0});
    const std::uint32_t corner = corner_of[slot];
    if (least > min_weight_[corner] + kLone) min_weight_[corner] = least, best_[corner] = element;
  }
  for (std::size_t i = 0; i < grid.points.size(); ++i) {
    TissuePoint& point = grid.points[i];
    const std::uint32_t home = home_[i];
    if (place_[i] == kNone || !places_[place_[i]].away) {
      point.weight = weight_[i];
      if (sides_ == 3)
        point.corner.fill(corner_of[home]);
      else
        std::copy_n(solid.corners_of(point.element), 4, point.corner.begin());
      continue;
    }
    const std::uint32_t* corner = solid.corners_of(home == kNone ? point.element : best_[corner_of[home]]);
    point.weight = weights_in(grid, corner, sides_, places_[place_[i]].moved);
    point.corner = {corner[0], corner[1], corner[2], corner[sides_ == 4 ? 3 : 0]};
  }
}

}  // namespace ambf::physics::detail
