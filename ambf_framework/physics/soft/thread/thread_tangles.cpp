// Pairs of segments which may come near each other within the step, with room for how far they may move.
#include "physics/soft/detail/thread_tangles.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "physics/soft/detail/near_shape.h"
#include "physics/soft/detail/segments.h"

namespace ambf::physics::detail {

using math::Vec3;

namespace {

constexpr std::size_t kRoom = 8192;                // for pairs that are near, of all threads
constexpr double kAhead = 0.5, kAheadRadii = 8.0;  // segments, and radii of thread: what is nearer is looked at
constexpr double kBend = 4.0;       // radii of thread between two segments, below which they do not touch
constexpr double kOverlap = 0.5;    // of both radii: what was nearer as loaded does not touch
constexpr double kStiffness = 5e4;  // N/m, where two threads of the same kind cross, however short their segments are

// Of one thread: so near along it that a bend is no touch.
bool is_bend(const ThreadData& thread, std::uint32_t a, std::uint32_t b) {
  const std::uint32_t low = std::min(a, b), high = std::max(a, b);
  return high - low < 2 || thread.along[high] - thread.along[low + 1] < kBend * thread.radius;
}

bool overlapped(const ThreadData& a, std::uint32_t i, const ThreadData& b, std::uint32_t k) {
  const Segment of_a{a.T_world_loaded * a.rest[i], a.T_world_loaded * a.rest[i + 1]};
  const Segment of_b{b.T_world_loaded * b.rest[k], b.T_world_loaded * b.rest[k + 1]};
  return math::norm(nearest_shares(of_a, of_b).gap) < kOverlap * (a.radius + b.radius);
}

bool may_touch(const ThreadData& a, std::uint32_t i, const ThreadData& b, std::uint32_t k) {
  return i < a.faces.size() && k < b.faces.size() && !(&a == &b && is_bend(a, i, k)) && !overlapped(a, i, b, k);
}

Box around(const std::vector<btVector3>& at, std::uint32_t first, std::uint32_t last, double margin) {
  Box box{at[first], at[first]};
  for (std::uint32_t i = first + 1; i <= last; ++i) box.low.setMin(at[i]), box.high.setMax(at[i]);
  const btVector3 more(margin, margin, margin);
  return {box.low - more, box.high + more};
}

ThreadPair pair_of(std::uint32_t thread_a, std::uint32_t a, std::uint32_t thread_b, std::uint32_t b) {
  ThreadPair made;
  made.of_a = thread_a, made.of_b = thread_b, made.a = a, made.b = b;
  return made;
}

}  // namespace

void ThreadData::sweep_blocks(double slack, double h) {
  for (Block& block : blocks) {
    double square = 0.0;
    block.box = {at[block.first], at[block.first]};
    for (std::size_t i = block.first; i <= block.last; ++i) {
      block.box.low.setMin(at[i]);
      block.box.high.setMax(at[i]);
      square = std::max(square, math::dot(chain.velocities()[i], chain.velocities()[i]));
    }
    block.way = slack + std::sqrt(square) * h;
  }
}

void ThreadTangles::make_room(const ThreadData& thread, std::size_t count) {
  threads.reserve(count);
  numbers.reserve(count);
  steps.reserve(count);
  leader_.reserve(count);
  slack_.reserve(count);
  holds_.reserve(Thread::kMaxCrossings * count);
  held_.reserve(Thread::kMaxCrossings * count);
  all_.reserve(kRoom);
  chosen_.reserve(kRoom);
  rooms.make_room(thread.rest.size());
}

void ThreadTangles::remove(const ThreadData& thread) {
  held_.clear();
  std::erase_if(holds_, [&](const Hold& hold) { return hold.a == &thread || hold.b == &thread; });
}

void ThreadTangles::find(double h) {
  leader_.clear();
  slack_.clear();
  all_.clear();
  std::swap(holds_, held_);
  holds_.clear();
  full_ = false;
  for (std::uint32_t i = 0; i < threads.size(); ++i) {
    leader_.push_back(i);
    ThreadData& of = *threads[i];
    const bool may_touch = of.touches_itself || (of.touches_others && threads.size() > 1);
    slack_.push_back(may_touch ? 0.5 * (kAhead * of.longest + kAheadRadii * of.radius)
                               : std::numeric_limits<double>::infinity());
    if (may_touch) of.sweep_blocks(slack_.back(), h);
  }
  for (std::uint32_t a = 0; a < threads.size(); ++a) {
    if (threads[a]->frozen) continue;
    for (std::uint32_t b = a; b < threads.size(); ++b) {
      const ThreadData &first = *threads[a], &second = *threads[b];
      if (a == b ? !first.touches_itself : !first.touches_others || !second.touches_others) continue;
      if (second.frozen || !groups_meet(first.collision_groups, second.collision_groups)) continue;
      look(a, b);
    }
  }
  for (const ThreadPair& pair : all_) {
    const std::uint32_t a = leader_[pair.of_a], b = leader_[pair.of_b];
    for (std::uint32_t& each : leader_)
      if (each == std::max(a, b)) each = std::min(a, b);
  }
}

// By blocks of segments, so that threads which are far from each other cost next to nothing.
void ThreadTangles::look(std::uint32_t a, std::uint32_t b) {
  const ThreadData &first = *threads[a], &second = *threads[b];
  const double reach = first.radius + second.radius;
  for (std::uint32_t i = 0; i < first.blocks.size(); ++i)
    for (std::uint32_t k = a == b ? i : 0; k < second.blocks.size(); ++k) {
      const ThreadData::Block &of_a = first.blocks[i], &of_b = second.blocks[k];
      const double farthest = reach + of_a.way + of_b.way;
      const btVector3 more(farthest, farthest, farthest);
      if (!Box{of_a.box.low - more, of_a.box.high + more}.overlaps(of_b.box.low, of_b.box.high)) continue;
      for (std::uint32_t s = of_a.first; s < of_a.last; ++s) {
        const Box of_segment = around(first.at, s, s + 1, farthest);
        for (std::uint32_t t = a == b ? std::max(s + 2, of_b.first) : of_b.first; t < of_b.last; ++t) {
          btVector3 low = second.at[t], high = low;
          low.setMin(second.at[t + 1]), high.setMax(second.at[t + 1]);
          if (of_segment.overlaps(low, high)) look(pair_of(a, s, b, t), farthest);
        }
      }
    }
}

void ThreadTangles::look(const ThreadPair& pair, double farthest) {
  const ThreadData &a = *threads[pair.of_a], &b = *threads[pair.of_b];
  if (&a == &b && is_bend(a, pair.a, pair.b)) return;
  const auto segment = [](const ThreadData& of, std::uint32_t i) {
    return Segment{of.chain.positions()[i], of.chain.positions()[i + 1]};
  };
  const double distance = math::norm(nearest_shares(segment(a, pair.a), segment(b, pair.b)).gap);
  if (distance > farthest || overlapped(a, pair.a, b, pair.b)) return;
  if (all_.size() == all_.capacity()) {
    full_ = true;
    return;
  }
  ThreadPair made = pair;
  made.reach = a.radius + b.radius;
  made.distance = distance;
  const auto mark = [&](unsigned bit, std::uint32_t i, std::uint32_t k) {
    if (may_touch(a, i, b, k)) made.beside = static_cast<std::uint8_t>(made.beside | (1U << bit));
  };
  mark(0, pair.a - 1, pair.b);  // none before the first: beyond the last
  mark(1, pair.a + 1, pair.b);
  mark(2, pair.a, pair.b - 1);
  mark(3, pair.a, pair.b + 1);
  const double of_a = a.contact_stiffness[a.rest.size() + pair.a], of_b = b.contact_stiffness[b.rest.size() + pair.b];
  made.stiffness = std::max(kStiffness, of_a * of_b / (of_a + of_b));
  made.friction = a.friction * b.friction;
  find_hold(made);
  all_.push_back(made);
}

// Its own; else of a place beside it, from which it may have wandered here.
void ThreadTangles::find_hold(ThreadPair& pair) const {
  const ThreadData *a = threads[pair.of_a], *b = threads[pair.of_b];
  const auto apart = [](std::uint32_t x, std::uint32_t y) { return std::max(x, y) - std::min(x, y); };
  std::uint32_t nearest = 2;
  for (const Hold& hold : held_) {
    if (hold.a != a || hold.b != b || hold.restarts_a != a->restarts || hold.restarts_b != b->restarts) continue;
    const std::uint32_t away = std::max(apart(hold.segment_a, pair.a), apart(hold.segment_b, pair.b));
    if (away >= nearest) continue;
    nearest = away;
    pair.away = hold.away;
  }
}

double ThreadTangles::slack(std::uint32_t thread) const { return slack_[thread]; }

std::span<ThreadPair> ThreadTangles::pairs() {
  chosen_.clear();
  const auto place = [&](std::uint32_t thread) {
    return static_cast<std::uint32_t>(std::find(numbers.begin(), numbers.end(), thread) - numbers.begin());
  };
  for (const ThreadPair& each : all_) {
    const std::uint32_t a = place(each.of_a), b = place(each.of_b);
    if (a == numbers.size()) continue;
    chosen_.push_back(each);
    chosen_.back().of_a = a;
    chosen_.back().of_b = b;
  }
  return chosen_;
}

void ThreadTangles::remember(double h) {
  for (const ThreadCrossing& each : rooms.touching) {
    ThreadData &a = *threads[numbers[each.pair->of_a]], &b = *threads[numbers[each.pair->of_b]];
    const ThreadPull& pull = each.pull;
    const Vec3 rate = a.chain.velocity(pull.at) - b.chain.velocity(each.on_b);
    // What slides is drawn as far as friction bears.
    const Vec3 away = (pull.away + pull.across(rate) * h) * (pull.side_stiffness / pull.stiffness);
    ++a.crossings;
    if (&a != &b) ++b.crossings;
    if (holds_.size() < holds_.capacity())
      holds_.push_back({&a, &b, a.restarts, b.restarts, pull.at.segment, each.on_b.segment, away});
  }
  for (const std::uint32_t i : numbers)
    threads[i]->crossings_left_out = full_ || (rooms.left_out && threads[i]->crossings > 0);
}

}  // namespace ambf::physics::detail
