// Which tips and edges of bodies touch which faces of tissue: all places of a body that are near, then for each the
// face that it is over.
#include "physics/soft/detail/tissue_tips.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "physics/detail/shape_data.h"
#include "physics/soft/detail/near_shape.h"
#include "physics/soft/detail/tip_faces.h"
#include "physics/soft/detail/tissue_data.h"
#include "physics/soft/held_nodes.h"

namespace ambf::physics::detail {

namespace {

constexpr double kSpacing = 0.5;  // elements, of places along an edge
constexpr double kReach = 1.0;    // elements: a tip that touches is looked for so far
constexpr double kInside = 0.6;   // elements: a tip that is met so far within a solid is pushed out
constexpr double kFacing = 0.2;   // cosine, of a tip's normal with that of its face
constexpr double kBeside = 0.25;  // of a share: beside a face the force of a tip fades, so that it slips off smoothly

const ShapeData* hull_of(const ShapeData& data, const btCollisionShape& shape) {
  if (data.shape.get() == &shape) return &data;
  for (const SharedShape& hull : data.hulls)
    if (hull->data().shape.get() == &shape) return &hull->data();
  return nullptr;
}

// The places of a body, one shape after the other.
struct Gathering {
  TissueData& tissue;
  BodyData& body;
  btVector3 low, high;  // m, world: the part of the tissue that matters
  double h, way;
  std::uint64_t shapes = 0;

  void gather(const btCollisionShape& shape, const btTransform& pose) {
    if (shape.isCompound()) {
      const auto& compound = static_cast<const btCompoundShape&>(shape);
      for (int i = 0; i < compound.getNumChildShapes(); ++i)
        gather(*compound.getChildShape(i), pose * compound.getChildTransform(i));
      return;
    }
    static const std::vector<std::array<btVector3, 2>> kNone;
    const std::uint64_t number = shapes++ << 40;
    if (!MetShape(shape).can_be_met || shape.getShapeType() == STATIC_PLANE_PROXYTYPE) return;
    const Box box = box_of(shape, pose, tissue.margin + way);
    if (!box.overlaps(low, high)) return;
    btVector3 from = box.low, to = box.high;
    from.setMax(low), to.setMin(high);
    // The same box in the shape's axes, and what is around it.
    const btVector3 half = (to - from) * 0.5, middle = pose.invXform((from + to) * 0.5);
    const btMatrix3x3 turned = pose.getBasis().transpose().absolute();
    const btVector3 around(turned[0].dot(half), turned[1].dot(half), turned[2].dot(half));
    const ShapeData* hull = hull_of(body.shape->data(), shape);
    TipRooms& rooms = tissue.tips;
    rooms.surface.clear();
    const double size = tissue.grid.element_size;
    if (!find_tips(shape, hull == nullptr ? kNone : hull->hull_edges,
                   {middle - around, middle + around, kSpacing * size, size}, rooms.surface))
      rooms.left_out = true;
    const btVector3 centre = body.rigid.getWorldTransform().getOrigin();
    for (const SurfaceTip& tip : rooms.surface) {
      TipRooms::Place place;
      place.body = &body;
      place.at = pose * tip.at;
      place.radius = tip.radius;
      const btVector3 room(tip.radius, tip.radius, tip.radius);
      if (!Box{low - room, high + room}.contains(place.at)) continue;
      if (rooms.places.size() == rooms.places.capacity()) {
        rooms.left_out = true;
        return;
      }
      place.moves = body.rigid.getVelocityInLocalPoint(place.at - centre) * h;
      place.number = number + tip.number;
      const auto known = std::find_if(rooms.tips.begin(), rooms.tips.end(), [&](const BodyTip& each) {
        return each.body == &body && each.number == place.number;
      });
      place.known = static_cast<std::size_t>(known - rooms.tips.begin());
      if (known != rooms.tips.end()) {
        place.touched = {0, 0, 0};
        for (std::size_t k = 0; k < 3; ++k)
          place.touched += tissue.at[tissue.grid.faces[known->face][k]] * known->share[k];
      }
      rooms.places.push_back(place);
    }
  }
};

bool is_better(const TipRooms::Best& one, const TipRooms::Best& other) {
  if (one.full != other.full) return one.full > other.full;
  return one.distance < other.distance;
}

// Whether a face is what a place touches, or may touch.
void look(const TissueData& tissue, std::uint32_t f, const Facet& facet, double reach, TipRooms::Place& place) {
  TipRooms::Best found;
  found.face = f;
  const btVector3 off = place.at - facet.a;
  const double above = facet.normal.dot(off);
  if (place.known < tissue.tips.tips.size()) {
    // Along the normal that it had: the surface is one piece, and so is what it touches.
    const BodyTip& tip = tissue.tips.tips[place.known];
    const double facing = tip.normal.dot(facet.normal), way = above / facing;
    found.side = tissue.is_sheet() && facing < 0.0 ? -1.0 : 1.0;
    if (!(facing * found.side > kFacing) || !(std::abs(way) < reach + place.radius)) return;
    found.share = facet.shares(off - tip.normal * way);
    found.full = fullness(found.share);
    found.distance = (place.at - tip.normal * way - place.touched).length();
  } else {
    if (!(std::abs(above) < std::max(reach, tissue.margin + place.radius))) return;
    found.share = facet.shares(off - facet.normal * above);
    found.full = fullness(found.share);
    found.distance = std::abs(above);
    found.side = tissue.is_sheet() && above < 0.0 ? -1.0 : 1.0;
  }
  found.above = above * found.side;
  if (found.full > 0.0 && is_better(found, place.best)) place.best = found;
}

void find_runs(TissueData& tissue) {
  TipRooms& rooms = tissue.tips;
  if (rooms.runs_known) return;
  rooms.runs_known = true;
  for (TipRooms::Run& run : rooms.runs) {
    run.low = run.high = tissue.at[run.points.front()];
    for (const std::uint32_t point : run.points) run.low.setMin(tissue.at[point]), run.high.setMax(tissue.at[point]);
  }
}

// What each place touches: faces one after the other, each with the places that are in its box.
void find_faces(TissueData& tissue, std::span<TipRooms::Place> places) {
  double radius = 0.0;
  btVector3 low = places.front().at, high = low;
  for (const TipRooms::Place& place : places) {
    radius = std::max(radius, place.radius);
    low.setMin(place.at), high.setMax(place.at);
  }
  const double reach = kReach * tissue.grid.element_size, more = std::max(reach, tissue.margin) + radius;
  const btVector3 around(more, more, more);
  find_runs(tissue);
  TipRooms& rooms = tissue.tips;
  for (std::size_t n = 0; n < rooms.runs.size(); ++n) {
    const Box room{rooms.runs[n].low - around, rooms.runs[n].high + around};
    if (!room.overlaps(low, high)) continue;
    rooms.near_run.clear();
    auto first = std::lower_bound(places.begin(), places.end(), room.low.x(),
                                  [](const TipRooms::Place& each, double x) { return each.at.x() < x; });
    for (; first != places.end() && first->at.x() <= room.high.x(); ++first)
      if (room.contains(first->at)) rooms.near_run.push_back(static_cast<std::uint32_t>(first - places.begin()));
    if (rooms.near_run.empty()) continue;
    const std::size_t end = std::min(tissue.grid.faces.size(), (n + 1) * TipRooms::kRun);
    for (auto f = static_cast<std::uint32_t>(n * TipRooms::kRun); f < end; ++f) {
      if (!tissue.cuts.shows_face(f)) continue;
      const auto& face = tissue.grid.faces[f];
      const btVector3 &a = tissue.at[face[0]], &b = tissue.at[face[1]], &c = tissue.at[face[2]];
      Box box{a, a};
      box.low.setMin(b), box.low.setMin(c), box.high.setMax(b), box.high.setMax(c);
      box.low -= around, box.high += around;
      const auto is_in = [&](std::uint32_t i) { return box.contains(places[i].at); };
      auto place = std::find_if(rooms.near_run.begin(), rooms.near_run.end(), is_in);
      if (place == rooms.near_run.end()) continue;
      const Facet facet(a, b, c);
      if (!(facet.square > 0.0)) continue;
      for (; place != rooms.near_run.end(); ++place)
        if (is_in(*place)) look(tissue, f, facet, reach, places[*place]);
    }
  }
}

// Out of the surface at each point: what is between points faces as they do, without steps from face to face.
void find_normals(TissueData& tissue) {
  TipRooms& rooms = tissue.tips;
  if (rooms.counted == tissue.moves) return;
  rooms.counted = tissue.moves;
  std::fill(rooms.normal.begin(), rooms.normal.end(), btVector3(0, 0, 0));
  for (std::uint32_t f = 0; f < tissue.grid.faces.size(); ++f) {
    if (!tissue.cuts.shows_face(f)) continue;
    const btVector3 area = facet_of(tissue, f).area;
    for (const std::uint32_t point : tissue.grid.faces[f]) rooms.normal[rooms.stands_for[point]] += area;
  }
}

btVector3 normal_at(const TissueData& tissue, const TipRooms::Best& best) {
  const auto& face = tissue.grid.faces[best.face];
  const btVector3 own = facet_of(tissue, best.face).normal;
  btVector3 mean(0, 0, 0);
  for (std::size_t k = 0; k < 3; ++k) {
    const btVector3& normal = tissue.tips.normal[tissue.tips.stands_for[face[k]]];
    if (const double size = normal.length(); size > 0.0) mean += normal * (std::max(0.0, best.share[k]) / size);
  }
  const double size = mean.length();
  return (size > 0.0 && mean.dot(own) > kFacing * size ? btVector3(mean / size) : own) * best.side;
}

}  // namespace

Facet facet_of(const TissueData& tissue, std::uint32_t f) {
  const auto& face = tissue.grid.faces[f];
  return {tissue.at[face[0]], tissue.at[face[1]], tissue.at[face[2]]};
}

double fullness(const std::array<double, 3>& share) {
  return std::min(1.0, 1.0 + std::min({share[0], share[1], share[2]}) / kBeside);
}

btVector3 place_of(const TissueData& tissue, std::uint32_t face, const std::array<double, 3>& share) {
  btVector3 at(0, 0, 0);
  for (std::size_t k = 0; k < 3; ++k) at += tissue.at[tissue.grid.faces[face][k]] * share[k];
  return at;
}

bool passes(const TissueData& tissue, std::uint32_t face, const BodyData& body) {
  const auto& points = tissue.grid.faces[face];
  return std::any_of(points.begin(), points.end(),
                     [&](std::uint32_t point) { return held_off(tissue.grips, *tissue.owner, point, body); });
}

bool touch_first(TipRooms& rooms, const TipRooms::Place& place, const btVector3& normal,
                 const std::array<double, 3>& share) {
  if (rooms.tips.size() == rooms.tips.capacity()) {
    rooms.left_out = true;
    return false;
  }
  rooms.tips.push_back({place.body, place.number, normal, place.best.face, share, place.best.face, share, true});
  return true;
}

double way_of(const BodyData& body, double h) {
  if (body.shape->infinite()) return 0.0;
  return h * (body.rigid.getLinearVelocity().length() + body.rigid.getAngularVelocity().length() * body.reach);
}

void find_tips(TissueData& tissue, BodyData& body, double h) {
  TipRooms& rooms = tissue.tips;
  rooms.met.clear();
  const std::size_t first = rooms.places.size();
  const double way = way_of(body, h), more = way + tissue.margin;
  const btVector3 around(more, more, more);
  Gathering all{tissue, body, tissue.low - around, tissue.high + around, h, way};
  all.gather(*body.rigid.getCollisionShape(), body.rigid.getWorldTransform());
  const std::span<TipRooms::Place> places = std::span(rooms.places).subspan(first);
  if (places.empty()) return;
  std::sort(places.begin(), places.end(), [](const TipRooms::Place& a, const TipRooms::Place& b) {
    return a.at.x() < b.at.x() || (a.at.x() == b.at.x() && a.number < b.number);
  });
  find_faces(tissue, places);
  const std::size_t known = rooms.tips.size();
  for (std::size_t i = first; i < rooms.places.size(); ++i) {
    TipRooms::Place& place = rooms.places[i];
    const TipRooms::Best& best = place.best;
    if (!(best.full > 0.0)) continue;
    const double thick = tissue.margin + place.radius;
    if (place.known >= known && !(best.above < thick && best.above > -kInside * tissue.grid.element_size)) continue;
    find_normals(tissue);
    const btVector3 normal = normal_at(tissue, best);
    const double depth = thick - normal.dot(place.at - place_of(tissue, best.face, best.share));
    if (!(depth > 0.0) || passes(tissue, best.face, body)) continue;
    std::size_t tip = place.known;
    if (tip >= known) {
      tip = rooms.tips.size();
      if (!touch_first(rooms, place, normal, best.share)) continue;
    }
    place.touches = true;
    BodyTip& made = rooms.tips[tip];
    made.normal = normal;
    made.face = best.face;
    made.share = best.share;
    made.renewed = true;
    rooms.met.push_back({tip, i, depth, best.full, 0.0});
  }
}

}  // namespace ambf::physics::detail
