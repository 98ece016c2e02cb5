// Rigid bodies on ROS: State, Command, and their lists in the Step service.
#include <atomic>

#include "ros_comm/endpoints/command_input.h"
#include "ros_comm/endpoints/conversions.h"
#include "ros_comm/endpoints/endpoint_kinds.h"
#include "ros_comm/endpoints/topics.h"
#include "ros_comm/services/step_lists.h"

namespace ambf::ros_comm {

namespace {

// Not an ObjectEndpoint: commands may ask for lists in the state, and are read into one object, whose joint list keeps
// its memory.
class BodyEndpoint final : public comm::Endpoint {
 public:
  BodyEndpoint(const EndpointParts& parts, const state::ObjectInfo& object, const std::string& topic)
      : commands_(parts.node.traffic(), parts.simulation.command, object),
        publisher_(parts.node, topic + "/State"),
        subscriber_(
            parts.node, topic + "/Command",
            [this](const ros::MessageEvent<const ambf_msgs::RigidBodyCmd>& event) {
              on_command(*event.getConstMessage());
            },
            [this](const std::string& why) { commands_.refuse(why); }) {}

  bool has_subscribers() const override { return publisher_.subscribers() > 0; }
  std::uint32_t step_interval() const override { return publisher_.step_interval(); }
  bool has_newcomers() const override { return publisher_.newcomers(); }
  void watch(const state::Frame&, bool active) override { commands_.watch(active); }

  void publish(const state::Frame& frame, std::uint32_t slot) override {
    const std::uint32_t requests = list_requests_.load();
    if (frame.structure->version != structure_version_ || requests != list_requests_done_) {
      structure_version_ = frame.structure->version;
      list_requests_done_ = requests;
      fill_names(*frame.structure, slot, message_, {children_, joint_names_, joint_positions_});
    }
    fill(frame, slot, message_);
    publisher_.publish(message_);
  }

 private:
  void on_command(const ambf_msgs::RigidBodyCmd& message) {
    const auto request = [this](bool requested, std::atomic<bool>& flag) {
      if (requested && !flag.exchange(true)) list_requests_.fetch_add(1);
      return requested;
    };
    bool requests_lists = request(message.publish_children_names != 0, children_);
    requests_lists |= request(message.publish_joint_names != 0, joint_names_);
    requests_lists |= request(message.publish_joint_positions != 0, joint_positions_);
    if (const std::string refusal = read(message, command_); !refusal.empty()) return commands_.refuse(refusal);
    // A client that only asks for lists must not end the command of another one.
    const bool commands_nothing = command_.type == state::CartesianCommandType::none && command_.joints.empty();
    if (!commands_nothing || !requests_lists) commands_.post(command_);
  }

  CommandInput commands_;
  state::RigidBodyCommand command_;  // command thread
  // Lists in the state that commands switched on, for good.
  std::atomic<bool> children_{false}, joint_names_{false}, joint_positions_{false};
  std::atomic<std::uint32_t> list_requests_{0};  // + 1 with each change of the three
  ambf_msgs::RigidBodyState message_;            // publisher thread, as the next two
  std::uint64_t structure_version_ = ~std::uint64_t{0};
  std::uint32_t list_requests_done_ = 0;
  StatePublisher<ambf_msgs::RigidBodyState> publisher_;
  CommandSubscriber<ambf_msgs::RigidBodyCmd> subscriber_;  // last: callbacks use all of the above
};

// For the Step service.
struct BodyMessages {
  using State = ambf_msgs::RigidBodyState;
  using Command = ambf_msgs::RigidBodyCmd;
  static void fill_names(const state::Structure& structure, std::uint32_t slot, State& message) {
    ros_comm::fill_names(structure, slot, message);
  }
  static void fill(const state::Frame& frame, std::uint32_t slot, State& message) {
    ros_comm::fill(frame, slot, message);
  }
  static std::string read(const Command& message, state::Command& out) {
    state::RigidBodyCommand command;
    std::string refusal = ros_comm::read(message, command);
    out = std::move(command);
    return refusal;
  }
};

}  // namespace

EndpointKind body_endpoint_kind() {
  static const StepListsOf<BodyMessages> lists(&StepRequest::rigid_body_names, &StepRequest::rigid_body_cmds,
                                               &StepResponse::rigid_bodies);
  EndpointKind kind;
  kind.open = make_endpoint<BodyEndpoint>;
  kind.step = &lists;
  return kind;
}

}  // namespace ambf::ros_comm
