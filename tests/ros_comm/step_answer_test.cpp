// The answer to a step: what was prepared while the steps ran, completed by the frame that they led to.
#include "ros_comm/services/step_answer.h"

#include <gtest/gtest.h>

#include "ros_comm/endpoints/conversions.h"

namespace ambf::ros_comm {
namespace {

// Bodies of the given names with a joint each, and a camera "eye".
std::shared_ptr<const state::Structure> scene(const std::vector<std::string>& bodies) {
  auto made = std::make_shared<state::Structure>();
  for (const std::string& name : bodies) {
    state::ObjectInfo object;
    object.name = object.local_name = name;
    object.kind = state::ObjectKind::rigid_body;
    object.slot = static_cast<std::uint32_t>(made->bodies.size());
    state::BodyInfo body;
    body.object = static_cast<std::uint32_t>(made->objects.size());
    body.joints = {static_cast<std::uint32_t>(made->joints.size())};
    made->objects.push_back(object);
    made->bodies.push_back(body);
    state::JointInfo joint;
    joint.name = "joint of " + name;
    made->joints.push_back(joint);
  }
  state::ObjectInfo eye;
  eye.name = eye.local_name = "eye";
  eye.kind = state::ObjectKind::camera;
  eye.slot = 0;
  eye.slot = 0;
  state::CameraInfo camera;
  camera.object = static_cast<std::uint32_t>(made->objects.size());
  made->objects.push_back(eye);
  made->cameras.push_back(camera);
  return made;
}

// The bodies stand at x = 1, 2, ...
std::unique_ptr<state::Frame> frame_of(std::shared_ptr<const state::Structure> structure) {
  auto frame = state::make_frame(std::move(structure));
  for (std::size_t i = 0; i < frame->bodies.size(); ++i) {
    frame->bodies[i].T_world_body.position.x = static_cast<double>(i + 1);
    frame->joints[i].position = 10.0 * static_cast<double>(i + 1);
  }
  frame->sim_step = 42;
  return frame;
}

void expect_sizes_fit(const ambf_msgs::Step::Response& response) {
  std::vector<std::uint32_t> sizes{ros::serialization::serializationLength(response.world)};
  for (const auto& each : response.rigid_bodies) sizes.push_back(ros::serialization::serializationLength(each));
  for (const auto& each : response.cameras) sizes.push_back(ros::serialization::serializationLength(each));
  EXPECT_EQ(response.state_sizes, sizes);
}

TEST(StepAnswer, HoldsTheWantedStatesOfTheFrameInTheirOrder) {
  const auto structure = scene({"base", "link", "tool"});
  const std::vector<std::string> wanted{"tool", "eye", "base"};
  ambf_msgs::Step::Response response;
  StepAnswer answer(wanted, response);
  answer.prepare(structure);
  answer.fill(*frame_of(structure));
  ASSERT_EQ(response.rigid_bodies.size(), 2u);
  EXPECT_EQ(response.rigid_bodies[0].name.data, "tool");
  EXPECT_EQ(response.rigid_bodies[0].pose.position.x, 3.0);
  EXPECT_EQ(response.rigid_bodies[0].joint_names, std::vector<std::string>{"joint of tool"});
  EXPECT_EQ(response.rigid_bodies[0].joint_positions, std::vector<float>{30.0f});
  EXPECT_EQ(response.rigid_bodies[1].name.data, "base");
  EXPECT_EQ(response.rigid_bodies[1].sim_step, 42u);
  ASSERT_EQ(response.cameras.size(), 1u);
  EXPECT_EQ(response.cameras[0].name.data, "eye");
  EXPECT_EQ(response.world.sim_step, 42u);
  EXPECT_TRUE(response.diagnostics.empty());
  expect_sizes_fit(response);
}

TEST(StepAnswer, FollowsWhatWasLoadedAndRemovedMeanwhile) {
  const std::vector<std::string> wanted{"tool", "link"};
  ambf_msgs::Step::Response response;
  StepAnswer answer(wanted, response);
  answer.prepare(scene({"base", "tool"}));
  answer.fill(*frame_of(scene({"tool of another", "link", "tool"})));
  ASSERT_EQ(response.rigid_bodies.size(), 2u);
  EXPECT_EQ(response.rigid_bodies[0].pose.position.x, 3.0);
  EXPECT_EQ(response.rigid_bodies[1].name.data, "link");
  EXPECT_TRUE(response.diagnostics.empty());  // it was missing only while it was prepared
  expect_sizes_fit(response);
}

TEST(StepAnswer, SaysWhatIsMissing) {
  const auto structure = scene({"base"});
  const std::vector<std::string> wanted{"nothing", "base"};
  ambf_msgs::Step::Response response;
  StepAnswer answer(wanted, response);
  answer.prepare(structure);
  answer.fill(*frame_of(structure));
  EXPECT_EQ(response.rigid_bodies.size(), 1u);
  ASSERT_EQ(response.diagnostics.size(), 1u);
  EXPECT_NE(response.diagnostics[0].message.find("'nothing'"), std::string::npos);
  EXPECT_NE(response.message.find("'nothing'"), std::string::npos);
}

TEST(StepAnswer, ManyUnknownNamesAreCountedAndFewAreRepeated) {
  const auto structure = scene({"base", "tool"});
  std::vector<std::string> wanted(1000, "nothing");
  wanted.push_back("tool");
  ambf_msgs::Step::Response response;
  StepAnswer answer(wanted, response);
  answer.prepare(structure);
  answer.fill(*frame_of(structure));
  ASSERT_EQ(response.rigid_bodies.size(), 1u);
  EXPECT_EQ(response.rigid_bodies[0].name.data, "tool");
  EXPECT_LT(response.diagnostics.size(), 20u);
  EXPECT_NE(response.message.find("nor 984 more"), std::string::npos) << response.message;
}

TEST(StepAnswer, MoreStatesThanThereCanBeAreRefusedWithTheNumber) {
  const auto structure = scene({"base"});
  EXPECT_EQ(StepAnswer::refusal(std::vector<std::string>(1024, "base"), *structure), "");
  EXPECT_EQ(StepAnswer::refusal(std::vector<std::string>(300'000, "base"), *structure).rfind("300000 states", 0), 0u);
  EXPECT_NE(StepAnswer::refusal({std::string(10'000, 'a')}, *structure), "");
}

TEST(StepAnswer, HoldsNoStatesWhereNothingWasRun) {
  const std::vector<std::string> wanted{"base", "eye"};
  ambf_msgs::Step::Response response;
  StepAnswer answer(wanted, response);
  answer.prepare(scene({"base"}));
  answer.clear();
  EXPECT_TRUE(response.rigid_bodies.empty() && response.cameras.empty() && response.state_sizes.empty());
}

}  // namespace
}  // namespace ambf::ros_comm
