// Bounces of bodies that touch each other in a row, passed on within a step: one pair of bodies after the other, the
// fastest first, as in a Newton's cradle. Solved all at once, as other contacts are, the first ball would throw all the
// others. docs/solver.md ("Impacts"). It knows no Bullet; storage only grows. Physics thread.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "physics/contacts/contact_system.h"

namespace ambf::physics {

// What a normal row that may bounce is about, apart from the row.
struct BouncingRow {
  int normal = 0;               // its index
  std::uint64_t pair = 0;       // which two bodies: rows of a pair follow each other
  double restitution = 0.0;     // > 0
  double start_velocity = 0.0;  // m/s, before the impulses of this step and with what forces add to it; > 0: apart
  double gap = 0.0;             // m; <= 0: touches
  double bounce = 0.0;          // m/s, the part of the row's target that is a bounce
};

class Impacts {
 public:
  Impacts();
  void clear() { rows_.clear(); }
  std::vector<BouncingRow>& rows() { return rows_; }

  // Where a bounce may be passed on (bodies bounce in more than one pair): lets pairs bounce until none closes within
  // h faster than `slowest` (m/s; what is slower does not bounce). What they exchanged is NormalRow::passed; their
  // targets lose their bounces. `follow` makes the joints follow the impulses; where it returns false, that has become
  // too much work, and what has not bounced yet does not.
  void pass_on(ContactSystem& contacts, BodyDelta* bodies, double h, double slowest,
               const std::function<bool()>& follow);

 private:
  struct Pair {
    std::size_t begin = 0, end = 0;  // of rows_
  };
  void find_pairs();
  double closing(const Pair& pair, ContactSystem& contacts, const BodyDelta* bodies, double h) const;
  bool bounce(const Pair& pair, ContactSystem& contacts, BodyDelta* bodies, const std::function<bool()>& follow);
  static bool bounce_at_point(const BouncingRow& bouncing, double wanted, double precision, ContactSystem& contacts,
                              BodyDelta* bodies, const std::function<bool()>& follow);

  std::vector<BouncingRow> rows_;
  std::vector<Pair> pairs_;
  std::vector<double> wanted_, given_;  // by row of a pair: m/s after the bounce; Ns
};

}  // namespace ambf::physics
