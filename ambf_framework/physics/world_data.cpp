#include "physics/detail/world_data.h"

#include <BulletCollision/Gimpact/btGImpactCollisionAlgorithm.h>
#include <BulletDynamics/MLCPSolvers/btDantzigSolver.h>

#include <algorithm>
#include <cmath>

#include "physics/detail/grasp_data.h"
#include "physics/joints/joint_block_solver.h"
#include "physics/joints/mimic_constraint.h"
#include "physics/joints/soft_row_solver.h"

namespace ambf::physics::detail {

namespace {

constexpr int kDefaultIterations = 10;
constexpr std::uint64_t kPhaseSampling = 8;  // every so many steps are timed

void configure(btContactSolverInfo& info, const WorldOptions& options) {
  info.m_numIterations = options.iterations > 0 ? options.iterations : kDefaultIterations;
  info.m_timeStep = options.step;
  info.m_minimumSolverBatchSize = 1;
  // Found by trial on leaning towers of up to ten boxes: stiffer (Bullet's 0.2) or warmer starts end in limit cycles
  // of half a millimetre, these let them stand still to a few micrometres a second.
  info.m_warmstartingFactor = 0.95;
  info.m_erp2 = 0.02;
  info.m_leastSquaresResidualThreshold =
      1e-12;  // (m/s)^2: stop sweeping when no row is wrong by more than a micrometre a second
  if (options.friction_directions >= 2)
    info.m_solverMode |= SOLVER_USE_2_FRICTION_DIRECTIONS | SOLVER_DISABLE_VELOCITY_DEPENDENT_FRICTION_DIRECTION;
  if (options.solver == SolverKind::mlcp) info.m_globalCfm = 1e-8;  // redundant rows of closed loops
}

// Bullet's pools are touched when they are made; it allocates what they lack.
std::unique_ptr<btCollisionConfiguration> make_configuration(const WorldOptions& options) {
  btDefaultCollisionConstructionInfo info;
  info.m_defaultMaxPersistentManifoldPoolSize = options.pooled_pairs;
  info.m_defaultMaxCollisionAlgorithmPoolSize = options.pooled_pairs;
  return std::make_unique<btDefaultCollisionConfiguration>(info);
}

}  // namespace

WorldData::WorldData(const WorldOptions& given)
    : options(given),
      h(given.step),
      configuration(make_configuration(options)),
      dispatcher(std::make_unique<btCollisionDispatcher>(configuration.get())),
      plane_contact(*dispatcher),
      broadphase(std::make_unique<btDbvtBroadphase>()) {
  btGImpactCollisionAlgorithm::registerAlgorithm(dispatcher.get());
  mesh_contacts = std::make_unique<MeshContacts>(*dispatcher, *configuration, options.preparation_thread);
  broadphase->getOverlappingPairCache()->setOverlapFilterCallback(&filter);
  switch (options.solver) {
    case SolverKind::mlcp:
      mlcp = std::make_unique<btDantzigSolver>();
      solver = std::make_unique<TouchingSolver<SoftMlcpSolver>>(mlcp.get());
      break;
    case SolverKind::direct: solver = std::make_unique<IslandSolver<JointBlockSolver>>(); break;
    case SolverKind::si: solver = std::make_unique<IslandSolver<SoftRowSolver>>(); break;
  }
  dynamics = std::make_unique<DynamicsWorld>(*dispatcher, *broadphase, *solver, *configuration, *mesh_contacts,
                                             options.solver == SolverKind::direct);
  dynamics->setGravity(to_bullet(options.gravity));
  dynamics->getDispatchInfo().m_useContinuous = false;
  configure(dynamics->getSolverInfo(), options);
}

WorldData::~WorldData() {
  end_pulls();
  while (!grasps.empty()) remove(*grasps.back());
  while (!joints.empty()) remove(*joints.back());
  while (!bodies.empty()) remove(*bodies.back());
}

void WorldData::step() {
  ++steps;
  if (soft != nullptr) soft->step(*this);
  if (!maybe_awake) return;
  set_carried_velocities();
  PhaseSums* times = steps % kPhaseSampling == 0 ? &phase_sums : nullptr;
  remember_start();
  solve(times);
  if (const int parts = parts_needed(); parts > 1) solve_in_parts(parts, times);
  dynamics->move(h, options.sleeping, times);
  set_part(1.0);
  dynamics->clear_applied_forces();
  maybe_awake = dynamics->awake_count() > 0;
  land_carried();
}

void WorldData::solve(PhaseSums* times) {
  for (BodyData* body : bodies)
    if (!body->joints.empty()) body->stiffen(h);
  if (dynamics->own_motion()) dynamics->begin_motion(h);
  for (JointData* joint : joints)
    if (joint->constraint.isEnabled() && !joint->asleep() && !joint->frozen()) joint->prepare(h);
  for (GraspData* grasp : holding)
    if (!grasp->joint->asleep() && !grasp->joint->frozen()) grasp->joint->prepare(h);
  dynamics->solve(h, times);
}

void WorldData::set_carried_velocities() {
  for (BodyData* body : carried) {
    btRigidBody& rigid = body->rigid;
    const btTransform target = to_bullet(body->move_target * body->initial.T_body_com);
    btVector3 linear, angular;
    btTransformUtil::calculateVelocity(rigid.getWorldTransform(), target, options.step, linear, angular);
    rigid.setCollisionFlags(rigid.getCollisionFlags() | btCollisionObject::CF_KINEMATIC_OBJECT);
    rigid.setLinearVelocity(linear);
    rigid.setAngularVelocity(angular);
    rigid.forceActivationState(ACTIVE_TAG);
    body->mean_linear = linear;
    body->mean_turn = angular;
    body->next_pose = target;
    for (JointData* joint : body->joints) joint->wake();
  }
}

void WorldData::land_carried() {
  if (carried.empty()) return;
  for (BodyData* body : carried) {
    btRigidBody& rigid = body->rigid;
    rigid.setCollisionFlags(rigid.getCollisionFlags() & ~btCollisionObject::CF_KINEMATIC_OBJECT);
    rigid.forceActivationState(ISLAND_SLEEPING);
    rigid.setLinearVelocity({0, 0, 0});
    rigid.setAngularVelocity({0, 0, 0});
    body->moving_to = false;
    body->given_pose = body->move_target;
    body->place(to_bullet(body->move_target * body->initial.T_body_com));
    dynamics->refresh_bounds(*body);
    dynamics->visit_neighbours(*body, [](BodyData& neighbour) { neighbour.wake(); });
  }
  carried.clear();
}

void WorldData::start_moving(BodyData& body) {
  carried.push_back(&body);
  maybe_awake = true;
}

void WorldData::before_teleport(BodyData& body) {
  dynamics->visit_neighbours(body, [](BodyData& neighbour) { neighbour.wake(); });
  std::erase(carried, &body);
}

void WorldData::after_teleport(BodyData& body) {
  dynamics->refresh_bounds(body);
  dynamics->visit_neighbours(body, [](BodyData& neighbour) { neighbour.wake(); });
  for (JointData* joint : body.joints) joint->wake();
  body.wake();
  maybe_awake = true;
}

void WorldData::wake_around(BodyData& body) {
  dynamics->visit_neighbours(body, [](BodyData& neighbour) { neighbour.wake(); });
  body.wake();
  maybe_awake = true;
}

void WorldData::set_damping(BodyData& body) const {
  body.linear_retained = std::pow(1.0 - body.rigid.getLinearDamping(), h);
  body.angular_retained = std::pow(1.0 - body.rigid.getAngularDamping(), h);
}

void WorldData::attach(BodyData& body) {
  btRigidBody& rigid = body.rigid;
  const bool moving = !body.is_static();
  if (dynamics->own_motion()) rigid.setFlags(rigid.getFlags() & ~BT_ENABLE_GYROSCOPIC_FORCE_IMPLICIT_BODY);
  const int group = moving ? btBroadphaseProxy::DefaultFilter : btBroadphaseProxy::StaticFilter;
  const int mask =
      moving ? btBroadphaseProxy::AllFilter : btBroadphaseProxy::AllFilter ^ btBroadphaseProxy::StaticFilter;
  dynamics->addRigidBody(&rigid, group, mask);
  dynamics->refresh_bounds(body);
  body.collided = false;
}

void WorldData::attach(JointData& joint) { dynamics->addConstraint(&joint.constraint, false); }

// A leader may come after its follower.
void WorldData::attach_mimics() {
  for (MimicConstraint* mimic : mimics) {
    if (mimic->attached || mimic->leader() == nullptr || mimic->leader()->world != this) continue;
    dynamics->addConstraint(mimic, false);
    mimic->attached = true;
    mimic->leader()->wake();
    mimic->follower().wake();
  }
}

void WorldData::detach(MimicConstraint& mimic) {
  if (mimic.attached) dynamics->removeConstraint(&mimic);
  mimic.attached = false;
}

void WorldData::add(BodyData& body) {
  body.world = this;
  set_damping(body);
  bodies.push_back(&body);
  rays.candidates.reserve(bodies.capacity());
  make_room_for_grasps(body);
  attach(body);
  body.wake();
  dynamics->visit_neighbours(body, [](BodyData& neighbour) { neighbour.wake(); });
  maybe_awake = true;
}

void WorldData::remove(BodyData& body) {
  if (soft != nullptr) soft->forget(body);
  for (PullData& pull : pulls)
    if (pull.body == &body) end(pull);
  release_grasps_of(body);
  before_teleport(body);
  dynamics->forget(body);
  dynamics->removeRigidBody(&body.rigid);
  if (body.frozen) {
    body.set_frozen(false);
    --frozen_count;
  }
  std::erase(bodies, &body);
  body.world = nullptr;
}

void WorldData::connect(JointData& joint) {
  joint.parent.joints.push_back(&joint);
  joint.child.joints.push_back(&joint);
  if (!joint.description.ignore_inter_collision) return;
  joint.parent.excluded.push_back(&joint.child);
  joint.child.excluded.push_back(&joint.parent);
}

void WorldData::disconnect(JointData& joint) {
  std::erase(joint.parent.joints, &joint);
  std::erase(joint.child.joints, &joint);
  if (!joint.description.ignore_inter_collision) return;
  const auto erase_one = [](std::vector<const BodyData*>& list, const BodyData* body) {
    if (const auto at = std::find(list.begin(), list.end(), body); at != list.end()) list.erase(at);
  };
  erase_one(joint.parent.excluded, &joint.child);
  erase_one(joint.child.excluded, &joint.parent);
}

void WorldData::add(JointData& joint) {
  joint.world = this;
  joints.push_back(&joint);
  connect(joint);
  if (joint.parent.mounted || joint.child.mounted) joint.constraint.setEnabled(false);
  if (joint.description.ignore_inter_collision) dynamics->refilter(joint.child);
  attach(joint);
  joint.turns_reference = 0.0;
  joint.turns_reference = joint.coordinate();
  joint.wake();
  if (joint.mimic != nullptr) mimics.push_back(joint.mimic.get());
  attach_mimics();
}

void WorldData::remove(JointData& joint) {
  joint.wake();
  for (MimicConstraint* mimic : mimics) {
    if (&mimic->follower() != &joint && mimic->leader() != &joint) continue;
    mimic->follower().wake();
    detach(*mimic);
    if (mimic->leader() == &joint) mimic->forget_leader();
  }
  std::erase(mimics, joint.mimic.get());
  dynamics->removeConstraint(&joint.constraint);
  std::erase(joints, &joint);
  disconnect(joint);
  if (joint.description.ignore_inter_collision) dynamics->refilter(joint.child);
  joint.world = nullptr;
}

void WorldData::restart() {
  order_grasps();
  for (MimicConstraint* mimic : mimics) detach(*mimic);
  for (JointData* joint : joints) {
    dynamics->removeConstraint(&joint->constraint);
    joint->prepared_step = 0;
  }
  for (GraspData* grasp : holding) {
    dynamics->removeConstraint(&grasp->joint->constraint);
    grasp->joint->prepared_step = 0;
  }
  for (PullData& pull : pulls)
    if (pull.constraint) dynamics->removeConstraint(&*pull.constraint);
  std::vector<int> states;
  for (BodyData* body : bodies) {
    states.push_back(body->rigid.getActivationState());
    dynamics->removeRigidBody(&body->rigid);
  }
  broadphase->resetPool(dispatcher.get());
  solver->reset();
  mesh_contacts->restart();
  dynamics->restart_memory();
  if (soft != nullptr) soft->restart();
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    attach(*bodies[i]);
    bodies[i]->rigid.forceActivationState(states[i]);
  }
  for (JointData* joint : joints) attach(*joint);
  for (MimicConstraint* mimic : mimics) {
    mimic->attached = mimic->leader() != nullptr && mimic->leader()->world == this;
    if (mimic->attached) dynamics->addConstraint(mimic, false);
  }
  for (GraspData* grasp : grasps)
    if (grasp->joint) attach(*grasp->joint);
  for (PullData& pull : pulls)
    if (pull.constraint) dynamics->addConstraint(&*pull.constraint, false);
  dynamics->count_awake();
}

void WorldData::end(PullData& pull) {
  if (pull.body == nullptr) return;
  dynamics->removeConstraint(&*pull.constraint);
  pull.constraint.reset();
  pull.body->wake();
  pull.body = nullptr;
}

void WorldData::end_pulls() {
  for (PullData& pull : pulls) end(pull);
}

}  // namespace ambf::physics::detail
