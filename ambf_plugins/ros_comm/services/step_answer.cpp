#include "ros_comm/services/step_answer.h"

#include <algorithm>
#include <numeric>

#include "base/bounds.h"
#include "ros_comm/endpoints/conversions.h"
#include "ros_comm/endpoints/endpoint_kinds.h"

namespace ambf::ros_comm {

namespace {
constexpr std::size_t kManyWanted = 64;     // from here on, names are looked up in a table
constexpr std::size_t kMaxSearches = 1024;  // for unknown names among parts of all names; later ones must be whole
constexpr std::size_t kShownUnknown = 16;   // names in messages
}  // namespace

StepAnswer::StepAnswer(const std::vector<std::string>& wanted, StepResponse& response)
    : wanted_(wanted), response_(response) {
  for (const auto& [kind, entry] : endpoint_kinds()) {
    if (entry.step != nullptr) parts_.push_back({kind, entry.step, {}});
  }
}

void StepAnswer::clear() {
  structure_ = nullptr;
  by_name_.clear();
  unknown_.clear();
  unknown_count_ = 0;
  response_.state_sizes.clear();
  for (Part& part : parts_) {
    part.slots.clear();
    part.lists->clear(response_);
  }
}

std::string StepAnswer::refusal(const std::vector<std::string>& wanted, const state::Structure& structure) {
  const std::size_t most = std::max(structure.objects.size(), base::kMinWantedStates);
  if (wanted.size() > most) {
    return std::to_string(wanted.size()) + " states are wanted; expected at most " + std::to_string(most) +
           ", as many as there are objects or " + std::to_string(base::kMinWantedStates);
  }
  const bool short_names =
      std::all_of(wanted.begin(), wanted.end(), [](const std::string& name) { return name.size() <= base::kMaxPath; });
  return short_names ? "" : "a wanted state has a name of over " + std::to_string(base::kMaxPath) + " bytes";
}

std::string StepAnswer::too_large() const {
  const std::size_t bytes = std::accumulate(response_.state_sizes.begin(), response_.state_sizes.end(), std::size_t{0});
  if (bytes <= base::kMaxStepAnswer) return {};
  return "the steps were run, but the wanted states take " + std::to_string(bytes >> 20) +
         " MB, and an answer holds at most " + std::to_string(base::kMaxStepAnswer >> 20) + " MB: none is in it";
}

void StepAnswer::index_names() {
  by_name_.clear();
  if (wanted_.size() < kManyWanted) return;
  for (std::uint32_t i = 0; i < structure_->objects.size(); ++i) {
    const state::ObjectInfo& object = structure_->objects[i];
    by_name_.emplace(object.name, i);
    by_name_.emplace(object.identifier, i);
  }
}

bool StepAnswer::add(const std::string& name) {
  const auto known = by_name_.find(name);
  if (known == by_name_.end() && unknown_count_ >= kMaxSearches) return false;
  Part* chosen = nullptr;
  std::uint32_t slot = 0;
  for (Part& part : parts_) {
    const std::uint32_t object = known != by_name_.end() && structure_->objects[known->second].kind == part.kind
                                     ? known->second
                                     : state::find(*structure_, name, part.kind);
    if (object == state::kNone) continue;
    const state::ObjectInfo& found = structure_->objects[object];
    const bool is_whole = name == found.name || name == found.identifier || name == found.local_name;
    if (chosen == nullptr || is_whole) {
      chosen = &part;
      slot = found.slot;
    }
    if (is_whole) break;  // else it is part of a name, which another kind's object may have as a whole
  }
  if (chosen == nullptr) return false;
  chosen->slots.push_back(slot);
  chosen->lists->append(*structure_, slot, response_);
  return true;
}

void StepAnswer::prepare(std::shared_ptr<const state::Structure> structure) {
  clear();
  structure_ = std::move(structure);
  response_.rigid_bodies.reserve(wanted_.size());
  index_names();
  for (const std::string& name : wanted_) {
    if (add(name)) continue;
    if (++unknown_count_ <= kShownUnknown) unknown_.push_back(name);
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
  if (unknown_count_ > unknown_.size())
    response_.message += "; nor " + std::to_string(unknown_count_ - unknown_.size()) + " more";
}

}  // namespace ambf::ros_comm
