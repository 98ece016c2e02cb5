#include "ros_comm/services/step_answer.h"

#include "ros_comm/endpoints/conversions.h"
#include "ros_comm/endpoints/endpoint_kinds.h"

namespace ambf::ros_comm {

StepAnswer::StepAnswer(const std::vector<std::string>& wanted, StepResponse& response)
    : wanted_(wanted), response_(response) {
  for (const auto& [kind, entry] : endpoint_kinds()) {
    if (entry.step != nullptr) parts_.push_back({kind, entry.step, {}});
  }
}

void StepAnswer::clear() {
  structure_ = nullptr;
  unknown_.clear();
  response_.state_sizes.clear();
  for (Part& part : parts_) {
    part.slots.clear();
    part.lists->clear(response_);
  }
}

bool StepAnswer::add(const std::string& name) {
  for (Part& part : parts_) {
    const std::uint32_t object = state::find(*structure_, name, part.kind);
    if (object == state::kNone) continue;
    part.slots.push_back(structure_->objects[object].slot);
    part.lists->append(*structure_, part.slots.back(), response_);
    return true;
  }
  return false;
}

void StepAnswer::prepare(std::shared_ptr<const state::Structure> structure) {
  clear();
  structure_ = std::move(structure);
  response_.rigid_bodies.reserve(wanted_.size());
  for (const std::string& name : wanted_) {
    if (!add(name)) unknown_.push_back(name);
  }
  // All lengths are final already.
  response_.state_sizes.assign(1, ros::serialization::serializationLength(response_.world));
  for (const Part& part : parts_) part.lists->append_sizes(response_);
}

void StepAnswer::fill(const state::Frame& frame) {
  if (frame.structure != structure_) prepare(frame.structure);  // objects were loaded or removed meanwhile
  ros_comm::fill(frame, response_.world);
  for (const Part& part : parts_) part.lists->fill(frame, part.slots, response_);
  for (const std::string& name : unknown_) {
    base::Diagnostic unknown;
    unknown.severity = base::Severity::warning;
    unknown.message = "there is no object '" + name + "': its state is missing";
    unknown.hint = "the service List names all";
    response_.diagnostics.push_back(to_ros(unknown));
    response_.message += (response_.message.empty() ? "" : "; ") + ("there is no object '" + name + "'");
  }
}

}  // namespace ambf::ros_comm
