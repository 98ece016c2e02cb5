#include "tests/physics/bare_soft_world.h"

#include <BulletSoftBody/btSoftBodyHelpers.h>
#include <BulletSoftBody/btSoftBodyRigidBodyCollisionConfiguration.h>
#include <BulletSoftBody/btSoftRigidDynamicsWorld.h>
#include <btBulletDynamicsCommon.h>

#include <optional>
#include <vector>

namespace ambf::physics::testing {

struct BareSoftWorld::Impl {
  btSoftBodyRigidBodyCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher{&configuration};
  btDbvtBroadphase broadphase;
  btSequentialImpulseConstraintSolver solver;
  btSoftRigidDynamicsWorld dynamics{&dispatcher, &broadphase, &solver, &configuration};
  btSoftBody* soft = nullptr;
  std::unique_ptr<btBoxShape> shape;
  std::unique_ptr<btRigidBody> box;

  explicit Impl(const SoftDefinition& given) {
    dynamics.setGravity({0, 0, -9.8});
    dynamics.getWorldInfo().m_gravity.setValue(0, 0, -9.8);
    std::vector<btScalar> vertices;
    std::vector<int> corners;
    for (const math::Vec3& node : given.nodes) vertices.insert(vertices.end(), {node.x, node.y, node.z});
    for (const auto& t : given.triangles)
      for (const std::uint32_t corner : t) corners.push_back(static_cast<int>(corner));
    soft = btSoftBodyHelpers::CreateFromTriMesh(dynamics.getWorldInfo(), vertices.data(), corners.data(),
                                                static_cast<int>(given.triangles.size()), false);
    for (const auto& line : given.lines)
      soft->appendLink(static_cast<int>(line[0]), static_cast<int>(line[1]), nullptr, true);
    soft->getCollisionShape()->setMargin(given.margin);
    soft->setTotalMass(given.mass, false);
    const math::Pose& at = given.T_world_body;
    soft->transform(btTransform(btQuaternion(at.orientation.x, at.orientation.y, at.orientation.z, at.orientation.w),
                                btVector3(at.position.x, at.position.y, at.position.z)));
    const scene::SoftConfig& config = given.config;
    soft->m_materials[0]->m_kLST = config.kLST;
    soft->m_materials[0]->m_kAST = config.kAST;
    soft->m_materials[0]->m_kVST = config.kVST;
    if (config.kMT > 0.0) soft->setPose(false, true);
    soft->m_cfg.kDP = config.kDP;
    soft->m_cfg.kPR = config.kPR;
    soft->m_cfg.kMT = config.kMT;
    soft->m_cfg.kDF = config.kDF;
    soft->m_cfg.kCHR = config.kCHR;
    soft->m_cfg.kKHR = config.kKHR;
    soft->m_cfg.piterations = config.piterations;
    soft->m_cfg.viterations = config.viterations;
    soft->m_cfg.collisions = config.flags;
    if (config.bending_distance > 0) soft->generateBendingConstraints(config.bending_distance, soft->m_materials[0]);
    for (const std::uint32_t node : given.fixed) soft->setMass(static_cast<int>(node), 0.0);
    if (given.randomize_constraints) soft->randomizeConstraints();
    dynamics.addSoftBody(soft);
  }
  ~Impl() {
    if (box != nullptr) dynamics.removeRigidBody(box.get());
    dynamics.removeSoftBody(soft);
    delete soft;
  }
};

BareSoftWorld::BareSoftWorld(const SoftDefinition& definition) : impl_(std::make_unique<Impl>(definition)) {}
BareSoftWorld::~BareSoftWorld() = default;

void BareSoftWorld::add_box(const math::Vec3& half) {
  impl_->shape = std::make_unique<btBoxShape>(btVector3(half.x, half.y, half.z));
  impl_->box = std::make_unique<btRigidBody>(0.0, nullptr, impl_->shape.get());
  impl_->dynamics.addRigidBody(impl_->box.get());
}

void BareSoftWorld::step() { impl_->dynamics.stepSimulation(0.001, 0, 0.001); }

math::Vec3 BareSoftWorld::position(std::size_t node) const {
  const btVector3& at = impl_->soft->m_nodes[static_cast<int>(node)].m_x;
  return {at.x(), at.y(), at.z()};
}

}  // namespace ambf::physics::testing
