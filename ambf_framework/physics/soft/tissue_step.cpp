// A step of tissue: what its points touch and hang on become springs, which the solver takes along.
#include <algorithm>

#include "physics/detail/world_data.h"
#include "physics/soft/detail/blade_data.h"
#include "physics/soft/detail/link_step.h"
#include "physics/soft/detail/near_shape.h"
#include "physics/soft/detail/needle_data.h"
#include "physics/soft/detail/soft_data.h"
#include "physics/soft/detail/tissue_data.h"
#include "physics/soft/held_nodes.h"
#include "physics/soft/soft_bodies.h"

namespace ambf::physics::detail {

namespace {

// What is pushed out of a body leaves within this time (s), instead of being shot off by a stiff spring.
constexpr double kCalming_s = 0.003;

void find_contacts(TissueData& tissue, const BodyData& body, const btCollisionShape& shape, const btTransform& pose) {
  if (shape.isCompound()) {
    const auto& compound = static_cast<const btCompoundShape&>(shape);
    for (int i = 0; i < compound.getNumChildShapes(); ++i)
      find_contacts(tissue, body, *compound.getChildShape(i), pose * compound.getChildTransform(i));
    return;
  }
  const MetShape met(shape);
  if (!met.can_be_met) return;
  const Box box = box_of(shape, pose, tissue.margin);
  if (!box.overlaps(tissue.low, tissue.high)) return;
  for (std::size_t i = 0; i < tissue.at.size() && tissue.found.size() < tissue.found.capacity(); ++i) {
    if (!tissue.cuts.shows_point(i) || !box.contains(tissue.at[i]) || held_off(tissue.grips, *tissue.owner, i, body))
      continue;
    if (const auto near = met.near(pose.invXform(tissue.at[i]), tissue.margin))
      tissue.found.push_back(
          {static_cast<std::uint32_t>(i), pose.getBasis() * near->normal, tissue.margin - near->distance});
  }
}

// The stiffness that a spring between a point and a body may have: of `count` of them none pushes the body, within a
// step, beyond where it is to be (EQUATIONS 16).
double held_back(double stiffness, const BodyData& body, const btVector3& at, const btVector3& along, double h,
                 std::size_t count) {
  if (body.is_static()) return stiffness;
  const double inverse_mass = body.rigid.computeImpulseDenominator(at, along) * static_cast<double>(count);
  return stiffness / (1.0 + h * h * stiffness * inverse_mass);
}

TissueHold* hold_of(TissueData& tissue, std::uint32_t point, const BodyData& body, const btVector3& place) {
  auto& holds = tissue.holds[point];
  for (TissueHold& hold : holds)
    if (hold.body == &body) {
      hold.renewed = true;
      return &hold;
    }
  for (TissueHold& hold : holds)
    if (hold.body == nullptr) {
      hold = {&body, place, true};
      return &hold;
    }
  return nullptr;
}

// Friction as a spring back to where the point sticks. What the step would stretch it to may be more than friction can
// bear: then the place gives way, and the spring is as soft as makes it bear just that.
void add_friction(TissueData& tissue, const TissueData::Contact& contact, BodyData& body, double limit,
                  double stiffness, const btVector3& carried, double h, TissueSpring& spring) {
  const btTransform& pose = body.rigid.getWorldTransform();
  const btVector3& at = tissue.at[contact.point];
  TissueHold* hold = hold_of(tissue, contact.point, body, pose.invXform(at));
  if (hold == nullptr) return;
  const auto across = [&](const btVector3& v) { return btVector3(v - contact.normal * v.dot(contact.normal)); };
  const btVector3 slide = across(carried) * h;
  btVector3 away = across(at - pose * hold->place);
  if (const double size = away.length(); stiffness * size > limit) {
    away *= limit / (stiffness * size);
    hold->place = pose.invXform(at - away);
  }
  const btVector3 after = away + across(to_bullet(tissue.solid.velocity(spring.at))) * h - slide;
  const double force = stiffness * after.length(), softness = force > limit ? limit / force : 1.0;
  spring.side_stiffness = stiffness * softness;
  spring.pull += from_bullet((slide - away) * spring.side_stiffness);
}

void add_contacts(TissueData& tissue, BodyData& body, double h) {
  const double friction = tissue.friction * body.rigid.getFriction();
  for (const TissueData::Contact& contact : tissue.found) {
    if (tissue.springs.size() == tissue.springs.capacity()) return;
    const btVector3& at = tissue.at[contact.point];
    const btVector3 carried = body.rigid.getVelocityInLocalPoint(at - body.rigid.getWorldTransform().getOrigin());
    const double stiffness =
        held_back(tissue.point_stiffness[contact.point], body, at, contact.normal, h, tissue.found.size());
    TissueSpring spring;
    spring.at = tissue.grid.points[contact.point];
    spring.normal = from_bullet(contact.normal);
    spring.normal_stiffness = stiffness * (1.0 + kCalming_s / h);
    spring.pushes = tissue.is_sheet();
    const double push = stiffness * contact.depth;
    double presses = push;
    // As it leaves it is not held back, and still met if it comes back within the step: or it chatters. A sheet's solve
    // undoes what pulls.
    const double leaves =
        h * (math::dot(spring.normal, tissue.solid.velocity(spring.at)) - contact.normal.dot(carried));
    if (!spring.pushes && spring.normal_stiffness * leaves > push) {
      presses *= push / (spring.normal_stiffness * leaves);
      spring.normal_stiffness = push / leaves;
    }
    spring.pull = spring.normal * (push + spring.normal_stiffness * h * contact.normal.dot(carried));
    // By what presses at rest: with the part of velocities, points that tremble would bear more than all of them.
    add_friction(tissue, contact, body, friction * presses, stiffness, carried, h, spring);
    tissue.springs.push_back(spring);
    tissue.pulled.push_back(&body);
  }
}

// EQUATIONS 16, as held_nodes.cpp has it for links: hardness and damping are one spring of the step. A force beyond the
// most that it may be is just that, the way it would pull.
void add_held(TissueData& tissue, const SoftGripData& grip, const HeldNode& held, double h) {
  BodyData* holder = grip.holder;
  TissueSpring spring;
  spring.at = tissue.grid.points[held.node];
  spring.normal = {0.0, 0.0, 1.0};
  btVector3 place = to_bullet(held.place), carried(0, 0, 0);
  const double full = grip.options.hardness + grip.options.damping / h;
  double stiffness = full;
  if (holder != nullptr) {
    const btTransform& pose = holder->rigid.getWorldTransform();
    place = pose * place;
    carried = holder->rigid.getVelocityInLocalPoint(place - pose.getOrigin());
    stiffness = held_back_in_all(full, *holder, place, h, grip.held.size());
  }
  const btVector3 gap = place - tissue.at[held.node];
  const double share = full > 0.0 ? stiffness / full : 0.0;
  spring.pull = from_bullet((gap * grip.options.hardness + carried * (full * h)) * share);
  spring.normal_stiffness = spring.side_stiffness = stiffness;
  const math::Vec3 force = spring.pull - tissue.solid.velocity(spring.at) * (stiffness * h);
  if (const double size = math::norm(force); size > grip.options.max_force) {
    spring.pull = force * (grip.options.max_force / size);
    spring.normal_stiffness = spring.side_stiffness = 0.0;
  }
  tissue.springs.push_back(spring);
  tissue.pulled.push_back(holder);
}

void add_attachment(TissueData& tissue, const TissueAttachment& attachment, BodyData& body, double h) {
  const btTransform& pose = body.rigid.getWorldTransform();
  for (std::size_t i = 0; i < attachment.corners.size(); ++i) {
    const std::uint32_t corner = attachment.corners[i];
    const btVector3 place = pose * attachment.places[i];
    const btVector3 carried = body.rigid.getVelocityInLocalPoint(place - pose.getOrigin());
    const btVector3 gap = place - to_bullet(tissue.solid.positions()[corner]);
    TissueSpring spring;
    spring.at.corner.fill(corner);
    spring.at.weight = {1.0, 0.0, 0.0, 0.0};
    spring.normal = {0.0, 0.0, 1.0};
    const double stiffness = held_back_in_all(tissue.corner_stiffness, body, place, h, attachment.corners.size());
    spring.normal_stiffness = spring.side_stiffness = stiffness;
    spring.pull = from_bullet((gap + carried * h) * stiffness);
    tissue.springs.push_back(spring);
    tissue.pulled.push_back(&body);
  }
}

}  // namespace

// Of `count` springs between points and a body, whichever way they pull.
double held_back_in_all(double stiffness, const BodyData& body, const btVector3& at, double h, std::size_t count) {
  double least = stiffness;
  for (int axis = 0; axis < 3; ++axis) {
    btVector3 along(0, 0, 0);
    along[axis] = 1.0;
    least = std::min(least, held_back(stiffness, body, at, along, h, count));
  }
  return least;
}

void SoftBodies::add_blades(TissueData& tissue, WorldData& world, double h) {
  tissue.blades.clear();
  if (!tissue.cuts.possible()) return;
  for (BladeData* blade : blades_) {
    if (blade->holder == nullptr || blade->holder->world != &world) continue;
    if (tissue.blades.size() == tissue.blades.capacity()) return;
    tissue.blades.push_back(blade);
    touch(*blade->holder, h);
    add_blade(tissue, *blade, h);
  }
}

void SoftBodies::add_needles(TissueData& tissue, WorldData& world, double h) {
  tissue.needles.clear();
  for (NeedleData* needle : needles_) {
    if (needle->holder == nullptr || needle->holder->world != &world || needle->corner.size() < 2) continue;
    if (!is_near_needle(tissue, *needle)) continue;
    if (tissue.needles.size() == tissue.needles.capacity()) return;
    tissue.needles.push_back(needle);
    touch(*needle->holder, h);
    add_needle(tissue, *needle, h);
  }
}

void SoftBodies::step_tissue(TissueData& tissue, WorldData& world, double h) {
  if (rests(tissue, world)) {
    tissue.stepped = true;
    return;
  }
  tissue.last_good = tissue.solid.positions();
  tissue.move_fixed(h);
  tissue.find_bounds();
  tissue.springs.clear();
  tissue.pulled.clear();
  tissue.spring_force.clear();
  tissue.links.clear();
  tissue.touch.made.clear();
  tissue.touch.felt.clear();
  tissue.touch.edges.begin_step();
  tissue.tips.made.clear();
  tissue.tips.places.clear();
  tissue.tips.runs_known = false;
  for (BodyTip& tip : tissue.tips.tips) tip.renewed = false;
  for (auto& holds : tissue.holds)
    for (TissueHold& hold : holds) hold.renewed = false;
  for (const TissueAttachment& attachment : tissue.attachments) {
    if (attachment.body == nullptr || attachment.body->data().world != &world) continue;
    touch(attachment.body->data(), h);
    add_attachment(tissue, attachment, attachment.body->data(), h);
  }
  const std::size_t first_held = tissue.springs.size();
  for (const SoftGripData* grip : tissue.grips) {
    if (grip->holder != nullptr) touch(*grip->holder, h);
    for (const HeldNode& held : grip->held)
      if (held.body == tissue.owner) add_held(tissue, *grip, held, h);
  }
  add_blades(tissue, world, h);
  add_needles(tissue, world, h);
  for (NeedleData* needle : needles_) add_stitches(tissue, *needle, h);
  const std::size_t first_contact = tissue.springs.size();
  for (BodyData* body : world.bodies) {
    if (std::any_of(tissue.grips.begin(), tissue.grips.end(),
                    [&](const SoftGripData* grip) { return grip->holder == body; }))
      continue;  // they pass through each other, as with a grasp of a rigid body
    if (std::any_of(tissue.blades.begin(), tissue.blades.end(),
                    [&](const BladeData* blade) { return blade->holder == body; }) ||
        std::any_of(needles_.begin(), needles_.end(), [&](const NeedleData* needle) { return needle->holder == body; }))
      continue;
    if (body->shape->empty() || !groups_meet(tissue.collision_groups, body->initial.collision_groups)) continue;
    if (std::any_of(tissue.attachments.begin(), tissue.attachments.end(),
                    [&](const TissueAttachment& each) { return each.body == &body->owner; }))
      continue;
    const btCollisionShape& shape = *body->rigid.getCollisionShape();
    const btTransform& pose = body->rigid.getWorldTransform();
    const double near = tissue.margin + tissue.grid.element_size;  // m, that a tip may go within the step
    if (!body->shape->infinite() && !box_of(shape, pose, near).overlaps(tissue.low, tissue.high)) continue;
    touch(*body, h);
    tissue.found.clear();
    find_contacts(tissue, *body, shape, pose);
    add_contacts(tissue, *body, h);
    find_tips(tissue, *body, h);
    add_tips(tissue, *body, h);
  }
  add_touches(tissue, h);
  for (SoftBody* other : bodies_)
    if (other->is_tissue() && other->tissue() != &tissue) add_touches(tissue, *other->tissue(), h);
  for (SoftBody* other : bodies_)
    if (other->is_of_links()) press(other->data(), tissue, h);
  for (auto& holds : tissue.holds)
    for (TissueHold& hold : holds)
      if (!hold.renewed) hold.body = nullptr;
  tissue.contacts = tissue.springs.size() - first_contact + tissue.tips.made.size();
  tissue.last_step_s = h;
  tissue.solid.step(h, from_bullet(world.dynamics->getGravity()), {tissue.springs, tissue.links, tissue.touch.made});
  ++tissue.moves;
  tissue.stepped = true;
  press_on_solids(tissue, h);
  std::size_t spring_of_held = first_held;
  for (SoftGripData* grip : tissue.grips)
    for (HeldNode& held : grip->held)
      if (held.body == tissue.owner) held.force_world = tissue.solid.force_of(tissue.springs[spring_of_held++], h);
  for (const TissueSpring& spring : tissue.springs) tissue.spring_force.push_back(tissue.solid.force_of(spring, h));
  for (std::size_t i = 0; i < tissue.springs.size(); ++i) {
    if (tissue.pulled[i] == nullptr || tissue.pulled[i]->is_static()) continue;
    BodyData& body = *tissue.pulled[i];
    const TissueSpring& spring = tissue.springs[i];
    // Where it acts on the point: no torque between the two.
    btVector3 at(0, 0, 0);
    for (int k = 0; k < 4; ++k) at += to_bullet(tissue.last_good[spring.at.corner[k]]) * spring.at.weight[k];
    body.rigid.applyImpulse(to_bullet(tissue.spring_force[i]) * -h, at - body.rigid.getWorldTransform().getOrigin());
  }
  end_tips(tissue, h);
  for (BladeData* blade : tissue.blades) sum_force(tissue, *blade);
  for (NeedleData* needle : tissue.needles) sum_force(tissue, *needle);
  for (NeedleData* needle : needles_) sum_stitches(tissue, *needle, h);
  if (cut(tissue)) {
    for (SoftBody* other : bodies_)
      if (other->is_tissue())
        other->tissue()->touch.stay(tissue);
      else if (other->is_of_links())
        other->data().let_go(&tissue);
    tissue.follow_points();
    tissue.sleep.still_s = 0.0;  // what lies on it knows other corners now
  }
  const std::vector<math::Vec3>& corners = tissue.solid.positions();
  tissue.sleep.watch(
      corners.size(), [&](std::size_t i) { return corners[i]; }, h);
}

}  // namespace ambf::physics::detail
