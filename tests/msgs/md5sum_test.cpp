// The generated C++ classes have the wire formats that clients, scripts and bags were built against.
#include <ambf_msgs/ActuatorCmd.h>
#include <ambf_msgs/ActuatorForces.h>
#include <ambf_msgs/ActuatorState.h>
#include <ambf_msgs/CameraCmd.h>
#include <ambf_msgs/CameraState.h>
#include <ambf_msgs/CommandRates.h>
#include <ambf_msgs/ContactData.h>
#include <ambf_msgs/ContactEvent.h>
#include <ambf_msgs/ContactForces.h>
#include <ambf_msgs/ContactSensorCmd.h>
#include <ambf_msgs/ContactSensorState.h>
#include <ambf_msgs/DeviceInfo.h>
#include <ambf_msgs/DeviceMapping.h>
#include <ambf_msgs/DeviceParameter.h>
#include <ambf_msgs/DeviceRates.h>
#include <ambf_msgs/Devices.h>
#include <ambf_msgs/Diagnostic.h>
#include <ambf_msgs/Forget.h>
#include <ambf_msgs/GhostObjectCmd.h>
#include <ambf_msgs/GhostObjectState.h>
#include <ambf_msgs/Hold.h>
#include <ambf_msgs/JointInfo.h>
#include <ambf_msgs/LightCmd.h>
#include <ambf_msgs/LightState.h>
#include <ambf_msgs/List.h>
#include <ambf_msgs/Load.h>
#include <ambf_msgs/ModelInfo.h>
#include <ambf_msgs/ObjectCmd.h>
#include <ambf_msgs/ObjectInfo.h>
#include <ambf_msgs/ObjectLabels.h>
#include <ambf_msgs/ObjectState.h>
#include <ambf_msgs/Received.h>
#include <ambf_msgs/Record.h>
#include <ambf_msgs/Remove.h>
#include <ambf_msgs/Restore.h>
#include <ambf_msgs/RigidBodyCmd.h>
#include <ambf_msgs/RigidBodyState.h>
#include <ambf_msgs/RunPercentiles.h>
#include <ambf_msgs/Save.h>
#include <ambf_msgs/SensorCmd.h>
#include <ambf_msgs/SensorEvent.h>
#include <ambf_msgs/SensorForces.h>
#include <ambf_msgs/SensorState.h>
#include <ambf_msgs/SetDevice.h>
#include <ambf_msgs/Snapshot.h>
#include <ambf_msgs/SoftBodyCmd.h>
#include <ambf_msgs/SoftBodyForces.h>
#include <ambf_msgs/SoftBodyState.h>
#include <ambf_msgs/SoftBodyTopology.h>
#include <ambf_msgs/Step.h>
#include <ambf_msgs/StepCommands.h>
#include <ambf_msgs/TaskCmd.h>
#include <ambf_msgs/TaskState.h>
#include <ambf_msgs/ThreadRates.h>
#include <ambf_msgs/Tune.h>
#include <ambf_msgs/Unload.h>
#include <ambf_msgs/VehicleCmd.h>
#include <ambf_msgs/VehicleState.h>
#include <ambf_msgs/WorldCmd.h>
#include <ambf_msgs/WorldCommandRates.h>
#include <ambf_msgs/WorldContacts.h>
#include <ambf_msgs/WorldDeviceRates.h>
#include <ambf_msgs/WorldRates.h>
#include <ambf_msgs/WorldState.h>
#include <ambf_msgs/WorldSuccess.h>
#include <gtest/gtest.h>
#include <ros/message_traits.h>
#include <ros/serialization.h>
#include <ros/service_traits.h>

#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

namespace {

std::map<std::string, std::string> frozen_md5sums() {
  std::map<std::string, std::string> sums;
  std::ifstream file(AMBF_MD5SUMS);
  for (std::string line; std::getline(file, line);) {
    std::istringstream words(line);
    std::string name, sum;
    if (words >> name >> sum && name != "#") {
      sums[name] = sum;
    }
  }
  return sums;
}

template <class... Messages>
void add_messages(std::map<std::string, std::string>& sums) {
  (sums.emplace(ros::message_traits::datatype<Messages>(), ros::message_traits::md5sum<Messages>()), ...);
}

template <class... Services>
void add_services(std::map<std::string, std::string>& sums) {
  (sums.emplace(ros::service_traits::datatype<Services>(), ros::service_traits::md5sum<Services>()), ...);
}

std::map<std::string, std::string> compiled_md5sums() {
  namespace m = ambf_msgs;
  std::map<std::string, std::string> sums;
  add_messages<m::ActuatorCmd, m::ActuatorState, m::CameraCmd, m::CameraState, m::LightCmd, m::LightState, m::ObjectCmd,
               m::ObjectState, m::RigidBodyCmd, m::RigidBodyState, m::SensorCmd, m::SensorState, m::SoftBodyCmd,
               m::SoftBodyState, m::VehicleCmd, m::VehicleState, m::WorldCmd, m::WorldState, m::Diagnostic,
               m::JointInfo, m::ModelInfo, m::ObjectInfo, m::ObjectLabels, m::ThreadRates, m::WorldRates,
               m::CommandRates, m::WorldCommandRates, m::StepCommands, m::DeviceInfo, m::DeviceMapping,
               m::DeviceParameter, m::DeviceRates, m::RunPercentiles, m::WorldDeviceRates, m::ContactData,
               m::ContactEvent, m::ContactSensorCmd, m::ContactSensorState, m::GhostObjectCmd, m::GhostObjectState,
               m::ContactForces, m::WorldContacts, m::SensorEvent, m::SensorForces, m::WorldSuccess, m::SoftBodyForces,
               m::SoftBodyTopology, m::ActuatorForces, m::TaskCmd, m::TaskState>(sums);
  add_services<m::Devices, m::Forget, m::Hold, m::List, m::Load, m::Received, m::Record, m::Remove, m::Restore, m::Save,
               m::SetDevice, m::Snapshot, m::Step, m::Tune, m::Unload>(sums);
  return sums;
}

}  // namespace

TEST(WireFormat, EveryMd5IsTheFrozenOne) {
  const auto frozen = frozen_md5sums();
  ASSERT_FALSE(frozen.empty()) << "cannot read " << AMBF_MD5SUMS;
  const auto compiled = compiled_md5sums();
  EXPECT_EQ(compiled.size(), frozen.size());
  for (const auto& [name, sum] : frozen) {
    const auto found = compiled.find("ambf_msgs/" + name);
    ASSERT_NE(found, compiled.end()) << name << " is not generated";
    EXPECT_EQ(found->second, sum) << name;
  }
}

TEST(WireFormat, CommandTypesHaveTheirKnownNumbers) {
  EXPECT_EQ(+ambf_msgs::RigidBodyCmd::TYPE_FORCE, 0);
  EXPECT_EQ(+ambf_msgs::RigidBodyCmd::TYPE_POSITION, 1);
  EXPECT_EQ(+ambf_msgs::RigidBodyCmd::TYPE_VELOCITY, 2);
}

TEST(WireFormat, StepRequestSurvivesTheWire) {
  ambf_msgs::StepRequest sent;
  sent.n = 7;
  sent.rigid_body_names = {"/ambf/env/arm/base"};
  sent.rigid_body_cmds.resize(1);
  sent.rigid_body_cmds[0].joint_cmds = {0.25F, -1.5F};
  sent.wanted_states = {"/ambf/env/arm/base", "/ambf/env/peg"};

  std::vector<uint8_t> bytes(ros::serialization::serializationLength(sent));
  ros::serialization::OStream out(bytes.data(), static_cast<uint32_t>(bytes.size()));
  ros::serialization::serialize(out, sent);
  ambf_msgs::StepRequest received;
  ros::serialization::IStream in(bytes.data(), static_cast<uint32_t>(bytes.size()));
  ros::serialization::deserialize(in, received);

  EXPECT_EQ(received.n, 7U);
  ASSERT_EQ(received.rigid_body_cmds.size(), 1U);
  EXPECT_EQ(received.rigid_body_cmds[0].joint_cmds, sent.rigid_body_cmds[0].joint_cmds);
  EXPECT_EQ(received.wanted_states, sent.wanted_states);
}
