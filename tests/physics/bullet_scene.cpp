#include "tests/physics/bullet_scene.h"

#include <algorithm>
#include <cmath>

namespace ambf::physics::testing {
namespace {

// A frame at `pivot` whose z axis (hinge) or x axis (slider) is `axis`, in a body's own axes.
btTransform frame_in(const btRigidBody& body, const btVector3& pivot, const btVector3& axis, int along) {
  btVector3 p;
  btVector3 q;
  btPlaneSpace1(axis, p, q);
  btMatrix3x3 basis;
  if (along == 2) {
    basis.setValue(p.x(), q.x(), axis.x(), p.y(), q.y(), axis.y(), p.z(), q.z(), axis.z());
  } else {
    basis.setValue(axis.x(), p.x(), q.x(), axis.y(), p.y(), q.y(), axis.z(), p.z(), q.z());
  }
  return body.getWorldTransform().inverse() * btTransform(basis, pivot);
}

}  // namespace

BulletScene::BulletScene(const SceneOptions& options)
    : options_(options), dispatcher_(&configuration_), solver_(options.solver) {
  world_ = std::make_unique<btDiscreteDynamicsWorld>(&dispatcher_, &broadphase_, &solver_, &configuration_);
  world_->setGravity(btVector3(0, 0, -9.81));
  btContactSolverInfo& info = world_->getSolverInfo();
  info.m_numIterations = options.iterations;
  info.m_minimumSolverBatchSize = options.batch_size;
  if (options.two_friction_directions) {
    info.m_solverMode |= SOLVER_USE_2_FRICTION_DIRECTIONS | SOLVER_DISABLE_VELOCITY_DEPENDENT_FRICTION_DIRECTION;
  }
}

BulletScene::~BulletScene() {
  for (const auto& joint : joints_) world_->removeConstraint(joint.get());
  for (const auto& body : bodies_) world_->removeRigidBody(body.get());
}

btRigidBody& BulletScene::add_box(const btVector3& half_extents, double mass, const btTransform& pose, bool collides,
                                  double friction) {
  auto shape = std::make_unique<btBoxShape>(half_extents);
  btVector3 inertia(0, 0, 0);
  if (mass > 0.0) shape->calculateLocalInertia(mass, inertia);
  btRigidBody::btRigidBodyConstructionInfo info(mass, nullptr, shape.get(), inertia);
  info.m_startWorldTransform = pose;
  info.m_friction = friction;
  auto body = std::make_unique<btRigidBody>(info);
  body->setActivationState(DISABLE_DEACTIVATION);
  if (collides) {
    world_->addRigidBody(body.get());
  } else {
    world_->addRigidBody(body.get(), 0, 0);
  }
  shapes_.push_back(std::move(shape));
  bodies_.push_back(std::move(body));
  return *bodies_.back();
}

btRigidBody& BulletScene::add_box(const btVector3& half_extents, double mass, const btVector3& position,
                                  bool collides) {
  return add_box(half_extents, mass, btTransform(btQuaternion::getIdentity(), position), collides);
}

btRigidBody& BulletScene::add_ground() {
  auto shape = std::make_unique<btStaticPlaneShape>(btVector3(0, 0, 1), 0.0);
  btRigidBody::btRigidBodyConstructionInfo info(0.0, nullptr, shape.get());
  info.m_friction = 0.5;
  auto body = std::make_unique<btRigidBody>(info);
  world_->addRigidBody(body.get());
  shapes_.push_back(std::move(shape));
  bodies_.push_back(std::move(body));
  return *bodies_.back();
}

template <class Joint>
Joint& BulletScene::keep(std::unique_ptr<Joint> joint) {
  Joint& result = *joint;
  world_->addConstraint(joint.get(), true);
  joints_.push_back(std::move(joint));
  return result;
}

btHingeConstraint& BulletScene::add_hinge(btRigidBody& a, btRigidBody& b, const btVector3& pivot,
                                          const btVector3& axis) {
  auto joint = std::make_unique<btHingeConstraint>(a, b, frame_in(a, pivot, axis, 2), frame_in(b, pivot, axis, 2));
  joint->setParam(BT_CONSTRAINT_ERP, options_.joint_erp);
  // With offset frames Bullet drops the lever arms of the pivot rows while a limit is active.
  joint->setUseFrameOffset(false);
  return keep(std::move(joint));
}

btHingeConstraint& BulletScene::add_hinge(btRigidBody& a, const btVector3& pivot, const btVector3& axis) {
  return add_hinge(a, btTypedConstraint::getFixedBody(), pivot, axis);
}

btPoint2PointConstraint& BulletScene::add_ball(btRigidBody& a, btRigidBody& b, const btVector3& pivot) {
  auto joint = std::make_unique<btPoint2PointConstraint>(a, b, a.getWorldTransform().inverse() * pivot,
                                                         b.getWorldTransform().inverse() * pivot);
  joint->setParam(BT_CONSTRAINT_ERP, options_.joint_erp);
  return keep(std::move(joint));
}

btPoint2PointConstraint& BulletScene::add_ball(btRigidBody& a, const btVector3& pivot) {
  return add_ball(a, btTypedConstraint::getFixedBody(), pivot);
}

btSliderConstraint& BulletScene::add_slider(btRigidBody& a, btRigidBody& b, const btVector3& pivot,
                                            const btVector3& axis) {
  auto joint =
      std::make_unique<btSliderConstraint>(a, b, frame_in(a, pivot, axis, 0), frame_in(b, pivot, axis, 0), true);
  joint->setUseFrameOffset(false);
  joint->setLowerLinLimit(-10.0);
  joint->setUpperLinLimit(10.0);
  joint->setLowerAngLimit(0.0);
  joint->setUpperAngLimit(0.0);
  for (int axis_number = 0; axis_number < 6; ++axis_number) {
    joint->setParam(BT_CONSTRAINT_STOP_ERP, options_.joint_erp, axis_number);
  }
  return keep(std::move(joint));
}

btSliderConstraint& BulletScene::add_slider(btRigidBody& a, const btVector3& axis) {
  return add_slider(btTypedConstraint::getFixedBody(), a, a.getWorldTransform().getOrigin(), axis);
}

btFixedConstraint& BulletScene::add_weld(btRigidBody& a, btRigidBody& b) {
  const btTransform middle(btQuaternion::getIdentity(),
                           0.5 * (a.getWorldTransform().getOrigin() + b.getWorldTransform().getOrigin()));
  auto joint = std::make_unique<btFixedConstraint>(a, b, a.getWorldTransform().inverse() * middle,
                                                   b.getWorldTransform().inverse() * middle);
  for (int axis = 0; axis < 6; ++axis) joint->setParam(BT_CONSTRAINT_STOP_ERP, options_.joint_erp, axis);
  return keep(std::move(joint));
}

void BulletScene::step(int count) {
  for (int i = 0; i < count; ++i) world_->stepSimulation(kStep, 0);
}

double BulletScene::gap(const btTypedConstraint& joint) const {
  const btTransform& a = joint.getRigidBodyA().getWorldTransform();
  const btTransform& b = joint.getRigidBodyB().getWorldTransform();
  switch (joint.getConstraintType()) {
    case HINGE_CONSTRAINT_TYPE: {
      const auto& hinge = static_cast<const btHingeConstraint&>(joint);
      return (a * hinge.getAFrame().getOrigin()).distance(b * hinge.getBFrame().getOrigin());
    }
    case POINT2POINT_CONSTRAINT_TYPE: {
      const auto& ball = static_cast<const btPoint2PointConstraint&>(joint);
      return (a * ball.getPivotInA()).distance(b * ball.getPivotInB());
    }
    case SLIDER_CONSTRAINT_TYPE: {
      const auto& slider = static_cast<const btSliderConstraint&>(joint);
      const btTransform frame = a * slider.getFrameOffsetA();
      const btVector3 offset = (b * slider.getFrameOffsetB().getOrigin()) - frame.getOrigin();
      const btVector3 axis = frame.getBasis().getColumn(0);
      return (offset - axis * axis.dot(offset)).length();
    }
    default: return 0.0;
  }
}

double BulletScene::largest_gap() const {
  double largest = 0.0;
  for (const auto& joint : joints_) {
    const double now = gap(*joint);
    if (!(now <= largest)) largest = now;  // a NaN counts as large
  }
  return largest;
}

std::vector<double> BulletScene::state() const {
  std::vector<double> result;
  for (const auto& body : bodies_) {
    const btTransform& pose = body->getWorldTransform();
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) result.push_back(pose.getBasis()[i][j]);
      result.push_back(pose.getOrigin()[i]);
      result.push_back(body->getLinearVelocity()[i]);
      result.push_back(body->getAngularVelocity()[i]);
    }
  }
  return result;
}

void BulletScene::restore(const std::vector<double>& state) {
  std::size_t k = 0;
  for (const auto& body : bodies_) {
    btTransform pose;
    btVector3 linear;
    btVector3 angular;
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) pose.getBasis()[i][j] = state[k++];
      pose.getOrigin()[i] = state[k++];
      linear[i] = state[k++];
      angular[i] = state[k++];
    }
    body->setWorldTransform(pose);
    body->setInterpolationWorldTransform(pose);
    body->setLinearVelocity(linear);
    body->setAngularVelocity(angular);
    body->setInterpolationLinearVelocity(linear);
    body->setInterpolationAngularVelocity(angular);
    body->updateInertiaTensor();
  }
}

}  // namespace ambf::physics::testing
