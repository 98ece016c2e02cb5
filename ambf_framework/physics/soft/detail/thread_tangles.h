// Where threads are near themselves and each other, and which of them are to be solved together. Private to
// physics/soft/. Physics thread once in a world.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "physics/soft/detail/thread_crossings.h"
#include "physics/soft/detail/thread_data.h"

namespace ambf::physics::detail {

class ThreadTangles {
 public:
  void make_room(const ThreadData& thread, std::size_t count);  // at load; `count` threads
  void remove(const ThreadData& thread);

  CrossingRooms rooms;
  // Of a step, for who makes it: all threads, and of those that are solved together their numbers and parts.
  std::vector<ThreadData*> threads;
  std::vector<std::uint32_t> numbers;
  std::vector<ChainStep> steps;

  // Of `threads`, as they are and will move on for h seconds.
  void find(double h);
  // The number of the first thread of those that a thread is solved with; its own, if it is that.
  std::uint32_t leader(std::uint32_t thread) const { return leader_[thread]; }
  // Of the threads that `numbers` names, which are solved together; and how far those may move.
  std::span<ThreadPair> pairs();
  double slack(std::uint32_t thread) const;  // m
  // After their step.
  void remember(double h);

 private:
  // How far friction had let a place be drawn away as a step ended. Not a place: where segments touch wanders along
  // both.
  struct Hold {
    const ThreadData *a = nullptr, *b = nullptr;
    std::uint64_t restarts_a = 0, restarts_b = 0;  // of these
    std::uint32_t segment_a = 0, segment_b = 0;
    math::Vec3 away;  // m
  };

  void look(std::uint32_t a, std::uint32_t b);
  void look(const ThreadPair& pair, double farthest);
  void find_hold(ThreadPair& pair) const;

  std::vector<std::uint32_t> leader_;
  std::vector<double> slack_;
  std::vector<Hold> holds_, held_;        // as the last step ended, and as it began
  std::vector<ThreadPair> all_, chosen_;  // of all threads; of those that are solved together
  bool full_ = false;
};

}  // namespace ambf::physics::detail
