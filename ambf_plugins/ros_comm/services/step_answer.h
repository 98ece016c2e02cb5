// The states in a Step service's answer. What does not change from step to step (names, lengths of arrays) is put there while the steps run:
// who steps waits only for the rest. One thread. Private to ros_comm. C++17.
#pragma once

#include <ambf_msgs/Step.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "state/frame.h"

namespace ambf::ros_comm {

class StepAnswer {
 public:
  // wanted: full or unambiguous names of bodies, cameras, lights. Both live as long as this.
  StepAnswer(const std::vector<std::string>& wanted, ambf_msgs::Step::Response& response)
      : wanted_(wanted), response_(response) {}

  void prepare(std::shared_ptr<const state::Structure> structure);
  // Nothing was run: there are no states.
  void clear();
  // Makes the answer complete. Names that are of nothing are left out, and said.
  void fill(const state::Frame& frame);

 private:
  template <class List>
  void add(List& list, std::vector<std::uint32_t>& slots, std::uint32_t object);

  const std::vector<std::string>& wanted_;
  ambf_msgs::Step::Response& response_;
  std::shared_ptr<const state::Structure> structure_;                   // what is prepared belongs to
  std::vector<std::uint32_t> body_slots_, camera_slots_, light_slots_;  // of the answer's states, in their order
  std::vector<std::string> unknown_;
};

}  // namespace ambf::ros_comm
