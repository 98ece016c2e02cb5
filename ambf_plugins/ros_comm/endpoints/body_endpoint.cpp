#include "ros_comm/endpoints/body_endpoint.h"

#include "ros_comm/endpoints/conversions.h"

namespace ambf::ros_comm {

BodyEndpoint::BodyEndpoint(Node& node, const state::ObjectInfo& object, const std::string& topic,
                           state::CommandAbility& command)
    : node_(node),
      command_ability_(command),
      name_(object.name),
      object_(object.id),
      port_(command.bind(object.id, state::Source::ros)),
      watch_(node.traffic(), object.name),
      publisher_(node, topic + "/State"),
      subscriber_(node, topic + "/Command", [this](const ros::MessageEvent<const ambf_msgs::RigidBodyCmd>& event) {
        on_command(*event.getConstMessage());
      }) {}

void BodyEndpoint::on_command(const ambf_msgs::RigidBodyCmd& message) {
  const auto wish = [this](bool wanted, std::atomic<bool>& flag) {
    if (wanted && !flag.exchange(true)) wishes_.fetch_add(1);
  };
  const bool wishes =
      message.publish_children_names != 0 || message.publish_joint_names != 0 || message.publish_joint_positions != 0;
  wish(message.publish_children_names != 0, wants_children_);
  wish(message.publish_joint_names != 0, wants_joint_names_);
  wish(message.publish_joint_positions != 0, wants_joint_positions_);
  const std::string refusal = read(message, command_);
  if (!refusal.empty()) {
    command_ability_.count_refused_command(object_);
    node_.traffic().refuse(name_, refusal);
    return;
  }
  // Who only asks for lists must not end what another client commands.
  const bool commands_nothing = command_.type == state::CartesianCommandType::none && command_.joints.empty();
  if (commands_nothing && wishes) return;
  if (!port_) return;  // the object is gone, its topics soon are
  port_->post(command_);
  watch_.commanded();
}

void BodyEndpoint::publish(const state::Frame& frame, std::uint32_t slot) {
  const std::uint32_t wishes = wishes_.load();
  if (frame.structure->version != structure_version_ || wishes != wishes_seen_) {
    structure_version_ = frame.structure->version;
    wishes_seen_ = wishes;
    fill_names(*frame.structure, slot, message_, {wants_children_, wants_joint_names_, wants_joint_positions_});
  }
  fill(frame, slot, message_);
  publisher_.publish(message_);
}

}  // namespace ambf::ros_comm
