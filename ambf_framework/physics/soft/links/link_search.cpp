// Which faces of tissue nodes of links are near, and which faces of nodes points of tissue.
#include <algorithm>
#include <cmath>

#include "physics/soft/detail/soft_data.h"
#include "physics/soft/detail/tip_faces.h"
#include "physics/soft/detail/touch_search.h"

namespace ambf::physics::detail {

namespace {

constexpr double kDeepest = 0.6;   // elements: what was found further within the tissue does not meet it
constexpr double kLost = 3.0;      // elements: nor does a node that was pushed in further
constexpr double kFacing = -0.25;  // cosine, of a node's last normal with the face that it touches now
constexpr double kOpposed = 0.25;  // cosine, of a face of nodes with the way that a point of a solid faces
constexpr double kFast = 0.25;     // elements in a step: what is as fast came in by a face that it moves against
constexpr double kFastest = 3.0;   // likewise: what is faster is not looked for all the way
constexpr double kCoarse = 0.75;   // elements: of larger faces of nodes points of tissue may be between the nodes

// Of the place on a facet that is the nearest to one, which is `off` from its first corner.
std::array<double, 3> nearest_on(const Facet& facet, const btVector3& off) {
  std::array<double, 3> share = facet.shares(off);
  if (share[0] >= 0.0 && share[1] >= 0.0 && share[2] >= 0.0) return share;
  const btVector3 corner[3] = {btVector3(0, 0, 0), facet.ab, facet.ac};
  double best = SIMD_INFINITY;
  for (std::size_t k = 0; k < 3; ++k) {  // on the edge from corner k to the next
    const std::size_t next = (k + 1) % 3;
    const btVector3 edge = corner[next] - corner[k];
    const double along = std::clamp((off - corner[k]).dot(edge) / edge.length2(), 0.0, 1.0);
    const double square = (off - corner[k] - edge * along).length2();
    if (!(square < best)) continue;
    best = square;
    share = {0.0, 0.0, 0.0};
    share[k] = 1.0 - along;
    share[next] = along;
  }
  return share;
}

// Around a face; `low` and `high`: and what is no further than `reach` from it, as far as that is within another box.
struct FaceBox {
  btVector3 own_low, own_high, low, high;

  FaceBox(const std::vector<btVector3>& at, const std::array<std::uint32_t, 3>& face)
      : own_low(at[face[0]]), own_high(own_low), low(own_low), high(own_low) {
    for (std::size_t k = 1; k < 3; ++k) own_low.setMin(at[face[k]]), own_high.setMax(at[face[k]]);
  }
  bool reaches(double reach, const btVector3& from, const btVector3& to) {
    const btVector3 more(reach, reach, reach);
    low = own_low - more, high = own_high + more;
    low.setMax(from), high.setMin(to);
    return low.x() <= high.x() && low.y() <= high.y() && low.z() <= high.z();
  }
};

struct Nodes {
  SoftData& links;
  const TissueData& tissue;
  double size, deepest;  // m

  btVector3 motion(std::size_t node) const { return links.now[node] - links.last_good[node]; }

  // Not on the far side of what is thin: a node stays on the side that it came from.
  bool may_touch(const Facet& facet, std::size_t node) const {
    if (const LinkHold* hold = links.hold_of(node, &tissue))
      return facet.normal.dot(hold->normal) * (hold->front ? 1.0 : -1.0) > kFacing;
    if (tissue.is_sheet()) return true;
    const btVector3 way = motion(node);
    return way.length2() < kFast * kFast * size * size || facet.normal.dot(way) < 0.0;
  }
  // `low` and `high`: around the face.
  void look(std::uint32_t face, const Facet& facet, const btVector3& low, const btVector3& high, std::size_t node) {
    NearFace& best = links.near_tissue[node];
    const btVector3& at = links.now[node];
    btVector3 beside = at;
    beside.setMax(low), beside.setMin(high);
    if (!((at - beside).length2() < best.away * best.away)) return;
    const btVector3 off = at - facet.a;
    if (!(std::abs(off.dot(facet.normal)) < best.away) || !may_touch(facet, node)) return;
    const std::array<double, 3> share = nearest_on(facet, off);
    const double away = (off - facet.ab * share[1] - facet.ac * share[2]).length();
    if (away < best.away) best = {true, face, share, true, away};
  }
  // Of a node that was pushed in beyond what was searched: where it went in.
  void stay(std::size_t node) {
    const LinkHold* hold = links.hold_of(node, &tissue);
    NearFace& near = links.near_tissue[node];
    if (near.found || hold == nullptr || !tissue.cuts.shows_face(hold->near)) return;
    const Facet facet = facet_of(tissue, hold->near);
    if (!(facet.square > 0.0)) return;
    const btVector3 off = links.now[node] - facet.a;
    near.share = nearest_on(facet, off);
    const btVector3 away = off - facet.ab * near.share[1] - facet.ac * near.share[2];
    const double height = away.dot(facet.normal) * (hold->front ? 1.0 : -1.0), aside = away.length2() - height * height;
    near.away = away.length();
    near.face = hold->near;
    near.found = height < 0.0 && height > -kLost * size && aside < deepest * deepest;
  }
};

}  // namespace

void find_faces(SoftData& links, const TissueData& tissue, double keep) {
  const double size = tissue.grid.element_size, most = kFastest * size;
  Nodes nodes{links, tissue, size, kDeepest * size};
  double reach = 0.0;
  for (std::size_t i = 0; i < links.now.size(); ++i) {
    const double own = std::max({keep + kStays * size, nodes.deepest, std::min(most, nodes.motion(i).length() + keep)});
    links.near_tissue[i] = {false, 0, {}, true, own};
    reach = std::max(reach, own);
    // What was the nearest still is near: few others are looked at then.
    const LinkHold* hold = links.hold_of(i, &tissue);
    if (hold == nullptr || !tissue.cuts.shows_face(hold->near)) continue;
    const FaceBox box(tissue.at, tissue.grid.faces[hold->near]);
    if (const Facet facet = facet_of(tissue, hold->near); facet.square > 0.0)
      nodes.look(hold->near, facet, box.own_low, box.own_high, i);
  }
  links.cells.sort(links.now, size, [](std::uint32_t) { return true; });
  for (std::uint32_t f = 0; f < tissue.grid.faces.size(); ++f) {
    if (!tissue.cuts.shows_face(f)) continue;
    FaceBox box(tissue.at, tissue.grid.faces[f]);
    if (!box.reaches(reach, links.low, links.high)) continue;
    const Facet facet = facet_of(tissue, f);
    if (!(facet.square > 0.0)) continue;
    links.cells.each_near(box.low, box.high, [&](const PointCells::Sorted& each) {
      nodes.look(f, facet, box.own_low, box.own_high, each.point);
    });
  }
  for (std::size_t i = 0; i < links.now.size(); ++i) {
    nodes.stay(i);
    NearFace& near = links.near_tissue[i];
    if (!near.found || !tissue.is_sheet()) continue;
    if (const LinkHold* hold = links.hold_of(i, &tissue)) {
      near.front = hold->front;
      continue;
    }
    btVector3 before = links.last_good[i], out(0, 0, 0);
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t point = tissue.grid.faces[near.face][k];
      before -= tissue.at[point] * near.share[k];
      out += tissue.touch.normal[stands_for(tissue, point)] * near.share[k];
    }
    near.front = before.dot(out) > 0.0;
  }
}

bool find_points(const SoftData& links, TissueData& tissue, double keep) {
  const double size = tissue.grid.element_size, deepest = kDeepest * size, far = keep + kStays * size,
               reach = std::max(far, deepest);
  bool any = false;
  for (std::uint32_t f = 0; f < links.faces.size(); ++f) {
    if (!(links.face_size[f] > kCoarse * size)) continue;
    if (!any) std::fill(tissue.near_links.begin(), tissue.near_links.end(), NearFace{});
    any = true;
    const auto& face = links.faces[f];
    FaceBox box(links.now, face);
    if (!box.reaches(reach, tissue.low, tissue.high)) continue;
    const Facet facet(links.now[face[0]], links.now[face[1]], links.now[face[2]]);
    const Facet before(links.last_good[face[0]], links.last_good[face[1]], links.last_good[face[2]]);
    if (!(facet.square > 0.0 && before.square > 0.0)) continue;
    tissue.touch.cells.each_near(box.low, box.high, [&](const PointCells::Sorted& each) {
      const btVector3& at = tissue.at[each.point];
      const btVector3 off = at - facet.a;
      const double height = off.dot(facet.normal);
      if (!(std::abs(height) < reach)) return;
      bool front = true;
      if (tissue.is_sheet()) {
        const LinkHold& hold = tissue.link_holds[each.point];
        front = hold.with == &links ? hold.front : before.normal.dot(at - before.a) > 0.0;
      } else {
        const double facing = facet.normal.dot(tissue.touch.normal[each.point]);
        if (!(std::abs(facing) > kOpposed)) return;
        front = facing < 0.0;
      }
      const double above = front ? height : -height;
      NearFace& best = tissue.near_links[each.point];
      if (!(above < far && above > -deepest) || (best.found && !(std::abs(above) < std::abs(best.away)))) return;
      const std::array<double, 3> share = facet.shares(off - facet.normal * height);
      if (share[0] >= 0.0 && share[1] >= 0.0 && share[2] >= 0.0) best = {true, f, share, front, above};
    });
  }
  return any;
}

}  // namespace ambf::physics::detail
