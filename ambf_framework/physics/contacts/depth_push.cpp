#include "physics/contacts/depth_push.h"

#include <algorithm>
#include <cmath>

namespace ambf::physics {
namespace {

// Steps go on where the last one ended: where a light link carries a heavy arm, a contact's own mass says little
// about the push that the arm needs, and many steps together find it. What joints do not allow must not grow for
// ever: it is forgotten within 50 pushes.
constexpr double kMemory = 0.98;
constexpr int kSweeps = 2;
constexpr int kMaxRounds = 3;       // in which limits that moves would pass are held
constexpr double kPrecision = 0.2;  // of the fastest push: fewer sweeps will do
// Bounds of the moves, for what joints ask for is exact only for small ones: no joint opens by more than some
// micrometres.
constexpr double kFastestMove = 0.8;  // m/s
constexpr double kFastestTurn = 4.0;  // rad/s
// Where a push is in vain, joints taking back the nanometres it opened them by would press ever more on the contact:
// it loses this share of its impulse. Not where something still approaches: there the contact needs all it has.
constexpr double kForgotten = 0.002;
constexpr double kVain = 0.02;   // of the push
constexpr double kHeld = 0.002;  // of the push: what may still approach

double largest_of(const double* v) { return std::max({std::fabs(v[0]), std::fabs(v[1]), std::fabs(v[2])}); }

}  // namespace

bool DepthPush::solve(ContactSystem& contacts, const std::vector<BodyDelta>& bodies, JointSystem& joints,
                      const std::vector<std::uint8_t>& touched, double slowest, JointSolveCounts& counts) {
  double fastest = 0.0;
  for (const NormalRow& row : contacts.normals()) {
    if (row.inverse_diagonal > 0.0) fastest = std::max(fastest, row.push / row.inverse_diagonal);
  }
  if (!(fastest > slowest)) {
    for (NormalRow& row : contacts.normals()) row.push_impulse = 0.0;
    return false;
  }
  for (NormalRow& row : contacts.normals()) row.push_impulse = row.push > 0.0 ? kMemory * row.push_impulse : 0.0;
  const double enough = kPrecision * kPrecision * fastest * fastest;
  find_moves(contacts, bodies, joints, touched, enough, counts);
  // Limits that are not touched do not show in velocities, and moves might pass them: again, with these held.
  const auto passes_limits = [&] {
    bool any = false;
    for (std::size_t c = 0; c < touched.size(); ++c)
      any |= touched[c] && joints.hold_passed(static_cast<int>(c), bodies.data(), moves_.data());
    return any;
  };
  for (int round = 0; round < kMaxRounds && passes_limits(); ++round)
    find_moves(contacts, bodies, joints, touched, enough, counts);
  for (NormalRow& row : contacts.normals()) {
    if (row.push <= 0.0) continue;
    const bool in_vain = ContactSystem::pushed(row, moves_.data()) < kVain * row.push;
    const bool holds = ContactSystem::shortfall(row, bodies.data()) < kHeld * row.push;
    if (in_vain && holds) row.impulse *= 1.0 - kForgotten;
  }
  return true;
}

void DepthPush::find_moves(ContactSystem& contacts, const std::vector<BodyDelta>& bodies, JointSystem& joints,
                           const std::vector<std::uint8_t>& touched, double enough, JointSolveCounts& counts) {
  moves_ = bodies;
  for (BodyDelta& move : moves_) {
    std::fill_n(move.linear, 3, 0.0);
    std::fill_n(move.angular, 3, 0.0);
  }
  for (const NormalRow& row : contacts.normals())
    ContactSystem::apply(row, row.push_impulse, row.body_a, row.body_b, moves_.data());
  joints.begin_follow();
  const auto follow = [&] {
    for (std::size_t c = 0; c < touched.size(); ++c) {
      if (touched[c]) joints.follow(static_cast<int>(c), moves_.data(), counts);
    }
  };
  follow();
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    const double error = contacts.sweep_pushes(moves_.data(), sweep % 2 == 1);
    follow();
    if (error <= enough) break;
  }
  bound(contacts);
}

void DepthPush::bound(ContactSystem& contacts) {
  double linear = 0.0;
  double angular = 0.0;
  for (const BodyDelta& move : moves_) {
    linear = std::max(linear, largest_of(move.linear));
    angular = std::max(angular, largest_of(move.angular));
  }
  const double share =
      std::min(kFastestMove / std::max(linear, kFastestMove), kFastestTurn / std::max(angular, kFastestTurn));
  if (share >= 1.0) return;
  for (BodyDelta& move : moves_) {
    for (int i = 0; i < 3; ++i) {
      move.linear[i] *= share;
      move.angular[i] *= share;
    }
  }
  for (NormalRow& row : contacts.normals()) row.push_impulse *= share;
}

}  // namespace ambf::physics
