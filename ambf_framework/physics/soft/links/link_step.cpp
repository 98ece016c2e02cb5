// The step of a soft body of links: Bullet 3.06's, number for number. Bullet's own nodes are half a kilobyte each, its
// contacts more than one, and it keeps trees and normals that only some settings read. A body that has no such setting
// is stepped here, on places and links that lie close together: twice to four times as fast with thousands of nodes.
#include "physics/soft/detail/link_step.h"

#include <algorithm>

#include "physics/detail/body_data.h"
#include "physics/soft/detail/soft_data.h"
#include "physics/soft/held_nodes.h"

namespace ambf::physics::detail {

namespace {

// What Bullet reads trees, normals, poses, velocities or clusters for.
bool is_plain_of(const scene::SoftConfig& config) {
  const bool has_forces = config.kLF > 0.0 || config.kDG > 0.0 || config.kPR != 0.0 || config.kVC > 0.0;
  const bool meets_soft = (config.flags & btSoftBody::fCollision::SVSmask) != 0;
  const bool meets_by_clusters =
      config.clusters >= 0 || (config.flags & btSoftBody::fCollision::RVSmask) == btSoftBody::fCollision::CL_RS;
  return !has_forces && !(config.kMT > 0.0) && !meets_soft && !meets_by_clusters && config.viterations <= 0 &&
         config.diterations <= 0 && config.piterations > 0;
}

// btSoftBody::PSolve_RContacts.
void push(SoftData& data) {
  const double step = data.soft->m_sst.sdt, margin = data.soft->getCollisionShape()->getMargin();
  for (const NodeContact& contact : data.contacts) {
    const MovingContact* moving =
        contact.moving < 0 ? nullptr : &data.moving_contacts[static_cast<std::size_t>(contact.moving)];
    btVector3& x = data.now[contact.node];
    const btVector3 moved = x - data.last_good[contact.node];
    const btVector3 along =
        moved - (moving == nullptr ? contact.carried : moving->rigid->getVelocityInLocalPoint(moving->lever) * step);
    const double closes = along.dot(contact.normal);
    if (closes > SIMD_EPSILON) continue;
    const double depth = std::min(x.dot(contact.normal) + contact.offset, margin);
    const btVector3 slides = along - contact.normal * closes;
    const btVector3 missing = along - slides * contact.slip + contact.normal * (depth * contact.hardness);
    if (moving == nullptr) {
      x -= missing * contact.impulse * contact.yield;
      continue;
    }
    const btVector3 impulse = moving->impulse * missing;
    x -= impulse * contact.yield;
    moving->rigid->applyImpulse(impulse, moving->lever);
  }
}

// btSoftBody::PSolve_Links.
void pull_links(SoftData& data) {
  btVector3* const now = data.now.data();
  const double* const inverse_mass = data.inverse_mass.data();
  for (const CloseLink& link : data.links) {
    btVector3 &a = now[link.a], &b = now[link.b];
    const btVector3 apart = b - a;
    const double length2 = apart.length2();
    if (!(link.rest + length2 > SIMD_EPSILON)) continue;
    const double share = (link.rest - length2) / (link.yield * (link.rest + length2));
    a -= apart * (share * inverse_mass[link.a]);
    b += apart * (share * inverse_mass[link.b]);
  }
}

// Links as their order asks, but such that neighbours in it seldom share a node: a processor works at several at once
// then, in place of waiting for each. Links that share a node keep their order, so every number stays what it was.
std::vector<CloseLink> in_waves(const std::vector<CloseLink>& links, std::size_t nodes) {
  std::vector<std::uint32_t> next_of(nodes, 0), wave_of, begin{0};
  for (const CloseLink& link : links) {
    const std::uint32_t wave = std::max(next_of[link.a], next_of[link.b]);
    next_of[link.a] = next_of[link.b] = wave + 1;
    wave_of.push_back(wave);
    if (begin.size() < wave + 2U) begin.resize(wave + 2U, 0);
    ++begin[wave + 1];
  }
  for (std::size_t wave = 1; wave < begin.size(); ++wave) begin[wave] += begin[wave - 1];
  std::vector<CloseLink> sorted(links.size());
  for (std::size_t i = 0; i < links.size(); ++i) sorted[begin[wave_of[i]]++] = links[i];
  return sorted;
}

}  // namespace

// After all that changes masses and links.
void SoftData::gather_links(const SoftDefinition& given) {
  for (int i = 0; i < soft->m_nodes.size(); ++i) inverse_mass.push_back(soft->m_nodes[i].m_im);
  is_plain = is_plain_of(given.config);
  if (!is_plain) return;
  const btSoftBody::Node* first = &soft->m_nodes[0];
  for (int i = 0; i < soft->m_links.size(); ++i) {
    const btSoftBody::Link& link = soft->m_links[i];
    if (link.m_c0 > 0.0)
      links.push_back({static_cast<std::uint32_t>(link.m_n[0] - first), static_cast<std::uint32_t>(link.m_n[1] - first),
                       link.m_c0, link.m_c1});
  }
  links = in_waves(links, now.size());
  contacts.reserve(4 * now.size());  // a node in a corner meets several bodies
  moving_contacts.reserve(contacts.capacity());
}

void SoftData::begin_step(double h, const btVector3& gravity) {
  surroundings.m_gravity = gravity;
  const double step = h * soft->m_cfg.timescale;
  for (const std::uint32_t node : fixed) {
    btSoftBody::Node& n = soft->m_nodes[static_cast<int>(node)];
    btVector3 speed(0, 0, 0);
    if (carried) {
      speed = (carried_to * rest[node] - now[node]) / step;
      const double size = speed.length();
      if (size > max_carried_speed) speed *= max_carried_speed / size;
    }
    n.m_v = velocity[node] = speed;
  }
  carried = touched_moving = false;
  was_held = may_be_held;
  may_be_held = false;
  on_tissue.clear();
  ++moves;
  last_good = now;
  if (is_plain) {
    // btSoftBody::predictMotion, without what nothing reads.
    soft->m_sst.sdt = step;
    soft->m_sst.isdt = 1 / soft->m_sst.sdt;
    const btVector3 falls = gravity * step;
    const double most = surroundings.m_maxDisplacement / step;
    for (std::size_t i = 0; i < now.size(); ++i) {
      if (inverse_mass[i] > 0) velocity[i] += falls;
      if (pushed) {
        btSoftBody::Node& node = soft->m_nodes[static_cast<int>(i)];
        btVector3 faster = node.m_f * inverse_mass[i] * step;
        for (int axis = 0; axis < 3; ++axis) faster[axis] = std::clamp(faster[axis], -most, most);
        velocity[i] += faster;
        node.m_f = btVector3(0, 0, 0);
      }
      now[i] += velocity[i] * step;
    }
    impulse_of = -1.0;
  } else {
    soft->predictMotion(h);
    for (std::size_t i = 0; i < now.size(); ++i) now[i] = soft->m_nodes[static_cast<int>(i)].m_x;
  }
  pushed = false;
  const double margin = soft->getCollisionShape()->getMargin();
  const Box around = runs.follow(now);
  low = around.low - btVector3(margin, margin, margin);
  high = around.high + btVector3(margin, margin, margin);
}

void SoftData::end_step(double h) {
  if (!is_plain) {
    soft->integrateMotion();
    follow_bullet();
  }
  forget_contacts();
  end_touches();
  sleep.watch(
      now.size(), [&](std::size_t i) { return from_bullet(now[i]); }, h);
}

void SoftData::stop() {
  for (int i = 0; i < soft->m_nodes.size(); ++i) soft->m_nodes[i].m_v = btVector3(0, 0, 0);
  std::fill(velocity.begin(), velocity.end(), btVector3(0, 0, 0));
  speeds2 = 0.0;
}

void solve_plain(SoftData& data, double h) {
  btSoftBody& soft = *data.soft;
  const double step = soft.m_sst.sdt;
  make_springs(data, h);
  push_as_before(data);
  for (int pass = 0; pass < soft.m_cfg.piterations; ++pass) {
    pull(data.springs, step, h);
    push(data);
    push_on_tissue(data);
    pull_links(data);
  }
  pull(data.springs, step, h);
  push_on_tissue(data);
  const double kept = soft.m_sst.isdt * (1 - soft.m_cfg.kDP);
  data.speeds2 = 0.0;
  for (std::size_t i = 0; i < data.now.size(); ++i) {
    data.velocity[i] = (data.now[i] - data.last_good[i]) * kept;
    data.speeds2 += data.velocity[i].length2();
  }
  for (const HeldSpring& spring : data.springs) spring.held->force_world = from_bullet(spring.force);
}

}  // namespace ambf::physics::detail
