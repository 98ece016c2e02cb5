// Tissue and bodies of links that lie still sleep: their step is left out until something near them is not what it was,
// to the bit. What counts is what the step would read: gravity, bodies within reach, what they hang on; of tissue other
// tissue there, blades and needles anywhere, too. What is held, pushed, carried, cut or sewn is awake; so are sheets on
// solids with those, and what a body rests on that is not asleep itself.
#include <algorithm>
#include <bit>

#include "physics/detail/world_data.h"
#include "physics/soft/detail/blade_data.h"
#include "physics/soft/detail/near_shape.h"
#include "physics/soft/detail/needle_data.h"
#include "physics/soft/detail/soft_data.h"
#include "physics/soft/detail/tissue_data.h"
#include "physics/soft/held_nodes.h"
#include "physics/soft/soft_bodies.h"

namespace ambf::physics {
namespace detail {

namespace {

constexpr double kFalls_m = 1e-4;  // more than nodes at rest go before they meet something within a step

// Two that differ differ here, but for one chance in 2^64.
class Digest {
 public:
  void add(std::uint64_t value) {
    value_ = (value_ ^ value) * 0x9e3779b97f4a7c15U;
    value_ ^= value_ >> 29U;
  }
  void add(const void* address) { add(std::bit_cast<std::uintptr_t>(address)); }
  void add(const btVector3& v) {
    for (int i = 0; i < 3; ++i) add(std::bit_cast<std::uint64_t>(static_cast<double>(v[i])));
  }
  void add(const BodyData& body) {
    const btTransform& pose = body.rigid.getWorldTransform();
    add(&body);
    add(body.rigid.getCollisionShape());
    for (int row = 0; row < 3; ++row) add(pose.getBasis()[row]);
    add(pose.getOrigin());
    add(body.rigid.getLinearVelocity());
    add(body.rigid.getAngularVelocity());
    add(std::bit_cast<std::uint64_t>(static_cast<double>(body.rigid.getFriction())));
    add(static_cast<std::uint64_t>(body.moving_to ? 1 : 0));
  }
  std::uint64_t value() const { return value_ | 1U; }  // never 0

 private:
  std::uint64_t value_ = 0;
};

// Sewn, cut or touched by an edge: its step has more to read than what the digest knows.
bool is_worked_on(const TissueData& tissue, const std::vector<NeedleData*>& needles) {
  const auto is_here = [&](const auto& each) { return each.tissue == &tissue; };
  return !tissue.needles.empty() ||
         std::any_of(tissue.blades.begin(), tissue.blades.end(),
                     [&](const BladeData* blade) {
                       return std::any_of(blade->samples.begin(), blade->samples.end(), is_here);
                     }) ||
         std::any_of(needles.begin(), needles.end(), [&](const NeedleData* needle) {
           return std::any_of(needle->stitches.begin(), needle->stitches.end(),
                              [&](const Stitch& each) { return is_here(each.at); });
         });
}

bool lies_on_solid(const TissueData& tissue) {
  return std::any_of(tissue.touch.felt.begin(), tissue.touch.felt.end(),
                     [](const TouchRooms::Felt& felt) { return felt.solid != nullptr; });
}

// Bodies whose shapes come that near (m) to the box.
void add_bodies_around(Digest& digest, const WorldData& world, const btVector3& low, const btVector3& high,
                       double reach) {
  for (const BodyData* body : world.bodies) {
    if (body->shape->empty()) continue;
    const btCollisionShape& shape = *body->rigid.getCollisionShape();
    if (body->shape->infinite() || box_of(shape, body->rigid.getWorldTransform(), reach).overlaps(low, high))
      digest.add(*body);
  }
}

// `left_alone`: it may sleep but for what `surroundings` knows; it does not while it `waits` for what moves near it.
template <class Body, class Surroundings, class Waits>
bool sleeps(Body& body, bool moved, bool left_alone, const Surroundings& surroundings, const Waits& waits) {
  SoftSleep& sleep = body.sleep;
  const std::uint64_t near = left_alone && !moved && sleep.is_still() ? surroundings() : 0;
  const bool has_changed = sleep.near != 0 && near != sleep.near;
  const bool is_as_it_was = near != 0 && near == sleep.near && !waits();
  sleep.near = near;
  // At once, and not when it is next looked at: tissue that rests on it goes by that.
  if (!is_as_it_was && (sleep.asleep || moved || has_changed)) sleep.still_s = 0.0;
  sleep.asleep = is_as_it_was;
  return is_as_it_was;
}

// What holds its nodes is part of the scene, and stands.
bool hangs_still(const SoftData& links) {
  return std::all_of(links.grips.begin(), links.grips.end(), [](const SoftGripData* grip) {
    return grip->options.first && grip->holder != nullptr && grip->holder->is_static();
  });
}

}  // namespace

template <class Use>
void SoftBodies::each_other_near(const TissueData& tissue, const Use& use) const {
  for (const SoftBody* body : bodies_) {
    const TissueData* other = body->is_tissue() ? body->tissue() : nullptr;
    if (other != nullptr && other != &tissue && Box{tissue.low, tissue.high}.overlaps(other->low, other->high))
      use(*other);
  }
}

std::uint64_t SoftBodies::surroundings(const TissueData& tissue, const WorldData& world) const {
  Digest digest;
  digest.add(world.dynamics->getGravity());
  const double reach = tissue.margin + tissue.grid.element_size;
  for (const TissueAttachment& attachment : tissue.attachments)
    if (attachment.body != nullptr) digest.add(attachment.body->data());
  add_bodies_around(digest, world, tissue.low, tissue.high, reach);
  each_other_near(tissue, [&](const TissueData& other) { digest.add(&other); });
  for (const SoftBody* body : bodies_)
    if (body->is_of_links() && body->data().touches(tissue)) digest.add(body);
  for (const BladeData* blade : blades_)
    if (blade->holder != nullptr) digest.add(*blade->holder);
  for (const NeedleData* needle : needles_)
    if (needle->holder != nullptr) digest.add(*needle->holder);
  return digest.value();
}

std::uint64_t SoftBodies::surroundings(const SoftData& links, const WorldData& world) const {
  Digest digest;
  digest.add(world.dynamics->getGravity());
  for (const SoftGripData* grip : links.grips) {
    digest.add(grip);
    digest.add(*grip->holder);
  }
  if (links.meets_bodies_by_nodes() || links.meets_bodies_by_clusters())
    add_bodies_around(digest, world, links.low, links.high, links.soft->getCollisionShape()->getMargin() + kFalls_m);
  for (const SoftBody* body : bodies_) {
    if (!body->is_tissue() || !links.meets(*body->tissue())) continue;
    const TissueData& tissue = *body->tissue();
    if (!Box{links.low, links.high}.overlaps(tissue.low, tissue.high)) continue;
    digest.add(&tissue);
    if (!tissue.sleep.is_still()) digest.add(tissue.moves);
  }
  return digest.value();
}

// What gives it forces in each step.
bool SoftBodies::bears_what_is_awake(const TissueData& tissue) const {
  return std::any_of(bodies_.begin(), bodies_.end(), [&](const SoftBody* body) {
    return body->is_of_links() && !body->asleep() && body->data().touches(tissue);
  });
}

bool SoftBodies::may_meet_others(const SoftData& links) const {
  return links.meets_soft_bodies() && std::any_of(bodies_.begin(), bodies_.end(), [&](const SoftBody* body) {
           if (!body->is_of_links() || &body->data() == &links) return false;
           const SoftData& other = body->data();
           return other.meets_soft_bodies() && groups_meet(links.collision_groups, other.collision_groups) &&
                  Box{links.low, links.high}.overlaps(other.low, other.high);
         });
}

// As its step begins: true, and there is none.
bool SoftBodies::rests(TissueData& tissue, const WorldData& world) {
  const bool was_asleep = tissue.sleep.asleep;
  const bool moved = tissue.carried || tissue.solid.pushed() || !tissue.grips.empty();
  const bool left_alone = world.options.sleeping && !is_worked_on(tissue, needles_) && !lies_on_solid(tissue) &&
                          !bears_what_is_awake(tissue);
  // Two that lie on each other are seldom still from the same step on: each waits for the other.
  const auto waits = [&] {
    bool any = false;
    each_other_near(tissue, [&](const TissueData& other) { any |= !other.sleep.is_still(); });
    return any;
  };
  if (!sleeps(
          tissue, moved, left_alone, [&] { return surroundings(tissue, world); }, waits))
    return false;
  if (!was_asleep) tissue.solid.stop();
  return true;
}

bool SoftBodies::rests(SoftData& links, const WorldData& world) {
  const bool was_asleep = links.sleep.asleep;
  const bool moved = links.carried || links.pushed || !hangs_still(links);
  const bool left_alone = world.options.sleeping && !links.touched_moving && !may_meet_others(links);
  const auto waits = [] { return false; };
  if (!sleeps(
          links, moved, left_alone, [&] { return surroundings(links, world); }, waits))
    return false;
  if (!was_asleep) links.stop();
  return true;
}

}  // namespace detail

bool SoftBody::asleep() const {
  if (is_tissue()) return tissue()->sleep.asleep;
  return is_of_links() && data_->sleep.asleep;
}

}  // namespace ambf::physics
