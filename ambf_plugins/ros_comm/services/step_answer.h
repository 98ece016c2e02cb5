// The states in a Step service's answer. What does not change from step to step (names, lengths of arrays) is filled in
// while the steps run, so that the client waits only for the rest. One thread. Private to ros_comm. C++17.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "ros_comm/services/step_lists.h"

namespace ambf::ros_comm {

class StepAnswer {
 public:
  // wanted: full or unambiguous names of objects whose kind has a list in the answer. Both arguments outlive this.
  StepAnswer(const std::vector<std::string>& wanted, StepResponse& response);

  // Empty, or why a request that wants these states is refused (base/bounds.h).
  static std::string refusal(const std::vector<std::string>& wanted, const state::Structure& structure);

  void prepare(std::shared_ptr<const state::Structure> structure);
  // Nothing was run: there are no states.
  void clear();
  // Completes the answer. Unknown names are left out and reported as warnings.
  void fill(const state::Frame& frame);
  // Empty, or why what was filled in must not be sent.
  std::string too_large() const;

 private:
  struct Part {
    state::ObjectKind kind;
    const StepLists* lists;
    std::vector<std::uint32_t> slots;  // of the kind's states in the answer, in their order
  };
  void index_names();
  bool add(const std::string& name);

  const std::vector<std::string>& wanted_;
  StepResponse& response_;
  std::shared_ptr<const state::Structure> structure_;            // that the prepared states belong to
  std::vector<Part> parts_;                                      // in the order of their lists in the answer
  std::unordered_map<std::string_view, std::uint32_t> by_name_;  // of structure_, where many are wanted
  std::vector<std::string> unknown_;                             // the first of them
  std::size_t unknown_count_ = 0;
};

}  // namespace ambf::ros_comm
