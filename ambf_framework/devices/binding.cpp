#include "devices/binding.h"

#include <algorithm>

#include "scene/device_model.h"

namespace ambf::devices {

using state::kNone;
using state::ObjectInfo;
using state::Structure;

namespace {

// The object with this name (state::find) among those of the rows' kind.
template <class Rows>
std::uint32_t find_among(const Rows& rows, const Structure& structure, const std::string& name) {
  return rows.empty() ? kNone : state::find(structure, name, structure.objects[rows.front().object].kind);
}

const state::ModelInfo* find_model(const Structure& structure, const std::string& name) {
  const auto found = std::find_if(structure.models.begin(), structure.models.end(),
                                  [&](const state::ModelInfo& model) { return model.name == name; });
  return found == structure.models.end() ? nullptr : &*found;
}

// How many bodies are above this one.
std::size_t parents_of(const Structure& structure, std::uint32_t object) {
  return static_cast<std::size_t>(
      std::count_if(structure.bodies.begin(), structure.bodies.end(), [object](const state::BodyInfo& body) {
        return std::find(body.children.begin(), body.children.end(), object) != body.children.end();
      }));
}

// Of the bodies of one model: the one called `name`, or that with the fewest parents, the first of these.
std::uint32_t find_in_model(const Structure& structure, state::ModelId model, const std::string& name) {
  std::uint32_t best = kNone;
  std::size_t fewest = 0;
  for (const state::BodyInfo& body : structure.bodies) {
    const ObjectInfo& object = structure.objects[body.object];
    if (object.model != model) continue;
    if (!name.empty()) {
      if (object.local_name == name || object.name == name || object.identifier == name) return body.object;
      const std::size_t at = object.identifier.size() - std::min(object.identifier.size(), name.size());
      if (best == kNone && object.identifier.compare(at, std::string::npos, name) == 0) best = body.object;
      continue;
    }
    const std::size_t parents = parents_of(structure, body.object);
    if (best != kNone && parents >= fewest) continue;
    best = body.object;
    fewest = parents;
  }
  return best;
}

std::uint32_t find_body(const Structure& structure, const scene::InputDevice& device, const std::string& multibody,
                        std::string& problem) {
  std::uint32_t object = kNone;
  if (device.multibody_file.empty()) {
    object = find_among(structure.bodies, structure, device.root_link);
    if (object == kNone) problem = "no body, or more than one, is called '" + device.root_link + "'; it is waited for";
  } else if (const state::ModelInfo* model = find_model(structure, multibody)) {
    object = find_in_model(structure, model->id, scene::name_of_root_link(device.name));
    if (object == kNone) object = find_in_model(structure, model->id, device.root_link);
    if (object == kNone) problem = "'" + device.multibody_file + "' has no body '" + device.root_link + "'";
  } else {
    problem = "'" + device.multibody_file + "' is not loaded";
  }
  if (object == kNone) return kNone;
  if (structure.bodies[structure.objects[object].slot].mass > 0.0) return object;
  problem = "'" + structure.objects[object].name + "' is static: a device moves bodies that have a mass";
  return kNone;
}

double largest(const math::Vec3& v) { return std::max({v.x, v.y, v.z}); }

}  // namespace

state::EffectorGains own_gains(const Structure& structure, std::uint32_t body) {
  const state::BodyInfo& info = structure.bodies[body];
  double mass = info.mass, inertia = largest(info.inertia);
  for (const std::uint32_t child : info.children) {
    const state::BodyInfo& below = structure.bodies[structure.objects[child].slot];
    mass += below.mass;
    inertia += largest(below.inertia);
  }
  const auto all = [](double value) { return math::Vec3{value, value, value}; };
  state::EffectorGains gains;
  const state::BodyParameters& own = info.parameters;
  const bool linear_forces = info.linear_output == state::ControllerOutput::force;
  const bool angular_forces = info.angular_output == state::ControllerOutput::force;
  gains.linear_stiffness = linear_forces ? own.linear.p : all(mass * kOwnFrequency * kOwnFrequency);
  gains.linear_damping = linear_forces ? own.linear.d : all(2.0 * mass * kOwnFrequency);
  gains.angular_stiffness = angular_forces ? own.angular.p : all(inertia * kOwnFrequency * kOwnFrequency);
  gains.angular_damping = angular_forces ? own.angular.d : all(2.0 * inertia * kOwnFrequency);
  return gains;
}

Places find_places(const Structure& structure, const scene::InputDevice& device, const std::string& multibody) {
  Places places;
  const auto add_camera = [&](const ObjectInfo& object) {
    places.cameras.push_back(object.id);
    places.camera_names.push_back(object.name);
  };
  for (const std::string& name : device.cameras) {
    const std::uint32_t object = find_among(structure.cameras, structure, name);
    if (object != kNone) add_camera(structure.objects[object]);
  }
  if (device.cameras.empty()) {
    for (const state::CameraInfo& camera : structure.cameras) add_camera(structure.objects[camera.object]);
  }

  const std::uint32_t object = find_body(structure, device, multibody, places.problem);
  if (object == kNone) return places;
  places.body = structure.objects[object].id;
  places.body_name = structure.objects[object].name;
  const std::uint32_t slot = structure.objects[object].slot;
  places.own_gains = own_gains(structure, slot);
  for (const std::uint32_t joint : structure.bodies[slot].joints) {
    const state::JointInfo& info = structure.joints[joint];
    const bool opens = info.type == state::JointType::revolute || info.type == state::JointType::prismatic;
    if (opens && info.has_limits) places.jaw_joints.push_back(structure.objects[info.object].id);
  }
  return places;
}

}  // namespace ambf::devices
