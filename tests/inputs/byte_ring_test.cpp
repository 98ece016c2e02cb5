// The ring between a real-time thread and the recorder.
#include "inputs/byte_ring.h"

#include <gtest/gtest.h>

#include <thread>

namespace ambf::inputs {
namespace {

using Message = std::vector<std::uint8_t>;

TEST(ByteRing, RefusesWhatDoesNotFitAsAWhole) {
  ByteRing ring(10);
  const Message seven(7, 1);
  EXPECT_TRUE(ring.try_push(seven.data(), 7));
  EXPECT_FALSE(ring.try_push(seven.data(), 4));
  Message got;
  ring.pop_all(got);
  EXPECT_EQ(got, seven);
  EXPECT_TRUE(ring.try_push(seven.data(), 7)) << "it goes on where it had stopped, around the end";
  got.clear();
  ring.pop_all(got);
  EXPECT_EQ(got, seven);
}

TEST(ByteRing, KeepsTheOrderBetweenTwoThreads) {
  constexpr std::uint32_t kCount = 20'000;
  ByteRing ring(1000);
  std::thread producer([&] {
    for (std::uint32_t i = 0; i < kCount;) {
      Message message(4 + i % 13);
      std::memcpy(message.data(), &i, 4);
      if (ring.try_push(message.data(), message.size())) {
        ++i;
      } else {
        std::this_thread::yield();
      }
    }
  });
  Message got;
  std::size_t at = 0;
  for (std::uint32_t expected = 0; expected < kCount;) {
    std::this_thread::yield();
    ring.pop_all(got);
    for (; at < got.size(); ++expected) {
      std::uint32_t number = 0;
      std::memcpy(&number, got.data() + at, 4);
      ASSERT_EQ(number, expected);
      at += 4 + expected % 13;
    }
  }
  producer.join();
}

}  // namespace
}  // namespace ambf::inputs
