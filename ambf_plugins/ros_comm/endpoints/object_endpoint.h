// The State/Command pair of an object of any kind. What is in the messages is given by a struct `Messages`, one a kind:
//
//   using State = ..., Command = ...;  // message types
//   // What changes only with the structure, and with each frame.
//   static void fill_names(const state::Structure&, std::uint32_t slot, State&);
//   static void fill(const state::Frame&, std::uint32_t slot, State&);
//   // Empty, or why the command is refused.
//   static std::string read(const Command&, state::Command&);
//   // Instead, where commands name other objects: their names are looked up in the newest structure; `object` (index
//   // into Structure::objects) is the one that is commanded.
//   static std::string read(const Command&, const state::Structure&, std::uint32_t object, state::Command&);
//
// For the files of kinds, here and in programs that register further kinds. C++17.
#pragma once

#include <string>

#include "comm/middleware.h"
#include "ros_comm/endpoints/command_input.h"
#include "ros_comm/endpoints/endpoint_kinds.h"
#include "ros_comm/endpoints/names_objects.h"
#include "ros_comm/endpoints/topics.h"
#include "state/structure.h"

namespace ambf::ros_comm {

template <class Messages>
class ObjectEndpoint : public comm::Endpoint {
 public:
  ObjectEndpoint(const EndpointParts& parts, const state::ObjectInfo& object, const std::string& topic)
      : observe_(parts.simulation.observe),
        object_(object.id),
        commands_(parts.node.traffic(), parts.simulation.command, object),
        publisher_(parts.node, topic + "/State"),
        subscriber_(
            parts.node, topic + "/Command",
            [this](const ros::MessageEvent<const Command>& event) { on_command(*event.getConstMessage()); },
            [this](const std::string& why) { commands_.refuse(why); }) {}

  bool has_subscribers() const override { return publisher_.subscribers() > 0; }
  std::uint32_t step_interval() const final { return publisher_.step_interval(); }
  bool has_newcomers() const final { return publisher_.newcomers(); }
  void watch(const state::Frame&, bool active) override { commands_.watch(active); }

  void publish(const state::Frame& frame, std::uint32_t slot) override {
    if (frame.structure->version != structure_version_) {
      structure_version_ = frame.structure->version;
      Messages::fill_names(*frame.structure, slot, message_);
    }
    Messages::fill(frame, slot, message_);
    publisher_.publish(message_);
  }

 private:
  using Command = typename Messages::Command;

  void on_command(const Command& message) {
    state::Command command;
    std::string refusal;
    if constexpr (kNamesObjects<Messages>) {
      const std::shared_ptr<const state::Structure> structure = observe_.structure();
      const std::uint32_t object = state::find(*structure, object_);
      if (object == state::kNone) return;  // it was removed, its topics close soon
      refusal = Messages::read(message, *structure, object, command);
    } else {
      refusal = Messages::read(message, command);
    }
    refusal.empty() ? commands_.post(command) : commands_.refuse(refusal);
  }

  state::ObserveAbility& observe_;
  const state::ObjectId object_;
  CommandInput commands_;
  typename Messages::State message_;  // publisher thread
  std::uint64_t structure_version_ = ~std::uint64_t{0};
  StatePublisher<typename Messages::State> publisher_;
  CommandSubscriber<Command> subscriber_;  // last: callbacks use all of the above
};

}  // namespace ambf::ros_comm
