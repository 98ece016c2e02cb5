#include "physics/soft_body.h"

#include <LinearMath/btPolarDecomposition.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "physics/soft/detail/soft_data.h"
#include "physics/soft/held_nodes.h"

namespace ambf::physics {

using detail::from_bullet;
using detail::SoftData;
using detail::to_bullet;

namespace {

constexpr double kSmallestSpread = 1e-18;  // m^2: nodes within less are a point or a line and show no rotation

// Bullet makes a link of each edge when it meets it first, from the third corner of a triangle on.
void add_links(btSoftBody& soft, const SoftDefinition& given) {
  std::set<std::pair<std::uint32_t, std::uint32_t>> linked;
  const auto link = [&](std::uint32_t from, std::uint32_t to) {
    if (linked.insert(std::minmax(from, to)).second)
      soft.appendLink(static_cast<int>(from), static_cast<int>(to), nullptr, false);
  };
  for (const auto& t : given.triangles)
    for (std::size_t j = 2, k = 0; k < 3; j = k++) link(t[j], t[k]);
  for (const auto& line : given.lines) link(line[0], line[1]);
}

void set_config(btSoftBody& soft, const scene::SoftConfig& given) {
  btSoftBody::Config& to = soft.m_cfg;
  to.kVCF = given.kVCF;
  to.kDP = given.kDP;
  to.kDG = given.kDG;
  to.kLF = given.kLF;
  to.kPR = given.kPR;
  to.kVC = given.kVC;
  to.kDF = given.kDF;
  to.kMT = given.kMT;
  to.kCHR = given.kCHR;
  to.kKHR = given.kKHR;
  to.kSHR = given.kSHR;
  to.kAHR = given.kAHR;
  to.kSRHR_CL = given.kSRHR_CL;
  to.kSKHR_CL = given.kSKHR_CL;
  to.kSSHR_CL = given.kSSHR_CL;
  to.kSR_SPLT_CL = given.kSR_SPLT_CL;
  to.kSK_SPLT_CL = given.kSK_SPLT_CL;
  to.kSS_SPLT_CL = given.kSS_SPLT_CL;
  to.maxvolume = given.maxvolume;
  to.timescale = given.timescale;
  to.viterations = given.viterations;
  to.piterations = given.piterations;
  to.diterations = given.diterations;
  to.citerations = given.citerations;
  to.collisions = given.flags;
}

}  // namespace

namespace detail {

namespace {

constexpr std::size_t kRoomForGrips = 4;  // more allocate when they hold

}  // namespace

// In the order of AMBF 2.0: some steps read what earlier ones made.
SoftData::SoftData(const SoftDefinition& given, const SoftBody& owned_by)
    : owner(&owned_by),
      faces(given.triangles),
      fixed(given.fixed),
      collision_groups(given.collision_groups),
      T_world_loaded(to_bullet(given.T_world_body)),
      total_mass(given.mass) {
  std::vector<btVector3> at;
  for (const math::Vec3& node : given.nodes) {
    rest.push_back(to_bullet(node));
    rest_centre += rest.back() / static_cast<double>(given.nodes.size());
    at.push_back(T_world_loaded * rest.back());
  }
  soft = std::make_unique<btSoftBody>(&surroundings, static_cast<int>(at.size()), at.data(), nullptr);
  add_links(*soft, given);
  for (const auto& t : given.triangles)
    soft->appendFace(static_cast<int>(t[0]), static_cast<int>(t[1]), static_cast<int>(t[2]));
  soft->getCollisionShape()->setMargin(given.margin);
  soft->setTotalMass(given.mass, false);
  mass_of_node = masses_of_parts(given);
  for (int i = 0; i < soft->m_nodes.size() && !given.parts.empty(); ++i)
    soft->setMass(i, mass_of_node[static_cast<std::size_t>(i)]);
  btSoftBody::Material& material = *soft->m_materials[0];
  material.m_kLST = given.config.kLST;
  material.m_kAST = given.config.kAST;
  material.m_kVST = given.config.kVST;
  // Without a rest volume kVC would pull towards volume 0.
  const bool keeps_volume = given.config.kVC > 0.0, keeps_shape = given.config.kMT > 0.0;
  if (keeps_volume || keeps_shape) soft->setPose(keeps_volume, keeps_shape);
  set_config(*soft, given.config);
  if (given.config.bending_distance > 1) soft->generateBendingConstraints(given.config.bending_distance, &material);
  stiffen_parts(*soft, given);
  for (const std::uint32_t node : fixed) soft->setMass(static_cast<int>(node), 0.0);
  if (given.config.clusters >= 0) soft->generateClusters(given.config.clusters);
  if (given.randomize_constraints) soft->randomizeConstraints();
  soft->setUserPointer(this);
  // Bullet would do this in the first step only; a reset is to be as if new.
  soft->updateConstants();
  soft->m_bUpdateRtCst = false;
  last_good = now = at;
  velocity.resize(at.size(), btVector3(0, 0, 0));
  runs.make(at.size(), faces);
  gather_links(given);
  near_faces.reserve(faces.size());
  grips.reserve(kRoomForGrips + given.attached_grips);
  springs.reserve(grips.capacity() * SoftGrip::kMaxNodes);
  sleep.may_tremble = SoftSleep::kTrembling_m;
  sleep.at.reserve(now.size());
  make_room_for_touches();
  if (!is_plain) find_pieces();
  restart();
}

bool SoftData::meets_bodies_by_nodes() const {
  return (soft->m_cfg.collisions & btSoftBody::fCollision::RVSmask) == btSoftBody::fCollision::SDF_RS;
}

bool SoftData::meets_bodies_by_clusters() const {
  return (soft->m_cfg.collisions & btSoftBody::fCollision::RVSmask) == btSoftBody::fCollision::CL_RS &&
         soft->m_clusters.size() > 0;
}

bool SoftData::meets_soft_bodies() const { return (soft->m_cfg.collisions & btSoftBody::fCollision::SVSmask) != 0; }

void SoftData::forget_contacts() {
  while (soft->m_rcontacts.size() > 0) soft->m_rcontacts.pop_back();
  while (soft->m_scontacts.size() > 0) soft->m_scontacts.pop_back();
  contacts.clear();
  moving_contacts.clear();
}

void SoftData::place(std::size_t number, const btVector3& at, const btVector3& speed) {
  btSoftBody::Node& node = soft->m_nodes[static_cast<int>(number)];
  now[number] = node.m_x = node.m_q = at;
  velocity[number] = node.m_v = speed;
  node.m_f = btVector3(0, 0, 0);
}

void SoftData::restart() {
  forget_contacts();
  if (!is_plain) restart_bullet();
  carried = false;
  pushed = true;
  speeds2 = std::numeric_limits<double>::infinity();
  sleep.restart();
  on_tissue.clear();
  let_go(nullptr);
  may_be_held = true;
  ++moves;
}

void SoftData::find_bounds() {
  if (bounded == moves) return;
  bounded = moves;
  const Box around = runs.follow(now);
  node_low = around.low;
  node_high = around.high;
}

}  // namespace detail

SoftBody::SoftBody(const SoftDefinition& definition) : data_(std::make_unique<SoftData>(definition, *this)) {}
SoftBody::SoftBody() = default;
SoftBody::~SoftBody() {
  if (data_ != nullptr) detail::let_go(*this);
}

std::size_t SoftBody::node_count() const { return data_->rest.size(); }
const std::vector<std::array<std::uint32_t, 3>>& SoftBody::faces() const { return data_->faces; }
std::size_t SoftBody::link_count() const { return static_cast<std::size_t>(data_->soft->m_links.size()); }

double SoftBody::mass() const {
  double all = 0.0;
  for (std::size_t node = 0; node < node_count(); ++node)
    if (!fixed(node)) all += data_->mass_of_node[node];
  return all;
}

math::Vec3 SoftBody::position(std::size_t node) const { return from_bullet(data_->now[node]); }
math::Vec3 SoftBody::velocity(std::size_t node) const { return from_bullet(data_->velocity[node]); }
bool SoftBody::fixed(std::size_t node) const { return data_->inverse_mass[node] == 0.0; }
bool SoftBody::has_fixed() const { return !data_->fixed.empty(); }

math::Pose SoftBody::centre() const {
  btVector3 centre(0, 0, 0);
  for (const btVector3& each : data_->now) centre += each;
  centre /= static_cast<double>(node_count());
  btMatrix3x3 moment(0, 0, 0, 0, 0, 0, 0, 0, 0);
  for (std::size_t i = 0; i < data_->now.size(); ++i) {
    const btVector3 now = data_->now[i] - centre, then = data_->rest[i] - data_->rest_centre;
    for (int row = 0; row < 3; ++row) moment[row] += now[row] * then;
  }
  // A flat body gives no moment across; the product of the other two directions is that of the third.
  btMatrix3x3 filled = moment;
  const btMatrix3x3 cofactors = moment.adjoint().transpose();
  double spread = 0.0, cofactor = 0.0;
  for (int row = 0; row < 3; ++row) spread += moment[row].length2(), cofactor += cofactors[row].length2();
  spread = std::sqrt(spread);
  cofactor = std::sqrt(cofactor);
  math::Pose pose{from_bullet(centre), from_bullet(data_->T_world_loaded.getRotation())};
  if (!(spread > kSmallestSpread) || !(cofactor > 1e-9 * spread * spread)) return pose;
  const double size = spread / cofactor;
  for (int row = 0; row < 3; ++row) filled[row] += cofactors[row] * (1e-3 * size);
  btMatrix3x3 turn, stretch;
  btPolarDecomposition(1e-12).decompose(filled, turn, stretch);
  if (std::isfinite(turn.determinant()) && turn.determinant() > 0.0) {
    btQuaternion rotation;
    turn.getRotation(rotation);
    pose.orientation = from_bullet(rotation.normalized());
  }
  return pose;
}

void SoftBody::apply_force(std::size_t node, const math::Vec3& force) {
  data_->soft->addForce(to_bullet(force), static_cast<int>(node));
  data_->pushed = true;
}

void SoftBody::apply_wrench(const math::Wrench& wrench) {
  SoftData& data = *data_;
  data.pushed = true;
  const auto weight = [&](std::size_t node) {  // by the mean of all nodes
    return data.mass_of_node[node] * static_cast<double>(node_count()) / data.total_mass;
  };
  btVector3 centre(0, 0, 0);
  double count = 0.0;
  for (std::size_t i = 0; i < node_count(); ++i) {
    if (fixed(i)) continue;
    centre += data.now[i] * weight(i);
    count += weight(i);
  }
  if (!(count > 0.0)) return;
  centre /= count;
  // In units of a node's mass.
  btMatrix3x3 inertia(0, 0, 0, 0, 0, 0, 0, 0, 0);
  double size = 0.0;
  for (std::size_t i = 0; i < node_count(); ++i) {
    if (fixed(i)) continue;
    const btVector3 r = data.now[i] - centre;
    const double square = weight(i) * r.length2();
    size += square;
    for (int row = 0; row < 3; ++row) {
      inertia[row] -= r * (weight(i) * r[row]);
      inertia[row][row] += square;
    }
  }
  btVector3 turning(0, 0, 0);
  if (size > kSmallestSpread) {
    for (int row = 0; row < 3; ++row) inertia[row][row] += 1e-9 * size;  // nodes on a line do not resist about it
    turning = inertia.inverse() * to_bullet(wrench.torque);
  }
  const btVector3 share = to_bullet(wrench.force) / count;
  for (std::size_t i = 0; i < node_count(); ++i)
    if (!fixed(i))
      data.soft->m_nodes[static_cast<int>(i)].m_f += (share + turning.cross(data.now[i] - centre)) * weight(i);
}

void SoftBody::carry_fixed(const math::Pose& T_world_body, double max_speed) {
  data_->carried = true;
  data_->carried_to = to_bullet(T_world_body);
  data_->max_carried_speed = max_speed;
}

void SoftBody::reset() {
  detail::let_go(*this);
  for (std::size_t i = 0; i < node_count(); ++i)
    data_->place(i, data_->T_world_loaded * data_->rest[i], btVector3(0, 0, 0));
  data_->frozen = false;
  data_->restart();
}

void SoftBody::get_state(std::vector<double>& out) const {
  out.clear();
  for (std::size_t i = 0; i < node_count(); ++i) {
    for (int k = 0; k < 3; ++k) out.push_back(data_->now[i][k]);
    for (int k = 0; k < 3; ++k) out.push_back(data_->velocity[i][k]);
  }
}

std::size_t SoftBody::state_size() const { return 6 * node_count(); }

bool SoftBody::set_state(std::span<const double> state) {
  if (state.size() != 6 * node_count()) return false;
  for (std::size_t i = 0; i < node_count(); ++i) {
    const double* value = state.data() + 6 * i;
    data_->place(i, btVector3(value[0], value[1], value[2]), btVector3(value[3], value[4], value[5]));
    data_->last_good[i] = data_->now[i];
  }
  data_->frozen = false;
  data_->restart();
  return true;
}

std::optional<SoftDivergence> SoftBody::divergence(const SpeedLimits& limits) const {
  if (data_->frozen) return std::nullopt;
  if (data_->is_plain && data_->speeds2 <= limits.linear * limits.linear) return std::nullopt;  // none is faster
  for (std::size_t i = 0; i < node_count(); ++i) {
    const btVector3& moves = data_->velocity[i];
    if (moves.length2() <= limits.linear * limits.linear && std::isfinite(data_->now[i].length2())) continue;
    return SoftDivergence{this, i, moves.length()};
  }
  return std::nullopt;
}

void SoftBody::freeze() {
  detail::let_go(*this);
  for (std::size_t i = 0; i < node_count(); ++i) data_->place(i, data_->last_good[i], btVector3(0, 0, 0));
  data_->restart();
  data_->frozen = true;
}

bool SoftBody::frozen() const { return data_->frozen; }

void SoftBody::set_user_index(std::uint32_t index) { user_index_ = index; }
std::uint32_t SoftBody::user_index() const { return user_index_; }

}  // namespace ambf::physics
