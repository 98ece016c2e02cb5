#include <gtest/gtest.h>
#include <ros/names.h>

#include <random>

#include "ros_comm/endpoints/topic_names.h"
#include "ros_comm/node_name.h"

namespace ambf::ros_comm {
namespace {

TEST(TopicName, AllowedNamesStayAsTheyAre) {
  for (const char* name : {"/ambf/env/psm/baselink", "/ambf/env/World", "/a", "/a_1/2b"}) {
    EXPECT_EQ(topic_name(name), name);
  }
}

TEST(TopicName, SlashesAreMendedAndForbiddenCharactersReplaced) {
  EXPECT_EQ(topic_name("box"), "/box");
  EXPECT_EQ(topic_name("//ambf//env///box/"), "/ambf/env/box");
  EXPECT_EQ(topic_name("/ambf/left-arm.link 2"), "/ambf/left_arm_link_2");
  EXPECT_EQ(topic_name("/2nd"), "/n2nd");
  EXPECT_EQ(topic_name(""), "/n");
}

TEST(TopicName, RosAcceptsWhateverComesOut) {
  std::mt19937 random(5);
  std::uniform_int_distribution<int> byte(1, 255), length(0, 30);
  for (int i = 0; i < 20000; ++i) {
    std::string name;
    for (int n = length(random); n > 0; --n) name += static_cast<char>(byte(random));
    std::string error;
    const std::string topic = topic_name(name);
    EXPECT_TRUE(ros::names::validate(topic, error)) << topic << ": " << error;
    EXPECT_EQ(topic.front(), '/');
    EXPECT_EQ(topic.find("//"), std::string::npos);
  }
}

TEST(TopicNames, EveryObjectHasOneOfItsOwn) {
  TopicNames names;
  EXPECT_EQ(names.reserve("/a-b"), "/a_b");
  EXPECT_EQ(names.reserve("/a_b"), "/a_b1");
  EXPECT_EQ(names.reserve("/a.b"), "/a_b2");
  EXPECT_EQ(names.find("/a_b"), "/a_b1");
  EXPECT_EQ(names.find("/a.b"), "/a_b2");
  EXPECT_EQ(names.find("/c"), "");
  names.release("/a_b");
  EXPECT_EQ(names.find("/a-b"), "");
  EXPECT_EQ(names.reserve("/a b"), "/a_b");
}

TEST(NodeName, SaysItsProcess) {
  const std::string name = node_name(1234, 1700000000000);
  std::string error;
  EXPECT_TRUE(ros::names::validate(name, error)) << error;
  EXPECT_EQ(process_in(name), 1234);
  EXPECT_EQ(process_in("/" + name), 1234);
  for (const char* other : {"", "/", "/rosout", "/ambf_comm_node", "/ambf_comm_node_x_1", "/ambf_comm_node_12",
                            "/other_1234_5", "/ambf_comm_node_-3_5"}) {
    EXPECT_EQ(process_in(other), 0) << other;
  }
}

}  // namespace
}  // namespace ambf::ros_comm
