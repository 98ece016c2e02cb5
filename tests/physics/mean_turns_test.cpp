// The turns of several bodies, found side by side: each as if it were alone, with wide vectors and without.
#include "physics/detail/mean_turns.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace ambf::physics::detail {
namespace {

std::vector<Turn> random_turns(std::size_t count, double fastest) {
  std::mt19937 generator(5);
  std::uniform_real_distribution<double> unit(-1.0, 1.0), inertia(0.3, 2.0);
  std::vector<Turn> turns(count);
  for (Turn& turn : turns) {
    turn.inertia = {inertia(generator), inertia(generator), inertia(generator)};
    turn.omega = btVector3(unit(generator), unit(generator), unit(generator)) * fastest;
    turn.momentum = momentum_before(turn.omega, turn.inertia, 1e-3);
    turn.omega *= 0.9;  // to begin with
  }
  return turns;
}

std::vector<double> numbers(const std::vector<Turn>& turns) {
  std::vector<double> out;
  for (const Turn& turn : turns)
    for (const double each : {turn.omega.x(), turn.omega.y(), turn.omega.z(), turn.found ? 1.0 : 0.0})
      out.push_back(each);
  return out;
}

TEST(MeanTurns, AreTheSameAloneAndBesideOthers) {
  for (const double fastest : {1e-3, 5.0, 300.0, 5000.0}) {  // rad/s: small turns, large ones, what is not found
    const std::vector<Turn> given = random_turns(7, fastest);
    std::vector<Turn> alone = given, pairs = given, wide = given;
    for (Turn& turn : alone) find_mean_velocities({&turn, 1}, 1e-3);
    find_mean_velocities(pairs, 1e-3, false);
    EXPECT_EQ(numbers(pairs), numbers(alone)) << fastest;
    if (!has_wide_vectors()) continue;
    find_mean_velocities(wide, 1e-3, true);
    EXPECT_EQ(numbers(wide), numbers(alone)) << fastest;
  }
}

TEST(MeanTurns, BelongToTheirMomenta) {
  const std::vector<Turn> given = random_turns(7, 100.0);
  std::vector<Turn> found = given;
  find_mean_velocities(found, 1e-3);
  for (std::size_t i = 0; i < found.size(); ++i) {
    EXPECT_TRUE(found[i].found);
    EXPECT_LT((found[i].omega - given[i].omega / 0.9).length(), 1e-11 * found[i].omega.length());
  }
}

}  // namespace
}  // namespace ambf::physics::detail
