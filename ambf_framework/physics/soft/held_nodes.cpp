// A held node at x hangs on p, a place on the holder, by F = H d+ + D (d+ - d) / h, with the gap d = p - x as the step
// begins and d+ as it ends. For a node that nothing else moves that is EQUATIONS 16,
// F = (H (d + h vr) + D vr) / (1 + (h D + h^2 H) / m_e). Links move nodes by position, and a node of a fine mesh is
// light: by that formula alone a cloth of 900 nodes would hang on h^2 / m, 100 N/m a node, whatever H is. So the same F
// is found with the links, as they are: a pass before each of theirs and one at the end, each of which adds what is
// missing of F.
#include "physics/soft/held_nodes.h"

#include <algorithm>
#include <cmath>

#include "physics/detail/world_data.h"
#include "physics/soft/detail/link_step.h"
#include "physics/soft/detail/soft_data.h"
#include "physics/soft/detail/thread_data.h"
#include "physics/soft/detail/tissue_data.h"

namespace ambf::physics {

namespace detail {
namespace {

// btMatrix3x3 has no such thing.
btMatrix3x3 cross_matrix(const btVector3& v) { return {0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0}; }

HeldSpring make_spring(SoftData& data, const SoftGripData& grip, HeldNode& held, double h) {
  btSoftBody::Node& node = data.soft->m_nodes[static_cast<int>(held.node)];
  HeldSpring spring;
  spring.x = data.is_plain ? &data.now[held.node] : &node.m_x;
  spring.q = data.is_plain ? &data.last_good[held.node] : &node.m_q;
  spring.inverse_mass = node.m_im;
  spring.holder = grip.holder;
  spring.held = &held;
  spring.max_force = grip.options.max_force;
  spring.place = to_bullet(held.place);
  spring.lever = *spring.q;
  btVector3 gap = spring.place - *spring.q;
  // How far the gap closes for each newton, m/N.
  const double step = data.soft->m_sst.sdt;
  double straight = step * step * spring.inverse_mass;
  btMatrix3x3 turning(0, 0, 0, 0, 0, 0, 0, 0, 0);
  if (grip.holder != nullptr) {
    const btRigidBody& rigid = grip.holder->rigid;
    spring.place = rigid.getWorldTransform().getBasis() * spring.place;
    spring.lever -= rigid.getWorldTransform().getOrigin();
    gap = spring.place - spring.lever;
    straight += h * h * rigid.getInvMass();
    const btMatrix3x3 arm = cross_matrix(spring.lever);
    turning = arm.transpose() * rigid.getInvInertiaTensorWorld() * arm;
  }
  const double damping_over_h = grip.options.damping / h;
  spring.stiffness = grip.options.hardness + damping_over_h;
  spring.from_damping = gap * damping_over_h;
  btMatrix3x3 yields;
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column) {
      const double one = row == column ? 1.0 : 0.0;
      yields[row][column] = one + spring.stiffness * (one * straight + h * h * turning[row][column]);
    }
  spring.share = yields.inverse();
  return spring;
}

}  // namespace

void pull(std::vector<HeldSpring>& springs, double node_step, double h) {
  for (HeldSpring& spring : springs) {
    btRigidBody* rigid = spring.holder == nullptr ? nullptr : &spring.holder->rigid;
    btVector3 target = spring.place;
    if (rigid != nullptr)
      target += rigid->getWorldTransform().getOrigin() + rigid->getVelocityInLocalPoint(spring.place) * h;
    const btVector3 wanted = (target - *spring.x) * spring.stiffness - spring.from_damping;
    const btVector3 before = spring.force;
    spring.force += spring.share * (wanted - before);
    const double size = spring.force.length();
    if (size > spring.max_force) spring.force *= spring.max_force / size;
    const btVector3 more = spring.force - before;
    *spring.x += more * (node_step * node_step * spring.inverse_mass);
    if (rigid != nullptr) rigid->applyImpulse(more * -h, spring.lever);
  }
}

void SoftGripData::release() {
  for (const HeldNode& each : held) std::erase(grips_of(*each.body), this);
  held.clear();
  holder = nullptr;
}

void SoftGripData::let_go_of(const SoftBody& body) {
  std::erase_if(held, [&](const HeldNode& each) { return each.body == &body; });
  std::erase(grips_of(body), this);
  if (held.empty()) holder = nullptr;
}

bool SoftGripData::take(const WorldData& world, BodyData* by, SoftBody& body, std::size_t node,
                        const math::Vec3& place) {
  if (node >= body.node_count() || held.size() >= SoftGrip::kMaxNodes || world.soft == nullptr) return false;
  if (!held.empty() && holder != by) return false;
  const std::vector<SoftBody*>& all = world.soft->all();
  if (std::find(all.begin(), all.end(), &body) == all.end()) return false;
  for (const HeldNode& each : held)
    if (each.body == &body && each.node == node) return false;
  holder = by;
  held.push_back({&body, node, place, {}});
  std::vector<SoftGripData*>& grips = grips_of(body);
  if (std::find(grips.begin(), grips.end(), this) != grips.end()) return true;
  const auto later =
      std::find_if(grips.begin(), grips.end(), [](const SoftGripData* each) { return !each->options.first; });
  grips.insert(options.first ? later : grips.end(), this);
  return true;
}

std::vector<SoftGripData*>& grips_of(const SoftBody& body) {
  if (body.is_thread()) return body.thread()->grips;
  return body.is_tissue() ? body.tissue()->grips : body.data().grips;
}

void let_go(const SoftBody& body) {
  const std::vector<SoftGripData*>& grips = grips_of(body);
  while (!grips.empty()) grips.back()->let_go_of(body);
}

void release_grips_of(const std::vector<SoftBody*>& bodies, const BodyData& holder) {
  for (SoftBody* body : bodies) {
    std::vector<SoftGripData*>& grips = grips_of(*body);
    for (std::size_t i = grips.size(); i-- > 0;)
      if (grips[i]->holder == &holder) grips[i]->release();
  }
}

bool held_off(const std::vector<SoftGripData*>& grips, const SoftBody& soft, std::size_t node, const BodyData& body) {
  const auto joined = [&](const BodyData& holder) {
    if (&holder == &body) return true;
    return std::any_of(holder.joints.begin(), holder.joints.end(),
                       [&](const JointData* joint) { return &joint->parent == &body || &joint->child == &body; });
  };
  for (const SoftGripData* grip : grips)
    for (const HeldNode& held : grip->held)
      if (grip->holder != nullptr && held.body == &soft && held.node == node && joined(*grip->holder)) return true;
  return false;
}

void make_springs(SoftData& data, double h) {
  data.springs.clear();
  for (SoftGripData* grip : data.grips)
    for (HeldNode& held : grip->held)
      if (held.body == data.owner) data.springs.push_back(make_spring(data, *grip, held, h));
}

void solve_with_held_nodes(SoftData& data, double h) {
  btSoftBody& soft = *data.soft;
  std::vector<HeldSpring>& springs = data.springs;
  make_springs(data, h);
  const double step = soft.m_sst.sdt;

  // From here on it is btSoftBody::solveConstraints() of Bullet 3.06, without its anchors.
  soft.applyClusters(false);
  for (int i = 0; i < soft.m_links.size(); ++i) {
    btSoftBody::Link& link = soft.m_links[i];
    link.m_c3 = link.m_n[1]->m_q - link.m_n[0]->m_q;
    link.m_c2 = 1 / (link.m_c3.length2() * link.m_c0);
  }
  if (soft.m_cfg.viterations > 0) {
    for (int pass = 0; pass < soft.m_cfg.viterations; ++pass)
      for (int i = 0; i < soft.m_cfg.m_vsequence.size(); ++i)
        btSoftBody::getSolver(soft.m_cfg.m_vsequence[i])(&soft, 1);
    for (int i = 0; i < soft.m_nodes.size(); ++i) {
      btSoftBody::Node& node = soft.m_nodes[i];
      node.m_x = node.m_q + node.m_v * step;
    }
  }
  if (soft.m_cfg.piterations > 0) {
    push_as_before(data);
    for (int pass = 0; pass < soft.m_cfg.piterations; ++pass) {
      pull(springs, step, h);
      push_on_tissue(data);
      const btScalar done = pass / static_cast<btScalar>(soft.m_cfg.piterations);
      for (int i = 0; i < soft.m_cfg.m_psequence.size(); ++i)
        btSoftBody::getSolver(soft.m_cfg.m_psequence[i])(&soft, 1, done);
    }
    pull(springs, step, h);
    push_on_tissue(data);
    const btScalar kept = soft.m_sst.isdt * (1 - soft.m_cfg.kDP);
    for (int i = 0; i < soft.m_nodes.size(); ++i) {
      btSoftBody::Node& node = soft.m_nodes[i];
      node.m_v = (node.m_x - node.m_q) * kept;
      node.m_f = btVector3(0, 0, 0);
    }
  } else {
    pull(springs, step, h);
    for (const HeldSpring& spring : springs)
      soft.m_nodes[static_cast<int>(spring.held->node)].m_v += spring.force * (step * spring.inverse_mass);
  }
  if (soft.m_cfg.diterations > 0) {
    const btScalar drift = soft.m_cfg.kVCF * soft.m_sst.isdt;
    for (int i = 0; i < soft.m_nodes.size(); ++i) soft.m_nodes[i].m_q = soft.m_nodes[i].m_x;
    for (int pass = 0; pass < soft.m_cfg.diterations; ++pass)
      for (int i = 0; i < soft.m_cfg.m_dsequence.size(); ++i)
        btSoftBody::getSolver(soft.m_cfg.m_dsequence[i])(&soft, 1, 0);
    for (int i = 0; i < soft.m_nodes.size(); ++i) {
      btSoftBody::Node& node = soft.m_nodes[i];
      node.m_v += (node.m_x - node.m_q) * drift;
    }
  }
  soft.dampClusters();
  soft.applyClusters(true);
  for (const HeldSpring& spring : springs) spring.held->force_world = from_bullet(spring.force);
}

}  // namespace detail

SoftGrip::SoftGrip(const SoftGripOptions& options) : data_(std::make_unique<detail::SoftGripData>()) {
  data_->options = options;
  data_->held.reserve(kMaxNodes);
}

SoftGrip::~SoftGrip() { release(); }

bool SoftGrip::hold(Body& holder, SoftBody& body, std::size_t node) {
  if (node >= body.node_count()) return false;
  if (body.frozen() || holder.frozen()) return false;
  return hold_at(holder, body, node, math::inverse(holder.com_pose()) * body.position(node));
}

bool SoftGrip::hold_at(Body& holder, SoftBody& body, std::size_t node, const math::Vec3& place) {
  detail::BodyData& own = holder.data();
  if (own.world == nullptr || own.mounted || !data_->take(*own.world, &own, body, node, place)) return false;
  holder.wake();
  return true;
}

bool SoftGrip::hold_in_world(const World& world, SoftBody& body, std::size_t node) {
  if (node >= body.node_count() || body.frozen()) return false;
  return data_->take(world.data(), nullptr, body, node, body.position(node));
}

void SoftGrip::shift(const math::Vec3& way_world) {
  for (HeldNode& each : data_->held) each.place += way_world;
}

void SoftGrip::set_max_force(double max_force) { data_->options.max_force = max_force; }
void SoftGrip::release() { data_->release(); }

Body* SoftGrip::holder() const { return data_->holder == nullptr ? nullptr : &data_->holder->owner; }
std::span<const HeldNode> SoftGrip::held() const { return data_->held; }
math::Vec3 SoftGrip::target(const HeldNode& node) const {
  return data_->holder == nullptr ? node.place : data_->holder->owner.com_pose() * node.place;
}

bool SoftGrip::holds_any_of(const SoftBody& body) const {
  return std::any_of(held().begin(), held().end(), [&](const HeldNode& each) { return each.body == &body; });
}

}  // namespace ambf::physics
