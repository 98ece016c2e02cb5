// The frame pool's promises, single-threaded first, then with real readers.
#include "exchange/frame_pool.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <memory>
#include <set>
#include <thread>
#include <vector>

namespace ambf::exchange {
namespace {

// All words of a whole value say the same number.
struct Payload {
  std::array<std::uint64_t, 64> words{};
  void fill(std::uint64_t n) { words.fill(n); }
  bool whole() const {
    for (std::uint64_t w : words) {
      if (w != words[0]) return false;
    }
    return true;
  }
};
using Pool = FramePool<Payload>;

std::unique_ptr<Payload> make_payload() { return std::make_unique<Payload>(); }

void publish(Pool& pool, std::uint64_t n) {
  pool.begin_write().fill(n);
  pool.publish();
}

TEST(FramePool, HasNothingToReadBeforeTheFirstPublish) {
  Pool pool(make_payload);
  auto reader = pool.make_reader();
  ASSERT_TRUE(reader);
  EXPECT_EQ(reader->latest(), nullptr);
  EXPECT_EQ(reader->previous(), nullptr);
  EXPECT_EQ(pool.newest(), nullptr);
  pool.begin_write().fill(1);
  EXPECT_EQ(reader->latest(), nullptr) << "what is being written is not published";
}

TEST(FramePool, GivesTheNewestAndTheOneSeenBefore) {
  Pool pool(make_payload);
  auto reader = pool.make_reader();
  publish(pool, 1);
  EXPECT_EQ(reader->latest()->words[0], 1u);
  EXPECT_EQ(reader->previous(), nullptr);
  publish(pool, 2);
  publish(pool, 3);
  EXPECT_EQ(reader->latest()->words[0], 3u);
  EXPECT_EQ(reader->previous()->words[0], 1u);
  EXPECT_EQ(reader->latest()->words[0], 3u) << "nothing newer";
  EXPECT_EQ(reader->previous()->words[0], 1u) << "and the one before is kept";
  EXPECT_EQ(pool.newest()->words[0], 3u);
}

TEST(FramePool, NeverWritesIntoWhatAllReadersPin) {
  Pool pool(make_payload);
  std::vector<Pool::Reader> readers;
  std::vector<const Payload*> pinned;
  std::uint64_t n = 0;
  for (int i = 0; i < base::kMaxReaders; ++i) readers.push_back(*pool.make_reader());
  for (auto& reader : readers) {  // all pins on different slots
    publish(pool, ++n);
    pinned.push_back(reader.latest());
    publish(pool, ++n);
    pinned.push_back(reader.latest());
  }
  ASSERT_EQ(std::set<const Payload*>(pinned.begin(), pinned.end()).size(), std::size_t{2 * base::kMaxReaders});
  for (int i = 0; i < 1000; ++i) publish(pool, 1000 + static_cast<std::uint64_t>(i));
  for (std::size_t i = 0; i < pinned.size(); ++i) EXPECT_EQ(pinned[i]->words[0], i + 1);
}

TEST(FramePool, RefusesOneReaderTooManyUntilOneLeaves) {
  Pool pool(make_payload);
  std::vector<std::unique_ptr<Pool::Reader>> readers;
  for (int i = 0; i < base::kMaxReaders; ++i) readers.push_back(std::make_unique<Pool::Reader>(*pool.make_reader()));
  EXPECT_FALSE(pool.make_reader());
  readers.pop_back();
  auto again = pool.make_reader();
  ASSERT_TRUE(again);
  publish(pool, 7);
  EXPECT_EQ(again->latest()->words[0], 7u);
  EXPECT_EQ(again->previous(), nullptr) << "nothing is left of the reader before";
}

TEST(FramePool, IsAsLargeAsItsReadersNeed) {
  int made = 0;
  Pool pool(
      [&made] {
        ++made;
        return make_payload();
      },
      1);
  EXPECT_EQ(made, 4);
  EXPECT_EQ(pool.slots(), 4);
  auto reader = pool.make_reader();
  ASSERT_TRUE(reader);
  EXPECT_FALSE(pool.make_reader());
  publish(pool, 1);
  const Payload* first = reader->latest();
  publish(pool, 2);
  reader->latest();
  for (std::uint64_t n = 3; n < 100; ++n) publish(pool, n);
  EXPECT_EQ(first->words[0], 1u) << "both pins hold";
  EXPECT_EQ(reader->latest()->words[0], 99u);

  Pool of_none(make_payload, 0);
  EXPECT_FALSE(of_none.make_reader());
  publish(of_none, 1);
  publish(of_none, 2);
  EXPECT_EQ(of_none.newest()->words[0], 2u);
}

TEST(FramePool, KeepsNothingPinnedForAReaderThatLeft) {
  Pool pool(make_payload);
  for (int i = 0; i < 5; ++i) {
    auto reader = pool.make_reader();
    publish(pool, 1);
    reader->latest();
    publish(pool, 2);
    reader->latest();
  }
  int free_slots = 0;
  for (int slot = 0; slot < pool.slots(); ++slot) {
    auto payload = make_payload();
    free_slots += pool.try_exchange_slot(slot, payload);
  }
  EXPECT_EQ(free_slots, pool.slots() - 1) << "all but the newest";
}

TEST(FramePool, ReplacesThePayloadOfTheSlotThatIsWrittenNextOnly) {
  Pool pool(make_payload);
  auto reader = pool.make_reader();
  publish(pool, 1);
  const Payload* pinned = reader->latest();
  auto fresh = make_payload();
  Payload* expected = fresh.get();
  const std::unique_ptr<Payload> old = pool.exchange_write_slot(std::move(fresh));
  EXPECT_NE(old.get(), nullptr);
  EXPECT_NE(old.get(), pinned);
  EXPECT_EQ(&pool.begin_write(), expected);
  publish(pool, 2);
  EXPECT_EQ(reader->latest(), expected);
  EXPECT_EQ(reader->previous(), pinned);
}

TEST(FramePool, LetsTheWriterReplaceEverySlotOnceReadersHaveMovedOn) {
  Pool pool(make_payload);
  auto reader = pool.make_reader();
  publish(pool, 1);
  const Payload* first = reader->latest();
  publish(pool, 2);
  const Payload* second = reader->latest();
  std::set<const Payload*> old;
  std::vector<int> left;
  std::vector<std::unique_ptr<Payload>> garbage;  // kept, so that no address is given out twice
  auto replace = [&](int slot) {
    auto payload = make_payload();
    if (!pool.try_exchange_slot(slot, payload)) return false;
    old.insert(payload.get());
    garbage.push_back(std::move(payload));
    return true;
  };
  for (int slot = 0; slot < pool.slots(); ++slot) {
    if (!replace(slot)) left.push_back(slot);
  }
  EXPECT_EQ(left.size(), 2u) << "pinned by the reader, one of them the newest";
  EXPECT_EQ(old.count(first) + old.count(second), 0u);
  EXPECT_EQ(first->words[0], 1u);
  EXPECT_EQ(second->words[0], 2u);
  for (std::uint64_t n = 3; n < 5; ++n) {  // each newer value frees one of them
    publish(pool, n);
    reader->latest();
    const auto gone = std::find_if(left.begin(), left.end(), replace);
    ASSERT_NE(gone, left.end());
    left.erase(gone);
  }
  EXPECT_EQ(old.size(), base::kFramesPerPool);
  EXPECT_EQ(old.count(first) + old.count(second), 2u);
}

// One writer at full speed, readers that look hard: no value is torn, none goes back, pinned ones stay, the last one
// arrives.
TEST(FramePoolThreads, ReadersSeeWholeValuesInOrderAndPinsHold) {
  constexpr std::uint64_t kPublished = 60000;
  Pool pool(make_payload);
  std::atomic<int> torn{0}, backwards{0}, changed{0}, missed_last{0};
  std::atomic<bool> done{false};
  auto read = [&] {
    auto reader = pool.make_reader();
    std::uint64_t last = 0;
    for (;;) {
      const bool finished = done.load();  // read before latest(): then latest() must give the last value
      const Payload* before = reader->previous();
      const std::uint64_t kept = last;
      const Payload* now = reader->latest();
      if (now == nullptr) continue;
      if (!now->whole()) ++torn;
      if (now->words[0] < last) ++backwards;
      last = now->words[0];
      before = reader->previous();
      if (before != nullptr && (!before->whole() || before->words[0] > last)) ++torn;
      if (before != nullptr && last != kept && before->words[0] != kept) ++changed;
      std::this_thread::yield();
      if (now->words[0] != last || !now->whole()) ++changed;
      if (finished) {
        if (last != kPublished) ++missed_last;
        return;
      }
    }
  };
  std::vector<std::thread> readers;
  for (int i = 0; i < 4; ++i) readers.emplace_back(read);
  for (std::uint64_t n = 1; n <= kPublished; ++n) {
    if (n % 7 == 0) pool.exchange_write_slot(make_payload());  // the old one is freed here: nobody may be reading it
    if (n % 5 == 0) {
      auto payload = make_payload();
      pool.try_exchange_slot(static_cast<int>(n % base::kFramesPerPool), payload);
    }
    publish(pool, n);
  }
  done = true;
  for (auto& thread : readers) thread.join();
  EXPECT_EQ(torn, 0);
  EXPECT_EQ(backwards, 0);
  EXPECT_EQ(changed, 0);
  EXPECT_EQ(missed_last, 0);
}

TEST(FramePoolThreads, ReadersMayComeAndGoWhileTheWriterRuns) {
  Pool pool(make_payload);
  publish(pool, 1);
  std::atomic<bool> done{false};
  std::atomic<int> bad{0};
  std::vector<std::thread> threads;
  for (int i = 0; i < 3; ++i) {
    threads.emplace_back([&] {
      for (int k = 0; k < 3000; ++k) {
        auto reader = pool.make_reader();
        if (!reader) {
          ++bad;
          continue;
        }
        for (int look = 0; look < 3; ++look) {
          const Payload* p = reader->latest();
          if (p == nullptr || !p->whole()) ++bad;
        }
      }
    });
  }
  std::thread writer([&] {
    for (std::uint64_t n = 2; !done; ++n) publish(pool, n);
  });
  for (auto& thread : threads) thread.join();
  done = true;
  writer.join();
  EXPECT_EQ(bad, 0);
}

}  // namespace
}  // namespace ambf::exchange
