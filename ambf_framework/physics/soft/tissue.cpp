#include "physics/tissue.h"

#include <algorithm>
#include <cmath>

#include "math/rotation.h"
#include "physics/soft/detail/tissue_data.h"
#include "physics/soft/held_nodes.h"

namespace ambf::physics {

using detail::TissueData;
using detail::to_bullet;
using math::Vec3;

namespace {

constexpr int kRotationSweeps = 60;

struct Centre {
  double mass = 0.0;
  Vec3 place{};
};

Centre centre_of(const detail::TissueSolid& solid, bool with_fixed) {
  Centre centre;
  for (std::size_t i = 0; i < solid.corner_count(); ++i) {
    if (solid.fixed(i) && !with_fixed) continue;
    centre.mass += solid.masses()[i];
    centre.place += solid.positions()[i] * solid.masses()[i];
  }
  if (centre.mass > 0.0) centre.place = centre.place / centre.mass;
  return centre;
}

}  // namespace

Tissue::Tissue(const TissueDefinition& definition) : tissue_(std::make_unique<TissueData>(definition, *this)) {}
Tissue::~Tissue() { detail::let_go(*this); }

std::size_t Tissue::node_count() const { return tissue_->grid.points.size(); }
std::size_t Tissue::link_count() const { return tissue_->solid.element_count() + tissue_->solid.triangle_count(); }
const std::vector<std::array<std::uint32_t, 3>>& Tissue::faces() const { return tissue_->grid.faces; }
double Tissue::mass() const { return centre_of(tissue_->solid, false).mass; }
Vec3 Tissue::position(std::size_t node) const { return tissue_->solid.at(tissue_->grid.points[node]); }
Vec3 Tissue::velocity(std::size_t node) const { return tissue_->solid.velocity(tissue_->grid.points[node]); }

bool Tissue::fixed(std::size_t node) const {
  const TissuePoint& point = tissue_->grid.points[node];
  for (int k = 0; k < 4; ++k)
    if (std::abs(point.weight[k]) > 1e-9 && !tissue_->solid.fixed(point.corner[k])) return false;
  return true;
}
bool Tissue::has_fixed() const { return !tissue_->fixed.empty(); }

math::Pose Tissue::centre() const {
  const detail::TissueSolid& solid = tissue_->solid;
  const Centre centre = centre_of(solid, true);
  Vec3 rest_centre{};
  for (std::size_t i = 0; i < solid.corner_count(); ++i)
    rest_centre += tissue_->grid.corners[i] * (solid.masses()[i] / centre.mass);
  Vec3 columns[3] = {};
  for (std::size_t i = 0; i < solid.corner_count(); ++i) {
    const Vec3 now = (solid.positions()[i] - centre.place) * solid.masses()[i];
    const Vec3 then = tissue_->grid.corners[i] - rest_centre;
    columns[0] += now * then.x, columns[1] += now * then.y, columns[2] += now * then.z;
  }
  return {centre.place, detail::fit_rotation(solid.rotation_of_first(), columns, kRotationSweeps)};
}

void Tissue::apply_force(std::size_t node, const Vec3& force) {
  const TissuePoint& point = tissue_->grid.points[node];
  for (int k = 0; k < 4; ++k) tissue_->solid.add_force(point.corner[k], force * point.weight[k]);
}

// Each corner gets the force that gives it the acceleration of a rigid body.
void Tissue::apply_wrench(const math::Wrench& wrench) {
  detail::TissueSolid& solid = tissue_->solid;
  const Centre centre = centre_of(solid, false);
  if (!(centre.mass > 0.0)) return;
  btMatrix3x3 inertia(0, 0, 0, 0, 0, 0, 0, 0, 0);
  for (std::size_t i = 0; i < solid.corner_count(); ++i) {
    if (solid.fixed(i)) continue;
    const btVector3 r = to_bullet(solid.positions()[i] - centre.place);
    for (int row = 0; row < 3; ++row) {
      inertia[row] -= r * (r[row] * solid.masses()[i]);
      inertia[row][row] += r.length2() * solid.masses()[i];
    }
  }
  const Vec3 turning = detail::from_bullet(inertia.inverse() * to_bullet(wrench.torque));
  for (std::size_t i = 0; i < solid.corner_count(); ++i) {
    if (solid.fixed(i)) continue;
    const Vec3 pull = wrench.force / centre.mass + math::cross(turning, solid.positions()[i] - centre.place);
    solid.add_force(i, pull * solid.masses()[i]);
  }
}

void Tissue::carry_fixed(const math::Pose& T_world_body, double max_speed) {
  tissue_->carried = true;
  tissue_->carried_to = T_world_body;
  tissue_->max_carried_speed = max_speed;
}

void Tissue::reset() {
  detail::let_go(*this);
  tissue_->cuts.close();
  tissue_->solid.reset(tissue_->T_world_loaded);
  tissue_->follow_cuts();
  tissue_->frozen = false;
  tissue_->restart();
}

// Of what can be cut, with room for all corners that there may be, so that the size is always the same.
std::size_t Tissue::state_size() const {
  const detail::TissueCuts& cuts = tissue_->cuts;
  if (!cuts.possible()) return tissue_->solid.state_size();
  return tissue_->solid.state_size() + 6 * (cuts.max_corners() - tissue_->solid.corner_count()) + cuts.state_size();
}

void Tissue::get_state(std::vector<double>& out) const {
  tissue_->solid.get_state(out);
  if (!tissue_->cuts.possible()) return;
  out.resize(state_size() - tissue_->cuts.state_size(), 0.0);
  tissue_->cuts.get_state(out);
}

bool Tissue::set_state(std::span<const double> state) {
  if (state.size() != state_size()) return false;
  if (tissue_->cuts.possible() && !tissue_->cuts.put(&state[state.size() - tissue_->cuts.state_size()])) return false;
  tissue_->solid.set_state(state);
  tissue_->follow_cuts();
  tissue_->frozen = false;
  tissue_->restart();
  return true;
}

std::optional<SoftDivergence> Tissue::divergence(const SpeedLimits& limits) const {
  if (tissue_->frozen) return std::nullopt;
  const detail::TissueSolid& solid = tissue_->solid;
  for (std::size_t i = 0; i < solid.corner_count(); ++i) {
    const double speed = math::norm(solid.velocities()[i]);
    if (speed <= limits.linear && math::is_finite(solid.positions()[i])) continue;
    // Named by the first point that it moves; one within moves none.
    const auto& points = tissue_->grid.points;
    const auto moved = std::find_if(points.begin(), points.end(), [&](const TissuePoint& point) {
      return std::find(point.corner.begin(), point.corner.end(), i) != point.corner.end();
    });
    return SoftDivergence{this, moved == points.end() ? 0 : static_cast<std::size_t>(moved - points.begin()), speed};
  }
  return std::nullopt;
}

void Tissue::freeze() {
  detail::let_go(*this);
  tissue_->solid.put(tissue_->last_good);
  tissue_->restart();
  tissue_->frozen = true;
}
bool Tissue::frozen() const { return tissue_->frozen; }

void Tissue::attach(std::size_t group, Body* body) {
  tissue_->attachments[group].body = body;
  tissue_->follow_cuts();
}

std::size_t Tissue::attached_groups() const { return tissue_->attachments.size(); }
std::size_t Tissue::iterations() const { return static_cast<std::size_t>(tissue_->solid.iterations()); }
std::size_t Tissue::wanted_iterations() const { return static_cast<std::size_t>(tissue_->solid.wanted_iterations()); }
bool Tissue::is_sheet() const { return tissue_->is_sheet(); }
double Tissue::volume() const { return tissue_->solid.volume(); }
std::size_t Tissue::corner_count() const { return tissue_->solid.corner_count(); }
std::size_t Tissue::open_seams() const { return tissue_->cuts.open_count(); }
std::size_t Tissue::pieces() const { return tissue_->cuts.pieces(); }
std::vector<std::size_t> Tissue::cut_nodes() const {
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < node_count(); ++i)
    if (tissue_->cuts.is_on_cut(i)) found.push_back(i);
  return found;
}
bool Tissue::full() const { return tissue_->cuts.full(); }
bool Tissue::can_be_cut() const { return tissue_->cuts.possible(); }
std::size_t Tissue::contacts() const { return tissue_->contacts; }
std::size_t Tissue::tips() const { return tissue_->tips.tips.size(); }
bool Tissue::touches_left_out() const { return tissue_->touch.left_out || tissue_->tips.left_out; }

Vec3 Tissue::force_on(const Body& body) const {
  Vec3 sum{};
  for (std::size_t i = 0; i < tissue_->spring_force.size(); ++i)
    if (tissue_->pulled[i] == &body.data()) sum -= tissue_->spring_force[i];
  for (const detail::TipRooms::Made& each : tissue_->tips.made)
    if (each.body == &body.data()) sum -= each.force;
  return sum;
}

Vec3 Tissue::momentum() const {
  Vec3 sum{};
  for (std::size_t i = 0; i < tissue_->solid.corner_count(); ++i)
    sum += tissue_->solid.velocities()[i] * tissue_->solid.masses()[i];
  return sum;
}

Vec3 Tissue::angular_momentum() const {
  const Vec3 centre = centre_of(tissue_->solid, true).place;
  Vec3 sum{};
  for (std::size_t i = 0; i < tissue_->solid.corner_count(); ++i)
    sum += math::cross(tissue_->solid.positions()[i] - centre,
                       tissue_->solid.velocities()[i] * tissue_->solid.masses()[i]);
  return sum;
}

}  // namespace ambf::physics
