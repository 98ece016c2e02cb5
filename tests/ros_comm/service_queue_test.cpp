// The queue of service requests: in order, each once, none after its owner's end, and nobody waits on when all ends.
#include "ros_comm/services/service_queue.h"

#include <gtest/gtest.h>

#include <atomic>
#include <boost/make_shared.hpp>
#include <thread>
#include <vector>

namespace ambf::ros_comm {
namespace {

using namespace std::chrono_literals;

class Call : public ros::CallbackInterface {
 public:
  Call(std::vector<int>& log, int number, int again = 0) : log_(log), number_(number), again_(again) {}
  CallResult call() override {
    log_.push_back(number_);
    return again_-- > 0 ? TryAgain : Success;
  }

 private:
  std::vector<int>& log_;
  const int number_;
  int again_;
};

class ServiceQueueTest : public ::testing::Test {
 protected:
  void add(int number, std::uint64_t owner = 1, int again = 0) {
    queue.addCallback(boost::make_shared<Call>(log, number, again), owner);
  }
  void run(int times) {
    for (int i = 0; i < times; ++i) queue.run_one(0ms);
  }
  ServiceQueue queue{100};
  std::vector<int> log;
};

TEST_F(ServiceQueueTest, RunsEachOnceInOrder) {
  add(1), add(2), add(3);
  run(5);
  EXPECT_EQ(log, (std::vector<int>{1, 2, 3}));
}

TEST_F(ServiceQueueTest, WhoIsNotReadyComesAgainLater) {
  add(1, 1, 2), add(2);
  run(6);
  EXPECT_EQ(log, (std::vector<int>{1, 2, 1, 1}));
}

TEST_F(ServiceQueueTest, AnOwnersEndTakesOnlyItsOwn) {
  add(1, 7), add(2, 8), add(3, 7), add(4, 8);
  queue.removeByID(7);
  run(5);
  EXPECT_EQ(log, (std::vector<int>{2, 4}));
}

TEST_F(ServiceQueueTest, NothingRunsOrStaysAfterTheEnd) {
  add(1);
  queue.disable();
  add(2);
  run(3);
  EXPECT_TRUE(log.empty());
}

TEST_F(ServiceQueueTest, TheEndWakesWhoWaits) {
  std::atomic<int> ended{0};
  std::vector<std::thread> threads;
  for (int i = 0; i < 3; ++i) {
    threads.emplace_back([&] {
      queue.run_one(60'000ms);  // the test's own limit is shorter
      ++ended;
    });
  }
  queue.disable();
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(ended, 3);
}

TEST_F(ServiceQueueTest, ManyThreadsShareTheWorkAndLoseNone) {
  class Count : public ros::CallbackInterface {
   public:
    explicit Count(std::atomic<int>& n) : n_(n) {}
    CallResult call() override { return ++n_, Success; }

   private:
    std::atomic<int>& n_;
  };
  std::atomic<int> done{0};
  constexpr int kCalls = 20000;
  std::vector<std::thread> threads;
  for (int i = 0; i < 3; ++i) {
    threads.emplace_back([&] {
      while (done < kCalls) queue.run_one(1ms);
    });
  }
  for (int i = 0; i < kCalls; ++i) queue.addCallback(boost::make_shared<Count>(done), 1);
  for (std::thread& thread : threads) thread.join();
  queue.run_one(0ms);
  EXPECT_EQ(done, kCalls);
}

// Three clients wait for many steps: a fourth one's question is answered.
TEST(ServiceQueueShares, OneServiceLeavesAThreadToTheOthers) {
  class Long : public ros::CallbackInterface {
   public:
    explicit Long(std::atomic<int>& running, const std::atomic<bool>& over) : running_(running), over_(over) {}
    CallResult call() override {
      ++running_;
      while (!over_) std::this_thread::sleep_for(1ms);
      return Success;
    }

   private:
    std::atomic<int>& running_;
    const std::atomic<bool>& over_;
  };
  ServiceQueue queue(2);
  std::atomic<int> steps{0}, lists{0};
  std::atomic<bool> over{false}, quick{true}, stop{false};
  std::vector<std::thread> threads;
  for (int i = 0; i < 3; ++i) {
    threads.emplace_back([&] {
      while (!stop) queue.run_one(10ms);
    });
  }
  for (int i = 0; i < 3; ++i) queue.addCallback(boost::make_shared<Long>(steps, over), 1);
  while (steps < 2) std::this_thread::sleep_for(1ms);
  queue.addCallback(boost::make_shared<Long>(lists, quick), 2);
  while (lists < 1) std::this_thread::sleep_for(1ms);  // else the test's own limit ends it
  EXPECT_EQ(steps, 2);
  over = true;
  while (steps < 3) std::this_thread::sleep_for(1ms);
  stop = true;
  for (std::thread& thread : threads) thread.join();
}

}  // namespace
}  // namespace ambf::ros_comm
