#include "ros_comm/step_requests.h"

#include <gtest/gtest.h>

#include <thread>

namespace ambf::ros_comm {
namespace {

using Topics = std::vector<std::string>;

class StepRequestsTest : public ::testing::Test {
 protected:
  Topics ask(const std::string& recorder, const Topics& topics, std::uint32_t interval, std::int64_t now_ns = 1) {
    Topics served;
    EXPECT_EQ(requests.request(recorder, topics, interval, now_ns, served), "");
    return served;
  }
  StepRequests requests;
};

TEST_F(StepRequestsTest, EndUnlessTheyAreRepeated) {
  const auto state = requests.interval_of("/a/State");
  EXPECT_FALSE(requests.in_force(1));
  EXPECT_EQ(ask("/r", {"/a/State", "/nowhere/State"}, 1), Topics{"/a/State"});
  EXPECT_EQ(*state, 1u);
  EXPECT_TRUE(requests.in_force(StepRequests::kLease_ns));
  ask("/r", {"/a/State"}, 1, StepRequests::kLease_ns);
  EXPECT_TRUE(requests.in_force(2 * StepRequests::kLease_ns - 1));
  EXPECT_FALSE(requests.in_force(2 * StepRequests::kLease_ns));
  EXPECT_EQ(*state, 0u);
  ask("/r", {"/a/State"}, 1);
  ask("/r", {}, 0);
  EXPECT_FALSE(requests.in_force(2));
}

TEST_F(StepRequestsTest, OfSeveralRecordersEachGetsItsSteps) {
  const auto a = requests.interval_of("/a/State"), b = requests.interval_of("/b/State");
  ask("/r", {"/a/State"}, 4);
  ask("/s", {"/a/State", "/b/State"}, 6);
  EXPECT_EQ(*a, 2u);
  EXPECT_EQ(*b, 6u);
  ask("/r", {}, 0);
  EXPECT_EQ(*a, 6u);
}

TEST_F(StepRequestsTest, ThereIsABoundToTheirNumber) {
  for (std::size_t i = 0; i < StepRequests::kMaxRecorders; ++i) ask("/r" + std::to_string(i), {}, 1);
  Topics served;
  EXPECT_NE(requests.request("/one_more", {}, 1, 1, served), "");
  ask("/r0", {}, 1);
}

TEST_F(StepRequestsTest, ReceiptsMakeRoom) {
  EXPECT_FALSE(requests.receipt("/r", 0)) << "no request";
  ask("/r", {}, 1);
  for (std::int64_t stamp = 1; stamp < 1000; ++stamp) requests.published(stamp);
  EXPECT_TRUE(requests.room()) << "it sends no receipts";
  EXPECT_TRUE(requests.receipt("/r", 0));
  // The system clock was put back in between.
  for (std::int64_t stamp = 0; stamp < static_cast<std::int64_t>(StepRequests::kMaxAhead); ++stamp) {
    EXPECT_TRUE(requests.room());
    requests.published(stamp < 10 ? 1'000'000 + stamp : stamp);
  }
  EXPECT_FALSE(requests.room());
  requests.receipt("/r", 5);
  EXPECT_FALSE(requests.room()) << "an unknown one";
  requests.receipt("/r", 20);
  EXPECT_TRUE(requests.room());
  for (int i = 0; i < 21; ++i) requests.published(0);
  EXPECT_FALSE(requests.room());
  requests.in_force(1 + StepRequests::kLease_ns);
  EXPECT_TRUE(requests.room()) << "its lease has ended";
}

TEST_F(StepRequestsTest, AreInForceAfterTwoIterationsOfThePublisher) {
  ask("/r", {}, 1);
  EXPECT_FALSE(requests.wait_until_in_force(std::chrono::milliseconds(5)));
  requests.in_force(2);
  EXPECT_FALSE(requests.wait_until_in_force(std::chrono::milliseconds(5))) << "what it does now may have begun before";
  requests.in_force(2);
  EXPECT_TRUE(requests.wait_until_in_force(std::chrono::milliseconds(5)));
}

}  // namespace
}  // namespace ambf::ros_comm
