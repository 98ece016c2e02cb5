// Edges of two tissues that cross between nodes: a rim of a sheet over another's rim or fold, or over a ridge of a
// solid, and ridges of solids. Where two lines are nearest each other a spring along the normal of both keeps them on
// their sides, and one across it is friction. A ridge pushes out of its solid. Sheets have no outside: their edges stay
// on the side that they came from, which is known from before they touch.
#include <algorithm>
#include <cmath>

#include "physics/soft/detail/near_shape.h"
#include "physics/soft/detail/point_cells.h"
#include "physics/soft/detail/touch_search.h"

namespace ambf::physics::detail {

using math::Vec3;

namespace {

constexpr double kCalming_s = 0.003;  // as in contacts with bodies (tissue_step.cpp)
constexpr double kTributary = 0.5;    // of an element's square: what a crossing bears
constexpr double kBeyond = 0.1;       // of an edge, beyond its ends: there its push fades
constexpr double kHalf = 0.75;        // of the longest edge as loaded: from its middle, when it is stretched by a half
// What fades in from the first on and is full from the second on: by the sine between edges, by the cosine from a
// ridge's outside to the way of the push, by the sine by which a sheet is bent.
struct Fades {
  double from, to;
  double operator()(double value) const { return std::clamp((value - from) / (to - from), 0.0, 1.0); }
};
constexpr Fades kAcross{0.1, 0.3}, kOutwards{0.35, 0.55}, kBent{0.2, 0.4};

enum class Kind { rims, bent, rims_and_bent, all, ridges };

btVector3 area_of(const TissueData& tissue, std::uint32_t face) {
  const auto& corner = tissue.grid.faces[face];
  const btVector3& a = tissue.at[corner[0]];
  return (tissue.at[corner[1]] - a).cross(tissue.at[corner[2]] - a);
}

// Of a solid's ridge: between both faces.
btVector3 outside_of(const TissueData& solid, const TouchEdges::Edge& edge) {
  const btVector3 a = area_of(solid, edge.face), b = area_of(solid, edge.mate);
  const double square_a = a.length2(), square_b = b.length2();
  if (!(square_a > 0.0 && square_b > 0.0)) return {0, 0, 0};
  const btVector3 sum = a / std::sqrt(square_a) + b / std::sqrt(square_b);
  return sum.length2() > 0.0 ? sum.normalized() : sum;
}

// 0 to 1, of a sheet's edge: by how much the triangles at it are not in one plane.
double bend_of(const TissueData& sheet, const TouchEdges::Edge& edge) {
  const btVector3& from = sheet.at[edge.point[0]];
  const btVector3 along = sheet.at[edge.point[1]] - from;
  const double square = along.length2();
  if (!(square > 0.0)) return 0.0;
  const auto across = [&](std::uint32_t face, std::uint8_t opposite) {
    const btVector3 off = sheet.at[sheet.grid.faces[face][opposite]] - from;
    return btVector3(off - along * (off.dot(along) / square));
  };
  const btVector3 a = across(edge.face, edge.opposite), b = across(edge.mate, edge.mate_opposite);
  const double sizes = std::sqrt(a.length2() * b.length2());
  if (!(sizes > 0.0)) return 0.0;
  const double cosine = -a.dot(b) / sizes;
  return cosine < 0.0 ? 1.0 : kBent(std::sqrt(std::max(0.0, 1.0 - cosine * cosine)));
}

bool is_of(const TissueData& tissue, const TouchEdges::Edge& edge, Kind kind) {
  if (!tissue.cuts.shows_face(edge.face)) return false;
  if (kind == Kind::ridges) return true;
  if (tissue.touch.rims.is_rim(edge.face, edge.opposite))
    return kind != Kind::bent && tissue.touch.rims.faces_out(edge.face, edge.opposite);
  if (edge.second || kind == Kind::rims) return false;
  return kind == Kind::all || bend_of(tissue, edge) > 0.0;
}

Box box_around(const TissueData& tissue, const TouchEdges::Edge& edge, double more) {
  btVector3 low = tissue.at[edge.point[0]], high = low;
  low.setMin(tissue.at[edge.point[1]]), high.setMax(tissue.at[edge.point[1]]);
  const btVector3 around(more, more, more);
  return {low - around, high + around};
}

// Of edges of both, of these kinds, those whose boxes are no further apart than `reach`: look(few, many), sorted by
// many and then by few.
template <class Look>
void each_near_pair(TissueData& tissue, const TissueData& few, Kind few_kind, const TissueData& many, Kind many_kind,
                    double reach, const Look& look) {
  TouchEdges& rooms = tissue.touch.edges;
  rooms.few.clear();
  const btVector3 around(reach, reach, reach);
  const btVector3 low = many.low - around, high = many.high + around;
  btVector3 from(SIMD_INFINITY, SIMD_INFINITY, SIMD_INFINITY), to = -from;
  double most = 0.0;  // m, along an axis
  for (std::uint32_t i = 0; i < few.touch.edges.edges.size(); ++i) {
    const TouchEdges::Edge& edge = few.touch.edges.edges[i];
    const Box box = box_around(few, edge, 0.0);
    if (!box.overlaps(low, high) || !is_of(few, edge, few_kind)) continue;
    if (rooms.few.size() == rooms.few.capacity()) {
      tissue.touch.left_out = true;
      break;
    }
    rooms.few.push_back(i);
    from.setMin(box.low), to.setMax(box.high);
    const btVector3 size = box.high - box.low;
    most =
        std::max({most, static_cast<double>(size.x()), static_cast<double>(size.y()), static_cast<double>(size.z())});
  }
  if (rooms.few.empty()) return;
  // A cell is no smaller than what is around an edge: that is in eight of them at most.
  const double more = reach + kHalf * many.touch.edges.longest, size = most + 2.0 * more;
  from -= around, to += around;
  const auto each_slot = [&](std::uint32_t i, const auto& use) {
    const Box box = box_around(few, few.touch.edges.edges[i], more);
    for (int z = cell_of(box.low.z(), size); z <= cell_of(box.high.z(), size); ++z)
      for (int y = cell_of(box.low.y(), size); y <= cell_of(box.high.y(), size); ++y)
        for (int x = cell_of(box.low.x(), size); x <= cell_of(box.high.x(), size); ++x)
          use(slot_of(x, y, z, TouchEdges::kSlots));
  };
  std::fill(rooms.first.begin(), rooms.first.end(), 0U);
  for (const std::uint32_t i : rooms.few) each_slot(i, [&](std::size_t slot) { ++rooms.first[slot]; });
  for (std::size_t k = 1; k < rooms.first.size(); ++k) rooms.first[k] += rooms.first[k - 1];
  if (rooms.first.back() > rooms.in_cell.size()) return;  // what is not finite has diverged
  for (std::size_t k = rooms.few.size(); k-- > 0;)
    each_slot(rooms.few[k], [&](std::size_t slot) { rooms.in_cell[--rooms.first[slot]] = rooms.few[k]; });
  for (std::uint32_t i = 0; i < many.touch.edges.edges.size(); ++i) {
    const TouchEdges::Edge& edge = many.touch.edges.edges[i];
    const Box box = box_around(many, edge, reach);
    if (!box.overlaps(from, to)) continue;
    const btVector3 at = (many.at[edge.point[0]] + many.at[edge.point[1]]) * 0.5;
    const std::size_t slot =
        slot_of(cell_of(at.x(), size), cell_of(at.y(), size), cell_of(at.z(), size), TouchEdges::kSlots);
    const std::uint32_t begin = rooms.first[slot], end = rooms.first[slot + 1];
    if (begin == end || !is_of(many, edge, many_kind)) continue;
    for (std::uint32_t k = begin; k < end; ++k) {
      const std::uint32_t other = rooms.in_cell[k];
      if (k > begin && rooms.in_cell[k - 1] == other) continue;  // two of its cells are in one slot
      const Box near = box_around(few, few.touch.edges.edges[other], 0.0);
      if (box.overlaps(near.low, near.high)) look(other, i);
    }
  }
}

// Two edges of which the lines are nearest each other between their ends, or little beyond.
struct Crossing {
  btVector3 own_way, others_way, normal;
  double own_place = 0.0, others_place = 0.0, distance = 0.0, full = 0.0;

  // False: they are not.
  bool find(const TissueData& own, const TouchEdges::Edge& a, const TissueData& other, const TouchEdges::Edge& b) {
    const btVector3 &from = own.at[a.point[0]], &others_from = other.at[b.point[0]];
    own_way = own.at[a.point[1]] - from;
    others_way = other.at[b.point[1]] - others_from;
    const btVector3 off = from - others_from, across = own_way.cross(others_way);
    const double aa = own_way.length2(), ab = own_way.dot(others_way), bb = others_way.length2();
    const double square = across.length2();
    if (!(square > kAcross.from * kAcross.from * aa * bb)) return false;
    const double ao = own_way.dot(off), bo = others_way.dot(off);
    own_place = (ab * bo - bb * ao) / square;
    others_place = (aa * bo - ab * ao) / square;
    const double least = std::min({own_place, 1.0 - own_place, others_place, 1.0 - others_place});
    if (!(least > -kBeyond)) return false;
    normal = across / std::sqrt(square);
    distance = normal.dot(off);
    full = kAcross(std::sqrt(square / (aa * bb))) * std::min(1.0, 1.0 + least / kBeyond);
    return true;
  }
  void turn() {
    normal = -normal;
    distance = -distance;
  }
};

class EdgeTouches {
 public:
  EdgeTouches(TissueData& tissue, TissueData& other, double h)
      : own_(tissue), other_(other), h_(h), reach_(tissue, other), rooms_(tissue.touch.edges) {
    const double size = std::min(own_.grid.element_size, other_.grid.element_size);
    stiffness_ = own_.slab * other_.slab / (own_.slab + other_.slab) * kTributary * size * size;
    friction_ = own_.friction * other_.friction;
    const auto is_before = [&](const TouchEdges::Pair& pair) { return pair.other == &other_; };
    first_ = std::find_if(rooms_.last.cbegin(), rooms_.last.cend(), is_before);
    end_ = std::find_if_not(first_, rooms_.last.cend(), is_before);
  }

  void look(std::uint32_t own, std::uint32_t others, bool own_is_few) {
    const TouchEdges::Edge &a = own_.touch.edges.edges[own], &b = other_.touch.edges.edges[others];
    Crossing crossing;
    if (!crossing.find(own_, a, other_, b) || !(std::abs(crossing.distance) < reach_.deepest)) return;
    TouchEdges::Pair pair;
    pair.other = &other_, pair.own = own, pair.others = others, pair.own_is_few = own_is_few;
    if (!(own_.is_sheet() && other_.is_sheet()) && !turn_outwards(a, b, crossing)) return;
    const bool known = recall(a, b, crossing, pair);
    if (own_.is_sheet() && other_.is_sheet()) {
      if (!known) pair.above = crossing.distance > 0.0;
      if (!pair.above) crossing.turn();
      crossing.full *= own_is_few ? fold(other_, b) : fold(own_, a);
    }
    const double depth = reach_.away - crossing.distance;
    pair.touching = depth > 0.0 && depth < reach_.deepest && crossing.full > 0.0;
    if (!pair.touching) pair.held = false;
    if (pair.touching) add(a, b, crossing, depth, pair);
    if (rooms_.pairs.size() < rooms_.pairs.capacity())
      rooms_.pairs.push_back(pair);
    else
      own_.touch.left_out = true;
  }

 private:
  using Iterator = std::vector<TouchEdges::Pair>::const_iterator;

  static double fold(const TissueData& sheet, const TouchEdges::Edge& edge) {
    return sheet.touch.rims.is_rim(edge.face, edge.opposite) ? 1.0 : bend_of(sheet, edge);
  }
  // Of a ridge, the push is out of its solid. False: there it has none.
  bool turn_outwards(const TouchEdges::Edge& a, const TouchEdges::Edge& b, Crossing& crossing) const {
    const btVector3 zero(0, 0, 0), out_of_other = other_.is_sheet() ? zero : outside_of(other_, b),
                                   out_of_own = own_.is_sheet() ? zero : outside_of(own_, a);
    if (crossing.normal.dot(out_of_other - out_of_own) < 0.0) crossing.turn();
    if (!other_.is_sheet()) crossing.full *= kOutwards(crossing.normal.dot(out_of_other));
    if (!own_.is_sheet()) crossing.full *= kOutwards(-crossing.normal.dot(out_of_own));
    return crossing.full > 0.0;
  }
  // What is known of it: from the step before, of neighbours from which it slid here, or from the other's own step.
  bool recall(const TouchEdges::Edge& a, const TouchEdges::Edge& b, const Crossing& crossing,
              TouchEdges::Pair& pair) const {
    const auto found = std::lower_bound(
        first_, end_, pair.key(), [](const TouchEdges::Pair& each, std::uint64_t key) { return each.key() < key; });
    if (found != end_ && found->key() == pair.key()) {
      pair.above = found->above;
      pair.held = found->held;
      pair.own_place = found->own_place, pair.others_place = found->others_place;
      return true;
    }
    for (Iterator each = first_; each != end_; ++each)
      if (each->touching && is_beside(*each, a, b, pair)) {
        // The same side in space: both triples by how the neighbour's edges lie to these.
        const btVector3 was = way_of(own_, each->own).cross(way_of(other_, each->others)),
                        is = crossing.own_way.cross(crossing.others_way);
        pair.above = (was.dot(is) > 0.0) == each->above;
        return true;
      }
    for (const TouchEdges::Pair& each : other_.touch.edges.pairs)
      if (each.other == &own_ && each.own == pair.others && each.others == pair.own) {
        pair.above = each.above;
        return true;
      }
    return false;
  }
  static btVector3 way_of(const TissueData& tissue, std::uint32_t edge) {
    const auto& point = tissue.touch.edges.edges[edge].point;
    return tissue.at[point[1]] - tissue.at[point[0]];
  }
  bool is_beside(const TouchEdges::Pair& before, const TouchEdges::Edge& a, const TouchEdges::Edge& b,
                 const TouchEdges::Pair& pair) const {
    const auto meet = [](const TouchEdges::Edge& one, const TouchEdges::Edge& two) {
      return one.place[0] == two.place[0] || one.place[0] == two.place[1] || one.place[1] == two.place[0] ||
             one.place[1] == two.place[1];
    };
    return (before.own == pair.own || meet(own_.touch.edges.edges[before.own], a)) &&
           (before.others == pair.others || meet(other_.touch.edges.edges[before.others], b));
  }

  void add(const TouchEdges::Edge& a, const TouchEdges::Edge& b, const Crossing& crossing, double depth,
           TouchEdges::Pair& pair) {
    std::vector<TissueTouch>& made = own_.touch.made;
    if (made.size() == made.capacity()) {
      own_.touch.left_out = true;
      return;
    }
    TissueTouch touch, felt;
    Vec3 own{}, others{};
    const double on_own = std::clamp(crossing.own_place, 0.0, 1.0),
                 on_others = std::clamp(crossing.others_place, 0.0, 1.0);
    for (std::size_t end = 0; end < 2; ++end) {
      const TissuePoint &at = own_.grid.points[a.point[end]], &there = other_.grid.points[b.point[end]];
      const double share = end == 0 ? 1.0 - on_own : on_own, less = end == 0 ? on_others - 1.0 : -on_others;
      touch.add(at, share);
      felt.add(there, less);
      own += own_.solid.velocity(at) * share;
      if (!other_.stepped) others += other_.solid.velocity(there) * less;
    }
    const Vec3 rate = own + others;
    const double stiffness = stiffness_ * crossing.full, push = stiffness * depth;
    touch.within = false;
    touch.place = from_bullet(own_.at[a.point[0]] + crossing.own_way * on_own);
    touch.normal = from_bullet(crossing.normal);
    touch.normal_stiffness = stiffness * (1.0 + kCalming_s / h_);
    // As it leaves it is not held back, and still met if it comes back within the step: or it trembles.
    if (const double leaves = h_ * math::dot(touch.normal, rate); touch.normal_stiffness * leaves > push)
      touch.normal_stiffness = push / leaves;
    touch.pull = touch.normal * push;
    touch.push = push;
    touch.friction = friction_;
    rub(crossing, rate, friction_ * push, stiffness, pair, touch);
    touch.pull -= touch.holding_back(others) * h_;
    made.push_back(touch);
    if (own_.is_sheet()) own_.touch.felt.push_back({nullptr, felt});
  }
  // Friction as a spring back to where they stick, which gives way beyond its limit (EQUATIONS 17).
  void rub(const Crossing& crossing, const Vec3& rate, double limit, double stiffness, TouchEdges::Pair& pair,
           TissueTouch& touch) const {
    if (!pair.held) pair.own_place = crossing.own_place, pair.others_place = crossing.others_place;
    pair.held = true;
    double own = pair.own_place - crossing.own_place, others = pair.others_place - crossing.others_place;
    btVector3 away = crossing.own_way * own - crossing.others_way * others;
    if (const double size = away.length(); stiffness * size > limit) {
      const double left = limit / (stiffness * size);
      away *= left, own *= left, others *= left;
      pair.own_place = crossing.own_place + own, pair.others_place = crossing.others_place + others;
    }
    const Vec3 back = from_bullet(away), after = back + (rate - touch.normal * math::dot(touch.normal, rate)) * h_;
    const double force = stiffness * math::norm(after);
    touch.side_stiffness = force > limit ? stiffness * limit / force : stiffness;
    touch.pull -= back * touch.side_stiffness;
  }

  TissueData &own_, &other_;
  double h_;
  Reach reach_;
  TouchEdges& rooms_;
  double stiffness_ = 0.0, friction_ = 0.0;
  Iterator first_, end_;  // of `last`, with the other
};

}  // namespace

void add_edge_touches(TissueData& tissue, TissueData& other, double h) {
  EdgeTouches touches(tissue, other, h);
  const double reach = Reach(tissue, other).deepest;
  const auto few_is_own = [&](std::uint32_t few, std::uint32_t many) { touches.look(few, many, true); };
  const auto few_is_other = [&](std::uint32_t few, std::uint32_t many) { touches.look(many, few, false); };
  if (!tissue.is_sheet()) {
    each_near_pair(tissue, tissue, Kind::ridges, other, Kind::ridges, reach, few_is_own);
  } else if (!other.is_sheet()) {
    each_near_pair(tissue, other, Kind::ridges, tissue, Kind::all, reach, few_is_other);
  } else {
    each_near_pair(tissue, tissue, Kind::rims, other, Kind::rims_and_bent, reach, few_is_own);
    each_near_pair(tissue, other, Kind::rims, tissue, Kind::bent, reach, few_is_other);
  }
}

}  // namespace ambf::physics::detail
