// The queue: everything accepted is delivered once and in each producer's order; full and empty are answers, not waits.
#include "exchange/bounded_queue.h"

#include <gtest/gtest.h>

#include <atomic>
#include <memory>
#include <thread>
#include <vector>

namespace ambf::exchange {
namespace {

TEST(BoundedQueue, IsFirstInFirstOutAndRefusesWhenFull) {
  BoundedQueue<std::unique_ptr<int>> queue(4);
  ASSERT_EQ(queue.capacity(), 4u);
  for (int round = 0; round < 10; ++round) {
    for (int i = 0; i < 4; ++i) EXPECT_TRUE(queue.try_push(std::make_unique<int>(i)));
    auto fifth = std::make_unique<int>(99);
    EXPECT_FALSE(queue.try_push(std::move(fifth)));
    ASSERT_NE(fifth, nullptr) << "what was refused stays with the caller";
    std::unique_ptr<int> value;
    for (int i = 0; i < 4; ++i) {
      ASSERT_TRUE(queue.try_pop(value));
      EXPECT_EQ(*value, i);
    }
    EXPECT_FALSE(queue.try_pop(value));
    EXPECT_EQ(*value, 3) << "untouched";
  }
}

TEST(BoundedQueue, IsReadyExactlyWhenAPopWouldSucceed) {
  BoundedQueue<int> queue(4);
  int value = 0;
  for (int i = 0; i < 10; ++i) {
    EXPECT_FALSE(queue.ready());
    queue.try_push(i);
    queue.try_push(i);
    EXPECT_TRUE(queue.ready());
    queue.try_pop(value);
    EXPECT_TRUE(queue.ready());
    queue.try_pop(value);
  }
  EXPECT_FALSE(queue.ready());
}

// A value whose move into the queue stops half way, as a producer that the scheduler takes off its core.
struct Slow {
  std::atomic<int>* stage = nullptr;
  Slow() = default;
  explicit Slow(std::atomic<int>* s) : stage(s) {}
  Slow(Slow&&) = default;
  Slow& operator=(Slow&& other) noexcept {
    stage = other.stage;
    if (stage != nullptr && *stage == 0) {
      *stage = 1;
      while (*stage == 1) std::this_thread::yield();
    }
    return *this;
  }
};

TEST(BoundedQueueThreads, AStoppedProducerMakesNobodyWaitOrSpin) {
  std::atomic<int> stage{0};
  BoundedQueue<Slow> queue(4);
  std::thread producer([&] { queue.try_push(Slow(&stage)); });
  while (stage != 1) std::this_thread::yield();
  Slow value;
  EXPECT_FALSE(queue.ready());
  EXPECT_FALSE(queue.try_pop(value));
  EXPECT_TRUE(queue.try_push(Slow())) << "others go on";
  EXPECT_FALSE(queue.ready()) << "in order: not before the first";
  stage = 2;
  producer.join();
  EXPECT_TRUE(queue.ready());
  EXPECT_TRUE(queue.try_pop(value));
  EXPECT_EQ(value.stage, &stage);
  EXPECT_TRUE(queue.try_pop(value));
  EXPECT_EQ(value.stage, nullptr);
}

TEST(BoundedQueue, RoundsItsCapacityUp) {
  EXPECT_EQ(BoundedQueue<int>(0).capacity(), 2u);
  EXPECT_EQ(BoundedQueue<int>(5).capacity(), 8u);
}

TEST(BoundedQueue, FreesWhatIsLeftInside) {
  auto shared = std::make_shared<int>(1);
  {
    BoundedQueue<std::shared_ptr<int>> queue(8);
    queue.try_push(shared);
    queue.try_push(shared);
    std::shared_ptr<int> out;
    queue.try_pop(out);
    out.reset();
    EXPECT_EQ(shared.use_count(), 2) << "a popped cell keeps nothing";
  }
  EXPECT_EQ(shared.use_count(), 1);
}

struct Ticket {
  int producer = -1;
  int number = -1;
  std::unique_ptr<int> proof;  // owned: delivered twice or torn would crash or be null
};

void run(int producers, int consumers, int count, std::size_t capacity) {
  BoundedQueue<Ticket> queue(capacity);
  std::atomic<int> taken{0}, disorder{0}, torn{0};
  std::vector<std::atomic<int>> delivered(static_cast<std::size_t>(producers * count));
  std::vector<std::thread> threads;
  for (int p = 0; p < producers; ++p) {
    threads.emplace_back([&, p] {
      for (int i = 0; i < count; ++i) {
        Ticket ticket{p, i, std::make_unique<int>(i)};
        while (!queue.try_push(std::move(ticket))) std::this_thread::yield();
      }
    });
  }
  for (int c = 0; c < consumers; ++c) {
    threads.emplace_back([&] {
      std::vector<int> last(static_cast<std::size_t>(producers), -1);
      Ticket ticket;
      while (taken.load() < producers * count) {
        if (!queue.try_pop(ticket)) {
          std::this_thread::yield();
          continue;
        }
        ++taken;
        if (ticket.proof == nullptr || *ticket.proof != ticket.number) ++torn;
        int& before = last[static_cast<std::size_t>(ticket.producer)];
        if (ticket.number <= before) ++disorder;
        before = ticket.number;
        ++delivered[static_cast<std::size_t>(ticket.producer * count + ticket.number)];
      }
    });
  }
  for (auto& thread : threads) thread.join();
  EXPECT_EQ(torn, 0);
  EXPECT_EQ(disorder, 0);
  for (auto& times : delivered) ASSERT_EQ(times.load(), 1);
}

TEST(BoundedQueueThreads, DeliversEverythingOnceAndInOrderToOneConsumer) { run(3, 1, 20000, 64); }
TEST(BoundedQueueThreads, DeliversEverythingOnceAndInOrderToSeveralConsumers) { run(2, 3, 20000, 2); }

// Nothing but pushes, then nothing but pops, by all at once: as many collisions as can be had.
TEST(BoundedQueueThreads, GivesEachPlaceToOneThreadWhenAllWantItAtOnce) {
  constexpr int kThreads = 4, kEach = 1024, kRounds = 200;
  BoundedQueue<int> queue(kThreads * kEach);
  std::vector<std::atomic<int>> times(kThreads * kEach);
  std::atomic<int> pushing{0}, popping{0}, done{0}, refused{0}, pushed{0};
  const auto wait_for = [](std::atomic<int>& count, int target) {
    while (count.load() < target) std::this_thread::yield();
  };
  std::vector<std::thread> threads;
  for (int t = 0; t < kThreads; ++t) {
    threads.emplace_back([&, t] {
      for (int r = 1; r <= kRounds; ++r) {
        ++pushing;
        wait_for(pushing, r * kThreads);
        for (int i = 0; i < kEach; ++i) refused += !queue.try_push(t * kEach + i);
        ++pushed;
        wait_for(pushed, r * kThreads);
        ++popping;
        wait_for(popping, r * kThreads);
        int value = -1;
        while (queue.try_pop(value)) times[static_cast<std::size_t>(value)].fetch_add(1, std::memory_order_relaxed);
        ++done;
        wait_for(done, r * kThreads);
      }
    });
  }
  for (auto& thread : threads) thread.join();
  EXPECT_EQ(refused, 0);
  for (auto& count : times) ASSERT_EQ(count.load(), kRounds);
}

}  // namespace
}  // namespace ambf::exchange
