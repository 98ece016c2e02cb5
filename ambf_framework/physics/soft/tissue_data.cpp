// What a Tissue is made of: rooms that are taken at load, and what follows when it is cut or moves.
#include "physics/soft/detail/tissue_data.h"

#include <algorithm>

#include "physics/blade.h"
#include "physics/detail/body_data.h"
#include "physics/needle.h"
#include "physics/soft/held_nodes.h"

namespace ambf::physics::detail {

using math::Vec3;

namespace {

constexpr double kContactLayers = 2.0;  // a contact is as stiff as tissue of half an element's height
// Of sheets: by the stiffness of an element in its plane.
constexpr double kContactSheets = 20.0;
// Thread between two places is stiffer than what holds a corner; of sheets that is stiff itself.
constexpr double kThread = 10.0, kThreadInSheets = 0.5;
constexpr std::size_t kRoomForGrips = 4;   // more allocate when they hold
constexpr double kRelaxed = 12.0;          // times of relaxation: of a stress that falls, 6e-6 are left
constexpr std::size_t kRoomForBlades = 4;  // that cut at once; more wait

// Area that belongs to each point of the surface, m^2.
std::vector<double> areas(const TissueGrid& grid) {
  std::vector<Vec3> at;
  for (const TissuePoint& point : grid.points) {
    Vec3 sum{};
    for (int k = 0; k < 4; ++k) sum += grid.corners[point.corner[k]] * point.weight[k];
    at.push_back(sum);
  }
  std::vector<double> area(grid.points.size(), 0.0);
  for (const auto& face : grid.faces) {
    const double third = math::norm(math::cross(at[face[1]] - at[face[0]], at[face[2]] - at[face[0]])) / 6.0;
    for (const std::uint32_t point : face) area[point] += third;
  }
  return area;
}

}  // namespace

TissueData::TissueData(const TissueDefinition& given, const SoftBody& owned_by)
    : owner(&owned_by),
      grid(given.grid),
      solid(given),
      cuts(grid, solid, given.max_corners),
      T_world_loaded(given.T_world_body),
      margin(given.margin + 0.5 * given.grid.thickness),
      friction(given.material.friction),
      fixed(given.fixed),
      collision_groups(given.collision_groups),
      touch(given),
      tips(given.grid) {
  const double size = grid.element_size;  // m
  slab = is_sheet() ? kContactSheets * solid.modulus() * grid.thickness / (size * size)
                    : kContactLayers * solid.modulus() / size;
  for (const double area : areas(grid)) point_stiffness.push_back(slab * area);
  corner_stiffness = slab * size * size;
  thread_stiffness = (is_sheet() ? kThreadInSheets : kThread) * corner_stiffness;
  std::size_t hanging = 0;
  for (std::vector<std::uint32_t> corners : given.attached) {
    std::sort(corners.begin(), corners.end());
    std::size_t most = corners.size();
    const auto count = [&](const auto& elements) {
      for (const auto& element : elements)
        most += static_cast<std::size_t>(std::count_if(
            element.corner.begin(), element.corner.end(),
            [&](std::uint32_t corner) { return std::binary_search(corners.begin(), corners.end(), corner); }));
    };
    if (cuts.possible()) count(grid.elements), count(grid.triangles);
    attachments.push_back({std::move(corners), {}, nullptr, {}});
    attachments.back().corners.reserve(most);
    attachments.back().places.reserve(most);
    hanging += most;
  }
  fixed.reserve(std::max(fixed.size(), cuts.max_corners()));
  last_good.reserve(std::max(solid.corner_count(), cuts.max_corners()));
  sleep.at.reserve(last_good.capacity());
  if (given.material.share < 1.0) sleep.relaxes_s = kRelaxed * given.material.time;
  of_corner.reserve(std::max(solid.corner_count(), cuts.max_corners()));
  hit.reserve(of_corner.capacity());
  if (touch.others) {
    link_holds.resize(grid.points.size());
    near_links.resize(grid.points.size());
  }
  follow_cuts();
  holds.resize(grid.points.size());
  at.resize(grid.points.size());
  found.reserve(grid.points.size());
  springs.reserve(kHolds * grid.points.size() + hanging + kRoomForGrips * SoftGrip::kMaxNodes +
                  Needle::kMaxInOneBody * (Needle::kMaxPunctures + 1 + Needle::kMaxStitches) +
                  (cuts.possible() ? kRoomForBlades * Blade::kMaxSamples : 0) + (is_sheet() ? Tissue::kMaxTips : 0));
  pulled.reserve(springs.capacity());
  touch.made.reserve(touch.made.capacity() + Tissue::kMaxTips);
  if (is_sheet()) touch.felt.reserve(touch.made.capacity());
  spring_force.reserve(springs.capacity());
  links.reserve(Needle::kMaxInOneBody * (Needle::kMaxStitches + Needle::kMaxKnots));
  blades.reserve(kRoomForBlades);
  needles.reserve(Needle::kMaxInOneBody);
  near_elements.reserve(grid.elements.size() + grid.triangles.size());
  grips.reserve(kRoomForGrips);
  near_faces.reserve(grid.faces.size());
  if (cuts.possible()) {
    near_seams.reserve(grid.seams.size());
    for (std::uint32_t e = 0; e < solid.element_count(); ++e) {
      middles.push_back({});
      for (int k = 0; k < 4; ++k) middles.back() += grid.corners[solid.corners_of(e)[k]] * 0.25;
    }
    for (const TissueTriangle& t : grid.triangles)
      middles.push_back((grid.corners[t.corner[0]] + grid.corners[t.corner[1]] + grid.corners[t.corner[2]]) / 3.0);
    for (std::size_t s = 0; is_sheet() && s < grid.seams.size(); ++s) {
      const TissueSeam& seam = grid.seams[s];
      const auto& corner = grid.triangles[seam.element[0]].corner;
      middles.push_back((grid.corners[corner[seam.corner[0][0]]] + grid.corners[corner[seam.corner[0][1]]]) * 0.5);
    }
  }
  locate();
}

void TissueData::share_area() {
  of_corner.assign(solid.corner_count(), 0.0);
  for (std::size_t t = 0; t < grid.triangles.size(); ++t) {
    const std::uint32_t* c = solid.corners_of(t);
    const Vec3 &a = grid.corners[c[0]], &b = grid.corners[c[1]], &d = grid.corners[c[2]];
    const double third = math::norm(math::cross(b - a, d - a)) / 6.0;
    for (int k = 0; k < 3; ++k) of_corner[c[k]] += third;
  }
  for (std::size_t i = 0; i < grid.points.size(); ++i) point_stiffness[i] = slab * of_corner[cuts.corner_at(i)];
}

void TissueData::follow_cuts() {
  touch.paired = false;
  touch.measure(grid);
  touch.rims.follow(grid, cuts, solid, touch.point_place);
  last_good = solid.positions();
  if (is_sheet() && cuts.possible()) share_area();
  fixed.clear();
  for (std::uint32_t i = 0; i < solid.corner_count(); ++i)
    if (solid.fixed(i)) fixed.push_back(i);
  for (TissueAttachment& attachment : attachments) {
    attachment.corners.clear();
    attachment.places.clear();
    const btTransform T_com_world = attachment.body == nullptr
                                        ? btTransform::getIdentity()
                                        : to_bullet(attachment.body->initial_com_pose()).inverse();
    for (std::uint32_t i = 0; i < solid.corner_count(); ++i) {
      if (!std::binary_search(attachment.loaded.begin(), attachment.loaded.end(), cuts.origin(i))) continue;
      attachment.corners.push_back(i);
      attachment.places.push_back(T_com_world * to_bullet(T_world_loaded * grid.corners[i]));
    }
  }
}

// What holds them goes along.
void TissueData::follow_points() {
  touch.edges.forget_friction(nullptr);
  const auto way_of = [&](std::size_t point) -> btVector3 {
    return to_bullet(solid.at(grid.points[point])) - at[point];
  };
  for (std::size_t i = 0; i < grid.points.size(); ++i) {
    const btVector3 way = way_of(i);
    if (way.fuzzyZero()) continue;
    for (TissueHold& hold : holds[i])
      if (hold.body != nullptr) hold.place += hold.body->rigid.getWorldTransform().getBasis().transpose() * way;
    if (!touch.holds.empty()) touch.holds[i].of = nullptr;
  }
  for (SoftGripData* grip : grips)
    for (HeldNode& held : grip->held) {
      if (held.body != owner) continue;
      const btVector3 way = way_of(held.node);
      const bool in_world = grip->holder == nullptr;
      held.place += from_bullet(in_world ? way : grip->holder->rigid.getWorldTransform().getBasis().transpose() * way);
    }
  ++moves;
}

void TissueData::restart() {
  for (auto& each : holds) each.fill({});
  touch.let_go(nullptr);
  touch.paired = false;
  std::fill(link_holds.begin(), link_holds.end(), LinkHold{});
  tips.let_go(nullptr);
  carried = false;
  sleep.restart();
  ++moves;
}

void TissueData::forget(const BodyData& body) {
  for (auto& each : holds)
    for (TissueHold& hold : each)
      if (hold.body == &body) hold.body = nullptr;
  for (TissueAttachment& attachment : attachments)
    if (attachment.body == &body.owner) attachment.body = nullptr;
  tips.let_go(&body);
  // Forces of others stay known: tissue that sleeps does not find them anew.
  std::size_t kept = 0;
  for (std::size_t i = 0; i < spring_force.size(); ++i) {
    if (pulled[i] == &body) continue;
    pulled[kept] = pulled[i];
    spring_force[kept++] = spring_force[i];
  }
  pulled.resize(kept);
  spring_force.resize(kept);
  springs.clear();
}

void TissueData::move_fixed(double h) {
  for (const std::uint32_t corner : fixed) {
    Vec3 speed{};
    if (carried) {
      speed = (carried_to * grid.corners[corner] - solid.positions()[corner]) / h;
      const double size = math::norm(speed);
      if (size > max_carried_speed) speed = speed * (max_carried_speed / size);
    }
    solid.set_velocity(corner, speed);
  }
  carried = false;
}

void TissueData::locate() {
  low = btVector3(SIMD_INFINITY, SIMD_INFINITY, SIMD_INFINITY);
  high = -low;
  for (std::size_t i = 0; i < at.size(); ++i) {
    at[i] = to_bullet(solid.at(grid.points[i]));
    low.setMin(at[i]);
    high.setMax(at[i]);
  }
  low -= btVector3(margin, margin, margin);
  high += btVector3(margin, margin, margin);
}

void TissueData::find_bounds() {
  if (bounded == moves) return;
  bounded = moves;
  locate();
  node_low = low;
  node_high = high;
}

}  // namespace ambf::physics::detail
