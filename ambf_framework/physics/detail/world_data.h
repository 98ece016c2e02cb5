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
#include "physics/soft/soft_bodies.h"
#include "physics/world.h"

namespace ambf::physics::detail {

// A body held by a point.
struct PullData {
  BodyData* body = nullptr;  // null: free
  std::optional<btPoint2PointConstraint> constraint;
  btJointFeedback feedback;
};

// What a bundle of rays may meet.
struct RayCandidate {
  const BodyData* body;
  btTransform pose;
  int order;  // of addition
  btVector3 low{0, 0, 0}, high{0, 0, 0};
};

// Rooms that all bundles of rays share (rays/ray_bundle.cpp).
struct RayRooms {
  std::vector<RayCandidate> candidates;          // room for all bodies
  std::uint64_t drift_step = ~std::uint64_t{0};  // the step that `drift` is of
  double drift = 0.0;                            // m
};

struct GraspData;

struct WorldData {
  explicit WorldData(const WorldOptions& given);
  ~WorldData();

  WorldOptions options;
  double h;                 // s, the step, or a part of it (step_parts.cpp)
  double part = 1.0;        // h as a share of the step: what bounds are given for a step count so far
  double bent_error = 0.0;  // m or rad: by what joints of fast bodies are still wrong when the step is solved
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
  std::vector<MimicConstraint*> mimics;  // of joints in it, in their order; attached while both joints are
  std::vector<GraspData*> grasps;        // in order of addition
  std::vector<GraspData*> holding;       // those that hold something, in the order in which they began to
  std::vector<BodyData*> carried;        // static bodies that move_to() takes somewhere in the next step

  std::uint64_t steps = 0;
  PhaseSums phase_sums;
  std::size_t frozen_count = 0;
  bool maybe_awake = true;  // false: nothing can move until something_woke()

  std::array<PullData, base::kMaxPicks> pulls;
  RayRooms rays;
  std::unique_ptr<SoftBodies> soft;  // null until one is added

  void step();
  void add(BodyData& body);
  void remove(BodyData& body);
  void add(JointData& joint);
  void remove(JointData& joint);
  // grasp.cpp
  void add(GraspData& grasp);
  void remove(GraspData& grasp);
  void hold(GraspData& grasp);     // its joint, just made, begins to act
  void release(GraspData& grasp);  // its joint ends
  void tie(GraspData& grasp);      // as hold(), before a restart
  void forget_grasps();            // as release() of all, before a restart
  void order_grasps();             // as if they had begun in their order, after all joints
  void end(PullData& pull);
  void end_pulls();

  void something_woke() { maybe_awake = true; }
  void state_changed() { maybe_awake = true; }
  void before_teleport(BodyData& body);
  void after_teleport(BodyData& body);
  void start_moving(BodyData& body);
  void freeze(BodyData& body, const btTransform& T_world_com);
  void release(BodyData& body);
  void mount(BodyData& body, bool mounted);
  void wake_around(BodyData& body);        // it, and what touches it
  void set_damping(BodyData& body) const;  // from its rigid body's coefficients, for h

  // Removes everything and adds it again in its order: pairs, warm starts and the solver's memory start anew.
  void restart();
  void release_grasps_of(const BodyData& body);  // that hold it, or hold by it

 private:
  void solve(PhaseSums* times);  // the velocities of a step of h; nothing is moved yet
  // step_parts.cpp
  void remember_start();
  int parts_needed() const;  // of the step that was solved; 1: it will do
  void solve_in_parts(int parts, PhaseSums* times);
  void solve_parts(int parts, PhaseSums* times);
  void return_to_start();
  double kinetic_energy() const;  // J
  void set_part(double share);
  void set_carried_velocities();
  void land_carried();
  // A joint among those of its bodies, and the exclusion of their contacts.
  void connect(JointData& joint);
  void disconnect(JointData& joint);
  void untie(GraspData& grasp);
  void make_room_for_grasps(BodyData& body) const;
  void attach(BodyData& body);
  void attach(JointData& joint);
  void attach_mimics();
  void detach(MimicConstraint& mimic);
};

}  // namespace ambf::physics::detail
