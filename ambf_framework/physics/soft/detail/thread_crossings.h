// A step of threads that touch each other: each is solved directly, and so is what they do to each other
// (docs/tissue.md#thread-on-thread). Knows neither bodies nor worlds. Private to physics/soft/. Physics thread once in
// a world.
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "physics/soft/detail/thread_chain.h"

namespace ambf::physics::detail {

// One of the threads that are solved together.
struct ChainStep {
  ThreadChain* chain;
  std::span<ThreadPull> pulls;
  double slack = std::numeric_limits<double>::infinity();  // m, more than at its speed: no node moves farther
  double stiffened = 0.0;                                  // N
};

// Two segments, perhaps of one thread, that may come near each other within the step.
struct ThreadPair {
  std::uint32_t of_a = 0, of_b = 0;  // chains of the step
  std::uint32_t a = 0, b = 0;        // their segments
  // Of a and of b, the segments before and after, which may touch the other one, too: bits 0 to 3.
  std::uint8_t beside = 0;
  double reach = 0.0;      // m, at which they touch
  double stiffness = 0.0;  // N/m
  double friction = 0.0;
  math::Vec3 away;       // m: how far friction has let it be drawn away from where it stuck (EQUATIONS 17)
  bool touched = false;  // as the step begins
  // As they were when they were last looked at.
  double distance = 0.0;  // m
  double moved = 0.0;     // m: CrossingRooms::moved, then
};

// A place where two segments touch. The pull's normal is out of the second; its force acts on the first, and its
// opposite on the second.
struct ThreadCrossing {
  const ThreadPair* pair;
  ThreadPull pull;  // `at`: of the first
  ThreadPoint on_b;
};

// What steps fill anew; taken at load.
struct CrossingRooms {
  // Of the longest thread.
  void make_room(std::size_t nodes);

  struct End {
    std::size_t number;  // of the crossing
    double sign;
    ThreadPoint point;
  };
  std::vector<ThreadCrossing> touching;  // as the last round had them
  std::vector<End> ends;                 // on one chain
  std::vector<math::Vec3> impulses;
  std::vector<double> matrix, right;  // dense, of three unknowns for each that touches
  ThreadChain::Columns columns;
  double moved = 0.0;     // m, that any two nodes came nearer at most, of all rounds so far
  bool left_out = false;  // more touched than there is room for
};

// One step of h seconds of all of these. No pair of segments passes through each other.
void step_chains(std::span<ChainStep> chains, std::span<ThreadPair> pairs, CrossingRooms& rooms, double h,
                 const math::Vec3& gravity);

}  // namespace ambf::physics::detail
