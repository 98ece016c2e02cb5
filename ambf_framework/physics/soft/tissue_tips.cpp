// Tips and edges of bodies against faces of tissue. A place of a body that comes to a face, or went through it in the
// last step, is held in front of it by a spring of the step's solve, at one point of both: of the body, and of the face
// as a sum of its points. Its side of the face is remembered as long as it touches, so that it never goes through.
#include "physics/soft/detail/tissue_tips.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "physics/detail/body_data.h"
#include "physics/soft/detail/tip_faces.h"
#include "physics/soft/detail/tissue_places.h"

namespace ambf::physics::detail {

using math::Vec3;

namespace {

constexpr double kStiffness =
    10.0;                         // corners' springs of a solid: a face gives way to a tip more than its contact does
constexpr double kOfSheet = 0.5;  // likewise; light ones would tremble
constexpr double kFirm = 0.1;     // elements: as deep its spring is half as stiff as it becomes; it begins softly
constexpr double kCalming_s = 0.003;  // as in contacts of points (tissue_step.cpp)
constexpr double kApart = 0.75;       // elements: nearer places of one body share one place's stiffness
constexpr double kSamePlace = 1e-5;   // elements

// Where friction holds a tip: a spring that gives way beyond its limit (EQUATIONS 17), as soft as makes it bear just
// that within the step. Returns what it pulls the tissue by as it is.
btVector3 rub(TissueData& tissue, BodyTip& tip, const btVector3& at, const btVector3& sliding, double limit,
              double stiffness, double h, double& side_stiffness) {
  const auto across = [&](const btVector3& v) { return btVector3(v - tip.normal * v.dot(tip.normal)); };
  btVector3 away = across(at - place_of(tissue, tip.stuck_face, tip.stuck));
  if (const double size = away.length(); stiffness * size > limit) {
    away *= limit / (stiffness * size);
    const Facet facet = facet_of(tissue, tip.face);
    const btVector3 off = at - away - facet.a;
    tip.stuck_face = tip.face;
    tip.stuck = facet.shares(off - tip.normal * (facet.normal.dot(off) / facet.normal.dot(tip.normal)));
  }
  const double force = stiffness * (away + across(sliding) * h).length();
  side_stiffness = force > limit ? stiffness * limit / force : stiffness;
  return away * side_stiffness;
}

// Of a sheet, whose faces are its triangles. Those at a cut reach further than their triangle, or less far.
TissuePoint point_on_sheet(const TissueData& sheet, std::uint32_t f, const std::array<double, 3>& share) {
  const auto& face = sheet.grid.faces[f];
  TissuePoint made;
  Vec3 rest{};
  bool cut = false;
  for (std::size_t k = 0; k < 3; ++k) {
    const TissuePoint& point = sheet.grid.points[face[k]];
    made.corner[k] = point.corner[0];
    made.weight[k] = share[k];
    cut = cut || point.weight[0] != 1.0;
    for (std::size_t j = 0; j < 4; ++j) rest += sheet.grid.corners[point.corner[j]] * (share[k] * point.weight[j]);
  }
  return cut ? point_of(sheet, from_rest(sheet, f, rest)) : made;
}

void share_stiffness(const TissueData& tissue, const BodyData& body, double h, std::vector<TipRooms::Met>& met) {
  const std::vector<TipRooms::Place>& places = tissue.tips.places;
  const double apart = kApart * tissue.grid.element_size;
  const double firmness = tissue.is_sheet() ? kOfSheet : kStiffness;
  double inverse = 0.0;  // 1/s^2: how all of them push the body within a step
  for (TipRooms::Met& each : met) {
    double near = 0.0;
    for (const TipRooms::Met& other : met) {
      const double far = (places[each.place].at - places[other.place].at).length2() / (apart * apart);
      if (far < 1.0) near += (1.0 - far) * (1.0 - far) * other.depth * other.full;
    }
    each.stiffness = firmness * tissue.corner_stiffness * each.full * each.depth * each.full / near;
    if (!body.is_static())
      inverse += each.stiffness *
                 body.rigid.computeImpulseDenominator(places[each.place].at, tissue.tips.tips[each.tip].normal);
  }
  // Together none of them pushes the body beyond where it is to be (EQUATIONS 16).
  for (TipRooms::Met& each : met) each.stiffness /= 1.0 + h * (h + kCalming_s) * inverse;
}

// What went through a face in this step touches it in the next one.
void find_passed(TissueData& tissue) {
  for (const TipRooms::Place& place : tissue.tips.places) {
    const TipRooms::Best& best = place.best;
    if (place.touches || !(best.full > 0.0) || !(best.above >= 0.0)) continue;
    const auto& face = tissue.grid.faces[best.face];
    const auto now = [&](std::size_t k) { return to_bullet(tissue.solid.at(tissue.grid.points[face[k]])); };
    const Facet facet(now(0), now(1), now(2));
    const btVector3 off = place.at + place.moves - facet.a;
    if (!(facet.square > 0.0 && facet.normal.dot(off) * best.side < 0.0)) continue;
    const std::array<double, 3> share = facet.shares(off);
    if (!(fullness(share) > 0.0) || passes(tissue, best.face, *place.body)) continue;
    touch_first(tissue.tips, place, facet.normal * best.side, share);
  }
}

}  // namespace

TipRooms::TipRooms(const TissueGrid& grid) {
  tips.reserve(Tissue::kMaxTips);
  met.reserve(Tissue::kMaxTips);
  made.reserve(Tissue::kMaxTips);
  places.reserve(kMaxPlaces);
  surface.reserve(kMaxPlaces);
  near_run.reserve(kMaxPlaces);
  for (std::size_t f = 0; f < grid.faces.size(); f += kRun) {
    std::vector<std::uint32_t>& points = runs.emplace_back().points;
    for (std::size_t i = f; i < std::min(grid.faces.size(), f + kRun); ++i)
      points.insert(points.end(), grid.faces[i].begin(), grid.faces[i].end());
    std::sort(points.begin(), points.end());
    points.erase(std::unique(points.begin(), points.end()), points.end());
  }
  normal.resize(grid.points.size());
  const double cell = kSamePlace * grid.element_size;
  std::map<std::array<long long, 3>, std::uint32_t> first;
  for (std::uint32_t i = 0; i < grid.points.size(); ++i) {
    stands_for.push_back(i);
    if (!grid.seams.empty() && i >= grid.first_inner_point) continue;  // of a lip
    Vec3 at{};
    for (std::size_t k = 0; k < 4; ++k) at += grid.corners[grid.points[i].corner[k]] * grid.points[i].weight[k];
    stands_for[i] =
        first.try_emplace({std::llround(at.x / cell), std::llround(at.y / cell), std::llround(at.z / cell)}, i)
            .first->second;
  }
}

void TipRooms::let_go(const BodyData* body) {
  const auto is_of_it = [&](const auto& each) { return body == nullptr || each.body == body; };
  std::erase_if(tips, is_of_it);
  std::erase_if(made, is_of_it);
}

void add_tips(TissueData& tissue, BodyData& body, double h) {
  TipRooms& rooms = tissue.tips;
  const double friction = tissue.friction * body.rigid.getFriction();
  share_stiffness(tissue, body, h, rooms.met);
  const btVector3 centre = body.rigid.getWorldTransform().getOrigin();
  for (const TipRooms::Met& met : rooms.met) {
    BodyTip& tip = rooms.tips[met.tip];
    const auto& face = tissue.grid.faces[tip.face];
    const btVector3& at = rooms.places[met.place].at;
    TissueTouch touch;
    touch.within = false;
    btVector3 moving(0, 0, 0);
    for (std::size_t k = 0; k < 3; ++k) {
      const TissuePoint& point = tissue.grid.points[face[k]];
      touch.add(point, tip.share[k]);
      moving += to_bullet(tissue.solid.velocity(point)) * tip.share[k];
    }
    const btVector3 place = place_of(tissue, tip.face, tip.share);
    const btVector3 carried = body.rigid.getVelocityInLocalPoint(place - centre);
    touch.place = from_bullet(place);
    touch.normal = from_bullet(-tip.normal);
    // The force grows as d^2 / (d + firm): nothing jumps as it begins, and light sheets do not tremble.
    const double firm = kFirm * tissue.grid.element_size, share = met.depth / (met.depth + firm);
    const double stiffness = met.stiffness * share, push = stiffness * met.depth;
    touch.normal_stiffness = stiffness * (2.0 - share) * (1.0 + kCalming_s / h);
    // As it leaves it is not held back; a sheet's solve undoes what pulls.
    const double leaves = h * tip.normal.dot(carried - moving);
    if (!tissue.is_sheet() && touch.normal_stiffness * leaves > push) touch.normal_stiffness = push / leaves;
    touch.pull =
        from_bullet(rub(tissue, tip, at, carried - moving, friction * push, stiffness, h, touch.side_stiffness) -
                    tip.normal * push);
    touch.pull += touch.holding_back(from_bullet(carried)) * h;
    if (tissue.is_sheet()) {
      if (tissue.springs.size() == tissue.springs.capacity()) {
        rooms.left_out = true;
        return;
      }
      TissueSpring spring;
      spring.at = point_on_sheet(tissue, tip.face, tip.share);
      spring.normal = touch.normal;
      spring.pull = touch.pull;
      spring.normal_stiffness = touch.normal_stiffness, spring.side_stiffness = touch.side_stiffness;
      spring.pushes = true;
      tissue.springs.push_back(spring);
      tissue.pulled.push_back(&body);
      continue;
    }
    rooms.made.push_back({tissue.touch.made.size(), &body, {}});
    tissue.touch.made.push_back(touch);
  }
}

void end_tips(TissueData& tissue, double h) {
  TipRooms& rooms = tissue.tips;
  find_passed(tissue);
  for (TipRooms::Made& each : rooms.made) {
    const TissueTouch& touch = tissue.touch.made[each.touch];
    each.force = tissue.solid.force_of(touch, h);
    btRigidBody& rigid = each.body->rigid;
    if (!each.body->is_static())
      rigid.applyImpulse(to_bullet(each.force) * -h, to_bullet(touch.place) - rigid.getWorldTransform().getOrigin());
  }
  std::erase_if(rooms.tips, [](const BodyTip& each) { return !each.renewed; });
}

}  // namespace ambf::physics::detail
