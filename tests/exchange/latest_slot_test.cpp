// The command slot: newest wins, nothing torn, and what a watchdog needs to know.
#include "exchange/latest_slot.h"

#include <gtest/gtest.h>

#include <atomic>
#include <thread>
#include <vector>

namespace ambf::exchange {
namespace {

TEST(LatestSlot, IsEmptyAndEndedBeforeTheFirstPost) {
  LatestSlot<int> slot;
  EXPECT_FALSE(slot.refresh());
  EXPECT_EQ(slot.sequence(), 0u);
  EXPECT_TRUE(slot.released());
}

TEST(LatestSlot, KeepsOnlyTheNewest) {
  LatestSlot<int> slot;
  for (int i = 1; i <= 5; ++i) slot.post(i * 10, i);
  ASSERT_TRUE(slot.refresh());
  EXPECT_EQ(slot.value(), 50);
  EXPECT_EQ(slot.sequence(), 5u);
  EXPECT_EQ(slot.time_ns(), 5);
  EXPECT_FALSE(slot.refresh()) << "read already";
  EXPECT_EQ(slot.value(), 50) << "and still there";
}

TEST(LatestSlot, KeepAliveRenewsTheTimeOnly) {
  LatestSlot<int> slot;
  slot.post(1, 100);
  slot.refresh();
  slot.keep_alive(250);
  EXPECT_FALSE(slot.refresh());
  EXPECT_EQ(slot.value(), 1);
  EXPECT_EQ(slot.time_ns(), 250);
  slot.post(2, 300);
  slot.refresh();
  EXPECT_EQ(slot.time_ns(), 300) << "the later of both counts";
}

TEST(LatestSlot, ReleaseEndsWhatWasPostedBeforeButNotWhatComesAfter) {
  LatestSlot<int> slot;
  slot.post(1, 1);
  slot.refresh();
  EXPECT_FALSE(slot.released());
  slot.release();
  EXPECT_TRUE(slot.released());
  slot.keep_alive(5);
  EXPECT_TRUE(slot.released()) << "a sign of life does not revive";
  slot.post(2, 6);
  EXPECT_TRUE(slot.released()) << "still looking at the old one";
  slot.refresh();
  EXPECT_FALSE(slot.released());
  slot.post(3, 7);
  slot.release();
  EXPECT_TRUE(slot.released()) << "the release covers the one not read yet";
  slot.refresh();
  EXPECT_TRUE(slot.released());
}

TEST(LatestSlot, ReusesTheMemoryInsideItsValues) {
  LatestSlot<std::vector<double>> slot;
  const std::vector<double> command(50, 1.0);
  for (int i = 0; i < 6; ++i) {
    slot.post(command, i);
    slot.refresh();
  }
  const double* storage[3];
  for (auto& place : storage) {
    slot.post(command, 9);
    slot.refresh();
    place = slot.value().data();
  }
  for (int i = 0; i < 30; ++i) {
    slot.post(command, 10 + i);
    slot.refresh();
    EXPECT_TRUE(slot.value().data() == storage[0] || slot.value().data() == storage[1] ||
                slot.value().data() == storage[2]);
  }
}

// A writer that changes the length all the time, a reader at full speed.
TEST(LatestSlotThreads, IsNeverTornNeverGoesBackAndEndsWithTheNewest) {
  LatestSlot<std::vector<std::uint64_t>> slot;
  constexpr std::uint64_t kPosts = 100000;
  std::thread writer([&] {
    for (std::uint64_t n = 1; n <= kPosts; ++n) {
      auto& value = slot.begin_write();
      value.assign(1 + n % 40, n);
      slot.commit(static_cast<std::int64_t>(n));
      if (n % 3 == 0) slot.keep_alive(static_cast<std::int64_t>(n));
    }
  });
  int torn = 0, backwards = 0, stamps = 0, fresh_but_same = 0;
  std::uint64_t last = 0;
  while (last < kPosts) {
    const bool fresh = slot.refresh();
    if (slot.sequence() == 0) continue;
    const auto& value = slot.value();
    if (value.size() != 1 + value[0] % 40) ++torn;
    for (std::uint64_t v : value) torn += v != value[0];
    if (slot.sequence() != value[0] || slot.time_ns() < static_cast<std::int64_t>(value[0])) ++stamps;
    if (value[0] < last) ++backwards;
    if (fresh && value[0] == last) ++fresh_but_same;
    last = value[0];
  }
  writer.join();
  EXPECT_EQ(torn, 0);
  EXPECT_EQ(backwards, 0);
  EXPECT_EQ(stamps, 0);
  EXPECT_EQ(fresh_but_same, 0);
}

}  // namespace
}  // namespace ambf::exchange
