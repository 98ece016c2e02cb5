// The mechanics of a thread: nodes in a row, implicit Euler steps solved directly (docs/tissue.md#threads). Knows
// neither bodies nor worlds. Private to physics/soft/. Physics thread once in a world.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "physics/thread.h"

namespace ambf::physics::detail {

// A point of a segment.
struct ThreadPoint {
  std::uint32_t segment = 0;
  double share = 0.0;  // of its second node
};

// What pulls at a point: with v its velocity after the step, the force is
// pull - h (normal_stiffness n n^T + side_stiffness (1 - n n^T)) v.
struct ThreadPull {
  ThreadPoint at;
  math::Vec3 normal;
  math::Vec3 pull;                                      // N
  double normal_stiffness = 0.0, side_stiffness = 0.0;  // N/m
  // Of contacts, what the solver makes the rest of: with u = v less `carried`, the force along the normal is
  // stiffness (depth - h n u), never below 0; of what is within when the step begins h is longer by `calming`, so that
  // it is not shot off. Across, a spring from where it will have been drawn to, `away` + h u, bears `friction` times
  // that force.
  bool touches = false;
  double depth = 0.0, stiffness = 0.0, calming = 0.0;  // m, N/m, s
  math::Vec3 carried, away;                            // m/s, m
  double friction = 0.0;
  math::Vec3 across(const math::Vec3& v) const { return v - normal * math::dot(normal, v); }

  math::Vec3 holding_back(const math::Vec3& v) const {
    return v * side_stiffness + normal * ((normal_stiffness - side_stiffness) * math::dot(normal, v));
  }
};

// What a contact does to what moves at u beside it, by where the last round put it.
void touch(ThreadPull& pull, const math::Vec3& u, double h, bool first);

class ThreadChain {
 public:
  // Of unknown r, the row of the lower triangle in the band: columns r - kBand to r.
  static constexpr std::size_t kBand = 8;
  // Right sides that are solved at once: of two points, along each axis.
  using Columns = std::vector<std::array<double, 6>>;

  explicit ThreadChain(const ThreadDefinition& given);

  // The parts of a step of h seconds (thread_crossings.cpp): the forces that were added, gravity, and the pulls, all of
  // which end with it. Velocities of fixed nodes are as set_velocity() left them.
  void begin();  // at rest, and the change is how it moved
  void assemble(double h, const math::Vec3& gravity, double stiffened, std::span<ThreadPull> pulls, bool first);
  void push(const ThreadPoint& at, const math::Vec3& impulse);  // Ns, of the linear system that was assembled
  bool solve();                                                 // the change; false: the system is not positive
  double too_wild(double h) const;
  void follow_tension(double h);             // that the change makes
  void keep_within(double slack, double h);  // m: no change takes nodes farther than their speed and that
  double farthest(double h) const;           // m, that the change moves a node
  void move(double h, double share);         // by that share of the change
  // Of the system that was solved: `at`, which holds zeros and some impulses, becomes velocities, from the `first` row
  // in which there are any, and down to the `last` that is asked for.
  void solve_more(Columns& at, std::size_t first, std::size_t last) const;
  // m/s, of velocities, in this round.
  math::Vec3 change(std::size_t node) const { return {right_[3 * node], right_[3 * node + 1], right_[3 * node + 2]}; }
  math::Vec3 change(const ThreadPoint& at) const {
    return change(at.segment) * (1.0 - at.share) + change(at.segment + 1) * at.share;
  }
  void add_change(const Columns& columns);                      // the first of these
  math::Vec3 force_of(const ThreadPull& pull, double h) const;  // after a step

  std::size_t node_count() const { return x_.size(); }
  const std::vector<math::Vec3>& positions() const { return x_; }
  const std::vector<math::Vec3>& velocities() const { return v_; }
  const std::vector<double>& masses() const { return mass_; }
  const std::vector<double>& lengths() const { return length_; }  // m, of segments at rest
  double tension(std::size_t segment) const { return tension_[segment]; }
  double stretching() const { return stretching_; }  // N, by strain
  bool fixed(std::size_t node) const { return fixed_[node] != 0; }
  bool any_fixed() const { return any_fixed_; }

  ThreadPoint point_at(double s) const;
  math::Vec3 at(const ThreadPoint& point) const { return sum(x_, point); }
  math::Vec3 velocity(const ThreadPoint& point) const { return sum(v_, point); }
  math::Vec3 tangent(std::size_t segment) const;  // unit

  void set_velocity(std::size_t node, const math::Vec3& v) { v_[node] = v; }
  void add_force(std::size_t node, const math::Vec3& force) { force_[node] += force; }
  void put(std::size_t node, const math::Vec3& x, const math::Vec3& v);
  void forget_tension();  // it is a guess of the next step's
  void forget_forces();

 private:
  using Row = std::array<double, kBand + 1>;

  static math::Vec3 sum(const std::vector<math::Vec3>& of, const ThreadPoint& point) {
    return of[point.segment] * (1.0 - point.share) + of[point.segment + 1] * point.share;
  }
  // Adds scale (along n n^T + across (1 - n n^T)) to the block of two nodes.
  void add_block(std::size_t a, std::size_t b, double scale, double along, double across, const math::Vec3& n);
  void add_bending(double h);
  void add_stretching(double h, double stiffened);
  void add_pulls(double h, std::span<ThreadPull> pulls, bool first);
  void hold_fixed();

  std::vector<double> mass_, length_, bending_;  // bending: N/m of (t2 - t1)^2 / 2 at each inner node, N m
  double stretching_;
  std::vector<std::uint8_t> fixed_;
  bool any_fixed_ = false;
  std::vector<math::Vec3> x_, v_, force_;
  std::vector<double> tension_;                       // N, of segments
  std::vector<math::Vec3> from_, before_, residual_;  // rooms of a step
  std::vector<Row> band_;
  std::vector<double> right_;
};

}  // namespace ambf::physics::detail
