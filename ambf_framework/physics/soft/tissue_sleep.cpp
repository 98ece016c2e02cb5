// Tissue that lies still sleeps: its step is left out until something near it is not what it was, to the bit. What
// counts is what its step would read: bodies within reach, other tissue there, blades and needles anywhere, gravity.
// What is held, pushed, carried, cut or sewn is awake; so are sheets on solids with those, and what a body rests on
// that is not asleep itself.
#include <algorithm>
#include <bit>

#include "physics/detail/world_data.h"
#include "physics/soft/detail/blade_data.h"
#include "physics/soft/detail/near_shape.h"
#include "physics/soft/detail/needle_data.h"
#include "physics/soft/detail/tissue_data.h"
#include "physics/soft/soft_bodies.h"

namespace ambf::physics::detail {

namespace {

// Still is what goes nowhere within half a second. What creeps more slowly is 0.1 mm away after four minutes at the
// soonest, and what relaxes has done so by then.
constexpr double kStillTime_s = 0.5, kStillDistance_m = 2e-7;
constexpr int kLookEvery = 20;  // steps

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

bool is_still(const TissueData& tissue) { return tissue.rest.still_s >= kStillTime_s + tissue.rest.relaxes_s; }

}  // namespace

void TissueData::watch_rest(double h) {
  if (++rest.steps < kLookEvery && !rest.at.empty()) return;
  const std::vector<math::Vec3>& now = solid.positions();
  bool is_still = rest.at.size() == now.size();
  for (std::size_t i = 0; i < now.size() && is_still; ++i)
    is_still = math::norm(now[i] - rest.at[i]) <= kStillDistance_m;
  if (is_still) {
    rest.still_s += rest.steps * h;
  } else {
    rest.at = now;
    rest.still_s = 0.0;
  }
  rest.steps = 0;
}

std::uint64_t SoftBodies::surroundings(const TissueData& tissue, const WorldData& world) const {
  Digest digest;
  digest.add(world.dynamics->getGravity());
  const double reach = tissue.margin + tissue.grid.element_size;
  for (const TissueAttachment& attachment : tissue.attachments)
    if (attachment.body != nullptr) digest.add(attachment.body->data());
  for (const BodyData* body : world.bodies) {
    if (body->shape->empty()) continue;
    const btCollisionShape& shape = *body->rigid.getCollisionShape();
    if (body->shape->infinite() ||
        box_of(shape, body->rigid.getWorldTransform(), reach).overlaps(tissue.low, tissue.high))
      digest.add(*body);
  }
  for (const SoftBody* body : bodies_) {
    const TissueData* other = body->is_tissue() ? body->tissue() : nullptr;
    if (other == nullptr || other == &tissue || !Box{tissue.low, tissue.high}.overlaps(other->low, other->high))
      continue;
    digest.add(other);
    if (!is_still(*other)) digest.add(other->moves);
  }
  for (const BladeData* blade : blades_)
    if (blade->holder != nullptr) digest.add(*blade->holder);
  for (const NeedleData* needle : needles_)
    if (needle->holder != nullptr) digest.add(*needle->holder);
  return digest.value();
}

// As its step begins: true, and there is none.
bool SoftBodies::rests(TissueData& tissue, const WorldData& world) {
  TissueRest& rest = tissue.rest;
  const bool is_moved = tissue.carried || tissue.solid.pushed() || !tissue.grips.empty();
  const bool is_left_alone = world.options.sleeping && is_still(tissue) && !is_moved &&
                             !is_worked_on(tissue, needles_) && !lies_on_solid(tissue);
  const std::uint64_t near = is_left_alone ? surroundings(tissue, world) : 0;
  const bool is_as_it_was = is_left_alone && near == rest.near, has_changed = rest.near != 0 && !is_as_it_was;
  rest.near = near;
  if (!is_as_it_was) {
    // At once, and not when it is next looked at: tissue that rests on it goes by that.
    if (rest.asleep || is_moved || has_changed) rest.still_s = 0.0;
    rest.asleep = false;
    return false;
  }
  if (!rest.asleep) tissue.solid.stop();
  rest.asleep = true;
  return true;
}

}  // namespace ambf::physics::detail
