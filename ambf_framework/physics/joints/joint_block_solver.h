// The default constraint solver: Bullet's sequential impulse for contacts, and around it all joint rows of an island
// (equality, motors, limits, springs) solved together and exactly. docs/solver.md has the equations.
//
// PRIVATE to physics/: this header shows Bullet. Only physics/ itself, its tests and benchmarks include it.
//
// It keeps Bullet's contract: the world calls solveGroup() for each island; feedback, breaking thresholds, applied
// impulses, split impulse (without joints) and rolling friction work as in Bullet. Warm starts, bounces and the push
// out of depth are its own (m_warmstartingFactor is not used, m_erp2 only where it is below contact_rate h). What it
// does not do: random row order, per-joint iteration counts, constraints of the obsolete (pre-2.82) kind. With
// `direct` off everything is Bullet's again. It never reads an address as a number and never a clock (unless set to
// measure), so equal inputs give equal bits; after reset() it behaves as a new one. Between structural changes it
// allocates nothing. Physics thread only.
//
// For the owner of the world:
// - info.m_solverMode |= SOLVER_USE_2_FRICTION_DIRECTIONS | SOLVER_DISABLE_VELOCITY_DEPENDENT_FRICTION_DIRECTION:
//   with both, friction is warm-started and bounded by a circle; nothing that rests or is held creeps.
// - info.m_minimumSolverBatchSize = 1: one call an island. Islands then stop iterating each when it has converged,
//   and joint structures do not change because an unrelated body touches something. (A larger value also works.)
// - info.m_splitImpulse on (the default): islands with joints are pushed out of depth by it (depth_push.h).
// - info.m_numIterations bounds the sweeps over contacts; 10 is plenty. Where a heavy body presses on a light one there
//   are more (max_sweeps).
#pragma once

#include <BulletDynamics/ConstraintSolver/btSequentialImpulseConstraintSolver.h>

#include <cstdint>
#include <memory>
#include <vector>

#include "physics/contacts/contact_system.h"
#include "physics/contacts/depth_push.h"
#include "physics/contacts/impacts.h"
#include "physics/joints/joint_system.h"

namespace ambf::physics {

namespace detail {
struct BodyData;
struct FarLimits;
class JointConstraint;
struct JointData;
class MimicConstraint;
struct Row;
}  // namespace detail

struct JointBlockOptions {
  bool direct = true;               // off: Bullet's sequential impulse for everything, untouched
  double contact_tolerance = 1e-6;  // stop sweeping when no row was wrong by more than this (m/s, rad/s)
  double grasp_tolerance = 1e-7;    // the same where friction slips against joints: what they hold creeps by it
  double contact_rate = 20.0;       // share of a penetration that is pushed out in a second, at most (1/s)
  bool measure = false;  // fill the times and the residual of the statistics (costs a few clock reads a call)
  JointSystem::Options joints;
};

struct JointBlockStatistics {
  std::uint64_t calls = 0;              // islands, or batches of them
  std::uint64_t symbolic_analyses = 0;  // structures not met before, or forgotten
  std::uint64_t contact_sweeps = 0;
  std::uint64_t passed_limits = 0;  // limits that got a row because they were passed without
  JointSolveCounts joints;
  double last_residual = 0.0;         // largest error left in a joint row of the last call, m/s or rad/s (if measured)
  std::uint64_t joint_time_ns = 0;    // loading, factoring and solving joint rows (if measured)
  std::uint64_t contact_time_ns = 0;  // packing and sweeping contacts (if measured)
};

class JointBlockSolver : public btSequentialImpulseConstraintSolver {
 public:
  BT_DECLARE_ALIGNED_ALLOCATOR();

  explicit JointBlockSolver(const JointBlockOptions& options = {});
  ~JointBlockSolver() override;
  JointBlockSolver(const JointBlockSolver&) = delete;
  JointBlockSolver& operator=(const JointBlockSolver&) = delete;

  // Forgets every structure and remembered state: the next step is that of a new solver.
  void reset() override;

  const JointBlockOptions& options() const { return options_; }
  // Takes effect at the next call, which is that of a new solver.
  void set_options(const JointBlockOptions& options);

  const JointBlockStatistics& statistics() const { return statistics_; }
  void clear_statistics() { statistics_ = {}; }

 protected:
  void convertContacts(btPersistentManifold** manifolds, int manifold_count, const btContactSolverInfo& info) override;
  void convertJoints(btTypedConstraint** constraints, int constraint_count, const btContactSolverInfo& info) override;
  btScalar solveGroupCacheFriendlyIterations(btCollisionObject** bodies, int body_count,
                                             btPersistentManifold** manifolds, int manifold_count,
                                             btTypedConstraint** constraints, int constraint_count,
                                             const btContactSolverInfo& info, btIDebugDraw* drawer) override;

 private:
  struct Mechanism;  // a structure met before, with its storage
  // What share of last step's impulses a call starts from, and whether every other sweep goes backwards.
  struct WarmStart {
    double normal = 1.0;
    double friction = 1.0;
    bool to_and_fro = true;
  };

  void load_bodies();
  WarmStart choose_warm_start() const;
  double max_warm_start() const;
  double bounce_correction(const btSolverConstraint& row, const btContactSolverInfo& info, BouncingRow& bouncing);
  double turned_by_torques(const btSolverConstraint& row) const;
  void pass_on_impacts(const btContactSolverInfo& info);
  void load_contacts(const btContactSolverInfo& info);
  int max_sweeps(const btContactSolverInfo& info);
  int joint_sweeps(const btContactSolverInfo& info) const;
  bool load_joints(btTypedConstraint** constraints, int constraint_count, const btContactSolverInfo& info);
  void load_all_rows(bool again, const btContactSolverInfo& info);
  // Rows for limits that joints passed; false: none.
  bool add_passed_limits(btTypedConstraint** constraints);
  // New targets for joints whose bodies turn fast: by how much (m or rad) a row was wrong, at most.
  double bend_targets(const btContactSolverInfo& info);
  double bend_targets(int joint, detail::JointData& data, double h);
  // Where impulses make bodies turn otherwise than rows counted on: they learn of it. False: nowhere. `last`: what is
  // left turns as its rows say.
  bool expect_turns(double h, bool last);
  void solve_from_start(const btContactSolverInfo& info);
  btVector3 turning_after(int body) const;  // rad/s, with the impulses of this step
  btTransform pose_after(const detail::BodyData& body, int id, double h) const;
  // The rate that a row of a joint between two solver bodies measures: without the impulses of this step, and of them.
  double rate_at_start(const detail::Row& row, int body_a, int body_b) const;
  double rate_by_impulses(const detail::Row& row, int body_a, int body_b) const;
  Mechanism& find_mechanism(int constraint_count);
  void load_rows(int joint, const btContactSolverInfo& info);
  void load_joint(int joint, const std::array<int, kMaxSides>& sides, const btContactSolverInfo& info);
  void load_joint_wide(int joint, const std::array<int, kMaxSides>& sides, const btContactSolverInfo& info);
  void write_back_joint(int joint, double h);
  struct OrderedJoint;
  std::array<int, kMaxSides> moving_sides(const OrderedJoint& joint) const;  // solver bodies; -1: does not move
  JointRow row_of(const OrderedJoint& joint, int pool_row, const std::array<int, kMaxSides>& sides) const;
  void find_touched();
  bool has_joints() const { return joint_rows_ > 0; }
  bool is_movable(int body) const { return movable_[body] != 0; }
  bool solve_joints(bool touched_only);  // false: no more work in this step, if it can be left out
  int iterate(const btContactSolverInfo& info);
  int sweep_contacts(const btContactSolverInfo& info);
  void solve_again(btTypedConstraint** constraints, const btContactSolverInfo& info);
  void leave_bent(double error) const;  // m or rad: by what joints of fast bodies are wrong when all rounds are over
  void push_out(const btContactSolverInfo& info);
  void write_back(double h);

  JointBlockOptions options_;
  JointBlockStatistics statistics_;

  std::vector<BodyDelta> bodies_;      // by solver body
  std::vector<std::uint8_t> movable_;  // by solver body
  ContactSystem contacts_;
  Impacts impacts_;
  DepthPush push_;  // of depth, in calls with joints

  std::vector<std::unique_ptr<Mechanism>> mechanisms_;
  Mechanism* current_ = nullptr;  // of this call; null without joint rows
  std::uint64_t call_ = 0;
  struct OrderedJoint {
    JointEnds ends;
    int constraint = 0;
    int rows = 0;
    int first_row = 0;  // of a mimic or a pull, in Bullet's pool
    std::array<int, kSidesOfJoints> solver_bodies{};
    detail::JointData* data = nullptr;               // null: a mimic or a pull
    const detail::MimicConstraint* mimic = nullptr;  // null: a joint, or a pull
    const detail::FarLimits* far_limits = nullptr;   // null: none
    int passed_row = -1;  // of a far limit, in Bullet's pool and last in the joint's block; -1: none
    double beside =
        0.0;  // m/s or rad/s: by how much more than its row says the coordinate changes, where bodies turn fast
    bool bent = false;  // its targets, in this step
    int all_rows() const { return passed_row < 0 ? rows : rows + 1; }
    int pool_row(int row) const { return row < rows ? first_row + row : passed_row; }
  };
  int joint_rows_ = 0;                                          // of this call
  std::vector<std::array<int, kSidesOfJoints>> solver_bodies_;  // by constraint
  std::vector<OrderedJoint> joints_;                            // of this call, in canonical order
  std::vector<int> rows_of_joint_;
  std::vector<int> component_of_body_;  // by solver body; -1: in no joint
  std::vector<std::uint8_t> touched_;   // by component: a contact acts on one of its bodies
  bool any_touched_ = false;
  WarmStart start_;  // of this call
};

}  // namespace ambf::physics
