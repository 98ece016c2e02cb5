#include "adf/crtk/mount.h"

#include <algorithm>

#include "adf/adf.h"
#include "adf/detail/text_edit.h"
#include "adf/save.h"
#include "scene/chain.h"
#include "scene/lookup.h"

namespace ambf::adf {

namespace {

std::string without_blanks(std::string name) {
  name.erase(std::remove(name.begin(), name.end(), ' '), name.end());
  return name;
}

// What follows the namespace.
std::string block_of(const std::string& written) { return written.substr(written.rfind('/') + 1); }

bool is_block_of(const scene::Model& model, const std::string& written) {
  return std::any_of(model.bodies.begin(), model.bodies.end(), [&](const scene::Body& body) {
    return body.identity.identifier == written || body.identity.name_space + body.identity.identifier == written;
  });
}

void replace_all(std::string& text, const std::string& from, const std::string& to) {
  if (from.empty() || from == to) return;
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size())) {
    text.replace(at, from.size(), to);
  }
}

// The model with the carrier as its last body, so that its joints can be followed from there.
scene::Model with_carrier(const scene::Model& model, const Place& place) {
  scene::Model whole = model;
  scene::Body carrier;
  carrier.identity.name_space = model.bodies.front().identity.name_space;
  carrier.identity.identifier = place.carrier;
  whole.bodies.push_back(std::move(carrier));
  return whole;
}

// Poses of the model's bodies, found from the carrier joint by joint.
std::vector<BodyPlace> places_of(const scene::Model& model, const Place& place) {
  const scene::Model whole = with_carrier(model, place);
  const std::vector<kinematics::MechanismJoint> joints = scene::mechanism_joints(whole);
  std::vector<std::optional<math::Pose>> poses(whole.bodies.size());
  poses.back() = place.T_world_carrier;
  for (bool grows = true; grows;) {
    grows = false;
    for (const kinematics::MechanismJoint& joint : joints) {
      if (joint.kind == kinematics::MechanismJoint::Kind::point || !poses[joint.parent] || poses[joint.child]) continue;
      const auto given = place.positions.find(without_blanks(joint.name));
      double position = given == place.positions.end() ? 0.0 : given->second;
      const scene::Joint* described = find_joint(whole, joint.name);
      if (described != nullptr && described->limits) {
        position = std::clamp(position, (*described->limits)[0], (*described->limits)[1]);
      }
      poses[joint.child] = *poses[joint.parent] * kinematics::at_position(joint, position);
      grows = true;
    }
  }
  std::vector<BodyPlace> made;
  for (std::size_t i = 0; i < model.bodies.size(); ++i) {
    if (poses[i]) made.push_back({model.bodies[i].identity.identifier, *poses[i]});
  }
  return made;
}

// Joints of the file that hang on bodies of the arm name those as the scene does.
void name_parents(const std::string& file, const scene::Model& model, const Place& place, Mounted& made) {
  Change change;
  for (const scene::Joint& joint : model.joints) {
    const std::string block = carrier_of(model, joint);
    if (block.empty()) continue;
    const auto found = scene::find_numbered(place.identifiers, place.name_space + block);
    if (!found || place.identifiers[*found] == place.name_space + block) continue;
    change.key(joint.identity.identifier).key("parent").scalar = place.identifiers[*found];
  }
  if (change.empty()) return;
  EditedText edited = edit(*made.text, Document(*made.text), change);
  if (edited.error) {
    made.diagnostics.push_back({base::Severity::error,
                                file,
                                edited.error->mark.line,
                                edited.error->mark.column,
                                {},
                                "parent",
                                edited.error->message,
                                edited.error->hint});
  }
  made.text = std::move(edited.text);
}

base::Diagnostic refusal(const std::string& file, const std::string& block, const std::string& message) {
  return {base::Severity::error, file, 0, 0, block, {}, message, "each body hangs on the arm by joints of the file"};
}

}  // namespace

std::vector<std::string> moved_joints(const kinematics::Arm& arm) {
  std::vector<std::string> names;
  for (const kinematics::AdfJoint& joint : arm.adf_joints) names.push_back(joint.name);
  for (const kinematics::JawHalf& half : arm.adf_jaw) names.push_back(half.name);
  return names;
}

const scene::Joint* find_joint(const scene::Model& model, const std::string& name) {
  for (const scene::Joint& joint : model.joints) {
    if (without_blanks(joint.identity.name) == without_blanks(name)) return &joint;
  }
  return nullptr;
}

std::string carrier_of(const scene::Model& model, const scene::Joint& joint) {
  return is_block_of(model, joint.parent) ? std::string() : block_of(joint.parent);
}

Mounted mounted(const std::string& file, const Place& place) {
  Mounted made;
  Options options;
  options.look_for_files = false;
  const ModelResult read = load_model(file, options);
  if (!read.model || read.text == nullptr || read.model->bodies.empty()) {
    made.diagnostics = read.diagnostics;
    if (made.diagnostics.empty()) made.diagnostics.push_back(refusal(file, {}, "it has no bodies"));
    return made;
  }
  SaveOrder order;
  order.text = *read.text;
  order.from = order.to = file;
  order.present.bodies = places_of(*read.model, place);
  if (order.present.bodies.size() != read.model->bodies.size()) {
    for (const scene::Body& body : read.model->bodies) {
      const bool placed = std::any_of(order.present.bodies.begin(), order.present.bodies.end(),
                                      [&](const auto& each) { return each.block == body.identity.identifier; });
      if (placed) continue;
      made.diagnostics.push_back(
          refusal(file, body.identity.identifier, "no joints lead from '" + place.carrier + "' to it"));
    }
    return made;
  }
  SavedModel saved = save_model(order, options);
  made.diagnostics = std::move(saved.diagnostics);
  if (!saved.text) return made;
  replace_all(*saved.text, read.model->bodies.front().identity.name_space, place.name_space);
  made.text = std::move(saved.text);
  name_parents(file, *read.model, place, made);
  return made;
}

}  // namespace ambf::adf
