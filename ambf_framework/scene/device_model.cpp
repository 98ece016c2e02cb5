#include "scene/device_model.h"

#include <algorithm>
#include <set>

namespace ambf::scene {

namespace {

bool ends_with(const std::string& text, const std::string& end) {
  return text.size() >= end.size() && text.compare(text.size() - end.size(), std::string::npos, end) == 0;
}

// How many bodies are above this one, over all joints.
std::size_t parents_of(const Model& model, const std::string& body) {
  std::set<std::string> above;
  std::vector<std::string> open = {body};
  while (!open.empty()) {
    const std::string child = open.back();
    open.pop_back();
    for (const Joint& joint : model.joints) {
      if (joint.child == child && above.insert(joint.parent).second) open.push_back(joint.parent);
    }
  }
  return above.size();
}

Body* find_root(Model& model, const std::string& root_link) {
  const auto named = [&](const auto& fits) {
    const auto found = std::find_if(model.bodies.begin(), model.bodies.end(), fits);
    return found == model.bodies.end() ? nullptr : &*found;
  };
  if (!root_link.empty()) {
    Body* exact = named(
        [&](const Body& body) { return body.identity.name == root_link || body.identity.identifier == root_link; });
    return exact != nullptr ? exact
                            : named([&](const Body& body) { return ends_with(body.identity.identifier, root_link); });
  }
  Body* best = nullptr;
  std::size_t fewest = 0;
  for (Body& body : model.bodies) {
    const std::size_t parents = parents_of(model, body.identity.identifier);
    if (best != nullptr && parents >= fewest) continue;
    best = &body;
    fewest = parents;
  }
  return best;
}

}  // namespace

std::string name_of_root_link(const std::string& device) { return "simulated_device/" + device; }

std::optional<math::Pose> make_device_model(Model& model, const std::string& device, const std::string& root_link) {
  Body* const root = find_root(model, root_link);
  if (root == nullptr) return std::nullopt;
  for (Body& body : model.bodies) body.identity.passive = true;
  root->identity.passive = false;
  root->identity.name = name_of_root_link(device);
  return root->T_world_body;
}

}  // namespace ambf::scene
