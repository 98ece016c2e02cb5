#include "ambf_plugins/legacy_states/second_generation.h"

#include <ambf_msgs/RigidBodyState.h>
#include <ambf_msgs/SensorState.h>
#include <ambf_msgs/WorldState.h>
#include <gtest/gtest.h>

#include <string>

namespace ambf::legacy_states {
namespace {

template <class Message>
std::vector<std::uint8_t> bytes_of(const Message& message) {
  std::vector<std::uint8_t> bytes(ros::serialization::serializationLength(message));
  ros::serialization::OStream stream(bytes.data(), static_cast<std::uint32_t>(bytes.size()));
  ros::serialization::serialize(stream, message);
  return bytes;
}

std::string text(const std::vector<std::uint8_t>& bytes) { return {bytes.begin(), bytes.end()}; }

TEST(SecondGeneration, BodiesLoseTheirIdentifierAndNothingElse) {
  ambf_msgs::RigidBodyState state;
  state.header.frame_id = "world";
  state.sim_step = 7;
  state.identifier.data = "BODY link";
  state.name.data = "link";
  state.joint_positions = {1.0F, 2.0F};
  std::vector<std::uint8_t> old;
  ASSERT_TRUE(to_old(*find_old_type("ambf_msgs/RigidBodyState"), bytes_of(state), old));

  state.identifier.data.clear();
  std::string expected = text(bytes_of(state));
  const std::size_t empty_identifier = 12 + (4 + 5) + 4;
  expected.erase(empty_identifier, 4);
  EXPECT_EQ(text(old), expected);
}

TEST(SecondGeneration, SensorsKeepTheirTypeAndParentBeforeIt) {
  ambf_msgs::SensorState state;
  state.type.data = "RAYS";
  state.parent_name.data = "tip";
  state.identifier.data = "SENSOR one";
  state.name.data = "one";
  std::vector<std::uint8_t> old;
  ASSERT_TRUE(to_old(*find_old_type("ambf_msgs/SensorState"), bytes_of(state), old));
  EXPECT_EQ(text(old).find("SENSOR"), std::string::npos);
  for (const char* kept : {"RAYS", "tip", "one"}) EXPECT_NE(text(old).find(kept), std::string::npos) << kept;
  EXPECT_EQ(old.size(), bytes_of(state).size() - (4 + std::string("SENSOR one").size()));
}

TEST(SecondGeneration, TheWorldHadNoGraphicsRate) {
  ambf_msgs::WorldState state;
  state.graphics_loop_freq = 0x1111111111111111;
  state.dynamic_loop_freq = 0x2222222222222222;
  std::vector<std::uint8_t> old;
  ASSERT_TRUE(to_old(*find_old_type("ambf_msgs/WorldState"), bytes_of(state), old));
  EXPECT_EQ(text(old).find('\x11'), std::string::npos);
  EXPECT_NE(text(old).find('\x22'), std::string::npos);
}

TEST(SecondGeneration, WhatIsCutShortIsRefused) {
  ambf_msgs::RigidBodyState state;
  state.identifier.data = "BODY link";
  const std::vector<std::uint8_t> whole = bytes_of(state);
  std::vector<std::uint8_t> old;
  for (std::size_t size = 0; size < 12 + 4 + 4 + 4 + 9; ++size) {
    const std::vector<std::uint8_t> part(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size));
    EXPECT_FALSE(to_old(*find_old_type("ambf_msgs/RigidBodyState"), part, old)) << size;
  }
}

TEST(SecondGeneration, OtherTopicsAreLeftAlone) {
  EXPECT_EQ(find_old_type("ambf_msgs/WorldRates"), nullptr);
  EXPECT_EQ(find_old_type("ambf_msgs/RigidBodyCmd"), nullptr);
}

}  // namespace
}  // namespace ambf::legacy_states
