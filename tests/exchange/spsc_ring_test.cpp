// The every-frame ring: all values in order, in place, and what does not fit is counted.
#include "exchange/spsc_ring.h"

#include <gtest/gtest.h>

#include <thread>
#include <vector>

namespace ambf::exchange {
namespace {

TEST(SpscRing, CountsWhatDoesNotFit) {
  SpscRing<int> ring(3);
  EXPECT_EQ(ring.front(), nullptr);
  for (int i = 0; i < 3; ++i) {
    *ring.begin_push() = i;
    ring.push();
  }
  EXPECT_EQ(ring.begin_push(), nullptr);
  EXPECT_EQ(ring.begin_push(), nullptr);
  EXPECT_EQ(ring.lost(), 2u);
  for (int i = 0; i < 3; ++i) {
    ASSERT_NE(ring.front(), nullptr);
    EXPECT_EQ(*ring.front(), i);
    ring.pop();
  }
  EXPECT_EQ(ring.front(), nullptr);
}

TEST(SpscRing, HidesAPlaceUntilItIsPushed) {
  SpscRing<int> ring(2);
  *ring.begin_push() = 5;
  EXPECT_EQ(ring.front(), nullptr);
  EXPECT_EQ(ring.lost(), 0u);
}

TEST(SpscRingThreads, DeliversEveryValueInOrderWithoutReallocating) {
  SpscRing<std::vector<int>> ring(5, std::vector<int>(16));
  constexpr int kCount = 50000;
  std::thread producer([&] {
    for (int i = 0; i < kCount;) {
      if (std::vector<int>* place = ring.begin_push()) {
        place->assign(16, i++);
        ring.push();
      } else {
        std::this_thread::yield();
      }
    }
  });
  int wrong = 0;
  for (int i = 0; i < kCount;) {
    const std::vector<int>* value = ring.front();
    if (value == nullptr) {
      std::this_thread::yield();
      continue;
    }
    for (int v : *value) wrong += v != i;
    wrong += value->capacity() != 16;
    ring.pop();
    ++i;
  }
  producer.join();
  EXPECT_EQ(wrong, 0);
}

}  // namespace
}  // namespace ambf::exchange
