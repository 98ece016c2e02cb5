// Soft bodies of links on tissue: nodes on its faces, and its points on theirs, which keep the margin. The tissue is a
// wall that moves as it did in the last step, and gives way as the mass of its corners alone would to more than they
// have come to bear: so a heavy cloth does not throw light tissue about, and what lies on it does not sink in. What it
// was given acts as a force in its own step, which comes later: at rest what the links weigh.
#include <algorithm>
#include <cmath>

#include "physics/soft/detail/link_step.h"
#include "physics/soft/detail/near_shape.h"
#include "physics/soft/detail/soft_data.h"
#include "physics/soft/detail/tip_faces.h"
#include "physics/soft/detail/touch_search.h"

namespace ambf::physics::detail {

using math::Vec3;

namespace {

constexpr double kNoDirection = 1e-12;  // m: below it a difference of points has none
constexpr double kTorn = 0.5;  // elements: what is as far from where it is held was put there, and did not slide
constexpr double kComesToBear_s = 0.1;
constexpr double kUnloads = 2.0;      // what it bears is not above that many times what was pushed in the last step
constexpr double kSpringsBack = 1.0;  // m/s: as the load on it ends, tissue is not expected to come back faster
constexpr double kEases = 0.5;        // of what is missing, that a pass adds: contacts share corners and links
constexpr std::size_t kRoom = SoftBody::kMaxTissuePoints;

// Points of one element share corners.
void add(FaceContact& contact, const TissuePoint& point, double share) {
  for (std::size_t k = 0; k < 4; ++k) {
    if (point.weight[k] * share == 0.0) continue;
    std::size_t at = 0;
    while (at < contact.corners && contact.corner[at] != point.corner[k]) ++at;
    if (at == contact.corners) contact.corner[contact.corners++] = point.corner[k];
    contact.weight[at] += point.weight[k] * share;
  }
}

void add_node(FaceContact& contact, SoftData& links, std::uint32_t number, double weight) {
  btSoftBody::Node& node = links.soft->m_nodes[static_cast<int>(number)];
  contact.node[contact.nodes++] = {links.is_plain ? &links.now[number] : &node.m_x,
                                   links.is_plain ? &links.last_good[number] : &node.m_q, weight,
                                   node.m_im * weight * links.soft->m_sst.sdt};
}

// With nodes, corners and the normal; the place of the nodes is that far (m) in front of the surface and its margin.
// False: nothing of it moves.
bool complete(FaceContact& contact, const SoftData& links, TissueData& tissue, double above) {
  const btSoftBody::Config& config = links.soft->m_cfg;
  double yields = 0.0;  // m/Ns
  for (std::size_t k = 0; k < contact.nodes; ++k) yields += contact.node[k].weight * contact.node[k].yield;
  for (std::size_t k = 0; k < contact.corners; ++k)
    if (!tissue.solid.fixed(contact.corner[k]))
      yields +=
          contact.weight[k] * contact.weight[k] / tissue.solid.masses()[contact.corner[k]] * links.soft->m_sst.sdt;
  if (!(yields > 0.0)) return false;
  contact.tissue = &tissue;
  contact.impulse = 1.0 / yields;
  contact.offset = above - contact.normal.dot(contact.now());
  contact.depth = std::min(0.0, contact.normal.dot(contact.before()) + contact.offset) * (1.0 - config.kKHR);
  contact.friction = config.kDF * tissue.friction;
  contact.pushed.setZero();
  return true;
}

// Of what has left the surface by a little, and may come back in the next step.
void ease(SoftData& links, LinkHold& hold) {
  links.may_be_held = true;
  hold.pushed.setZero(), hold.off.setZero();
  hold.borne *= 1.0 - std::min(1.0, links.soft->m_sst.sdt / kComesToBear_s);
  hold.slid = true;
}

// `off`: of the nodes from where they are held; `hold_at` holds them anew, as far off. `with`: what they are held on.
template <class HoldAt>
void rub(SoftData& links, FaceContact& contact, LinkHold& hold, const void* with, const btVector3& off,
         const HoldAt& hold_at) {
  const btVector3 across = off - contact.normal * off.dot(contact.normal);
  const double size = across.length(), far = kTorn * contact.tissue->grid.element_size;
  if (hold.with != with || !(size < far)) {
    hold.pushed.setZero(), hold.borne.setZero(), hold.off.setZero();
    hold_at(hold.off);
  } else if (hold.slid) {
    // As far off as before, the way that it slides: nodes that pull against each other come to pull together.
    const double most = hold.off.length();
    hold.off = size > most ? across * (most / size) : across;
    hold_at(hold.off);
  } else {
    hold.off = across;
  }
  hold.with = with;
  contact.hold = &hold;
  contact.back = hold.off * links.soft->m_cfg.kKHR;
  links.on_tissue.push_back(contact);
  links.may_be_held = true;
}

}  // namespace

void SoftData::make_room_for_touches() {
  on_tissue.reserve(now.size() + kRoom);
  near_tissue.resize(now.size());
  holds.resize(kHolds * now.size());
  cells.make_room(now.size());
  for (const auto& face : faces) {
    double size = 0.0;
    for (std::size_t k = 0; k < 3; ++k) size = std::max(size, (rest[face[k]] - rest[face[(k + 1) % 3]]).length());
    face_size.push_back(size);
  }
}

// Where `flags` let its nodes meet rigid or soft bodies.
bool SoftData::meets(const TissueData& tissue) const {
  return (meets_bodies_by_nodes() || (soft->m_cfg.collisions & btSoftBody::fCollision::VF_SS) != 0) &&
         tissue.touch.others && !tissue.frozen && groups_meet(collision_groups, tissue.collision_groups);
}

bool SoftData::touches(const TissueData& tissue) const {
  return std::any_of(on_tissue.begin(), on_tissue.end(),
                     [&](const FaceContact& each) { return each.tissue == &tissue; });
}

LinkHold* SoftData::hold_of(std::size_t node, const TissueData* tissue) {
  LinkHold* first = &holds[kHolds * node];
  LinkHold* found = std::find_if(first, first + kHolds, [&](const LinkHold& each) { return each.with == tissue; });
  return found == first + kHolds ? nullptr : found;
}

void SoftData::let_go(TissueData* tissue) {
  for (LinkHold& hold : holds)
    if (tissue == nullptr || hold.with == tissue) hold.with = nullptr;
  if (tissue == nullptr) return;
  for (LinkHold& hold : tissue->link_holds)
    if (hold.with == this) hold.with = nullptr;
}

void SoftData::forget(TissueData& tissue) {
  std::erase_if(on_tissue, [&](const FaceContact& each) { return each.tissue == &tissue; });
  let_go(&tissue);
}

namespace {

// Of a node, with what is the nearest to it. False: it does not touch it.
bool meet(SoftData& links, TissueData& tissue, std::uint32_t node, const NearFace& near, double keep,
          FaceContact& made) {
  const auto& face = tissue.grid.faces[near.face];
  // Which way is out is as its corners say together: beside an edge no single face knows.
  btVector3 away = links.now[node], out(0, 0, 0);
  for (std::size_t k = 0; k < 3; ++k) {
    away -= tissue.at[face[k]] * near.share[k];
    out += tissue.touch.normal[stands_for(tissue, face[k])] * (near.front ? near.share[k] : -near.share[k]);
  }
  const bool within = away.dot(out) < 0.0;
  if (!within && near.away >= keep) return false;
  made.normal = near.away > kNoDirection ? away * ((within ? -1.0 : 1.0) / near.away) : out.safeNormalize();
  for (std::size_t k = 0; k < 3; ++k) add(made, tissue.grid.points[face[k]], near.share[k]);
  add_node(made, links, node, 1.0);
  return complete(made, links, tissue, (within ? -near.away : near.away) - keep);
}

// Nodes on faces of tissue.
void lay_nodes(SoftData& links, TissueData& tissue, double keep) {
  find_faces(links, tissue, keep);
  const double stays = keep + kStays * tissue.grid.element_size;
  for (std::uint32_t i = 0; i < links.now.size(); ++i) {
    const NearFace& near = links.near_tissue[i];
    LinkHold* hold = links.hold_of(i, &tissue);
    if (!near.found) {
      if (hold != nullptr) hold->with = nullptr;
      continue;
    }
    const bool held = hold != nullptr;
    if (!held) hold = links.hold_of(i, nullptr);
    const bool room = hold != nullptr && links.on_tissue.size() < links.on_tissue.capacity();
    tissue.touch.left_out |= !room;
    FaceContact made{};
    if (!room || !meet(links, tissue, i, near, keep, made)) {
      if (held && near.away < stays)
        ease(links, *hold);
      else if (held)
        hold->with = nullptr;
      continue;
    }
    hold->near = near.face;
    hold->front = near.front;
    hold->normal = made.normal;
    const btVector3& at = *made.node[0].q;
    const btVector3 off = held ? btVector3(at - place_of(tissue, hold->face, hold->share)) : btVector3(0, 0, 0);
    rub(links, made, *hold, &tissue, off, [&](const btVector3& from) {
      const Facet facet = facet_of(tissue, near.face);
      hold->face = near.face;
      hold->share = facet.shares(at - from - facet.a);
    });
  }
}

// Points of tissue on faces of nodes.
void lay_points(SoftData& links, TissueData& tissue, double keep) {
  if (!find_points(links, tissue, keep)) return;
  const auto place = [&](std::uint32_t face, const std::array<double, 3>& share) {
    btVector3 sum(0, 0, 0);
    for (std::size_t k = 0; k < 3; ++k) sum += links.last_good[links.faces[face][k]] * share[k];
    return sum;
  };
  for (std::uint32_t i = 0; i < tissue.at.size(); ++i) {
    const NearFace& near = tissue.near_links[i];
    LinkHold& hold = tissue.link_holds[i];
    const bool held = hold.with == &links;
    if (!near.found || (hold.with != nullptr && !held)) {
      if (held) hold.with = nullptr;
      continue;
    }
    if (links.on_tissue.size() == links.on_tissue.capacity()) {
      tissue.touch.left_out = true;
      return;
    }
    if (near.away >= keep) {
      if (held) ease(links, hold);
      continue;
    }
    const auto& face = links.faces[near.face];
    const btVector3 &a = links.now[face[0]], &b = links.now[face[1]], &c = links.now[face[2]];
    FaceContact made{};
    made.normal = Facet(a, b, c).normal * (near.front ? -1.0 : 1.0);
    for (std::size_t k = 0; k < 3; ++k) add_node(made, links, face[k], near.share[k]);
    add(made, tissue.grid.points[i], 1.0);
    if (!complete(made, links, tissue, near.away - keep)) continue;
    hold.front = near.front;
    const btVector3 off = held ? btVector3(place(hold.face, hold.share) - tissue.at[i]) : btVector3(0, 0, 0);
    rub(links, made, hold, &links, off, [&](const btVector3& from) {
      const btVector3& first = links.last_good[face[0]];
      hold.face = near.face;
      hold.share = Facet(first, links.last_good[face[1]], links.last_good[face[2]]).shares(tissue.at[i] + from - first);
    });
  }
}

// What the tissue has come to bear does not move it: it is taken off what it will be given.
void expect(const SoftData& links, TissueData& tissue, std::size_t first) {
  if (links.on_tissue.size() > first && tissue.hit.empty()) tissue.hit.assign(tissue.solid.corner_count(), Vec3{});
  const auto each_corner = [&](const auto& use) {
    for (std::size_t i = first; i < links.on_tissue.size(); ++i) {
      const FaceContact& contact = links.on_tissue[i];
      for (std::size_t k = 0; k < contact.corners; ++k)
        if (!tissue.solid.fixed(contact.corner[k])) use(contact, contact.corner[k], contact.weight[k]);
    }
  };
  each_corner([&](const FaceContact& contact, std::uint32_t corner, double weight) {
    const btVector3& borne = contact.hold->borne;
    const double size = borne.length(), most = kUnloads * contact.hold->pushed.length();
    const double share = size > most ? most / size : 1.0;
    tissue.hit[corner] += from_bullet(borne) * (share * weight / tissue.solid.masses()[corner]);
  });
  each_corner([&](const FaceContact&, std::uint32_t corner, double) {
    if (const double size = math::norm(tissue.hit[corner]); size > kSpringsBack)
      tissue.hit[corner] = tissue.hit[corner] * (kSpringsBack / size);
  });
}

}  // namespace

void lay_on(SoftData& links, TissueData& tissue) {
  tissue.find_bounds();
  if (!links.meets(tissue) || !Box{tissue.low, tissue.high}.overlaps(links.low, links.high)) {
    if (links.was_held) links.let_go(&tissue);
    return;
  }
  count(tissue);
  const std::size_t first = links.on_tissue.size();
  const double keep = links.soft->getCollisionShape()->getMargin() + 0.5 * tissue.grid.thickness;
  lay_nodes(links, tissue, keep);
  lay_points(links, tissue, keep);
  expect(links, tissue, first);
}

namespace {

void give(FaceContact& contact, const btVector3& push) {
  const btVector3 more = push - contact.pushed;
  contact.pushed = push;
  for (std::size_t k = 0; k < contact.nodes; ++k) *contact.node[k].x += more * contact.node[k].yield;
  TissueData& tissue = *contact.tissue;
  for (std::size_t k = 0; k < contact.corners; ++k) {
    const std::uint32_t corner = contact.corner[k];
    if (!tissue.solid.fixed(corner))
      tissue.hit[corner] -= from_bullet(more) * (contact.weight[k] / tissue.solid.masses()[corner]);
  }
}

}  // namespace

// Several nodes at one corner would else share what they bear as few passes over them happen to.
void push_as_before(SoftData& links) {
  for (FaceContact& contact : links.on_tissue) give(contact, contact.hold->pushed);
}

// Adds what is missing, to the nodes and to the corners, of what keeps the nodes outside and, within friction, where
// they are on the surface.
void push_on_tissue(SoftData& links) {
  const double step = links.soft->m_sst.sdt;
  for (FaceContact& contact : links.on_tissue) {
    const TissueData& tissue = *contact.tissue;
    Vec3 carried{};
    for (std::size_t k = 0; k < contact.corners; ++k) {
      const std::uint32_t corner = contact.corner[k];
      carried += (tissue.solid.velocities()[corner] + tissue.hit[corner]) * contact.weight[k];
    }
    const btVector3 x = contact.now(), &normal = contact.normal, way = to_bullet(carried) * step;
    const btVector3 slid = x - contact.before() - way;
    const double beyond = (x - way).dot(normal) + contact.offset - contact.depth;
    const btVector3 missing = (slid - normal * slid.dot(normal)) + contact.back + normal * beyond;
    btVector3 push = contact.pushed - missing * (contact.impulse * kEases);
    const double along = push.dot(normal), most = contact.friction * along;
    const btVector3 side = push - normal * along;
    const double size = side.length();
    contact.slides = size > most;
    if (!(along > 0.0))
      push.setZero();
    else if (contact.slides)
      push = normal * along + side * (most / size);
    give(contact, push);
  }
}

void SoftData::end_touches() {
  const double share = std::min(1.0, soft->m_sst.sdt / kComesToBear_s);
  for (const FaceContact& each : on_tissue) {
    LinkHold& hold = *each.hold;
    hold.pushed = each.pushed;
    hold.borne += (each.pushed - hold.borne) * share;
    hold.slid = each.slides;
  }
}

void press(const SoftData& links, TissueData& tissue, double h) {
  for (const FaceContact& contact : links.on_tissue) {
    if (contact.tissue != &tissue) continue;
    const Vec3 force = from_bullet(contact.pushed) * (-1.0 / h);
    for (std::size_t k = 0; k < contact.corners; ++k)
      tissue.solid.add_force(contact.corner[k], force * contact.weight[k]);
  }
}

}  // namespace ambf::physics::detail
