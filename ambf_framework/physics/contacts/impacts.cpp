#include "physics/contacts/impacts.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ambf::physics {
namespace {

constexpr std::size_t kUsualRows = 64;
// A bounce runs to the end of a row of balls and back before it is spread among them: some rounds a pair.
constexpr std::size_t kRoundsAPair = 8;
constexpr std::size_t kMaxVisits = 1'000'000;  // of pairs in a step: some 50 ms
constexpr std::size_t kFewestRounds = 64;
constexpr int kMaxSweeps = 50;        // of one bounce: joints behind a body make it heavier than its row knows
constexpr double kPrecision = 1e-9;   // of the velocities of a bounce
constexpr double kGoodEnough = 1e-3;  // of the velocity that it shall have
// What a point may feel of the joints behind it, in masses of the bodies alone.
constexpr double kHeaviest = 1e4;

double velocity(const BouncingRow& row, ContactSystem& contacts, const BodyDelta* bodies) {
  return row.start_velocity + ContactSystem::velocity(contacts.normals()[static_cast<std::size_t>(row.normal)], bodies);
}

void give(NormalRow& row, double impulse, BodyDelta* bodies) {
  ContactSystem::apply(row, impulse, row.body_a, row.body_b, bodies);
  row.passed += impulse;
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
  if (given_.size() == 1)
    return bounce_at_point(rows_[pair.begin], wanted_[0], kPrecision * fastest, contacts, bodies, follow);
  for (int sweep = 0; sweep < kMaxSweeps; ++sweep) {
    double error = 0.0;
    for (std::size_t i = pair.begin; i < pair.end; ++i) {
      NormalRow& row = contacts.normals()[static_cast<std::size_t>(rows_[i].normal)];
      double& given = given_[i - pair.begin];
      const double missing = wanted_[i - pair.begin] - velocity(rows_[i], contacts, bodies);
      const double before = given;
      given = std::max(0.0, given + missing * row.inverse_diagonal);
      const double change = given - before;
      if (change == 0.0) continue;
      give(row, change, bodies);
      error = std::max(error, std::abs(missing));
    }
    if (error <= kPrecision * fastest) break;
    if (!follow()) return false;
  }
  return true;
}

// One point: the velocity grows with the impulse, but not in proportion, because motors of the joints behind hold it
// until they have no strength left. A secant alone, taken where they hold, asks for a thousand times too much, so it
// stays between what was too little and what was too much.
bool Impacts::bounce_at_point(const BouncingRow& bouncing, double wanted, double precision, ContactSystem& contacts,
                              BodyDelta* bodies, const std::function<bool()>& follow) {
  NormalRow& row = contacts.normals()[static_cast<std::size_t>(bouncing.normal)];
  double given = 0.0, missing = wanted - velocity(bouncing, contacts, bodies);
  const double first = std::max(0.0, missing * row.inverse_diagonal);
  double low = 0.0, high = std::numeric_limits<double>::infinity();
  double next = first;
  for (int sweep = 0; sweep < kMaxSweeps && std::abs(missing) > precision && next != given; ++sweep) {
    const double change = next - given;
    give(row, change, bodies);
    given = next;
    if (!follow()) return false;
    const double left = wanted - velocity(bouncing, contacts, bodies), gained = missing - left;
    const double mass = gained != 0.0 ? change / gained : 0.0;  // kg, as the row feels it, joints included
    missing = left;
    (missing > 0.0 ? low : high) = given;
    next = mass > 0.0 ? given + missing * mass : given + missing * row.inverse_diagonal;
    if (high < std::numeric_limits<double>::infinity()) {
      if (!(next >= low && next <= high)) next = 0.5 * (low + high);
    } else {
      next = std::min(next, kHeaviest * first);
    }
  }
  // Not found, or nothing can move the point: rather too little than too much.
  if (std::abs(missing) <= std::max(precision, kGoodEnough * std::abs(wanted))) return true;
  const double kept = high < std::numeric_limits<double>::infinity() ? low : std::min(given, first);
  if (kept == given) return true;
  give(row, kept - given, bodies);
  return follow();
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
