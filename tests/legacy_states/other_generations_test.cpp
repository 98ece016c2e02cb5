#include "ambf_plugins/legacy_states/other_generations.h"

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

TEST(OtherGenerations, BodiesLoseTheirIdentifierAndNothingElse) {
  ambf_msgs::RigidBodyState state;
  state.header.frame_id = "world";
  state.sim_step = 7;
  state.identifier.data = "BODY link";
  state.name.data = "link";
  state.joint_positions = {1.0F, 2.0F};
  std::vector<std::uint8_t> old;
  ASSERT_TRUE(convert(*find_other_type(Generation::second, "ambf_msgs/RigidBodyState"), bytes_of(state), old));

  state.identifier.data.clear();
  std::string expected = text(bytes_of(state));
  const std::size_t empty_identifier = 12 + (4 + 5) + 4;
  expected.erase(empty_identifier, 4);
  EXPECT_EQ(text(old), expected);
}

TEST(OtherGenerations, SensorsKeepTheirTypeAndParentBeforeIt) {
  ambf_msgs::SensorState state;
  state.type.data = "RAYS";
  state.parent_name.data = "tip";
  state.identifier.data = "SENSOR one";
  state.name.data = "one";
  std::vector<std::uint8_t> old;
  ASSERT_TRUE(convert(*find_other_type(Generation::second, "ambf_msgs/SensorState"), bytes_of(state), old));
  EXPECT_EQ(text(old).find("SENSOR"), std::string::npos);
  for (const char* kept : {"RAYS", "tip", "one"}) EXPECT_NE(text(old).find(kept), std::string::npos) << kept;
  EXPECT_EQ(old.size(), bytes_of(state).size() - (4 + std::string("SENSOR one").size()));
}

TEST(OtherGenerations, TheWorldHadNoGraphicsRate) {
  ambf_msgs::WorldState state;
  state.graphics_loop_freq = 0x1111111111111111;
  state.dynamic_loop_freq = 0x2222222222222222;
  std::vector<std::uint8_t> old;
  ASSERT_TRUE(convert(*find_other_type(Generation::second, "ambf_msgs/WorldState"), bytes_of(state), old));
  EXPECT_EQ(text(old).find('\x11'), std::string::npos);
  EXPECT_NE(text(old).find('\x22'), std::string::npos);
}

TEST(OtherGenerations, WhatIsCutShortIsRefused) {
  ambf_msgs::RigidBodyState state;
  state.identifier.data = "BODY link";
  const std::vector<std::uint8_t> whole = bytes_of(state);
  std::vector<std::uint8_t> old;
  for (std::size_t size = 0; size < 12 + 4 + 4 + 4 + 9; ++size) {
    const std::vector<std::uint8_t> part(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size));
    EXPECT_FALSE(convert(*find_other_type(Generation::second, "ambf_msgs/RigidBodyState"), part, old)) << size;
  }
}

TEST(OtherGenerations, TheFourthRenamesAFieldAndChangesNoByte) {
  ambf_msgs::RigidBodyState state;
  state.name.data = "link";
  state.pInertia.x = 2.0;
  const OtherType& body = *find_other_type(Generation::fourth, "ambf_msgs/RigidBodyState");
  std::vector<std::uint8_t> other;
  ASSERT_TRUE(convert(body, bytes_of(state), other));
  EXPECT_EQ(text(other), text(bytes_of(state)));
  EXPECT_STREQ(body.other_md5, "201be33698a79d982715e2a5a3814805");
  EXPECT_NE(body.other_definition().find("geometry_msgs/Point p_inertia"), std::string::npos);
  EXPECT_EQ(body.other_definition().find("pInertia"), std::string::npos);
  for (const char* same : {"ambf_msgs/WorldState", "ambf_msgs/CameraState", "ambf_msgs/SensorState"}) {
    EXPECT_EQ(find_other_type(Generation::fourth, same), nullptr) << same;
  }
}

TEST(OtherGenerations, TheirWordsAreKnown) {
  Generation generation = Generation::second;
  EXPECT_TRUE(parse("g4", generation));
  EXPECT_EQ(generation, Generation::fourth);
  EXPECT_FALSE(parse("g3", generation));
}

TEST(OtherGenerations, OtherTopicsAreLeftAlone) {
  EXPECT_EQ(find_other_type(Generation::second, "ambf_msgs/WorldRates"), nullptr);
  EXPECT_EQ(find_other_type(Generation::second, "ambf_msgs/RigidBodyCmd"), nullptr);
}

}  // namespace
}  // namespace ambf::legacy_states
