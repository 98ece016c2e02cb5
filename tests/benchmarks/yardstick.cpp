// The fixed yardstick of the benchmarks: a bare Bullet scene without a line of ours, so that figures of two machines,
// or of a calm and a busy hour, can be compared as ratios to it. Prints the steps of that scene a second of thread CPU.
#include <btBulletDynamicsCommon.h>

#include <ctime>

#include <algorithm>
#include <array>
#include <cstdio>
#include <memory>
#include <vector>

namespace {

constexpr int kTowers = 20, kCubesPerTower = 5;
constexpr int kSettlingSteps = 200, kSteps = 400;

double thread_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

}  // namespace

int main() {
  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher(&configuration);
  btDbvtBroadphase broadphase;
  btSequentialImpulseConstraintSolver solver;
  btDiscreteDynamicsWorld world(&dispatcher, &broadphase, &solver, &configuration);
  world.setGravity(btVector3(0, 0, -9.81));

  btStaticPlaneShape plane(btVector3(0, 0, 1), 0);
  btBoxShape cube(btVector3(0.05, 0.05, 0.05));
  std::vector<std::unique_ptr<btRigidBody>> bodies;
  const auto add = [&](btScalar mass, btCollisionShape& shape, const btVector3& position) {
    btVector3 inertia(0, 0, 0);
    if (mass > 0) shape.calculateLocalInertia(mass, inertia);
    btRigidBody::btRigidBodyConstructionInfo info(mass, nullptr, &shape, inertia);
    info.m_startWorldTransform.setOrigin(position);
    bodies.push_back(std::make_unique<btRigidBody>(info));
    bodies.back()->setActivationState(DISABLE_DEACTIVATION);
    world.addRigidBody(bodies.back().get());
  };
  add(0, plane, btVector3(0, 0, 0));
  for (int tower = 0; tower < kTowers; ++tower)
    for (int level = 0; level < kCubesPerTower; ++level) add(1, cube, btVector3(tower, 0, 0.05 + 0.1 * level));

  const auto step = [&](int count) {
    for (int i = 0; i < count; ++i) world.stepSimulation(1e-3, 0, 1e-3);
  };
  step(kSettlingSteps);
  std::array<double, 5> rates{};
  for (double& rate : rates) {
    const double start = thread_seconds();
    step(kSteps);
    rate = kSteps / (thread_seconds() - start);
  }
  std::sort(rates.begin(), rates.end());
  std::printf("%.0f\n", rates[rates.size() / 2]);
  for (const auto& body : bodies) world.removeRigidBody(body.get());
  return 0;
}
