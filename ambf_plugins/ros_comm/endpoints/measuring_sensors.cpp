#include "ros_comm/endpoints/measuring_sensors.h"

#include <ambf_msgs/ContactForces.h>
#include <ambf_msgs/ContactSensorCmd.h>
#include <ambf_msgs/ContactSensorState.h>
#include <geometry_msgs/WrenchStamped.h>
#include <sensor_msgs/Imu.h>
#include <sensor_msgs/JointState.h>

#include "ros_comm/endpoints/object_endpoint.h"
#include "ros_comm/endpoints/sensor_messages.h"
#include "state/readings.h"

namespace ambf::ros_comm {

namespace {

const std::string& identifier_of(const state::Frame& frame, const state::SensedContact& contact) {
  return frame.structure->objects[frame.structure->bodies[contact.body].object].identifier;
}

// AMBF3 1.5: one event a body.
struct ContactMessages {
  using State = ambf_msgs::ContactSensorState;
  using Command = ambf_msgs::ContactSensorCmd;

  static void fill_names(const state::Structure& structure, std::uint32_t slot, State& message) {
    fill_placed_names(structure, state::sensors(structure)[slot], message);
    message.type.data = state::name_of(state::SensorType::contact);
  }
  static void fill(const state::Frame& frame, std::uint32_t slot, State& message) {
    fill_times(frame, message);
    const bool details = state::sensors(*frame.structure)[slot].contact_details;
    message.contact_events.clear();
    std::uint32_t last = state::kNone;
    for (const state::SensedContact& contact : state::contacts_of(frame, slot)) {
      if (contact.body != last) {
        message.contact_events.emplace_back();
        message.contact_events.back().object_name.data = identifier_of(frame, contact);
        last = contact.body;
      }
      if (!details) continue;
      ambf_msgs::ContactData data;
      data.distance.data = contact.distance_m;
      data.contact_point = to_ros(contact.point_world);
      data.contact_normal = to_ros(contact.normal_world);
      message.contact_events.back().contact_data.push_back(data);
    }
  }
  static std::string read(const Command&, state::Command& out) {
    out = state::KindCommand{state::SensorCommand{}};
    return {};
  }
};

// Further topics of one sensor: `Readings` opens and fills them.
template <class Messages, class Readings>
class MeasuringEndpoint final : public comm::Endpoint {
 public:
  MeasuringEndpoint(const EndpointParts& parts, const state::ObjectInfo& object, const std::string& topic)
      : pair_(parts, object, topic), readings_(parts.node, topic) {}

  bool has_subscribers() const override { return pair_.has_subscribers() || readings_.subscribers() > 0; }
  std::uint32_t step_interval() const override { return pair_.step_interval(); }
  bool has_newcomers() const override { return pair_.has_newcomers() || readings_.newcomers(); }
  void watch(const state::Frame& frame, bool active) override { pair_.watch(frame, active); }
  void publish(const state::Frame& frame, std::uint32_t slot) override {
    if (pair_.has_subscribers()) pair_.publish(frame, slot);
    if (readings_.subscribers() > 0) readings_.publish(frame, slot);
  }

 private:
  ObjectEndpoint<Messages> pair_;
  Readings readings_;
};

// Whose frame vectors are in.
const std::string& frame_of(const state::Frame& frame, std::uint32_t slot) {
  return name_of(*frame.structure, state::sensors(*frame.structure)[slot].object);
}

class ContactReadings {
 public:
  ContactReadings(Node& node, const std::string& topic) : forces_(node, topic + "/forces") {}
  int subscribers() const { return forces_.subscribers(); }
  bool newcomers() const { return forces_.newcomers(); }
  void publish(const state::Frame& frame, std::uint32_t slot) {
    fill_times(frame, message_);
    message_.object_names.clear(), message_.points.clear(), message_.forces.clear();
    for (const state::SensedContact& contact : state::contacts_of(frame, slot)) {
      message_.object_names.push_back(identifier_of(frame, contact));
      geometry_msgs::Point point;
      point.x = contact.point_world.x, point.y = contact.point_world.y, point.z = contact.point_world.z;
      message_.points.push_back(point);
      message_.forces.push_back(to_ros(contact.force_world));
    }
    forces_.publish(message_);
  }

 private:
  ambf_msgs::ContactForces message_;
  StatePublisher<ambf_msgs::ContactForces> forces_;
};

// Covariances of 0: not known.
class ImuReadings {
 public:
  ImuReadings(Node& node, const std::string& topic) : imu_(node, topic + "/Imu") {}
  int subscribers() const { return imu_.subscribers(); }
  bool newcomers() const { return imu_.newcomers(); }
  void publish(const state::Frame& frame, std::uint32_t slot) {
    const state::SensorReading& reading = state::reading_of(frame, slot);
    message_.header.stamp = stamp_of(frame);
    message_.header.frame_id = frame_of(frame, slot);
    message_.orientation = to_ros(state::rows(frame, state::sensor_kind().column)[slot].T_world_object).orientation;
    message_.linear_acceleration = to_ros(reading.linear);
    message_.angular_velocity = to_ros(reading.angular);
    imu_.publish(message_);
  }

 private:
  sensor_msgs::Imu message_;
  StatePublisher<sensor_msgs::Imu> imu_;
};

class ForceTorqueReadings {
 public:
  ForceTorqueReadings(Node& node, const std::string& topic)
      : wrench_(node, topic + "/Wrench"), joint_(node, topic + "/JointState") {}
  int subscribers() const { return wrench_.subscribers() + joint_.subscribers(); }
  bool newcomers() const { return wrench_.newcomers() || joint_.newcomers(); }
  void publish(const state::Frame& frame, std::uint32_t slot) {
    if (wrench_.subscribers() > 0) {
      const state::SensorReading& reading = state::reading_of(frame, slot);
      wrench_message_.header.stamp = stamp_of(frame);
      wrench_message_.header.frame_id = frame_of(frame, slot);
      wrench_message_.wrench = to_ros(math::Wrench{reading.linear, reading.angular});
      wrench_.publish(wrench_message_);
    }
    const std::uint32_t joint = state::sensors(*frame.structure)[slot].joint;
    if (joint_.subscribers() == 0 || joint == state::kNone) return;
    const state::JointState& now = frame.joints[joint];
    joint_message_.header.stamp = stamp_of(frame);
    joint_message_.name = {frame.structure->joints[joint].name};
    joint_message_.position = {now.position};
    joint_message_.velocity = {now.velocity};
    joint_message_.effort = {now.effort};
    joint_.publish(joint_message_);
  }

 private:
  geometry_msgs::WrenchStamped wrench_message_;
  sensor_msgs::JointState joint_message_;
  StatePublisher<geometry_msgs::WrenchStamped> wrench_;
  StatePublisher<sensor_msgs::JointState> joint_;
};

}  // namespace

std::unique_ptr<comm::Endpoint> open_measuring_sensor(state::SensorType type, const EndpointParts& parts,
                                                      const state::ObjectInfo& object, const std::string& topic) {
  switch (type) {
    case state::SensorType::contact:
      return std::make_unique<MeasuringEndpoint<ContactMessages, ContactReadings>>(parts, object, topic);
    case state::SensorType::imu:
      return std::make_unique<MeasuringEndpoint<SensorMessages, ImuReadings>>(parts, object, topic);
    case state::SensorType::force_torque:
      return std::make_unique<MeasuringEndpoint<SensorMessages, ForceTorqueReadings>>(parts, object, topic);
    default: return nullptr;
  }
}

}  // namespace ambf::ros_comm
