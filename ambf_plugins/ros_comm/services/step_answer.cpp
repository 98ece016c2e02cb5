#include "ros_comm/services/step_answer.h"

#include "ros_comm/endpoints/conversions.h"

namespace ambf::ros_comm {

template <class List>
void StepAnswer::add(List& list, std::vector<std::uint32_t>& slots, std::uint32_t object) {
  const std::uint32_t slot = structure_->objects[object].slot;
  slots.push_back(slot);
  list.emplace_back();
  fill_names(*structure_, slot, list.back());
}

void StepAnswer::clear() {
  structure_ = nullptr;
  for (std::vector<std::uint32_t>* slots : {&body_slots_, &camera_slots_, &light_slots_}) slots->clear();
  unknown_.clear();
  response_.rigid_bodies.clear();
  response_.cameras.clear();
  response_.lights.clear();
  response_.state_sizes.clear();
}

void StepAnswer::prepare(std::shared_ptr<const state::Structure> structure) {
  clear();
  structure_ = std::move(structure);
  response_.rigid_bodies.reserve(wanted_.size());
  for (const std::string& name : wanted_) {
    const auto find = [&](state::ObjectKind kind) { return state::find(*structure_, name, kind); };
    if (const auto body = find(state::ObjectKind::rigid_body); body != state::kNone) {
      add(response_.rigid_bodies, body_slots_, body);
    } else if (const auto camera = find(state::ObjectKind::camera); camera != state::kNone) {
      add(response_.cameras, camera_slots_, camera);
    } else if (const auto light = find(state::ObjectKind::light); light != state::kNone) {
      add(response_.lights, light_slots_, light);
    } else {
      unknown_.push_back(name);
    }
  }
  // All lengths stand already.
  response_.state_sizes.assign(1, ros::serialization::serializationLength(response_.world));
  const auto add_sizes = [this](const auto& states) {
    for (const auto& each : states) response_.state_sizes.push_back(ros::serialization::serializationLength(each));
  };
  add_sizes(response_.rigid_bodies);
  add_sizes(response_.cameras);
  add_sizes(response_.lights);
}

void StepAnswer::fill(const state::Frame& frame) {
  if (frame.structure != structure_) prepare(frame.structure);  // something was loaded or removed meanwhile
  const auto fill_all = [&frame](auto& states, const std::vector<std::uint32_t>& slots) {
    for (std::size_t i = 0; i < slots.size(); ++i) ros_comm::fill(frame, slots[i], states[i]);
  };
  ros_comm::fill(frame, response_.world);
  fill_all(response_.rigid_bodies, body_slots_);
  fill_all(response_.cameras, camera_slots_);
  fill_all(response_.lights, light_slots_);
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
