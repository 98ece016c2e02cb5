// Which pairs are updated in a step when all together would cost too much: work is bounded, and each pair gets its
// share.
#include "physics/meshes/detail/contact_budget.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace ambf::physics::detail {
namespace {

struct Pair {
  std::uint64_t ticket;
  std::size_t known, cost;  // of the last update, and of the next
  int updates = 0, waits = 0, longest = 0;
};

struct Crowd {
  explicit Crowd(const std::vector<std::size_t>& costs) {
    for (const std::size_t cost : costs) all.push_back({budget.first_ticket(), 0, cost});
  }
  // Returns what the step cost.
  std::size_t step() {
    budget.begin_step();
    std::size_t spent = 0;
    for (Pair& m : all) {
      if (budget.must_wait(m.ticket, m.known)) {
        m.longest = std::max(m.longest, ++m.waits);
        continue;
      }
      m.waits = 0;
      ++m.updates;
      m.ticket = budget.charge(m.cost);
      m.known = m.cost;
      spent += m.cost;
    }
    return spent;
  }
  std::size_t max_cost_of(int steps) {
    std::size_t max_cost = 0;
    for (int i = 0; i < steps; ++i) max_cost = std::max(max_cost, step());
    return max_cost;
  }
  ContactBudget budget;
  std::vector<Pair> all;
};

TEST(ContactBudget, NoPairWaitsWhereAllCanBeAfforded) {
  Crowd crowd({1, 150, 5000, 8000});
  crowd.max_cost_of(50);
  for (const Pair& m : crowd.all) EXPECT_EQ(m.updates, 50);
  EXPECT_EQ(crowd.budget.overloaded_steps(), 0u);
  EXPECT_FALSE(crowd.budget.take_postponed());
}

TEST(ContactBudget, WorkIsBoundedAndSharedEvenly) {
  for (const std::size_t cost : {std::size_t{150}, std::size_t{1000}, 2 * kStepBudget}) {
    const std::size_t count = 400;
    Crowd crowd(std::vector<std::size_t>(count, cost));
    EXPECT_LE(crowd.max_cost_of(400), kNewPairBudget + cost) << cost;  // until all are known
    for (Pair& m : crowd.all) m.updates = m.longest = m.waits = 0;
    EXPECT_LE(crowd.max_cost_of(1500), kStepBudget + cost) << cost;
    const int fair = static_cast<int>(1500 * std::max(kStepBudget, cost) / (count * cost));
    int fewest = 1500, longest = 0;
    for (const Pair& m : crowd.all) {
      fewest = std::min(fewest, m.updates);
      longest = std::max(longest, m.longest);
    }
    EXPECT_GE(fewest, fair * 7 / 10) << cost;
    EXPECT_LE(longest, 2 * 1500 / fair) << cost;
    EXPECT_TRUE(crowd.budget.take_postponed());
  }
}

TEST(ContactBudget, CheapPairsDoNotWaitForExpensiveOnes) {
  std::vector<std::size_t> costs(20, 100);
  costs.insert(costs.end(), 50, 3000);
  Crowd crowd(costs);
  crowd.max_cost_of(20);  // until all are known
  for (Pair& m : crowd.all) m.updates = m.longest = 0;
  EXPECT_LE(crowd.max_cost_of(100), kStepBudget + 3000);
  const auto updates = [](const Pair& a, const Pair& b) { return a.updates < b.updates; };
  EXPECT_EQ(std::min_element(crowd.all.begin(), crowd.all.begin() + 20, updates)->updates, 100);
  EXPECT_GT(std::min_element(crowd.all.begin() + 20, crowd.all.end(), updates)->updates, 5);
}

TEST(ContactBudget, NewPairsComeFirst) {
  Crowd crowd(std::vector<std::size_t>(100, 3000));
  crowd.max_cost_of(200);
  crowd.all.insert(crowd.all.begin(), {crowd.budget.first_ticket(), 0, 3000});
  crowd.step();
  EXPECT_EQ(crowd.all.front().updates, 1);
}

// Bodies may be falling, so that much is done at once when a scene comes; but not for ever.
TEST(ContactBudget, ManyNewPairsAreUpdatedInFewStepsWhileTheReserveLasts) {
  Crowd crowd(std::vector<std::size_t>(60, 8000));
  crowd.max_cost_of(5);
  for (const Pair& m : crowd.all) ASSERT_GT(m.updates, 0);
  std::size_t sum = 0;
  for (int i = 0; i < 1000; ++i) {
    for (Pair& m : crowd.all) m.known = 0;  // bodies that come and go
    sum += crowd.step();
  }
  EXPECT_LT(sum, 1000 * (kStepBudget + 8000) + kBudgetReserve + kNewPairBudget);
}

TEST(ContactBudget, CostsAboveThoseOfTheLastUpdateAreNoticed) {
  Crowd crowd(std::vector<std::size_t>(15, 1000));
  crowd.max_cost_of(10);
  for (Pair& m : crowd.all) m.cost = 10000;
  EXPECT_LE(crowd.max_cost_of(100), kStepBudget + 10000);
}

}  // namespace
}  // namespace ambf::physics::detail
