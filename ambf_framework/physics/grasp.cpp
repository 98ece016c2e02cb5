#include "physics/grasp.h"

#include <algorithm>

#include "physics/detail/grasp_data.h"
#include "physics/detail/jointed_group.h"
#include "physics/detail/world_data.h"
#include "physics/joints/joint_rows.h"
#include "physics/soft/held_nodes.h"

namespace ambf::physics {

using detail::BodyData;
using detail::from_bullet;
using detail::GraspData;

namespace detail {

JointData& GraspData::make(BodyData& holder, BodyData& held, const btTransform& frame_in_holder,
                           const btTransform& frame_in_held) {
  scene::Joint description;
  description.type = state::JointType::fixed;
  JointOptions of_joint;
  of_joint.erp = options.erp;
  joint.emplace(description, holder.owner, held.owner, of_joint);
  joint->frame_a = frame_in_holder;
  joint->frame_b = frame_in_held;
  joint->lock_bound = options.max_impulse;
  return *joint;
}

}  // namespace detail

Grasp::Grasp(const GraspOptions& options) : data_(std::make_unique<GraspData>(options)) {}

Grasp::~Grasp() {
  if (data_->world) data_->world->remove(*data_);
}

bool Grasp::hold(Body& holder, Body& held, const math::Pose& T_com_grasp,
                 const std::optional<math::Pose>& T_held_grasp) {
  GraspData& grasp = *data_;
  BodyData &a = holder.data(), &b = held.data();
  if (grasp.joint || !grasp.world || a.world != grasp.world || b.world != grasp.world) return false;
  if (&a == &b || (a.is_static() && b.is_static()) || a.mounted || b.mounted) return false;
  const btTransform frame_a = detail::to_bullet(T_com_grasp);
  const btTransform frame_b = T_held_grasp
                                  ? detail::to_bullet(*T_held_grasp)
                                  : b.rigid.getWorldTransform().inverse() * a.rigid.getWorldTransform() * frame_a;
  grasp.make(a, b, frame_a, frame_b);
  grasp.world->hold(grasp);
  return true;
}

void Grasp::release() {
  if (data_->joint) data_->world->release(*data_);
}

Body* Grasp::holder() const { return data_->joint ? &data_->joint->parent.owner : nullptr; }
Body* Grasp::held() const { return data_->joint ? &data_->joint->child.owner : nullptr; }

std::optional<Hold> Grasp::current() const {
  if (!data_->joint) return std::nullopt;
  return Hold{holder(), held(), from_bullet(data_->joint->frame_a), from_bullet(data_->joint->frame_b)};
}

bool Grasp::resume(const Hold& was) {
  BodyData &a = was.holder->data(), &b = was.held->data();
  if (data_->joint || !data_->world || a.world != data_->world || b.world != data_->world) return false;
  const std::vector<BodyData*> group = detail::jointed_group(b, [](const BodyData&) { return true; });
  const auto anchors = [&](const BodyData* body) { return body == &a || body->is_static(); };
  if (std::any_of(group.begin(), group.end(), anchors)) return false;
  const math::Pose moved =
      was.holder->com_pose() * was.T_com_grasp * math::inverse(was.T_held_grasp) * math::inverse(was.held->com_pose());
  for (BodyData* body : group) body->owner.set_pose(moved * body->owner.pose());
  return hold(*was.holder, *was.held, was.T_com_grasp, was.T_held_grasp);
}

math::Wrench Grasp::reaction_on_held() const {
  if (!data_->joint) return {};
  const btJointFeedback& feedback = data_->joint->feedback;
  return {from_bullet(feedback.m_appliedForceBodyB), from_bullet(feedback.m_appliedTorqueBodyB)};
}

JointGap Grasp::gap() const {
  if (!data_->joint) return {};
  const detail::JointGeometry geometry(*data_->joint);
  return {geometry.pivot_gap.length(), detail::rotation_vector(geometry.relative()).length()};
}

// ---- In the world ----

void World::add(Grasp& grasp) { data_->add(grasp.data()); }
void World::remove(Grasp& grasp) { data_->remove(grasp.data()); }

void World::release_grasps() {
  while (!data_->holding.empty()) data_->release(*data_->holding.back());
}

namespace detail {
namespace {

void make_room(BodyData& body) {
  body.joints.reserve(body.joints.size() + kRoomForGrasps);
  body.excluded.reserve(body.excluded.size() + kRoomForGrasps);
}

}  // namespace

void WorldData::add(GraspData& grasp) {
  if (grasps.empty())
    for (BodyData* body : bodies) make_room(*body);
  grasp.world = this;
  grasps.push_back(&grasp);
  holding.reserve(grasps.capacity());
}

void WorldData::remove(GraspData& grasp) {
  if (grasp.joint) release(grasp);
  std::erase(grasps, &grasp);
  grasp.world = nullptr;
}

void WorldData::make_room_for_grasps(BodyData& body) const {
  if (!grasps.empty()) make_room(body);
}

void WorldData::hold(GraspData& grasp) {
  JointData& joint = *grasp.joint;
  tie(grasp);
  dynamics->part(joint.parent, joint.child);
  attach(joint);
  joint.wake();
}

void WorldData::release(GraspData& grasp) {
  BodyData& held = grasp.joint->child;
  grasp.joint->wake();
  dynamics->removeConstraint(&grasp.joint->constraint);
  untie(grasp);
  dynamics->find_pairs(held);
}

void WorldData::tie(GraspData& grasp) {
  grasp.joint->world = this;
  connect(*grasp.joint);
  holding.push_back(&grasp);
}

void WorldData::untie(GraspData& grasp) {
  disconnect(*grasp.joint);
  std::erase(holding, &grasp);
  grasp.joint.reset();
}

void WorldData::release_grasps_of(const BodyData& body) {
  for (std::size_t i = holding.size(); i-- > 0;)
    if (holding[i]->connects(body)) release(*holding[i]);
  if (soft != nullptr) release_grips_of(soft->all(), body);
}

void WorldData::forget_grasps() {
  while (!holding.empty()) {
    dynamics->removeConstraint(&holding.back()->joint->constraint);
    untie(*holding.back());
  }
}

void WorldData::order_grasps() {
  for (GraspData* grasp : holding) disconnect(*grasp->joint);
  holding.clear();
  for (GraspData* grasp : grasps) {
    if (!grasp->joint) continue;
    connect(*grasp->joint);
    holding.push_back(grasp);
  }
}

}  // namespace detail

}  // namespace ambf::physics
