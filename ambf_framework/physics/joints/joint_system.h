// All joint rows of one island and their exact solution. With J the row Jacobians, M the masses, v the velocities:
//   A x + ... : find impulses x with  w = J (v + M^-1 J^T x) + softness x - target  and the conditions of active_set.h.
// Rows of one joint form one block; A = J M^-1 J^T + softness is factored by BlockCholesky in the order of a
// BlockStructure. The impulses found and the changes of velocity they cause are always consistent, so that a solve
// may be repeated after something else (contacts) changed the velocities. It knows no Bullet, never integrates, and
// allocates only when its row counts outgrow what it had. Physics thread.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/limits.h"
#include "physics/detail/lanes.h"
#include "physics/joints/body_delta.h"
#include "physics/joints/detail/active_set.h"
#include "physics/joints/detail/block_cholesky.h"
#include "physics/joints/detail/block_structure.h"

namespace ambf::physics {

// Bodies that a row can act on: two of a joint, four where it ties the coordinates of two joints.
constexpr int kSidesOfJoints = 2, kMaxSides = 4;

// What a row needs. Jacobians and responses M^-1 J^T are {linear a, angular a, linear b, angular b, ...}; a body
// without a response (static) has zeros there. Of the rows of joints only the first twelve are read.
struct JointRow {
  double jacobian[6 * kMaxSides];
  double response[6 * kMaxSides];
  double target;     // wanted J dv, m/s or rad/s
  double softness;   // constraint force mixing relative to the row's own J M^-1 J^T, as Bullet's rows have it
  RowBounds bounds;  // of the impulse, N s or N m s
};

struct JointSolveCounts {
  std::uint64_t solves = 0;             // back-substitutions
  std::uint64_t factorisations = 0;     // of a component, whole or in part
  std::uint64_t active_set_rounds = 0;  // exchanges of rows
  std::uint64_t fallbacks = 0;          // components that ended in projected sweeps
  std::uint64_t dead_rows = 0;          // pivots that were not positive
};

class JointSystem {
 public:
  // Added to the diagonal entries of A, relative to themselves: `regularisation` everywhere, `loop_regularisation` in
  // mechanisms with closed loops, whose rows may be redundant and contradict each other; bounded rows get a
  // ten-thousandth of it. Where a row of a loop gives way by more than `max_given` (m/s or rad/s; its pivot rests
  // 10 um open then, in steps of 1 ms), that is taken back. `round_limit` caps the rounds of the active set of one
  // component in one solve. `work_limit` bounds the work of a step, in visits of a row (some 50 ns): beyond, active
  // sets are no longer searched.
  struct Options {
    double regularisation = 1e-7;
    double loop_regularisation = 2e-5;
    double max_given = 8e-3;
    int round_limit = 40;
    int fallback_sweeps = 30;
    std::int64_t work_limit = base::kMaxJointWork;
    bool wide = has_wide_vectors();  // the same bits without
  };

  // `structure` must outlive this.
  JointSystem(const BlockStructure& structure, const Options& options);

  // Starts a step: rows[j] rows for joint j. Remembered states of bounded rows are kept for joints with as many rows
  // as before.
  // again: the step is solved once more, with what is left of its work.
  void begin(const std::vector<int>& rows_of_joint, bool again = false);
  // Bodies of a joint as indices into the velocities given to solve(); -1: none.
  void set_bodies(int joint, const std::array<int, kMaxSides>& bodies);
  void set_row(int joint, int row, const JointRow& values);
  // The same for who writes Jacobian and response of a joint's rows where they are: six columns a body, `ld` numbers
  // apart; all rows of the padded block. finish_row() then takes the rest of a row: diagonal = J M^-1 J^T; shifts:
  // false where its linear parts are zero.
  struct Place {
    int begin, ld;
    double *jacobian, *response;
    double regularisation;
  };
  Place place_of(int joint);
  void finish_row(const Place& place, int row, double diagonal, double target, double softness, const RowBounds& bounds,
                  bool shifts);
  // Another target for a row, after assemble(); impulses stay until the next solve(), and so does what was given back.
  void set_target(int joint, int row, double target) {
    const int k = row_index(joint, row);
    target_[k] = target + given_back_[k];
  }
  // Builds A from the rows; impulses become 0.
  void assemble();

  // Adds to `bodies` what brings every row of the component to its conditions; true if the active set was found
  // exactly.
  bool solve(int component, BodyDelta* bodies, JointSolveCounts& counts);

  // For moves beside the velocities: begin_follow(), then follow() adds to `moves` what keeps the rows that solve()
  // left free where they are; soft rows give way as they do to velocities, pinned ones freely. Repeatable, as solve()
  // is.
  void begin_follow();
  void follow(int component, BodyDelta* moves, JointSolveCounts& counts);
  // Limits (rows that only push) that `moves` beside the velocities of `bodies` would pass: from now on, in this step,
  // they keep still as free rows do. False: there are none.
  bool hold_passed(int component, const BodyDelta* bodies, const BodyDelta* moves);

  double impulse(int joint, int row) const { return impulse_[row_index(joint, row)]; }
  RowState state(int joint, int row) const { return state_[row_index(joint, row)]; }
  // Largest |w| among the free rows of the component: how exact the last solve was.
  double residual(int component, const BodyDelta* bodies);

  const BlockStructure& structure() const { return *structure_; }
  int rows() const { return static_cast<int>(impulse_.size()); }  // of all components, with what pads them
  bool exhausted() const { return work_left_ <= 0; }              // the work of this step

 private:
  struct Joint {
    std::array<int, kMaxSides> bodies{-1, -1, -1, -1};
    int sides = kSidesOfJoints;
    std::size_t begin = 0;  // of its Jacobian columns, six a side, in jacobian_ and response_
  };

  int row_index(int joint, int row) const { return cholesky_.row_begin(structure_->position_of(joint)) + row; }
  std::size_t lay_out_columns();  // how many there are
  template <bool kWide>
  void multiply_jacobians(int position);  // the blocks of A in its column
  void multiply_jacobians_wide(int position);
  void residual_of(int position, const BodyDelta* bodies, double* out) const;
  void subtract_velocities(int position, const BodyDelta* bodies, double* out) const;
  void apply(int position, const double* change, BodyDelta* bodies) const;
  void apply_all(const BlockStructure::Component& component, BodyDelta* bodies);
  void move_to_bounds(const BlockStructure::Component& component, BodyDelta* bodies);
  void solve_free(const BlockStructure::Component& component, BodyDelta* bodies, JointSolveCounts& counts);
  void factor(const BlockStructure::Component& component, JointSolveCounts& counts);
  bool solve_rows(int component, BodyDelta* bodies, JointSolveCounts& counts);
  bool take_back(const BlockStructure::Component& component);  // what its rows gave way; false: not worth it
  int find_offenders(const BlockStructure::Component& component, const BodyDelta* bodies);
  void exchange(int row, int position);
  void sweep(const BlockStructure::Component& component, BodyDelta* bodies);

  // Bounded rows need little regularisation, because no impulse of theirs can grow without end, and bear little: a
  // motor has no position to return to, so what it gives way is lost.
  static constexpr double kBoundedShare = 1e-4;

  const BlockStructure* structure_;
  Options options_;
  BlockCholesky cholesky_;
  std::vector<int> rows_, previous_rows_;  // by position
  std::vector<Joint> joints_;              // by position
  std::vector<double> jacobian_, response_;
  // Vectors over all padded rows.
  std::vector<double> target_, given_back_, softness_, own_softness_, diagonal_, threshold_, impulse_, follow_impulse_,
      change_, residual_;
  std::vector<RowBounds> bounds_;
  std::vector<RowState> state_, previous_state_;
  std::vector<std::uint8_t> pinned_, shifts_;
  struct BoundedRow {
    int row = 0;
    int position = 0;
  };
  std::vector<BoundedRow> bounded_;  // all, in elimination order
  std::vector<int> bounded_begin_;   // by component, into bounded_
  std::vector<int> offenders_;       // indices into bounded_
  std::int64_t work_left_ = 0;       // in this step
  // By component: the factor belongs to the present rows and states; take_back() was in this step.
  std::vector<std::uint8_t> factored_, taken_back_;
};

inline void JointSystem::finish_row(const Place& place, int row, double diagonal, double target, double softness,
                                    const RowBounds& bounds, bool shifts) {
  const int k = place.begin + row;
  const double regularisation = is_bounded(bounds) ? kBoundedShare * place.regularisation : place.regularisation;
  diagonal_[k] = diagonal;
  own_softness_[k] = softness * diagonal;
  softness_[k] = own_softness_[k] + regularisation * diagonal;
  target_[k] = target;
  given_back_[k] = 0.0;
  shifts_[k] = shifts;
  bounds_[k] = bounds;
  // A row that moves nothing gets no impulse.
  if (diagonal <= 0.0) bounds_[k] = {0.0, 0.0};
  state_[k] = possible_state(state_[k], bounds_[k]);
}

}  // namespace ambf::physics
