// The lists of one kind in the Step service: names and commands in its request, states in its answer. Private to
// ros_comm. C++17.
#pragma once

#include <ambf_msgs/Step.h>

#include <functional>
#include <string>
#include <vector>

#include "ros_comm/endpoints/names_objects.h"
#include "state/command.h"
#include "state/frame.h"
#include "state/structure.h"

namespace ambf::ros_comm {

using StepRequest = ambf_msgs::Step::Request;
using StepResponse = ambf_msgs::Step::Response;

class StepLists {
 public:
  virtual ~StepLists() = default;

  // Calls `visit` for each command with the name of its object and the reason to refuse it (empty: none). False: the
  // lists of names and of commands differ in length; nothing is visited then.
  using Visit = std::function<void(const std::string& name, const std::string& refusal, state::Command command)>;
  virtual bool read(const StepRequest& request, const state::Structure& structure, const Visit& visit) const = 0;

  virtual void clear(StepResponse& response) const = 0;
  // Appends the state of the object in this slot: everything but what changes from step to step, all lengths included.
  virtual void append(const state::Structure& structure, std::uint32_t slot, StepResponse& response) const = 0;
  // Appends the serialized size of each state.
  virtual void append_sizes(StepResponse& response) const = 0;
  // Fills in the values of a frame; slots[i] belongs to the i-th state.
  virtual void fill(const state::Frame& frame, const std::vector<std::uint32_t>& slots,
                    StepResponse& response) const = 0;
};

// `Messages`: as in ros_comm/endpoints/object_endpoint.h; where commands name other objects it has kind(), too.
template <class Messages>
class StepListsOf final : public StepLists {
 public:
  using Names = std::vector<std::string> StepRequest::*;
  using Commands = std::vector<typename Messages::Command> StepRequest::*;
  using States = std::vector<typename Messages::State> StepResponse::*;
  // Null names: objects of this kind take no commands in the Step service.
  StepListsOf(Names names, Commands commands, States states) : names_(names), commands_(commands), states_(states) {}

  bool read(const StepRequest& request, const state::Structure& structure, const Visit& visit) const override {
    if (names_ == nullptr) return true;
    const auto& names = request.*names_;
    const auto& commands = request.*commands_;
    if (names.size() != commands.size()) return false;
    for (std::size_t i = 0; i < names.size(); ++i) {
      state::Command command;
      const std::string refusal = read_one(names[i], commands[i], structure, command);
      visit(names[i], refusal, std::move(command));
    }
    return true;
  }
  void clear(StepResponse& response) const override { (response.*states_).clear(); }
  void append(const state::Structure& structure, std::uint32_t slot, StepResponse& response) const override {
    (response.*states_).emplace_back();
    Messages::fill_names(structure, slot, (response.*states_).back());
  }
  void append_sizes(StepResponse& response) const override {
    for (const auto& state : response.*states_) {
      response.state_sizes.push_back(ros::serialization::serializationLength(state));
    }
  }
  void fill(const state::Frame& frame, const std::vector<std::uint32_t>& slots, StepResponse& response) const override {
    for (std::size_t i = 0; i < slots.size(); ++i) Messages::fill(frame, slots[i], (response.*states_)[i]);
  }

 private:
  static std::string read_one([[maybe_unused]] const std::string& name, const typename Messages::Command& message,
                              [[maybe_unused]] const state::Structure& structure, state::Command& command) {
    if constexpr (kNamesObjects<Messages>) {
      const std::uint32_t object = state::find(structure, name, Messages::kind());
      return object == state::kNone ? std::string() : Messages::read(message, structure, object, command);
    } else {
      return Messages::read(message, command);
    }
  }

  const Names names_;
  const Commands commands_;
  const States states_;
};

}  // namespace ambf::ros_comm
