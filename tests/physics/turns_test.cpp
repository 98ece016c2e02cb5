// Who looks at its contacts in a step when all together would cost too much: work is bounded, and nobody is forgotten.
#include "physics/meshes/detail/turns.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace ambf::physics::detail {
namespace {

struct Meeting {
  std::uint64_t ticket;
  std::size_t known, cost;  // of the last look, and of the next
  int looks = 0, waits = 0, longest = 0;
};

struct Crowd {
  explicit Crowd(const std::vector<std::size_t>& costs) {
    for (const std::size_t cost : costs) all.push_back({turns.first_ticket(), 0, cost});
  }
  // Returns what the step cost.
  std::size_t step() {
    turns.begin_step();
    std::size_t spent = 0;
    for (Meeting& m : all) {
      if (turns.must_wait(m.ticket, m.known)) {
        m.longest = std::max(m.longest, ++m.waits);
        continue;
      }
      m.waits = 0;
      ++m.looks;
      m.ticket = turns.served(m.cost);
      m.known = m.cost;
      spent += m.cost;
    }
    return spent;
  }
  std::size_t dearest_of(int steps) {
    std::size_t dearest = 0;
    for (int i = 0; i < steps; ++i) dearest = std::max(dearest, step());
    return dearest;
  }
  Turns turns;
  std::vector<Meeting> all;
};

TEST(Turns, NobodyWaitsWhereAllCanBeAfforded) {
  Crowd crowd({1, 150, 5000, 8000});
  crowd.dearest_of(50);
  for (const Meeting& m : crowd.all) EXPECT_EQ(m.looks, 50);
  EXPECT_EQ(crowd.turns.overloads(), 0u);
  EXPECT_FALSE(crowd.turns.take_postponed());
}

TEST(Turns, WorkIsBoundedAndSharedEvenly) {
  for (const std::size_t cost : {std::size_t{150}, std::size_t{1000}, 2 * Turns::kMostWork}) {
    const std::size_t count = 400;
    Crowd crowd(std::vector<std::size_t>(count, cost));
    EXPECT_LE(crowd.dearest_of(400), Turns::kMostNewWork + cost) << cost;  // until all are known
    for (Meeting& m : crowd.all) m.looks = m.longest = m.waits = 0;
    EXPECT_LE(crowd.dearest_of(1500), Turns::kMostWork + cost) << cost;
    const int fair = static_cast<int>(1500 * std::max(Turns::kMostWork, cost) / (count * cost));
    int fewest = 1500, longest = 0;
    for (const Meeting& m : crowd.all) {
      fewest = std::min(fewest, m.looks);
      longest = std::max(longest, m.longest);
    }
    EXPECT_GE(fewest, fair * 7 / 10) << cost;
    EXPECT_LE(longest, 2 * 1500 / fair) << cost;
    EXPECT_TRUE(crowd.turns.take_postponed());
  }
}

TEST(Turns, CheapMeetingsDoNotWaitForDearOnes) {
  std::vector<std::size_t> costs(20, 100);
  costs.insert(costs.end(), 50, 3000);
  Crowd crowd(costs);
  crowd.dearest_of(20);  // until all are known
  for (Meeting& m : crowd.all) m.looks = m.longest = 0;
  EXPECT_LE(crowd.dearest_of(100), Turns::kMostWork + 3000);
  const auto looks = [](const Meeting& a, const Meeting& b) { return a.looks < b.looks; };
  EXPECT_EQ(std::min_element(crowd.all.begin(), crowd.all.begin() + 20, looks)->looks, 100);
  EXPECT_GT(std::min_element(crowd.all.begin() + 20, crowd.all.end(), looks)->looks, 5);
}

TEST(Turns, NewMeetingsComeFirst) {
  Crowd crowd(std::vector<std::size_t>(100, 3000));
  crowd.dearest_of(200);
  crowd.all.insert(crowd.all.begin(), {crowd.turns.first_ticket(), 0, 3000});
  crowd.step();
  EXPECT_EQ(crowd.all.front().looks, 1);
}

// Bodies may be falling, so that much is done at once when a scene comes; but not for ever.
TEST(Turns, ManyNewMeetingsAreLookedAtInFewStepsWhileTheSavingLasts) {
  Crowd crowd(std::vector<std::size_t>(60, 8000));
  crowd.dearest_of(5);
  for (const Meeting& m : crowd.all) ASSERT_GT(m.looks, 0);
  std::size_t sum = 0;
  for (int i = 0; i < 1000; ++i) {
    for (Meeting& m : crowd.all) m.known = 0;  // bodies that come and go
    sum += crowd.step();
  }
  EXPECT_LT(sum, 1000 * (Turns::kMostWork + 8000) + Turns::kSaving + Turns::kMostNewWork);
}

TEST(Turns, DearerThanAnnouncedIsNoticed) {
  Crowd crowd(std::vector<std::size_t>(15, 1000));
  crowd.dearest_of(10);
  for (Meeting& m : crowd.all) m.cost = 10000;
  EXPECT_LE(crowd.dearest_of(100), Turns::kMostWork + 10000);
}

}  // namespace
}  // namespace ambf::physics::detail
