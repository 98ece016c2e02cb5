// Soft bodies on ROS: the pose of the centre, a wrench on all of them, a pose that carries their fixed nodes; the place
// of each node, what joins them, forces on them.
#include <ambf_msgs/SoftBodyCmd.h>
#include <ambf_msgs/SoftBodyForces.h>
#include <ambf_msgs/SoftBodyState.h>
#include <ambf_msgs/SoftBodyTopology.h>
#include <sensor_msgs/PointCloud2.h>

#include "base/clock.h"
#include "ros_comm/endpoints/command_input.h"
#include "ros_comm/endpoints/conversions.h"
#include "ros_comm/endpoints/endpoint_kinds.h"
#include "ros_comm/endpoints/topics.h"
#include "state/soft_bodies.h"

namespace ambf::ros_comm {

namespace {

constexpr std::int64_t kNodesInterval_ns = 10'000'000;  // NAME/Nodes: at most 100 a second

void fill_nodes(const state::Frame& frame, std::uint32_t slot, sensor_msgs::PointCloud2& message) {
  message.header.stamp = stamp_of(frame);
  message.fields.resize(3);
  for (std::uint32_t axis = 0; axis < 3; ++axis) {
    message.fields[axis].name = std::string(1, "xyz"[axis]);
    message.fields[axis].offset = 4 * axis;
    message.fields[axis].datatype = sensor_msgs::PointField::FLOAT32;
    message.fields[axis].count = 1;
  }
  message.height = 1;
  message.point_step = 12;
  message.is_dense = 1;
  message.data.clear();
  for (const state::SoftNode& node : state::nodes_of(frame, slot)) {
    const math::Vec3& at = node.position_world;
    const float point[3] = {static_cast<float>(at.x), static_cast<float>(at.y), static_cast<float>(at.z)};
    const auto* bytes = reinterpret_cast<const std::uint8_t*>(point);
    message.data.insert(message.data.end(), bytes, bytes + sizeof point);
  }
  message.width = static_cast<std::uint32_t>(message.data.size() / message.point_step);
  message.row_step = message.width * message.point_step;
}

ambf_msgs::SoftBodyTopology topology_of(const state::SoftBodyInfo& body) {
  ambf_msgs::SoftBodyTopology message;
  message.nodes = body.nodes;
  for (const auto& face : body.shape->faces)
    message.triangles.insert(message.triangles.end(), face.begin(), face.end());
  for (const auto& line : body.shape->lines) message.lines.insert(message.lines.end(), line.begin(), line.end());
  for (std::uint32_t node = 0; node < body.nodes; ++node)
    if (body.fixed[node]) message.fixed.push_back(node);
  return message;
}

// Null: it is not there.
const state::SoftBodyInfo* info_of(const state::Structure& structure, state::ObjectId id) {
  const std::uint32_t object = state::find(structure, id);
  return object == state::kNone ? nullptr : &state::soft_bodies(structure)[structure.objects[object].slot];
}

// The simulation knows one command of ROS for each object: what came on both topics, each as long as it is fresh.
class Commands {
 public:
  Commands(const EndpointParts& parts, const state::ObjectInfo& object)
      : observe_(parts.simulation.observe),
        object_(object.id),
        input_(parts.node.traffic(), parts.simulation.command, object) {}

  // Command thread.
  void take(const ambf_msgs::SoftBodyCmd& message) {
    state::SoftBodyCommand command;
    command.carries = message.enable_position_controller != 0;
    if (command.carries) {
      command.T_world_body = from_ros(message.pose);
    } else {
      command.wrench_world = {from_ros(message.wrench.force), from_ros(message.wrench.torque)};
    }
    if (fresh(forces_ns_)) command.node_forces = whole_.node_forces;
    post(std::move(command), whole_ns_);
  }
  void take(const ambf_msgs::SoftBodyForces& message) {
    if (message.nodes.size() != message.forces.size()) {
      refuse("NodeForces has " + std::to_string(message.nodes.size()) + " nodes and " +
             std::to_string(message.forces.size()) + " forces: as many of both are expected");
      return;
    }
    state::SoftBodyCommand command;
    if (fresh(whole_ns_)) command = whole_;
    command.node_forces.clear();
    for (std::size_t i = 0; i < message.nodes.size(); ++i)
      command.node_forces.push_back({message.nodes[i], from_ros(message.forces[i])});
    post(std::move(command), forces_ns_);
  }
  void refuse(const std::string& why) { input_.refuse(why); }
  // Publisher thread.
  void watch(const state::Frame& frame, bool active) {
    watchdog_ns_.store(static_cast<std::int64_t>(1e9 * frame.run.watchdog_s), std::memory_order_relaxed);
    input_.watch(active);
  }

 private:
  bool fresh(std::int64_t since_ns) const {
    return since_ns != 0 && base::steady_ns() - since_ns < watchdog_ns_.load(std::memory_order_relaxed);
  }
  void post(state::SoftBodyCommand command, std::int64_t& since_ns) {
    const std::shared_ptr<const state::Structure> structure = observe_.structure();
    const state::SoftBodyInfo* body = info_of(*structure, object_);
    if (body == nullptr) return;  // it was removed, its topics close soon
    const std::string refusal = state::check(command, body->nodes);
    if (!refusal.empty()) {
      refuse(refusal);
      return;
    }
    since_ns = base::steady_ns();
    whole_ = command;
    input_.post(state::KindCommand{std::move(command)});
  }

  state::ObserveAbility& observe_;
  const state::ObjectId object_;
  CommandInput input_;
  state::SoftBodyCommand whole_;  // this and the next two: command thread
  std::int64_t whole_ns_ = 0, forces_ns_ = 0;
  std::atomic<std::int64_t> watchdog_ns_{500'000'000};
};

class SoftBodyEndpoint final : public comm::Endpoint {
 public:
  SoftBodyEndpoint(const EndpointParts& parts, const state::ObjectInfo& object, const std::string& topic)
      : object_(object.id),
        commands_(parts, object),
        states_(parts.node, topic + "/State"),
        nodes_(parts.node, topic + "/Nodes", 1),
        topology_(parts.node, topic + "/Topology", 1, true),
        command_(
            parts.node, topic + "/Command", [this](const auto& event) { commands_.take(*event.getConstMessage()); },
            [this](const std::string& why) { commands_.refuse(why); }),
        forces_(
            parts.node, topic + "/NodeForces", [this](const auto& event) { commands_.take(*event.getConstMessage()); },
            [this](const std::string& why) { commands_.refuse(why); }) {}

  bool has_subscribers() const override { return states_.subscribers() > 0 || nodes_.subscribers() > 0; }
  std::uint32_t step_interval() const override { return states_.step_interval(); }
  bool has_newcomers() const override { return states_.newcomers() || nodes_.newcomers(); }
  void watch(const state::Frame& frame, bool active) override {
    commands_.watch(frame, active);
    if (topology_sent_) return;
    const state::SoftBodyInfo* body = info_of(*frame.structure, object_);
    topology_sent_ = body != nullptr;
    if (body != nullptr) topology_.publish(topology_of(*body));
  }

  void publish(const state::Frame& frame, std::uint32_t slot) override {
    if (states_.subscribers() > 0 || states_.step_interval() > 0) publish_state(frame, slot);
    if (nodes_.subscribers() == 0) return;
    if (!nodes_.newcomers() && frame.steady_ns - nodes_ns_ < kNodesInterval_ns) return;
    nodes_ns_ = frame.steady_ns;
    fill_nodes(frame, slot, cloud_);
    nodes_.publish(cloud_);
  }

 private:
  void publish_state(const state::Frame& frame, std::uint32_t slot) {
    if (frame.structure->version != structure_version_) {
      structure_version_ = frame.structure->version;
      const state::SoftBodyInfo& body = state::soft_bodies(*frame.structure)[slot];
      message_.name.data = frame.structure->objects[body.object].local_name;
      message_.identifier.data = frame.structure->objects[body.object].identifier;
      message_.mass = static_cast<float>(body.mass);
    }
    fill_times(frame, message_);
    message_.pose = to_ros(state::rows(frame, state::soft_body_kind().column)[slot].T_world_object);
    states_.publish(message_);
  }

  const state::ObjectId object_;
  Commands commands_;
  bool topology_sent_ = false;        // publisher thread
  ambf_msgs::SoftBodyState message_;  // this and the next three: publisher thread
  std::uint64_t structure_version_ = ~std::uint64_t{0};
  sensor_msgs::PointCloud2 cloud_;
  std::int64_t nodes_ns_ = 0;
  StatePublisher<ambf_msgs::SoftBodyState> states_;
  TopicPublisher<sensor_msgs::PointCloud2> nodes_;
  TopicPublisher<ambf_msgs::SoftBodyTopology> topology_;
  CommandSubscriber<ambf_msgs::SoftBodyCmd> command_;  // this and the next last: callbacks use all of the above
  CommandSubscriber<ambf_msgs::SoftBodyForces> forces_;
};

}  // namespace

EndpointKind soft_body_endpoint_kind() {
  EndpointKind kind;
  kind.open = make_endpoint<SoftBodyEndpoint>;
  return kind;
}

}  // namespace ambf::ros_comm
