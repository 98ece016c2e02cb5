// What the physics thread does with these parts allocates and frees nothing: counted, not believed.
#include <gtest/gtest.h>

#include <cstdlib>
#include <memory>
#include <new>
#include <vector>

#include "base/log.h"
#include "base/rolling_stats.h"
#include "exchange/bounded_queue.h"
#include "exchange/dirty_set.h"
#include "exchange/frame_pool.h"
#include "exchange/latest_slot.h"
#include "exchange/signal.h"

namespace {
thread_local long allocations = 0;  // and frees
}

void* operator new(std::size_t size) {
  ++allocations;
  if (void* p = std::malloc(size)) return p;
  throw std::bad_alloc();
}
void operator delete(void* p) noexcept {
  if (p != nullptr) ++allocations;
  std::free(p);
}
void operator delete(void* p, std::size_t) noexcept { operator delete(p); }

namespace ambf::exchange {
namespace {

using Values = std::vector<double>;

class NoAllocation : public ::testing::Test {
 protected:
  void SetUp() override { allocations = 0; }
  void TearDown() override { EXPECT_GT(allocations, 0) << "the counter itself works"; }
  template <class Work>
  long count(Work&& work) {
    const long before = allocations;
    for (int i = 0; i < 100; ++i) work();
    return allocations - before;
  }
};

TEST_F(NoAllocation, InFramesWrittenAndRead) {
  FramePool<Values> pool([] { return std::make_unique<Values>(50); });
  auto reader = pool.make_reader();
  EXPECT_EQ(count([&] {
              pool.begin_write().assign(50, 1.0);
              pool.publish();
              reader->latest();
            }),
            0);
  auto spare = std::make_unique<Values>(50);
  EXPECT_EQ(count([&] { spare = pool.exchange_write_slot(std::move(spare)); }), 0);
  EXPECT_EQ(count([&] { pool.try_exchange_slot(20, spare); }), 0);
}

TEST_F(NoAllocation, InCommandsReadAndMarksDrained) {
  LatestSlot<Values> slot;
  DirtySet dirty(500);
  const Values command(20, 1.0);
  long in_reader = 0;
  for (int i = 0; i < 100; ++i) {
    slot.post(command, i);  // the writer may allocate
    dirty.mark(300);
    const long before = allocations;
    dirty.drain([&](std::size_t) { slot.refresh(); });
    in_reader += allocations - before;
  }
  EXPECT_EQ(in_reader, 0);
  EXPECT_EQ(slot.sequence(), 100u);
}

TEST_F(NoAllocation, InQueuesSignalsLogAndStatistics) {
  BoundedQueue<std::unique_ptr<int>> queue(8);
  auto request = std::make_unique<int>(1);
  EXPECT_EQ(count([&] {
              queue.try_push(std::move(request));
              queue.try_pop(request);
            }),
            0);
  Signal signal;
  EXPECT_EQ(count([&] { signal.notify_all(); }), 0);
  base::Log log(64);
  EXPECT_EQ(count([&] { log.warning("%s has a speed of %g m/s in step %d", "Link1", 1e30, 5); }), 0);
  base::RollingStats stats;
  std::int64_t now = 0;
  EXPECT_EQ(count([&] {
              stats.add(1000, now += 20000000);
              stats.percentiles(now);
            }),
            0);
}

}  // namespace
}  // namespace ambf::exchange
