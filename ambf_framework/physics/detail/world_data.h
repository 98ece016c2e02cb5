// What a World is made of. Private to physics/. Physics thread.
#pragma once

#include <BulletDynamics/MLCPSolvers/btMLCPSolverInterface.h>

#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "base/limits.h"
#include "physics/contacts/plane_contact.h"
#include "physics/detail/body_data.h"
#include "physics/detail/dynamics_world.h"
#include "physics/joints/joint_data.h"
#include "physics/meshes/mesh_contacts.h"
#include "physics/world.h"

namespace ambf::physics::detail {

// A body held by a point.
struct PullData {
  BodyData* body = nullptr;  // null: free
  std::optional<btPoint2PointConstraint> constraint;
  btJointFeedback feedback;
};

struct WorldData {
  explicit WorldData(const WorldOptions& given);
  ~WorldData();

  WorldOptions options;
  double h;  // s, the step
  std::unique_ptr<btCollisionConfiguration> configuration;
  std::unique_ptr<btCollisionDispatcher> dispatcher;
  PlaneContactRegistration plane_contact;
  std::unique_ptr<MeshContacts> mesh_contacts;
  std::unique_ptr<btDbvtBroadphase> broadphase;
  PairFilter filter;
  std::unique_ptr<btMLCPSolverInterface> mlcp;
  std::unique_ptr<btConstraintSolver> solver;
  std::unique_ptr<DynamicsWorld> dynamics;

  std::vector<BodyData*> bodies;  // in order of addition: the canonical order
  std::vector<JointData*> joints;
  std::vector<BodyData*> carried;  // static bodies that move_to() takes somewhere in the next step

  std::uint64_t steps = 0;
  PhaseSums phase_sums;
  std::size_t frozen_count = 0;
  bool maybe_awake = true;  // false: nothing can move until something_woke()

  std::array<PullData, base::kMaxPicks> pulls;

  void step();
  void add(BodyData& body);
  void remove(BodyData& body);
  void add(JointData& joint);
  void remove(JointData& joint);
  void end(PullData& pull);
  void end_pulls();

  void something_woke() { maybe_awake = true; }
  void state_changed() { maybe_awake = true; }
  void before_teleport(BodyData& body);
  void after_teleport(BodyData& body);
  void start_moving(BodyData& body);
  void freeze(BodyData& body, const btTransform& T_world_com);
  void release(BodyData& body);
  void wake_around(BodyData& body);        // it, and what touches it
  void set_damping(BodyData& body) const;  // from its rigid body's coefficients

  // Removes everything and adds it again in its order: pairs, warm starts and the solver's memory start anew.
  void restart();

 private:
  void set_carried_velocities();
  void land_carried();
  void attach(BodyData& body);
  void attach(JointData& joint);
};

}  // namespace ambf::physics::detail
