// Several readers of one writer's newest value: each copy is whole, and none is older than one read before.
#include "exchange/broadcast.h"

#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <cstdint>
#include <thread>
#include <vector>

namespace {

// All words carry the same number; its size is no multiple of eight bytes.
struct Value {
  std::array<std::uint32_t, 101> words{};
};

Value value_of(std::uint32_t number) {
  Value value;
  value.words.fill(number);
  return value;
}

TEST(Broadcast, HasNothingBeforeTheFirstPublication) {
  ambf::exchange::Broadcast<Value> broadcast;
  Value value = value_of(7);
  EXPECT_FALSE(broadcast.read(value));
  EXPECT_EQ(value.words.front(), 7u);
  EXPECT_EQ(broadcast.number(), 0u);
}

TEST(Broadcast, EveryReaderGetsTheNewestValueAgainAndAgain) {
  ambf::exchange::Broadcast<Value> broadcast;
  for (std::uint32_t number = 1; number <= 9; ++number) {
    broadcast.publish(value_of(number));
    for (int reader = 0; reader < 2; ++reader) {
      Value value;
      ASSERT_TRUE(broadcast.read(value));
      EXPECT_EQ(value.words.front(), number);
      EXPECT_EQ(value.words.back(), number);
    }
  }
  EXPECT_EQ(broadcast.number(), 9u);
}

TEST(Broadcast, ConcurrentReadersSeeWholeValuesThatNeverGoBack) {
  ambf::exchange::Broadcast<Value> broadcast;
  std::atomic<bool> done{false};
  std::atomic<int> torn{0}, backward{0};
  std::vector<std::thread> readers;
  for (int i = 0; i < 3; ++i) {
    readers.emplace_back([&] {
      std::uint32_t last = 0;
      while (!done.load()) {
        Value value;
        if (!broadcast.read(value)) continue;
        for (const std::uint32_t word : value.words) torn += word != value.words.front() ? 1 : 0;
        backward += value.words.front() < last ? 1 : 0;
        last = value.words.front();
      }
    });
  }
  for (std::uint32_t number = 1; number <= 20000; ++number) broadcast.publish(value_of(number));
  done = true;
  for (std::thread& reader : readers) reader.join();
  EXPECT_EQ(torn.load(), 0);
  EXPECT_EQ(backward.load(), 0);
}

}  // namespace
