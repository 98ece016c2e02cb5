// A step of a thread: what it touches and hangs on become springs, which the solver takes along.
#include <algorithm>
#include <optional>

#include "physics/detail/world_data.h"
#include "physics/soft/detail/blade_data.h"
#include "physics/soft/detail/near_shape.h"
#include "physics/soft/detail/needle_data.h"
#include "physics/soft/detail/thread_data.h"
#include "physics/soft/detail/thread_tangles.h"
#include "physics/soft/held_nodes.h"
#include "physics/soft/soft_bodies.h"

namespace ambf::physics::detail {

using math::Vec3;

namespace {

// What is pushed out of a body leaves within this time (s), instead of being shot off by a stiff spring.
constexpr double kCalming_s = 0.003;

// Of stitches: N/m, and about the most (N) that one pulls the thread by; and the most (N) of who holds it while
// stitches bear the rest.
constexpr double kFollowing = 500.0, kMaxFollowing = 0.05, kMaxBeside = 0.03;

constexpr int kHalvings = 12;  // of a segment, to where it is deepest

bool kept_off(const ThreadData& thread, const ThreadPoint& point, const BodyData& body) {
  return thread.hangs_on(point, body) || held_off(thread.grips, *thread.owner, point.segment, body) ||
         held_off(thread.grips, *thread.owner, point.segment + 1, body);
}

// Inside a segment whose ends both slope down towards its middle: an edge or a bulge reaches farther there. Of a convex
// shape there is one such place.
void find_inside(ThreadData& thread, const MetShape& met, const btTransform& pose, std::uint32_t segment, double reach,
                 ThreadPoint& point, std::optional<PointDistance>& near) {
  const btVector3 a = pose.invXform(thread.at[segment]), along = pose.invXform(thread.at[segment + 1]) - a;
  double low = 0.0, high = 1.0;
  for (int k = 0; k < kHalvings; ++k) {
    point = {segment, 0.5 * (low + high)};
    near = met.near(a + along * point.share, reach);
    if (!near) return;
    (near->normal.dot(along) < 0.0 ? low : high) = point.share;
  }
}

void find_contacts(ThreadData& thread, const BodyData& body, const btCollisionShape& shape, const btTransform& pose) {
  if (shape.isCompound()) {
    const auto& compound = static_cast<const btCompoundShape&>(shape);
    for (int i = 0; i < compound.getNumChildShapes(); ++i)
      find_contacts(thread, body, *compound.getChildShape(i), pose * compound.getChildTransform(i));
    return;
  }
  const MetShape met(shape);
  if (!met.can_be_met) return;
  const Box box = box_of(shape, pose, thread.margin + thread.longest);
  if (!box.overlaps(thread.low, thread.high)) return;
  const auto nodes = static_cast<std::uint32_t>(thread.at.size());
  const double reach = thread.margin + thread.longest, ahead = 0.5 * thread.longest;
  const auto add = [&](std::uint32_t of, const ThreadPoint& point, const PointDistance& near) {
    if (near.distance < thread.margin + ahead && thread.found.size() < thread.found.capacity() &&
        !kept_off(thread, point, body))
      thread.found.push_back({of, point, pose.getBasis() * near.normal, thread.margin - near.distance});
  };
  std::optional<PointDistance> before;
  for (std::uint32_t i = 0; i < nodes; ++i) {
    std::optional<PointDistance> here;
    if (box.contains(thread.at[i])) here = met.near(pose.invXform(thread.at[i]), reach);
    if (here) add(i, thread.point_of(i), *here);
    if (here && before) {
      const btVector3 along = pose.getBasis().transpose() * (thread.at[i] - thread.at[i - 1]);
      if (before->normal.dot(along) < 0.0 && here->normal.dot(along) > 0.0) {
        ThreadPoint point;
        std::optional<PointDistance> inside;
        find_inside(thread, met, pose, i - 1, reach, point, inside);
        if (inside) add(nodes + i - 1, point, *inside);
      }
    }
    before = here;
  }
}

ThreadHold* hold_of(std::array<ThreadHold, ThreadData::kHolds>& holds, const BodyData& body) {
  for (const BodyData* wanted : {&body, static_cast<const BodyData*>(nullptr)})
    for (ThreadHold& hold : holds) {
      if (hold.body != wanted) continue;
      if (wanted == nullptr) hold = {&body, {0, 0, 0}, false};
      hold.renewed = true;
      return &hold;
    }
  return nullptr;
}

// `count` threads that touch each other may all bear on the body.
void add_contacts(ThreadData& thread, BodyData& body, std::size_t count, double h) {
  const btMatrix3x3& turned = body.rigid.getWorldTransform().getBasis();
  const auto touching = std::count_if(thread.found.begin(), thread.found.end(), [&](const ThreadData::Contact& each) {
    return each.depth > -0.1 * thread.radius;
  });
  for (const ThreadData::Contact& contact : thread.found) {
    if (thread.pulls.size() == thread.pulls.capacity()) return;
    const btVector3 at = to_bullet(thread.chain.at(contact.point));
    ThreadHold* hold = hold_of(thread.holds[contact.of], body);
    ThreadPull pull;
    pull.touches = true;
    pull.at = contact.point;
    pull.normal = from_bullet(contact.normal);
    pull.depth = contact.depth;
    pull.calming = kCalming_s;
    const double calmed = 1.0 + kCalming_s / h;
    pull.stiffness = held_back_in_all(thread.contact_stiffness[contact.of] * calmed, body, at, h,
                                      count * static_cast<std::size_t>(std::max<std::ptrdiff_t>(touching, 1))) /
                     calmed;
    pull.carried = from_bullet(body.rigid.getVelocityInLocalPoint(at - body.rigid.getWorldTransform().getOrigin()));
    pull.friction = hold == nullptr ? 0.0 : thread.friction * body.rigid.getFriction();
    if (hold != nullptr) pull.away = pull.across(from_bullet(turned * hold->away));
    thread.pulls.push_back(pull);
    thread.pulled.push_back(&body);
    thread.pulled_hold.push_back(hold);
  }
}

// A spring from a place that moves at `carried`; `share` of it is what its body bears.
void add_pull(ThreadData& thread, const ThreadSpring& spring, const ThreadPoint& at, double share, BodyData* body,
              double h) {
  ThreadPull pull;
  pull.at = at;
  pull.normal = thread.chain.tangent(at.segment);
  const double stiffness = (spring.stiffness + spring.damping / h) * share;
  using Axes = ThreadSpring::Axes;
  pull.normal_stiffness = spring.axes == Axes::across ? 0.0 : stiffness;
  pull.side_stiffness = spring.axes == Axes::along ? 0.0 : stiffness;
  const Vec3 wanted =
      (spring.anchor - thread.chain.at(at)) * (spring.stiffness * share) + spring.anchor_velocity * (stiffness * h);
  const Vec3 along = pull.normal * math::dot(pull.normal, wanted);
  pull.pull = spring.axes == Axes::all ? wanted : spring.axes == Axes::along ? along : wanted - along;
  const Vec3 force = thread.chain.force_of(pull, h);
  if (const double size = math::norm(force); size > spring.max_force) {
    pull.pull = force * (spring.max_force / size);
    pull.normal_stiffness = pull.side_stiffness = 0.0;
  }
  thread.pulls.push_back(pull);
  thread.pulled.push_back(body);
  thread.pulled_hold.push_back(nullptr);
}

// Of a spring to a body at `place` (COM frame): where that is, how fast, and the share of it that the body bears.
double hang_on(const BodyData& body, const btVector3& place, double h, std::size_t count, ThreadSpring& spring) {
  const btTransform& pose = body.rigid.getWorldTransform();
  const btVector3 at = pose * place;
  spring.anchor = from_bullet(at);
  spring.anchor_velocity = from_bullet(body.rigid.getVelocityInLocalPoint(at - pose.getOrigin()));
  const double full = spring.stiffness + spring.damping / h;
  return full > 0.0 ? held_back_in_all(full, body, at, h, count) / full : 0.0;
}

void add_attachment(ThreadData& thread, const ThreadAttachment& attachment, std::size_t count, double h) {
  BodyData& body = attachment.body->data();
  for (std::size_t i = 0; i < attachment.nodes.size(); ++i) {
    ThreadSpring spring;
    spring.stiffness = thread.node_stiffness;
    const double share = hang_on(body, attachment.places[i], h, count * attachment.nodes.size(), spring);
    add_pull(thread, spring, thread.point_of(attachment.nodes[i]), share, &body, h);
  }
}

void add_held(ThreadData& thread, const SoftGripData& grip, const HeldNode& held, bool beside, std::size_t count,
              double h) {
  ThreadSpring spring;
  spring.anchor = held.place;
  spring.stiffness = grip.options.hardness;
  spring.damping = grip.options.damping;
  spring.max_force = grip.options.max_force;
  double share = 1.0;
  if (grip.holder != nullptr) share = hang_on(*grip.holder, to_bullet(held.place), h, count * grip.held.size(), spring);
  if (beside) {
    const ThreadPoint at = thread.point_of(held.node);
    const double full = spring.stiffness + spring.damping / h;
    const Vec3 after = spring.anchor - thread.chain.at(at) + (spring.anchor_velocity - thread.chain.velocity(at)) * h;
    if (const double force = full * share * math::norm(after); force > kMaxBeside) share *= kMaxBeside / force;
  }
  add_pull(thread, spring, thread.point_of(held.node), share, grip.holder, h);
}

// The thread goes where the tissue that it is sewn through is. What it pulls there is of the tissue's step
// (stitches.cpp): here it is hardly felt, and so has no part in it.
void follow_stitches(ThreadData& thread, const NeedleData& needle, double h) {
  for (const Stitch& stitch : needle.stitches) {
    if (thread.pulls.size() == thread.pulls.capacity()) return;
    ThreadPull pull;
    pull.at = thread.chain.point_at(stitch.s);
    pull.normal = thread.chain.tangent(pull.at.segment);
    const Vec3 gap = stitch.world - thread.chain.at(pull.at);
    const double force = kFollowing * math::norm(gap + (stitch.velocity - thread.chain.velocity(pull.at)) * h);
    const double stiffness = force > kMaxFollowing ? kFollowing * (kMaxFollowing / force) : kFollowing;
    pull.normal_stiffness = pull.side_stiffness = stiffness;
    pull.pull = (gap + stitch.velocity * h) * stiffness;
    thread.pulls.push_back(pull);
    thread.pulled.push_back(nullptr);
    thread.pulled_hold.push_back(nullptr);
  }
}

bool meets(const ThreadData& thread, const BodyData& body) {
  // They pass through each other, as with a grasp of a rigid body.
  if (std::any_of(thread.grips.begin(), thread.grips.end(),
                  [&](const SoftGripData* grip) { return grip->holder == &body; }))
    return false;
  if (body.shape->empty() || !groups_meet(thread.collision_groups, body.initial.collision_groups)) return false;
  return body.shape->infinite() ||
         box_of(*body.rigid.getCollisionShape(), body.rigid.getWorldTransform(), thread.margin + thread.longest)
             .overlaps(thread.low, thread.high);
}

}  // namespace

void SoftBodies::step_threads(WorldData& world, double h) {
  ThreadTangles& tangles = *tangles_;
  tangles.threads.clear();
  for (SoftBody* body : bodies_) {
    if (!body->is_thread()) continue;
    ThreadData& thread = *body->thread();
    tangles.threads.push_back(&thread);
    if (thread.frozen) continue;
    thread.last_good = thread.chain.positions();
    thread.crossings = 0;
    thread.move_fixed(h);
    thread.locate();
  }
  tangles.find(h);
  for (std::uint32_t first = 0; first < tangles.threads.size(); ++first) {
    if (tangles.threads[first]->frozen || tangles.leader(first) != first) continue;
    tangles.numbers.clear();
    tangles.steps.clear();
    for (std::uint32_t i = first; i < tangles.threads.size(); ++i)
      if (tangles.leader(i) == first) tangles.numbers.push_back(i);
    for (const std::uint32_t i : tangles.numbers) {
      ThreadData& thread = *tangles.threads[i];
      gather_pulls(thread, world, tangles.numbers.size(), h);
      tangles.steps.push_back({&thread.chain, thread.pulls, tangles.slack(i)});
    }
    step_chains(tangles.steps, tangles.pairs(), tangles.rooms, h, from_bullet(world.dynamics->getGravity()));
    tangles.remember(h);
    for (const std::uint32_t i : tangles.numbers) use_pulls(*tangles.threads[i], h);
  }
}

// What it touches, hangs on and is held by; `count` threads are solved with it, itself included.
void SoftBodies::gather_pulls(ThreadData& thread, WorldData& world, std::size_t count, double h) {
  thread.pulls.clear();
  thread.pulled.clear();
  thread.pulled_hold.clear();
  thread.pull_force.clear();
  for (auto& holds : thread.holds)
    for (ThreadHold& hold : holds) hold.renewed = false;
  for (const ThreadSpring& spring : thread.asked)
    add_pull(thread, spring, thread.chain.point_at(spring.s), 1.0, nullptr, h);
  for (const ThreadAttachment& attachment : thread.attachments) {
    if (attachment.body == nullptr || attachment.body->data().world != &world) continue;
    touch(attachment.body->data(), h);
    add_attachment(thread, attachment, count, h);
  }
  for (const NeedleData* needle : needles_)
    if (needle->thread == &thread) follow_stitches(thread, *needle, h);
  thread.first_held = thread.pulls.size();
  for (const SoftGripData* grip : thread.grips) {
    if (grip->holder != nullptr) touch(*grip->holder, h);
    for (const HeldNode& held : grip->held)
      if (held.body == thread.owner)
        add_held(thread, *grip, held,
                 std::any_of(needles_.begin(), needles_.end(),
                             [&](const NeedleData* needle) {
                               return needle->thread == &thread && is_beside_stitches(*needle, held);
                             }),
                 count, h);
  }
  for (BodyData* body : world.bodies) {
    if (!meets(thread, *body)) continue;
    thread.found.clear();
    find_contacts(thread, *body, *body->rigid.getCollisionShape(), body->rigid.getWorldTransform());
    if (thread.found.empty()) continue;
    touch(*body, h);
    add_contacts(thread, *body, count, h);
  }
  for (auto& holds : thread.holds)
    for (ThreadHold& hold : holds)
      if (!hold.renewed) hold.body = nullptr;
}

void SoftBodies::use_pulls(ThreadData& thread, double h) {
  thread.contacts = 0;
  ++thread.moves;
  for (std::size_t i = 0; i < thread.pulls.size(); ++i) {
    const ThreadPull& pull = thread.pulls[i];
    thread.pull_force.push_back(thread.chain.force_of(pull, h));
    if (thread.pulled_hold[i] == nullptr) continue;
    // What slides is drawn as far as friction bears.
    const bool holds = pull.normal_stiffness > 0.0;
    const Vec3 away = pull.away + pull.across(thread.chain.velocity(pull.at) - pull.carried) * h;
    const Vec3 drawn = holds ? away * (pull.side_stiffness / pull.stiffness) : Vec3{};
    thread.pulled_hold[i]->away = thread.pulled[i]->rigid.getWorldTransform().getBasis().transpose() * to_bullet(drawn);
    if (holds) ++thread.contacts;
  }
  const auto asked = static_cast<std::ptrdiff_t>(thread.asked.size());
  thread.answered.assign(thread.pull_force.begin(), thread.pull_force.begin() + asked);
  thread.asked.clear();
  std::size_t pull_of_held = thread.first_held;
  for (SoftGripData* grip : thread.grips)
    for (HeldNode& held : grip->held)
      if (held.body == thread.owner) held.force_world = thread.pull_force[pull_of_held++];
  for (std::size_t i = 0; i < thread.pulls.size(); ++i) {
    if (thread.pulled[i] == nullptr || thread.pulled[i]->is_static()) continue;
    BodyData& body = *thread.pulled[i];
    // Where it acts on the thread: no torque between the two.
    const ThreadPoint& at = thread.pulls[i].at;
    const Vec3 place = thread.last_good[at.segment] * (1.0 - at.share) + thread.last_good[at.segment + 1] * at.share;
    body.rigid.applyImpulse(to_bullet(thread.pull_force[i]) * -h,
                            to_bullet(place) - body.rigid.getWorldTransform().getOrigin());
  }
}

}  // namespace ambf::physics::detail
