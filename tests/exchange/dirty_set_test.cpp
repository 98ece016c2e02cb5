// The dirty set: no mark is lost, the order is that of the numbers, and a mark carries the data posted before it.
#include "exchange/dirty_set.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <memory>
#include <random>
#include <set>
#include <thread>
#include <vector>

namespace ambf::exchange {
namespace {

std::vector<std::size_t> drain(DirtySet& set) {
  std::vector<std::size_t> seen;
  set.drain([&](std::size_t i) { seen.push_back(i); });
  return seen;
}

TEST(DirtySet, DrainsEachMarkOnceInIncreasingOrder) {
  std::mt19937 rng(7);
  for (std::size_t capacity : {1u, 64u, 65u, 4096u, 4097u, 20000u}) {
    DirtySet set(capacity);
    std::set<std::size_t> expected{0, capacity - 1};
    for (int i = 0; i < 300; ++i) expected.insert(rng() % capacity);
    std::vector<std::size_t> shuffled(expected.begin(), expected.end());
    std::shuffle(shuffled.begin(), shuffled.end(), rng);
    for (std::size_t i : shuffled) {
      EXPECT_TRUE(set.mark(i));
      EXPECT_TRUE(set.mark(i));
    }
    EXPECT_EQ(drain(set), std::vector<std::size_t>(expected.begin(), expected.end()));
    EXPECT_TRUE(drain(set).empty());
  }
}

TEST(DirtySet, RefusesWhatIsBeyondItsCapacity) {
  DirtySet set(100);
  EXPECT_FALSE(set.mark(100));
  EXPECT_FALSE(set.mark(127));
  EXPECT_FALSE(set.mark(std::size_t(-1)));
  EXPECT_TRUE(drain(set).empty());
}

// Producers raise a counter and mark it; a drained mark must show at least the counts posted before it, and at
// the end all of them.
TEST(DirtySetThreads, LosesNoMarkAndShowsTheDataBehindIt) {
  constexpr std::size_t kSlots = 5000;
  constexpr int kPosts = 40000;
  DirtySet set(kSlots);
  std::vector<std::atomic<std::uint32_t>> posted(kSlots);
  std::vector<std::uint32_t> seen(kSlots, 0);
  std::atomic<int> running{3};
  std::vector<std::thread> producers;
  for (unsigned p = 0; p < 3; ++p) {
    producers.emplace_back([&, p] {
      std::mt19937 rng(p);
      for (int i = 0; i < kPosts; ++i) {
        const std::size_t slot = rng() % kSlots;
        posted[slot].fetch_add(1, std::memory_order_relaxed);  // ordered by the mark alone
        set.mark(slot);
      }
      --running;
    });
  }
  auto look = [&](std::size_t i) { seen[i] = posted[i].load(std::memory_order_relaxed); };
  while (running > 0) set.drain(look);
  for (auto& thread : producers) thread.join();
  set.drain(look);
  std::uint64_t sum = 0;
  for (std::size_t i = 0; i < kSlots; ++i) {
    EXPECT_EQ(seen[i], posted[i].load()) << i;
    sum += seen[i];
  }
  EXPECT_EQ(sum, std::uint64_t{3} * kPosts);
}

// Many short races: in each round every number is marked once, so that a mark that is lost stays lost.
void race(std::size_t stride) {
  constexpr int kRounds = 1500, kMarkers = 2;
  constexpr std::size_t kNumbers = 64;
  DirtySet set(kNumbers * stride);
  std::atomic<int> round{0}, finished{0};
  std::vector<std::thread> markers;
  for (int m = 0; m < kMarkers; ++m) {
    markers.emplace_back([&, m] {
      for (int r = 1; r <= kRounds; ++r) {
        while (round.load() < r) std::this_thread::yield();
        for (std::size_t i = static_cast<std::size_t>(m); i < kNumbers; i += kMarkers) set.mark(i * stride);
        ++finished;
      }
    });
  }
  int incomplete = 0;
  for (int r = 1; r <= kRounds; ++r) {
    std::uint64_t seen = 0;
    const auto look = [&](std::size_t i) { seen |= std::uint64_t{1} << (i / stride); };
    round = r;
    while (finished.load() < r * kMarkers) {
      for (int i = 0; i < 100; ++i) set.drain(look);
      std::this_thread::yield();
    }
    set.drain(look);
    incomplete += seen != ~std::uint64_t{0};
  }
  for (auto& thread : markers) thread.join();
  EXPECT_EQ(incomplete, 0);
}

TEST(DirtySetThreads, LosesNoMarkOfAWordThatIsBeingDrained) { race(1); }
TEST(DirtySetThreads, LosesNoWordOfASummaryThatIsBeingDrained) { race(64); }

}  // namespace
}  // namespace ambf::exchange
