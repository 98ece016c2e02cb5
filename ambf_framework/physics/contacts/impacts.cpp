#include "physics/contacts/impacts.h"

#include <algorithm>
#include <cmath>

namespace ambf::physics {
namespace {

constexpr std::size_t kUsualRows = 64;
// A bounce runs to the end of a row of balls and back before it is spread among them: some rounds a pair.
constexpr std::size_t kRoundsAPair = 8;
constexpr std::size_t kMaxVisits = 1'000'000;  // of pairs in a step: some 50 ms
constexpr std::size_t kFewestRounds = 64;
constexpr int kMaxSweeps = 50;       // of one bounce: joints behind a body make it heavier than its row knows
constexpr double kPrecision = 1e-9;  // of the velocities of a bounce

double velocity(const BouncingRow& row, ContactSystem& contacts, const BodyDelta* bodies) {
  return row.start_velocity + ContactSystem::velocity(contacts.normals()[static_cast<std::size_t>(row.normal)], bodies);
}

}  // namespace

Impacts::Impacts() {
  pairs_.reserve(kUsualRows);
  wanted_.reserve(kUsualRows);
  given_.reserve(kUsualRows);
}

void Impacts::find_pairs() {
  pairs_.clear();
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    if (i == 0 || rows_[i].pair != rows_[i - 1].pair) pairs_.push_back({i, i});
    pairs_.back().end = i + 1;
  }
}

double Impacts::closing(const Pair& pair, ContactSystem& contacts, const BodyDelta* bodies, double h) const {
  double fastest = 0.0;
  for (std::size_t i = pair.begin; i < pair.end; ++i) {
    const double apart = velocity(rows_[i], contacts, bodies);
    if (rows_[i].gap + apart * h < 0.0) fastest = std::max(fastest, -apart);
  }
  return fastest;
}

// All points of the pair at once: those that close leave as their restitution has it, no point closes afterwards.
bool Impacts::bounce(const Pair& pair, ContactSystem& contacts, BodyDelta* bodies,
                     const std::function<bool()>& follow) {
  double fastest = 0.0;
  wanted_.clear();
  given_.assign(pair.end - pair.begin, 0.0);
  for (std::size_t i = pair.begin; i < pair.end; ++i) {
    const double apart = velocity(rows_[i], contacts, bodies);
    wanted_.push_back(apart < 0.0 ? -rows_[i].restitution * apart : 0.0);
    fastest = std::max(fastest, std::abs(apart));
  }
  const bool single = given_.size() == 1;
  double mass = 0.0;  // kg, as a single row feels it, joints included
  for (int sweep = 0; sweep < kMaxSweeps; ++sweep) {
    double error = 0.0;
    for (std::size_t i = pair.begin; i < pair.end; ++i) {
      NormalRow& row = contacts.normals()[static_cast<std::size_t>(rows_[i].normal)];
      double& given = given_[i - pair.begin];
      const double missing = wanted_[i - pair.begin] - velocity(rows_[i], contacts, bodies);
      const double before = given;
      given = std::max(0.0, given + missing * (mass > 0.0 ? mass : row.inverse_diagonal));
      const double change = given - before;
      if (change == 0.0) continue;
      ContactSystem::apply(row, change, row.body_a, row.body_b, bodies);
      row.passed += change;
      error = std::max(error, std::abs(missing));
    }
    if (error <= kPrecision * fastest) break;
    if (!follow()) return false;
    if (!single) continue;
    const BouncingRow& row = rows_[pair.begin];
    const double left = wanted_[0] - velocity(row, contacts, bodies), gained = error - left;
    if (sweep == 0 && gained > 0.0) mass = given_[0] / gained;
  }
  return true;
}

void Impacts::pass_on(ContactSystem& contacts, BodyDelta* bodies, double h, double slowest,
                      const std::function<bool()>& follow) {
  if (rows_.empty() || rows_.front().pair == rows_.back().pair) return;
  if (std::none_of(rows_.begin(), rows_.end(), [](const BouncingRow& row) { return row.bounce > 0.0; })) return;
  find_pairs();
  for (const BouncingRow& bouncing : rows_) {
    NormalRow& row = contacts.normals()[static_cast<std::size_t>(bouncing.normal)];
    row.target -= bouncing.bounce * row.inverse_diagonal;
    ContactSystem::apply(row, -row.impulse, row.body_a, row.body_b, bodies);
    row.impulse = 0.0;
  }
  if (!follow()) return;
  const std::size_t affordable = std::max(kFewestRounds, kMaxVisits / pairs_.size());
  for (std::size_t rounds = std::min(kRoundsAPair * pairs_.size(), affordable); rounds > 0; --rounds) {
    const Pair* next = nullptr;
    double fastest = slowest;
    for (const Pair& pair : pairs_) {
      const double speed = closing(pair, contacts, bodies, h);
      if (speed <= fastest) continue;
      fastest = speed;
      next = &pair;
    }
    if (next == nullptr) return;
    if (!bounce(*next, contacts, bodies, follow)) return;
  }
}

}  // namespace ambf::physics
