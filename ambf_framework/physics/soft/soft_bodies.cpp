// One step of all soft bodies of a world, in the order of btSoftRigidDynamicsWorld, before rigid bodies are solved.
#include "physics/soft/soft_bodies.h"

#include <BulletCollision/CollisionDispatch/btCollisionObjectWrapper.h>
#include <BulletSoftBody/btSoftBodyInternals.h>

#include <algorithm>

#include "physics/detail/world_data.h"
#include "physics/soft/detail/blade_data.h"
#include "physics/soft/detail/link_step.h"
#include "physics/soft/detail/near_shape.h"
#include "physics/soft/detail/needle_data.h"
#include "physics/soft/detail/soft_data.h"
#include "physics/soft/detail/thread_data.h"
#include "physics/soft/detail/thread_tangles.h"
#include "physics/soft/detail/tissue_data.h"
#include "physics/soft/held_nodes.h"

namespace ambf::physics {
namespace detail {

// Rooms that steps fill anew.
struct SoftBodies::Rooms {
  // A rigid body that soft bodies may meet in this step.
  struct Touched {
    BodyData* body;
    btVector3 linear, angular;                    // its velocity as it is
    btVector3 expected_linear, expected_angular;  // with the forces of this step
  };
  std::vector<Touched> touched;
  btAlignedObjectArray<btSoftBody*> stepped;
};

SoftBodies::SoftBodies() : rooms_(std::make_unique<Rooms>()) {}
SoftBodies::~SoftBodies() = default;

void SoftBodies::add(SoftBody& body) {
  bodies_.push_back(&body);
  rooms_->stepped.reserve(static_cast<int>(bodies_.capacity()));
  if (!body.is_thread()) return;
  if (tangles_ == nullptr) tangles_ = std::make_unique<ThreadTangles>();
  tangles_->make_room(*body.thread(), bodies_.capacity());
}

void SoftBodies::remove(SoftBody& body) {
  let_go(body);
  if (body.is_of_links())
    for (SoftBody* other : bodies_)
      if (other->is_tissue()) body.data().let_go(other->tissue());
  if (body.is_tissue()) {
    for (BladeData* blade : blades_) blade->forget(body.tissue());
    for (NeedleData* needle : needles_) needle->forget(body.tissue());
    for (SoftBody* other : bodies_)
      if (other->is_tissue())
        other->tissue()->touch.let_go(body.tissue());
      else if (other->is_of_links())
        other->data().forget(*body.tissue());
  }
  for (NeedleData* needle : needles_)
    if (body.is_thread() && needle->thread == body.thread()) needle->leave_thread();
  if (body.is_thread()) tangles_->remove(*body.thread());
  std::erase(bodies_, &body);
}

void SoftBodies::add(BladeData& blade) { blades_.push_back(&blade); }

// Whether tissue sleeps is asked before it looks for blades anew.
void SoftBodies::remove(BladeData& blade) {
  std::erase(blades_, &blade);
  for (SoftBody* body : bodies_)
    if (body->is_tissue()) std::erase(body->tissue()->blades, &blade);
}

void SoftBodies::add(NeedleData& needle) { needles_.push_back(&needle); }

// All that holds a thread with stitches is felt, and so are its holders.
void SoftBodies::begin_threads(WorldData& world, double h) {
  for (SoftBody* body : bodies_)
    if (body->is_tissue()) body->tissue()->stepped = body->frozen();
  for (NeedleData* needle : needles_) {
    needle->take_free_thread();
    if (needle->thread != nullptr && !needle->stitches.empty()) {
      for (const ThreadAttachment& each : needle->thread->attachments)
        if (each.body != nullptr && each.body->data().world == &world) touch(each.body->data(), h);
      for (const SoftGripData* grip : needle->thread->grips)
        if (grip->holder != nullptr) touch(*grip->holder, h);
    }
    begin_stitches(*needle, h);
  }
}

void SoftBodies::remove(NeedleData& needle) { std::erase(needles_, &needle); }

void SoftBodies::touch(BodyData& body, double h) {
  for (const Rooms::Touched& each : rooms_->touched)
    if (each.body == &body) return;
  btRigidBody& own = body.rigid;
  Rooms::Touched touched{&body, own.getLinearVelocity(), own.getAngularVelocity(), {}, {}};
  touched.expected_linear = touched.linear;
  touched.expected_angular = touched.angular;
  if (body.moving_to) {
    btTransformUtil::calculateVelocity(own.getWorldTransform(), to_bullet(body.move_target * body.initial.T_body_com),
                                       h, touched.expected_linear, touched.expected_angular);
  } else if (!body.is_static() && !body.asleep()) {
    touched.expected_linear += (own.getTotalForce() * own.getInvMass() + own.getGravity()) * h;
    touched.expected_angular += own.getInvInertiaTensorWorld() * own.getTotalTorque() * h;
  }
  own.setLinearVelocity(touched.expected_linear);
  own.setAngularVelocity(touched.expected_angular);
  rooms_->touched.push_back(touched);
}

void SoftBodies::meet(SoftBody& soft, BodyData& body, double h) {
  SoftData& data = soft.data();
  for (const SoftGripData* grip : data.grips)
    if (grip->holder == &body) return;  // they pass through each other, as with a grasp of a rigid body
  if (body.shape->empty() || !groups_meet(data.collision_groups, body.initial.collision_groups)) return;
  const btCollisionShape& shape = *body.rigid.getCollisionShape();
  const btTransform& pose = body.rigid.getWorldTransform();
  const double margin = data.soft->getCollisionShape()->getMargin();
  if (!body.shape->infinite() && !box_of(shape, pose, margin).overlaps(data.low, data.high)) return;
  touch(body, h);
  if (data.meets_bodies_by_nodes()) add_contacts(data, body, shape, pose);
  if (!data.meets_bodies_by_clusters() || !shape.isConvex()) return;  // Bullet's clusters meet nothing else
  data.touched_moving |= !body.is_static();
  const btCollisionObjectWrapper wrapper(nullptr, &shape, &body.rigid, pose, -1, -1);
  data.soft->defaultCollisionHandler(&wrapper);
}

void SoftBodies::meet_each_other() {
  btAlignedObjectArray<btSoftBody*>& all = rooms_->stepped;
  for (int i = 0; i < all.size(); ++i) {
    const auto& a = *static_cast<const SoftData*>(all[i]->getUserPointer());
    for (int k = i + 1; k < all.size(); ++k) {
      const auto& b = *static_cast<const SoftData*>(all[k]->getUserPointer());
      if (Box{a.low, a.high}.overlaps(b.low, b.high) && groups_meet(a.collision_groups, b.collision_groups))
        all[i]->defaultCollisionHandler(all[k]);
    }
  }
  for (int i = 0; i < all.size(); ++i) {
    auto& found = all[i]->m_scontacts;
    int kept = 0;
    // Of a node that lies right on a face Bullet divides 0 by 0: it is on neither side, and nothing is to push.
    for (int c = 0; c < found.size(); ++c)
      if (found[c].m_normal.length2() > 0.0) found[kept++] = found[c];
    while (found.size() > kept) found.pop_back();
  }
}

void SoftBodies::step(WorldData& world) {
  if (bodies_.empty()) return;
  const double h = world.h;
  const btVector3 gravity = to_bullet(world.options.gravity);
  btAlignedObjectArray<btSoftBody*>& all = rooms_->stepped;
  all.resize(0);
  rooms_->touched.clear();
  rooms_->touched.reserve(world.bodies.size());
  for (SoftBody* body : bodies_)
    if (body->is_tissue()) body->tissue()->hit.clear();
  for (SoftBody* body : bodies_) {
    if (body->frozen() || !body->is_of_links()) continue;
    SoftData& data = body->data();
    if (rests(data, world)) continue;
    data.begin_step(static_cast<float>(h), gravity);  // Bullet's world rounds it so, and nodes feel it within seconds
    all.push_back(data.soft.get());
    for (const SoftGripData* grip : data.grips)
      if (grip->holder != nullptr) touch(*grip->holder, h);
    for (SoftBody* other : bodies_)
      if (other->is_tissue()) lay_on(data, *other->tissue());
    if (!data.meets_bodies_by_nodes() && !data.meets_bodies_by_clusters()) continue;
    for (BodyData* rigid : world.bodies) meet(*body, *rigid, h);
  }
  meet_each_other();
  btSoftBody::solveClusters(all);
  for (int i = 0; i < all.size(); ++i) {
    auto& data = *static_cast<SoftData*>(all[i]->getUserPointer());
    if (data.is_plain)
      solve_plain(data, h);
    else if (data.grips.empty() && data.on_tissue.empty())
      all[i]->solveConstraints();
    else
      solve_with_held_nodes(data, h);
  }
  for (BladeData* blade : blades_) blade->force_world = {};
  for (NeedleData* needle : needles_) {
    needle->force_world = {};
    needle->seen_inside = false;
  }
  begin_threads(world, h);
  // Threads first: what they do to tissue acts in the same step.
  if (tangles_ != nullptr) step_threads(world, h);
  // Sheets before the solids that they lie on.
  for (const bool sheets : {true, false})
    for (SoftBody* body : bodies_)
      if (body->is_tissue() && !body->frozen() && body->tissue()->is_sheet() == sheets)
        step_tissue(*body->tissue(), world, h);
  for (NeedleData* needle : needles_)
    if (needle->holder != nullptr && needle->tip == TipState::unknown && !needle->seen_inside)
      needle->tip = TipState::outside;
  for (NeedleData* needle : needles_) end_stitches(*needle);
  give_reactions(h);
  // Joints of clusters of one body that touch act in the next step.
  for (int i = 0; i < all.size(); ++i)
    if ((all[i]->m_cfg.collisions & btSoftBody::fCollision::CL_SELF) != 0) all[i]->defaultCollisionHandler(all[i]);
  for (int i = 0; i < all.size(); ++i) static_cast<SoftData*>(all[i]->getUserPointer())->end_step(h);
}

// As a force, so that joints and contacts hold against it.
void SoftBodies::give_reactions(double h) {
  for (const Rooms::Touched& each : rooms_->touched) {
    btRigidBody& rigid = each.body->rigid;
    const btVector3 linear = rigid.getLinearVelocity() - each.expected_linear;
    const btVector3 angular = rigid.getAngularVelocity() - each.expected_angular;
    rigid.setLinearVelocity(each.linear);
    rigid.setAngularVelocity(each.angular);
    if (each.body->is_static() || (linear.isZero() && angular.isZero())) continue;
    const btVector3 torque = rigid.getInvInertiaTensorWorld().inverse() * angular / h;
    each.body->owner.apply_wrench({from_bullet(linear / (rigid.getInvMass() * h)), from_bullet(torque)});
  }
}

void SoftBodies::forget(const BodyData& body) {
  for (SoftBody* each : bodies_) {
    if (each->is_tissue()) each->tissue()->forget(body);
    if (each->is_thread()) each->thread()->forget(body);
  }
  for (BladeData* blade : blades_) {
    if (blade->holder != &body) continue;
    blade->holder = nullptr;
    blade->forget(nullptr);
  }
  for (NeedleData* needle : needles_) {
    if (needle->holder != &body) continue;
    needle->holder = nullptr;
    needle->hang_thread();
    needle->forget(nullptr);
  }
}

void SoftBodies::restart() {
  for (SoftBody* body : bodies_) {
    if (body->is_tissue())
      body->tissue()->restart();
    else if (body->is_thread())
      body->thread()->restart();
    else
      body->data().restart();
  }
}

void SoftBodies::reset() {
  for (SoftBody* body : bodies_) body->reset();
  for (BladeData* blade : blades_) blade->forget(nullptr);
  for (NeedleData* needle : needles_) needle->forget(nullptr);
}

}  // namespace detail

void add(World& world, SoftBody& body) {
  std::unique_ptr<detail::SoftBodies>& all = world.data().soft;
  if (all == nullptr) all = std::make_unique<detail::SoftBodies>();
  all->add(body);
}

void remove(World& world, SoftBody& body) {
  if (world.data().soft != nullptr) world.data().soft->remove(body);
}

std::size_t soft_body_count(const World& world) {
  return world.data().soft == nullptr ? 0 : world.data().soft->all().size();
}

std::vector<SoftDivergence> freeze_diverged_soft_bodies(World& world, const SpeedLimits& limits) {
  std::vector<SoftDivergence> found;
  if (world.data().soft == nullptr) return found;
  for (SoftBody* body : world.data().soft->all()) {
    const std::optional<SoftDivergence> diverged = body->divergence(limits);
    if (!diverged) continue;
    found.push_back(*diverged);
    body->freeze();
  }
  return found;
}

}  // namespace ambf::physics
