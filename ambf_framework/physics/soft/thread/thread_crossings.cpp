// Newton's method for threads that touch each other. With A the linear systems of the threads, one beside the other,
// and G the rates of their crossings, each round solves (A + h^2 G^T S G) dv = r, S the springs of what touches. A is
// solved by its bands, and G adds three unknowns for each that touches (Woodbury): with S = B B and U = h G^T B,
//     dv = y - A^-1 U (1 + U^T A^-1 U)^-1 U^T y,   y = A^-1 r.
// So crossings are as implicit as all else, however stiff they are beside what a thread weighs.
//
// A thread is so light that a round may move it by metres. What a round wants is therefore done only by the share at
// which no two segments have come nearer than half of what was between them (additive continuous collision detection:
// Li et al., Codimensional Incremental Potential Contact, 2021): however hard it is pulled and wherever rounds end,
// nothing has passed through anything. Each round looks anew where segments touch.
#include "physics/soft/detail/thread_crossings.h"

#include <algorithm>
#include <cmath>

#include "physics/soft/detail/segments.h"
#include "physics/thread.h"

namespace ambf::physics::detail {

using math::Vec3;

namespace {

constexpr int kMaxRounds = 16;    // of Newton's method
constexpr int kMaxSolved = 32;    // linear systems in a step
constexpr double kExact = 1e-10;  // m: a round that moves nodes by less is the last
constexpr int kMaxTouching = 10;  // rounds, where threads touch: knots do not converge to the last digit
constexpr double kExactTouching = 1e-7;
constexpr double kTouching = 1e-5;    // m, apart: in the first round what is nearer holds
constexpr double kCalming_s = 0.003;  // as in contacts with bodies (thread_step.cpp)
constexpr double kKept = 0.5;         // of what is between two segments, in a round
constexpr double kNearKept = 0.05;    // of that: near enough to it
constexpr int kMaxAdvances = 32;
constexpr double kSame = 1e-9;  // of a distance: the same

Segment segment_of(const ThreadChain& chain, std::uint32_t i) {
  return {chain.positions()[i], chain.positions()[i + 1]};
}

// The root of a contact's springs, on a vector.
Vec3 root(const ThreadPull& pull, const Vec3& v) {
  const double side = std::sqrt(pull.side_stiffness), normal = std::sqrt(pull.normal_stiffness);
  return v * side + pull.normal * ((normal - side) * math::dot(pull.normal, v));
}

// Those that may have come near since they were last looked at.
bool may_be_near(const ThreadPair& pair, const CrossingRooms& rooms) {
  return pair.distance - (rooms.moved - pair.moved) < pair.reach + kTouching;
}

// The segment beside one whose end is nearest is nearer still; or as near, and comes first.
bool next_is_nearer(const ThreadChain& of, std::uint32_t i, double share, unsigned beside, const Segment& other,
                    double distance) {
  if (share >= 1.0 && (beside & 2U) != 0)
    return math::norm(nearest_shares(segment_of(of, i + 1), other).gap) < distance * (1.0 - kSame);
  if (share <= 0.0 && (beside & 1U) != 0)
    return math::norm(nearest_shares(segment_of(of, i - 1), other).gap) <= distance * (1.0 + kSame);
  return false;
}

// A spring that bears F = k depth reach / distance, so that no force brings the middles together: by its slope and its
// force where the last round put it.
ThreadCrossing crossing_of(const ThreadPair& pair, const NearestShares& near, const Vec3& u, double h) {
  ThreadCrossing made;
  made.pair = &pair;
  made.on_b = {pair.b, near.b};
  ThreadPull& pull = made.pull;
  const double steeper = std::max(1.0, pair.reach / pair.distance);
  pull.at = {pair.a, near.a};
  pull.touches = true;
  pull.normal = near.gap / pair.distance;
  pull.stiffness = pair.stiffness * steeper * steeper;
  pull.depth = (pair.reach - pair.distance) / steeper + h * math::dot(pull.normal, u);
  pull.calming = pair.touched ? kCalming_s : 0.0;
  pull.friction = pair.friction;
  pull.away = pull.across(pair.away);
  return made;
}

// All that touch, and what they do to the threads as these move now.
void push_all(std::span<ChainStep> chains, std::span<ThreadPair> pairs, CrossingRooms& rooms, double h, bool first) {
  rooms.touching.clear();
  for (ThreadPair& pair : pairs) {
    if (!may_be_near(pair, rooms)) continue;
    ThreadChain &a = *chains[pair.of_a].chain, &b = *chains[pair.of_b].chain;
    const Segment of_a = segment_of(a, pair.a), of_b = segment_of(b, pair.b);
    const NearestShares near = nearest_shares(of_a, of_b);
    pair.distance = math::norm(near.gap);
    pair.moved = rooms.moved;
    if (pair.distance > pair.reach + (first ? kTouching : 0.0) || !(pair.distance > 0.0)) continue;
    if (next_is_nearer(a, pair.a, near.a, pair.beside, of_b, pair.distance) ||
        next_is_nearer(b, pair.b, near.b, pair.beside >> 2U, of_a, pair.distance))
      continue;
    const Vec3 u = a.velocity({pair.a, near.a}) - b.velocity({pair.b, near.b});
    ThreadCrossing each = crossing_of(pair, near, u, h);
    touch(each.pull, u, h, first);
    if (!(each.pull.normal_stiffness > 0.0)) continue;
    if (rooms.touching.size() == rooms.touching.capacity()) {
      rooms.left_out = true;
      continue;
    }
    const Vec3 impulse = (each.pull.pull - each.pull.holding_back(u) * h) * h;
    a.push(each.pull.at, impulse);
    b.push(each.on_b, -impulse);
    rooms.touching.push_back(each);
  }
}

void find_ends(std::uint32_t chain, CrossingRooms& rooms) {
  rooms.ends.clear();
  for (std::size_t i = 0; i < rooms.touching.size(); ++i) {
    const ThreadCrossing& each = rooms.touching[i];
    if (each.pair->of_a == chain) rooms.ends.push_back({i, 1.0, each.pull.at});
    if (each.pair->of_b == chain) rooms.ends.push_back({i, -1.0, each.on_b});
  }
}

void clear(CrossingRooms& rooms, const ThreadChain& chain) {
  std::fill_n(rooms.columns.begin(), 3 * chain.node_count(), ThreadChain::Columns::value_type{});
}

// Adds G A^-1 G^T of one chain to the lower triangle of the matrix.
void add_compliance(const ThreadChain& chain, CrossingRooms& rooms) {
  const std::size_t n = 3 * rooms.touching.size();
  std::size_t lowest = chain.node_count();
  for (const CrossingRooms::End& end : rooms.ends) lowest = std::min<std::size_t>(lowest, end.point.segment);
  for (std::size_t e = 0; e < rooms.ends.size(); e += 2) {
    clear(rooms, chain);
    const std::size_t both = std::min<std::size_t>(2, rooms.ends.size() - e);
    std::size_t first = 3 * chain.node_count();
    for (std::size_t p = 0; p < both; ++p) {
      const ThreadPoint& at = rooms.ends[e + p].point;
      first = std::min<std::size_t>(first, 3 * at.segment);
      for (std::size_t k = 0; k < 3; ++k) {
        rooms.columns[3 * at.segment + k][3 * p + k] = 1.0 - at.share;
        rooms.columns[3 * at.segment + 3 + k][3 * p + k] = at.share;
      }
    }
    chain.solve_more(rooms.columns, first, 3 * lowest);
    for (const CrossingRooms::End& end : rooms.ends)
      for (std::size_t p = 0; p < both; ++p) {
        const CrossingRooms::End& source = rooms.ends[e + p];
        if (source.number > end.number) continue;
        for (std::size_t i = 0; i < 3; ++i)
          for (std::size_t k = 0; k < 3; ++k) {
            const std::size_t row = 3 * end.point.segment + i, column = 3 * p + k;
            const double value =
                rooms.columns[row][column] * (1.0 - end.point.share) + rooms.columns[row + 3][column] * end.point.share;
            rooms.matrix[(3 * end.number + i) * n + 3 * source.number + k] += end.sign * source.sign * value;
          }
      }
  }
}

// From compliances to 1 + U^T A^-1 U: each block between the roots of both springs.
void scale(CrossingRooms& rooms, double h) {
  const std::size_t n = 3 * rooms.touching.size();
  for (std::size_t a = 0; a < rooms.touching.size(); ++a)
    for (std::size_t b = 0; b <= a; ++b) {
      double* block = &rooms.matrix[3 * a * n + 3 * b];
      for (std::size_t i = 0; i < 3; ++i) {
        double* row = block + i * n;
        const Vec3 scaled = root(rooms.touching[b].pull, {row[0], row[1], row[2]});
        row[0] = scaled.x, row[1] = scaled.y, row[2] = scaled.z;
      }
      for (std::size_t k = 0; k < 3; ++k) {
        const Vec3 scaled = root(rooms.touching[a].pull, {block[k], block[n + k], block[2 * n + k]}) * (h * h);
        block[k] = scaled.x, block[n + k] = scaled.y, block[2 * n + k] = scaled.z;
      }
    }
  for (std::size_t i = 0; i < n; ++i) rooms.matrix[i * n + i] += 1.0;
}

// Cholesky, of the lower triangle. Its smallest eigenvalue is 1 but for rounding.
bool solve_dense(CrossingRooms& rooms) {
  const std::size_t n = 3 * rooms.touching.size();
  for (std::size_t r = 0; r < n; ++r) {
    double* row = &rooms.matrix[r * n];
    for (std::size_t c = 0; c < r; ++c) {
      const double* above = &rooms.matrix[c * n];
      double value = row[c];
      for (std::size_t k = 0; k < c; ++k) value -= row[k] * above[k];
      row[c] = value / above[c];
    }
    double pivot = row[r];
    for (std::size_t k = 0; k < r; ++k) pivot -= row[k] * row[k];
    if (!(pivot > 0.0)) return false;
    row[r] = std::sqrt(pivot);
    for (std::size_t k = 0; k < r; ++k) rooms.right[r] -= row[k] * rooms.right[k];
    rooms.right[r] /= row[r];
  }
  for (std::size_t r = n; r-- > 0;) {
    for (std::size_t below = r + 1; below < n; ++below)
      rooms.right[r] -= rooms.matrix[below * n + r] * rooms.right[below];
    rooms.right[r] /= rooms.matrix[r * n + r];
  }
  return true;
}

bool add_crossings(std::span<ChainStep> chains, CrossingRooms& rooms, double h) {
  const std::size_t n = 3 * rooms.touching.size();
  std::fill_n(rooms.matrix.begin(), n * n, 0.0);
  for (std::uint32_t c = 0; c < chains.size(); ++c) {
    find_ends(c, rooms);
    add_compliance(*chains[c].chain, rooms);
  }
  scale(rooms, h);
  for (std::size_t i = 0; i < rooms.touching.size(); ++i) {
    const ThreadCrossing& each = rooms.touching[i];
    const Vec3 gap =
        chains[each.pair->of_a].chain->change(each.pull.at) - chains[each.pair->of_b].chain->change(each.on_b);
    const Vec3 scaled = root(each.pull, gap) * h;
    rooms.right[3 * i] = scaled.x, rooms.right[3 * i + 1] = scaled.y, rooms.right[3 * i + 2] = scaled.z;
  }
  if (!solve_dense(rooms)) return false;
  for (std::size_t i = 0; i < rooms.touching.size(); ++i) {
    const double* of = &rooms.right[3 * i];
    rooms.impulses[i] = root(rooms.touching[i].pull, {of[0], of[1], of[2]}) * -h;
  }
  for (std::uint32_t c = 0; c < chains.size(); ++c) {
    find_ends(c, rooms);
    if (rooms.ends.empty()) continue;
    clear(rooms, *chains[c].chain);
    for (const CrossingRooms::End& end : rooms.ends) {
      const Vec3 impulse = rooms.impulses[end.number] * end.sign;
      for (std::size_t node = 0; node < 2; ++node) {
        const Vec3 share = impulse * (node == 0 ? 1.0 - end.point.share : end.point.share);
        const std::size_t row = 3 * (end.point.segment + node);
        rooms.columns[row][0] += share.x, rooms.columns[row + 1][0] += share.y, rooms.columns[row + 2][0] += share.z;
      }
    }
    chains[c].chain->solve_more(rooms.columns, 0, 0);
    chains[c].chain->add_change(rooms.columns);
  }
  return true;
}

bool solve(std::span<ChainStep> chains, std::span<ThreadPair> pairs, CrossingRooms& rooms, double h,
           const Vec3& gravity, bool first) {
  for (ChainStep& each : chains) each.chain->assemble(h, gravity, each.stiffened, each.pulls, first);
  push_all(chains, pairs, rooms, h, first);
  for (ChainStep& each : chains)
    if (!each.chain->solve()) return false;
  return rooms.touching.empty() || add_crossings(chains, rooms, h);
}

// The share of a round's change at which a pair is as near as it may come.
double share_until_near(std::span<ChainStep> chains, const ThreadPair& pair, double h) {
  const ThreadChain &a = *chains[pair.of_a].chain, &b = *chains[pair.of_b].chain;
  const Segment of_a = segment_of(a, pair.a), of_b = segment_of(b, pair.b);
  const Segment way_a{a.change(pair.a) * h, a.change(pair.a + 1) * h},
      way_b{b.change(pair.b) * h, b.change(pair.b + 1) * h};
  double fastest = 0.0;
  for (const Vec3& end_a : {way_a.from, way_a.to})
    for (const Vec3& end_b : {way_b.from, way_b.to}) fastest = std::max(fastest, math::norm(end_a - end_b));
  double distance = math::norm(nearest_shares(of_a, of_b).gap);
  const double kept = kKept * std::min(distance, pair.reach);
  double share = 0.0;
  for (int i = 0; i < kMaxAdvances && distance - kept > kNearKept * kept; ++i) {
    if (distance - kept >= (1.0 - share) * fastest) return 1.0;
    share += (distance - kept) / fastest;
    const Segment then_a{of_a.from + way_a.from * share, of_a.to + way_a.to * share};
    const Segment then_b{of_b.from + way_b.from * share, of_b.to + way_b.to * share};
    distance = math::norm(nearest_shares(then_a, then_b).gap);
  }
  return share;
}

// Moves all by one share of the change, at which none has come too near another.
void move_all(std::span<ChainStep> chains, std::span<ThreadPair> pairs, CrossingRooms& rooms, double h) {
  double share = 1.0, farthest = 0.0;
  for (ChainStep& each : chains) {
    if (std::isfinite(each.slack)) each.chain->keep_within(each.slack, h);
    farthest = std::max(farthest, pairs.empty() ? 0.0 : each.chain->farthest(h));
  }
  if (!pairs.empty()) {
    for (const ThreadPair& pair : pairs) {
      const double nearest = pair.distance - (rooms.moved - pair.moved) - 2.0 * farthest * share;
      if (nearest < kKept * std::min(pair.distance, pair.reach))
        share = std::min(share, share_until_near(chains, pair, h));
    }
    rooms.moved += 2.0 * farthest * share;
  }
  for (ChainStep& each : chains) each.chain->move(h, share);
}

}  // namespace

void CrossingRooms::make_room(std::size_t nodes) {
  constexpr std::size_t kUnknowns = 3 * Thread::kMaxCrossings;
  touching.reserve(Thread::kMaxCrossings);
  ends.reserve(2 * Thread::kMaxCrossings);
  impulses.resize(Thread::kMaxCrossings);
  matrix.resize(kUnknowns * kUnknowns);
  right.resize(kUnknowns);
  if (columns.size() < 3 * nodes) columns.resize(3 * nodes);
}

void step_chains(std::span<ChainStep> chains, std::span<ThreadPair> pairs, CrossingRooms& rooms, double h,
                 const Vec3& gravity) {
  rooms.moved = 0.0;
  rooms.left_out = false;
  for (ThreadPair& pair : pairs) {
    pair.touched = pair.distance < pair.reach;
    pair.moved = 0.0;
  }
  for (ChainStep& each : chains) each.chain->begin();
  move_all(chains, pairs, rooms, h);
  for (int round = 0, solved = 0; round < kMaxRounds && solved < kMaxSolved; ++round) {
    for (ChainStep& each : chains) each.stiffened = 0.0;
    bool done = false, positive = true;
    for (; solved < kMaxSolved && positive && !done; ++solved) {
      positive = solve(chains, pairs, rooms, h, gravity, round == 0);
      done = true;
      for (ChainStep& each : chains) {
        const double needed = positive ? each.chain->too_wild(h) : 0.0;
        if (!(needed > 0.0)) continue;
        done = false;
        each.stiffened = std::max(needed, 4.0 * each.stiffened);
      }
    }
    if (!positive) break;
    double farthest = 0.0;
    for (ChainStep& each : chains) {
      each.chain->follow_tension(h);
      farthest = std::max(farthest, each.chain->farthest(h));
    }
    move_all(chains, pairs, rooms, h);
    const bool touching = !rooms.touching.empty();
    if (farthest < (touching ? kExactTouching : kExact) || (touching && round + 1 == kMaxTouching)) break;
  }
  for (ChainStep& each : chains) each.chain->forget_forces();
}

}  // namespace ambf::physics::detail
