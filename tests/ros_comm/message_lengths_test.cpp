// What arrives is checked against its own lengths before it is deserialized.
#include "ros_comm/message_lengths.h"

#include <ambf_msgs/RigidBodyCmd.h>
#include <ambf_msgs/Step.h>
#include <ambf_msgs/WorldCmd.h>
#include <gtest/gtest.h>

#include <random>

namespace ambf::ros_comm {
namespace {

template <class Message>
std::vector<std::uint8_t> bytes_of(const Message& message) {
  std::vector<std::uint8_t> bytes(ros::serialization::serializationLength(message));
  ros::serialization::OStream stream(bytes.data(), static_cast<std::uint32_t>(bytes.size()));
  ros::serialization::serialize(stream, message);
  return bytes;
}

template <class Message>
std::string problem_of(const std::vector<std::uint8_t>& bytes) {
  return problem_of_lengths<Message>(bytes.data(), bytes.size());
}

ambf_msgs::RigidBodyCmd body_command() {
  ambf_msgs::RigidBodyCmd command;
  command.header.frame_id = "a frame";
  command.joint_cmds_types = {1, 1, 0};
  command.joint_cmds = {0.1f, 0.2f, 0.3f};
  return command;
}

ambf_msgs::Step::Request step_request() {
  ambf_msgs::Step::Request request;
  request.n = 10;
  request.rigid_body_names = {"base", "tool"};
  request.rigid_body_cmds = {body_command(), ambf_msgs::RigidBodyCmd()};
  request.wanted_states = {"base", "", "tool"};
  return request;
}

// Puts `length` in place of the four bytes at `at`.
std::vector<std::uint8_t> with_length(std::vector<std::uint8_t> bytes, std::size_t at, std::uint32_t length) {
  std::memcpy(bytes.data() + at, &length, sizeof length);
  return bytes;
}

TEST(MessageLengths, WholeMessagesPass) {
  EXPECT_EQ(problem_of<ambf_msgs::RigidBodyCmd>(bytes_of(body_command())), "");
  EXPECT_EQ(problem_of<ambf_msgs::RigidBodyCmd>(bytes_of(ambf_msgs::RigidBodyCmd())), "");
  EXPECT_EQ(problem_of<ambf_msgs::WorldCmd>(bytes_of(ambf_msgs::WorldCmd())), "");
  EXPECT_EQ(problem_of<ambf_msgs::Step::Request>(bytes_of(step_request())), "");
}

TEST(MessageLengths, AListLongerThanWhatCameIsRefusedWithBothNumbers) {
  const auto bytes = bytes_of(body_command());
  const std::size_t joint_cmds = bytes.size() - 3 - 3 * sizeof(float) - 4;  // its length stands before three flags
  const std::string problem = problem_of<ambf_msgs::RigidBodyCmd>(with_length(bytes, joint_cmds, 500'000'000));
  EXPECT_NE(problem.find("length of 500000000, which takes 2000000000 bytes"), std::string::npos) << problem;
  EXPECT_NE(problem.find("15 came"), std::string::npos) << problem;
}

TEST(MessageLengths, EveryTruncatedMessageIsRefused) {
  const auto bytes = bytes_of(step_request());
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    EXPECT_NE(problem_of_lengths<ambf_msgs::Step::Request>(bytes.data(), size), "") << size;
  }
}

// What passes can be deserialized: roscpp finds no end before a field's.
TEST(MessageLengths, WhatPassesCanBeDeserialized) {
  const auto bytes = bytes_of(step_request());
  std::mt19937 random(1);
  int passed = 0;
  for (int i = 0; i < 20000; ++i) {
    auto damaged = bytes;
    for (int k = 0; k < 2; ++k) damaged[random() % damaged.size()] = static_cast<std::uint8_t>(random());
    if (!problem_of<ambf_msgs::Step::Request>(damaged).empty()) continue;
    ++passed;
    ambf_msgs::Step::Request request;
    ros::serialization::IStream stream(damaged.data(), static_cast<std::uint32_t>(damaged.size()));
    EXPECT_NO_THROW(ros::serialization::deserialize(stream, request)) << i;
  }
  EXPECT_GT(passed, 1000);
}

TEST(MessageLengths, ManyEmptyTextsMayNotTakeSeveralTimesTheMessage) {
  ambf_msgs::Step::Request request;
  request.wanted_states.resize(65536);  // as many as there can be objects
  EXPECT_EQ(problem_of<ambf_msgs::Step::Request>(bytes_of(request)), "");
  request.wanted_states.resize(2'000'000);
  EXPECT_NE(problem_of<ambf_msgs::Step::Request>(bytes_of(request)).find("MB of memory"), std::string::npos);
}

}  // namespace
}  // namespace ambf::ros_comm
