// Surfaces of tissue that touch: the lips of a cut, of a wound, and other tissues. A point behind a face is pushed out
// of it by a spring of the step's solve, and rubs on it. Between parts of one tissue both ends are in the solve. Of two
// tissues each has the other as a wall that moves as that does now: one after the other they come to agree.
#include <algorithm>
#include <cmath>

#include "physics/soft/detail/near_shape.h"
#include "physics/soft/detail/tip_faces.h"
#include "physics/soft/detail/touch_search.h"

namespace ambf::physics {
namespace detail {

using math::Vec3;

namespace {

constexpr double kFacing = -0.25;     // cosine: a point whose normal is less against the face's does not touch it
constexpr double kCalming_s = 0.003;  // as in contacts with bodies (tissue_step.cpp)
constexpr auto kNone = kNoCorner;

}  // namespace

std::uint32_t corner_at(const TissueData& tissue, std::uint32_t point) {
  if (tissue.cuts.possible()) return tissue.cuts.corner_at(point);
  const std::uint8_t lone = tissue.touch.lone[point];
  return lone == TouchRooms::kNoLone ? kNone : tissue.grid.points[point].corner[lone];
}

std::uint32_t stands_for(const TissueData& tissue, std::uint32_t point) {
  const std::uint32_t corner = corner_at(tissue, point);
  return corner == kNone ? point : tissue.touch.at_corner[corner];
}

void count(TissueData& tissue) {
  TouchRooms& rooms = tissue.touch;
  if (rooms.counted == tissue.moves) return;
  rooms.counted = tissue.moves;
  tissue.find_bounds();
  std::fill(rooms.normal.begin(), rooms.normal.end(), btVector3(0, 0, 0));
  std::fill(rooms.area.begin(), rooms.area.end(), 0.0);
  std::fill(rooms.at_corner.begin(), rooms.at_corner.end(), kNone);
  for (auto i = static_cast<std::uint32_t>(tissue.at.size()); i-- > 0;)
    if (const std::uint32_t corner = corner_at(tissue, i); corner != kNone && tissue.cuts.shows_point(i))
      rooms.at_corner[corner] = i;
  for (std::uint32_t f = 0; f < tissue.grid.faces.size(); ++f) {
    if (!tissue.cuts.shows_face(f)) continue;
    const auto& face = tissue.grid.faces[f];
    const btVector3& a = tissue.at[face[0]];
    const btVector3 normal = (tissue.at[face[1]] - a).cross(tissue.at[face[2]] - a);
    const double share = normal.length() / 6.0;
    for (const std::uint32_t point : face) {
      const std::uint32_t first = stands_for(tissue, point);
      rooms.normal[first] += normal;
      rooms.area[first] += share;
    }
  }
  for (btVector3& normal : rooms.normal)
    if (const double length = normal.length(); length > 0.0) normal /= length;
  rooms.cells.sort(tissue.at, tissue.grid.element_size, [&](std::uint32_t i) { return rooms.area[i] > 0.0; });
}

namespace {

// What looks for the faces that points are behind.
struct Search {
  Search(TissueData& of, const TissueData& others, bool may_hang)
      : points(of), faces(others), hangs(may_hang), reach(of, others) {}

  TissueData& points;
  const TissueData& faces;
  bool hangs;  // points and faces may hang together
  Reach reach;
  // Of one face.
  std::uint32_t face = 0;
  btVector3 a, ab, ac, area, normal, from, to;  // `from` and `to`: the box in which points may touch it
  Vec3 out;
  double square = 0.0, plane = 0.0;

  // False: it has no area.
  bool begin(std::uint32_t f) {
    face = f;
    if (faces.is_sheet() && faces.touch.rims.is_flat(f)) return false;
    const auto& corner = faces.grid.faces[f];
    a = faces.at[corner[0]];
    const btVector3 &b = faces.at[corner[1]], &c = faces.at[corner[2]];
    ab = b - a, ac = c - a, area = ab.cross(ac);
    square = area.length2();
    if (!(square > 0.0)) return false;
    normal = area / std::sqrt(square);
    enclose(f);
    out = from_bullet(normal);
    plane = normal.dot(a);
    return true;
  }
  void enclose(std::uint32_t f) {
    const auto& corner = faces.grid.faces[f];
    const btVector3 around(reach.deepest, reach.deepest, reach.deepest);
    from = to = faces.at[corner[0]];
    for (std::size_t k = 1; k < 3; ++k) from.setMin(faces.at[corner[k]]), to.setMax(faces.at[corner[k]]);
    from -= around, to += around;
  }
  // Leaves of the box what may hold points; false: nothing, or what is too far from the face's plane.
  bool clip(const btVector3& low, const btVector3& high) {
    from.setMax(low), to.setMin(high);
    if (!(from.x() <= to.x() && from.y() <= to.y() && from.z() <= to.z())) return false;
    const double middle = 0.5 * normal.dot(from + to) - plane, half = 0.5 * normal.absolute().dot(to - from);
    const bool sheet = faces.is_sheet();
    const double before = sheet ? std::max(reach.away, reach.deepest - reach.away) : reach.away;
    return middle - half <= before && middle + half >= (sheet ? -before : reach.away - reach.deepest);
  }
  // On which side of a sheet's face a point is: of a solid by the way that it faces, of a sheet where it was when they
  // touched first.
  bool is_in_front(std::uint32_t i, double before) const {
    if (!faces.is_sheet()) return true;
    if (!points.is_sheet()) return normal.dot(points.touch.normal[i]) < 0.0;
    const TouchRooms::Hold& hold = points.touch.holds[i];
    return hold.of == &faces && !hold.rim ? hold.front : before > 0.0;
  }
  // Of each point the face that it is the least behind: where the way back, against its own normal, meets their
  // surface. A surface of facets has no jumps along that.
  void look(std::uint32_t i, const Vec3& at) {
    const double before = math::dot(out, at) - plane;
    const bool front = is_in_front(i, before);
    const double behind = reach.away - (front ? before : -before);
    if (!(behind > 0.0 && behind < reach.deepest)) return;
    TouchRooms& rooms = points.touch;
    if (rooms.behind[i].rim) return;
    const btVector3 toward = front ? normal : -normal, back = points.is_sheet() ? -toward : rooms.normal[i];
    const double facing = toward.dot(back);
    if (!(facing < kFacing)) return;
    const double way = -behind / facing;
    TouchRooms::Behind& best = rooms.behind[i];
    if (!(way < reach.deepest) || (best.full == 1.0 && !(way < best.way))) return;
    const btVector3 off = points.at[i] - back * way - a;
    const double at_b = off.cross(ac).dot(area) / square, at_c = ab.cross(off).dot(area) / square;
    const std::array<double, 3> share{1.0 - at_b - at_c, at_b, at_c};
    double least = std::min({at_b, at_c, share[0]});
    const bool beside = &points == &faces && faces.is_sheet() && is_beside(faces, face, i, std::abs(before), reach);
    if (beside && !comes_over(faces, face, i, behind, share, reach, least)) return;
    const double full = std::min(1.0, 1.0 + least / Reach::kBeside);
    if (!(full > 0.0) || full < best.full || (full == best.full && !(way < best.way))) return;
    if (hangs && hang_together(points, face, i)) return;
    best = {face, front, way, behind, full, share, toward, false, beside};
  }
};

// Of all points and all faces.
void find_behind(TissueData& points, const TissueData& faces) {
  TouchRooms& rooms = points.touch;
  for (TouchRooms::Behind& each : rooms.behind) each.full = 0.0, each.rim = false;
  const btVector3 low = points.low, high = points.high;
  const bool itself = &points == &faces;
  Search search(points, faces, itself);
  if (itself && faces.is_sheet()) {
    for (TouchRooms::NearRim& each : rooms.near_rims) each = {};
    for (std::uint32_t f = 0; f < faces.grid.faces.size(); ++f) {
      if (!rooms.rims.any_faces_out(f)) continue;
      search.enclose(f);
      rooms.cells.each_near(search.from, search.to, [&](const PointCells::Sorted& each) {
        if (!hang_together(points, f, each.point)) look_at_rims(points, f, each.point, search.reach);
      });
    }
    for (std::uint32_t i = 0; i < points.at.size(); ++i) choose_rim(points, i, search.reach);
  }
  for (std::uint32_t f = 0; f < faces.grid.faces.size(); ++f) {
    if (!faces.cuts.shows_face(f) || !search.begin(f) || !search.clip(low, high)) continue;
    rooms.cells.each_near(search.from, search.to,
                          [&](const PointCells::Sorted& each) { search.look(each.point, each.at); });
  }
}

// Of those points and faces of one tissue that may touch (touch_pairs.cpp).
void find_behind_itself(TissueData& tissue) {
  TouchRooms& rooms = tissue.touch;
  for (const std::uint32_t point : rooms.paired_points) rooms.behind[point].full = 0.0, rooms.behind[point].rim = false;
  Search search(tissue, tissue, false);
  if (tissue.is_sheet()) {
    for (const std::uint32_t point : rooms.paired_points) rooms.near_rims[point] = {};
    for (const TouchRooms::Pair& pair : rooms.pairs)
      if (rooms.rims.any_faces_out(pair.face)) look_at_rims(tissue, pair.face, pair.point, search.reach);
    for (const std::uint32_t point : rooms.paired_points) choose_rim(tissue, point, search.reach);
  }
  std::uint32_t face = kNone;
  bool begun = false;
  for (const TouchRooms::Pair& pair : rooms.pairs) {
    if (pair.face != face) begun = search.begin(face = pair.face);
    const btVector3& at = tissue.at[pair.point];
    if (begun && Box{search.from, search.to}.contains(at)) search.look(pair.point, from_bullet(at));
  }
}

Vec3 velocity_of(const TissueData& tissue, const TissuePoint& point) {
  return tissue.stepped ? Vec3{} : tissue.solid.velocity(point);
}

// Where a point would be on a face if it were moved along a direction, as shares of the face's corners.
std::array<double, 3> shares_at(const TissueData& faces, std::uint32_t face, const btVector3& at,
                                const btVector3& along) {
  const auto& corner = faces.grid.faces[face];
  const btVector3 &a = faces.at[corner[0]], ab = faces.at[corner[1]] - a, ac = faces.at[corner[2]] - a;
  const btVector3 area = ab.cross(ac), off = at - a;
  const btVector3 on = off - along * (off.dot(area) / along.dot(area));
  const double at_b = on.cross(ac).dot(area) / area.length2(), at_c = ab.cross(on).dot(area) / area.length2();
  return {1.0 - at_b - at_c, at_b, at_c};
}

// Friction as a spring back to where the point sticks on a face, which gives way beyond its limit (EQUATIONS 17).
void add_friction(TissueData& points, const TissueData& faces, std::size_t i, const Vec3& rate, double limit,
                  double stiffness, double h, TissueTouch& touch) {
  TouchRooms::Hold& hold = points.touch.holds[i];
  const TouchRooms::Behind& behind = points.touch.behind[i];
  const btVector3 normal = to_bullet(touch.normal);
  const auto hold_at = [&](const btVector3& at) {
    if (behind.rim) return hold_at_rim(faces, static_cast<std::uint32_t>(i), at);
    const bool entering = behind.entering && behind.full < 1.0;
    return TouchRooms::Hold{&faces,       behind.face, shares_at(faces, behind.face, at, normal),
                            behind.front, false,       entering};
  };
  if (hold.of != &faces || hold.rim != behind.rim) hold = hold_at(points.at[i]);
  hold.entering = hold.entering && behind.entering && behind.full < 1.0;
  btVector3 away = points.at[i] - place_of(faces, hold);
  away -= normal * away.dot(normal);
  if (const double size = away.length(); stiffness * size > limit) {
    away *= limit / (stiffness * size);
    hold = hold_at(points.at[i] - away);
  }
  const Vec3 back = from_bullet(away), after = back + (rate - touch.normal * math::dot(touch.normal, rate)) * h;
  const double force = stiffness * math::norm(after);
  touch.side_stiffness = force > limit ? stiffness * limit / force : stiffness;
  touch.pull -= back * touch.side_stiffness;
}

// Springs of `tissue`, which is one of the two or both, for what find_behind() found.
void add(TissueData& tissue, TissueData& points, const TissueData& faces, double h,
         const std::vector<std::uint32_t>* some = nullptr) {
  const double layers = points.slab * faces.slab / (points.slab + faces.slab),
               friction = points.friction * faces.friction;
  std::vector<TissueTouch>& made = tissue.touch.made;
  const std::size_t count = some == nullptr ? points.touch.behind.size() : some->size();
  for (std::size_t n = 0; n < count; ++n) {
    const std::size_t i = some == nullptr ? n : (*some)[n];
    const TouchRooms::Behind& behind = points.touch.behind[i];
    if (!(behind.full > 0.0)) {
      if (points.touch.holds[i].of == &faces) points.touch.holds[i].of = nullptr;
      continue;
    }
    if (made.size() == made.capacity()) {
      tissue.touch.left_out = true;
      return;
    }
    const auto& face = faces.grid.faces[behind.face];
    const btVector3& normal = behind.normal;
    TissueTouch touch;
    touch.within = &points == &faces;
    touch.place = from_bullet(points.at[i]);
    touch.normal = from_bullet(normal);
    TissueTouch other;
    Vec3 own{}, others{};  // velocities of the point from the face, as far as they are in the solve and not
    const auto add_end = [&](const TissueData& of, const TissuePoint& point, double share) {
      (&of == &tissue ? own : others) += velocity_of(of, point) * share;
      (&of == &tissue ? touch : other).add(point, share);
    };
    add_end(points, points.grid.points[i], 1.0);
    // Where it makes no torque between the two.
    const std::array<double, 3> share = behind.rim ? behind.share : shares_at(faces, behind.face, points.at[i], normal);
    for (std::size_t k = 0; k < 3; ++k) add_end(faces, faces.grid.points[face[k]], -share[k]);
    const double stiffness = layers * points.touch.area[i] * behind.full;
    const double push = stiffness * behind.depth;
    touch.normal_stiffness = stiffness * (1.0 + kCalming_s / h);
    const Vec3 rate = own + others;
    // As it leaves it is not held back, and still met if it comes back within the step: or it trembles.
    if (const double leaves = h * math::dot(touch.normal, rate); touch.normal_stiffness * leaves > push)
      touch.normal_stiffness = push / leaves;
    touch.pull = touch.normal * push;
    touch.push = push;
    touch.friction = friction;
    add_friction(points, faces, i, rate, friction * push, stiffness, h, touch);
    touch.pull -= touch.holding_back(others) * h;
    made.push_back(touch);
    if (tissue.is_sheet()) tissue.touch.felt.push_back({nullptr, other});
  }
}

}  // namespace

void add_touches(TissueData& tissue, double h) {
  if (!tissue.touch.itself) return;
  if (pair_up(tissue, Reach(tissue, tissue).deepest)) {
    find_behind_itself(tissue);
    add(tissue, tissue, tissue, h, &tissue.touch.paired_points);
    return;
  }
  count(tissue);
  find_behind(tissue, tissue);
  add(tissue, tissue, tissue, h);
}

void add_touches(TissueData& tissue, TissueData& other, double h) {
  if (!tissue.touch.others || !other.touch.others) return;
  if (!groups_meet(tissue.collision_groups, other.collision_groups)) return;
  if (other.is_sheet() && !tissue.is_sheet()) return;  // in the sheet's step
  other.find_bounds();
  if (!Box{tissue.low, tissue.high}.overlaps(other.low, other.high)) {
    tissue.touch.let_go(&other);
    if (tissue.is_sheet()) other.touch.let_go(&tissue);
    return;
  }
  count(tissue);
  count(other);
  const std::size_t first = tissue.touch.made.size();
  find_behind(tissue, other);
  add(tissue, tissue, other, h);
  find_behind(other, tissue);
  add(tissue, other, tissue, h);
  add_edge_touches(tissue, other, h);
  if (tissue.is_sheet() && !other.is_sheet()) lay_on(tissue, other, first, h);
}

}  // namespace detail

std::size_t Tissue::touches() const { return tissue_->touch.made.size() - tissue_->tips.made.size(); }

}  // namespace ambf::physics
