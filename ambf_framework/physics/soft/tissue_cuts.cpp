#include "physics/soft/detail/tissue_cuts.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ambf::physics::detail {

using math::Vec3;

namespace {

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
constexpr double kNearest = 1e-9;  // elements, from a middle to a plane: nearer ones would lose their direction
constexpr double kFurthest = 1e3;  // mean elements, likewise, in a saved state: no cut's, however uneven the mesh is

}  // namespace

void TissueSolid::make_room(std::size_t corners) {
  for (auto* room : {&rest_, &x_, &v_, &force_, &change_, &residual_, &direction_, &product_}) room->reserve(corners);
  if (sheet_.triangle_count() > 0) lightness_.reserve(corners);
  mass_.reserve(corners);
  fixed_.reserve(corners);
  next_fixed_.reserve(corners);
}

// The rooms of the solver hold what corners become.
void TissueSolid::renumber(const std::vector<std::uint32_t>& corner_of, std::size_t count) {
  for (auto* room : {&product_, &direction_, &residual_}) room->assign(count, Vec3{});
  next_fixed_.assign(count, 0);
  mass_.assign(count, 0.0);
  const auto move = [&](std::size_t slot, std::uint32_t& corner, double mass) {
    const std::uint32_t now = corner_of[slot];
    product_[now] = x_[corner];
    direction_[now] = v_[corner];
    residual_[now] = rest_[corner];
    next_fixed_[now] = fixed_[corner];
    mass_[now] += mass;
    corner = now;
  };
  for (std::size_t e = 0; e < hot_.size(); ++e)
    for (std::size_t k = 0; k < 4; ++k) move(4 * e + k, hot_[e].corner[k], 0.25 * cold_[e].mass);
  sheet_.each_corner(move);
  if (!lightness_.empty()) lightness_.resize(count);
  x_.swap(product_);
  v_.swap(direction_);
  rest_.swap(residual_);
  fixed_.swap(next_fixed_);
  for (auto* room : {&force_, &change_, &residual_, &direction_, &product_}) room->assign(count, Vec3{});
}

TissueCuts::TissueCuts(TissueGrid& grid, TissueSolid& solid, std::size_t max_corners) : grid_(grid), solid_(solid) {
  for (std::uint32_t i = 0; i < grid.corners.size(); ++i) origin_.push_back(i);
  if (grid.seams.empty()) return;
  for (const TissueElement& element : grid.elements)
    loaded_.insert(loaded_.end(), element.corner.begin(), element.corner.end());
  for (const TissueTriangle& triangle : grid.triangles)
    loaded_.insert(loaded_.end(), triangle.corner.begin(), triangle.corner.end());
  if (!grid.triangles.empty()) sides_ = 3, shared_ = 2;
  const std::size_t slots = loaded_.size();
  // No more than every element by itself.
  max_corners_ = std::min(max_corners, slots);
  rest_ = grid.corners;
  parent_.resize(slots);
  number_.resize(slots);
  corner_of_.resize(slots);
  used_.resize(rest_.size());
  origin_.reserve(std::max(max_corners_, rest_.size()));
  open_.assign(grid.seams.size(), 0);
  wanted_ = open_;
  swept_.resize(open_.size());
  wanted_swept_ = swept_;
  if (!connect(open_)) {
    open_.clear();
    return;
  }
  solid.make_room(max_corners_);
  surface_.emplace(grid, loaded_, max_corners_);
  grid.corners.reserve(max_corners_);
  shown_.assign(grid.points.size(), 0);
  use();
}

std::size_t TissueCuts::open_count() const {
  return static_cast<std::size_t>(std::count(open_.begin(), open_.end(), std::uint8_t{1}));
}

std::uint32_t TissueCuts::root(std::uint32_t slot) {
  while (parent_[slot] != slot) slot = parent_[slot] = parent_[parent_[slot]];
  return slot;
}

void TissueCuts::unite(std::uint32_t a, std::uint32_t b) {
  a = root(a), b = root(b);
  parent_[std::max(a, b)] = std::min(a, b);
}

// Numbers the corners that there are when these seams are open; the first of those at one place keeps its number.
bool TissueCuts::connect(const std::vector<std::uint8_t>& open) {
  for (std::uint32_t i = 0; i < parent_.size(); ++i) parent_[i] = i;
  for (std::size_t s = 0; s < grid_.seams.size(); ++s) {
    if (open[s] != 0) continue;
    const TissueSeam& seam = grid_.seams[s];
    const auto slot = [&](std::size_t side, std::size_t k) {
      return static_cast<std::uint32_t>(sides_ * seam.element[side] + seam.corner[side][k]);
    };
    for (std::size_t k = 0; k < shared_; ++k) unite(slot(0, k), slot(1, k));
  }
  std::fill(number_.begin(), number_.end(), kNone);
  std::fill(used_.begin(), used_.end(), std::uint8_t{0});
  std::size_t count = rest_.size();
  for (std::uint32_t slot = 0; slot < parent_.size(); ++slot) {
    const std::uint32_t top = root(slot), corner = loaded_[slot];
    if (number_[top] == kNone) {
      number_[top] = used_[corner] != 0 ? static_cast<std::uint32_t>(count++) : corner;
      used_[corner] = 1;
    }
    corner_of_[slot] = number_[top];
  }
  if (count > max_corners_) return false;
  count_ = count;
  return true;
}

// As connect() numbered them.
void TissueCuts::use() {
  solid_.renumber(corner_of_, count_);
  solid_.part_at(grid_.seams, open_);
  origin_.resize(count_);
  grid_.corners.resize(count_);
  for (std::size_t slot = 0; slot < corner_of_.size(); ++slot) {
    const std::uint32_t corner = loaded_[slot];
    origin_[corner_of_[slot]] = corner;
    grid_.corners[corner_of_[slot]] = rest_[corner];
  }
  surface_->follow(open_, swept_, corner_of_, solid_, grid_);
  if (sides_ == 3) {
    for (std::uint32_t slot = 0; slot < corner_of_.size(); ++slot)
      shown_[grid_.faces[slot / 3][slot % 3]] = root(slot) == slot ? 1 : 0;
    return;
  }
  std::fill(shown_.begin(), shown_.begin() + static_cast<std::ptrdiff_t>(grid_.first_inner_point), std::uint8_t{1});
  std::fill(shown_.begin() + static_cast<std::ptrdiff_t>(grid_.first_inner_point), shown_.end(), std::uint8_t{0});
  for (std::size_t s = 0; s < open_.size(); ++s) {
    if (open_[s] == 0) continue;
    for (std::size_t side = 0; side < 2; ++side)
      for (const std::uint32_t point : grid_.faces[grid_.first_inner_face + 2 * s + side]) shown_[point] = 1;
  }
}

Vec3 TissueCuts::middle(std::size_t element) const {
  Vec3 sum{};
  for (std::size_t k = 0; k < sides_; ++k) sum += rest_[loaded_[sides_ * element + k]];
  return sum / static_cast<double>(sides_);
}

bool TissueCuts::is_on_cut(std::size_t point) const {
  return surface_ && surface_->is_away(point) && shows_point(point);
}

void TissueCuts::mark(std::size_t seam, const Vec3& at, const Vec3& normal) {
  if (open_[seam] != 0 || wanted_[seam] != 0) return;
  wanted_[seam] = 1;
  const double far = math::dot(normal, at - middle(grid_.seams[seam].element[0]));
  const double least = kNearest * grid_.element_size;
  wanted_swept_[seam] = normal * (std::abs(far) > least ? far : least);
}

bool TissueCuts::apply() {
  bool any = false;
  for (std::size_t s = 0; s < open_.size(); ++s) {
    any = any || (wanted_[s] != 0 && open_[s] == 0);
    wanted_[s] = wanted_[s] != 0 || open_[s] != 0 ? 1 : 0;
  }
  if (!any) return false;
  if (!connect(wanted_)) {
    full_ = true;
    wanted_ = open_;
    wanted_swept_ = swept_;
    connect(open_);  // numbers as they were
    return false;
  }
  open_ = wanted_;
  swept_ = wanted_swept_;
  use();
  return true;
}

void TissueCuts::get_state(std::vector<double>& out) const {
  for (const Vec3& way : swept_) out.insert(out.end(), {way.x, way.y, way.z});
}

bool TissueCuts::put(const double* state) {
  bool fits = true;
  for (std::size_t s = 0; s < open_.size(); ++s) {
    const Vec3 way{state[3 * s], state[3 * s + 1], state[3 * s + 2]};
    wanted_swept_[s] = way;
    wanted_[s] = way == Vec3{} ? 0 : 1;
    fits = fits && math::norm(way) <= kFurthest * grid_.element_size;
  }
  fits = fits && connect(wanted_);
  if (fits) {
    open_ = wanted_;
    swept_ = wanted_swept_;
    surface_->look_at_all();
    use();
  } else {
    connect(open_);
  }
  wanted_ = open_;
  wanted_swept_ = swept_;
  return fits;
}

void TissueCuts::close() {
  full_ = false;
  if (open_.empty()) return;
  std::fill(open_.begin(), open_.end(), std::uint8_t{0});
  std::fill(swept_.begin(), swept_.end(), Vec3{});
  wanted_ = open_;
  wanted_swept_ = swept_;
  connect(open_);
  use();
}

// Elements that hang together over closed seams. Allocates.
std::size_t TissueCuts::pieces() const {
  std::vector<std::uint32_t> above(loaded_.size() / sides_);
  for (std::uint32_t e = 0; e < above.size(); ++e) above[e] = e;
  const auto top = [&](std::uint32_t e) {
    while (above[e] != e) e = above[e];
    return e;
  };
  std::size_t count = above.size();
  for (std::size_t s = 0; s < open_.size(); ++s) {
    if (open_[s] != 0) continue;
    const std::uint32_t a = top(grid_.seams[s].element[0]), b = top(grid_.seams[s].element[1]);
    if (a == b) continue;
    above[std::max(a, b)] = std::min(a, b);
    --count;
  }
  return open_.empty() ? 1 : count;
}

}  // namespace ambf::physics::detail
