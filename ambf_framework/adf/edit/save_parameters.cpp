// Values that users change while the simulation runs, at the keys that give them.
#include <algorithm>
#include <cmath>

#include "adf/detail/save_present.h"
#include "scene/keys.h"

namespace ambf::adf {

namespace {

using state::Parameter;

struct KeyOf {
  Parameter parameter;
  std::vector<const char*> path;
};

const std::vector<KeyOf>& body_keys() {
  static const std::vector<KeyOf> keys = {{Parameter::friction, {"friction", "static"}},
                                          {Parameter::rolling_friction, {"friction", "rolling"}},
                                          {Parameter::restitution, {"restitution"}},
                                          {Parameter::linear_damping, {"damping", "linear"}},
                                          {Parameter::angular_damping, {"damping", "angular"}},
                                          {Parameter::linear_p, {"controller", "linear", "P"}},
                                          {Parameter::linear_i, {"controller", "linear", "I"}},
                                          {Parameter::linear_d, {"controller", "linear", "D"}},
                                          {Parameter::angular_p, {"controller", "angular", "P"}},
                                          {Parameter::angular_i, {"controller", "angular", "I"}},
                                          {Parameter::angular_d, {"controller", "angular", "D"}}};
  return keys;
}

const std::vector<KeyOf>& joint_keys() {
  static const std::vector<KeyOf> keys = {{Parameter::joint_p, {"controller", "P"}},
                                          {Parameter::joint_i, {"controller", "I"}},
                                          {Parameter::joint_d, {"controller", "D"}},
                                          {Parameter::joint_damping, {"damping"}}};
  return keys;
}

void set_number(Change& change, double wanted) { change.scalar = scene::text_of(wanted); }

// At a path of keys in a block; axes apart where they differ, or where the file has them apart.
void set_at(const Value& block, const std::vector<const char*>& path, const math::Vec3& wanted, bool per_axis,
            Change& change) {
  Change* at = &change;
  std::optional<Value> value = block;
  for (const char* key : path) {
    at = &at->key(key);
    if (value) value = value->find(key);
  }
  const bool apart = (value && value->is_map()) || wanted.x != wanted.y || wanted.y != wanted.z;
  if (!per_axis || !apart) return set_number(*at, wanted.x);
  set_number(at->key("x"), wanted.x), set_number(at->key("y"), wanted.y), set_number(at->key("z"), wanted.z);
}

// A controller that a file does not have drives velocities; with the key alone it would make forces.
void keep_output(const Value& block, bool velocity, Change& change) {
  if (change.find("controller") != nullptr && !block.find("controller") && velocity)
    change.key("controller output type").scalar = "VELOCITY";
}

template <class Parameters>
Change changed(const Value& block, const Tuned<Parameters>& tuned, const std::vector<KeyOf>& keys, bool velocity) {
  Change change;
  for (const KeyOf& key : keys) {
    const math::Vec3 now = value_of(tuned.now, key.parameter);
    if (now == value_of(tuned.loaded, key.parameter)) continue;
    set_at(block, key.path, now, state::info_of(key.parameter).per_axis, change);
  }
  keep_output(block, velocity, change);
  return change;
}

Change changed(const CameraNow& camera) {
  Change change;
  const state::Lens &was = camera.loaded, &is = camera.now;
  if (is.near_m != was.near_m) set_number(change.key("clipping plane").key("near"), is.near_m);
  if (is.far_m != was.far_m) set_number(change.key("clipping plane").key("far"), is.far_m);
  if (is.field_of_view_rad != was.field_of_view_rad) set_number(change.key("field view angle"), is.field_of_view_rad);
  if (is.eye_separation_m != was.eye_separation_m)
    set_number(change.key("stereo").key("eye separation"), is.eye_separation_m);
  if (is.focal_length_m != was.focal_length_m) set_number(change.key("stereo").key("focal length"), is.focal_length_m);
  if (is.stereo && !was.stereo) change.key("stereo").key("mode").scalar = "passive";
  if (is.orthographic && is.orthographic_width_m > 0.0 && !(is == was))
    set_number(change.key("orthographic view width"), is.orthographic_width_m);
  return change;
}

Change changed(const LightNow& light) {
  Change change;
  const state::Beam &was = light.loaded, &is = light.now;
  if (is.spot_exponent != was.spot_exponent) set_number(change.key("spot exponent"), is.spot_exponent);
  if (is.cutoff_angle_rad != was.cutoff_angle_rad) set_number(change.key("cutoff angle"), is.cutoff_angle_rad);
  if (is.shadow_quality != was.shadow_quality) change.key("shadow quality").scalar = std::to_string(is.shadow_quality);
  if (is.attenuation_constant != was.attenuation_constant)
    set_number(change.key("attenuation").key("constant"), is.attenuation_constant);
  if (is.attenuation_linear != was.attenuation_linear)
    set_number(change.key("attenuation").key("linear"), is.attenuation_linear);
  if (is.attenuation_quadratic != was.attenuation_quadratic)
    set_number(change.key("attenuation").key("quadratic"), is.attenuation_quadratic);
  return change;
}

template <class Object>
const Object* find_block(const std::vector<Object>& objects, const std::string& block) {
  const auto found =
      std::find_if(objects.begin(), objects.end(), [&](const Object& o) { return o.identity.identifier == block; });
  return found == objects.end() ? nullptr : &*found;
}

template <class Parameters>
bool same_where_changed(const Parameters& read, const Tuned<Parameters>& tuned, const std::vector<KeyOf>& keys) {
  return std::all_of(keys.begin(), keys.end(), [&](const KeyOf& key) {
    const math::Vec3 now = value_of(tuned.now, key.parameter);
    return now == value_of(tuned.loaded, key.parameter) || now == value_of(read, key.parameter);
  });
}

}  // namespace

std::vector<TunedBlock> tuned_blocks(const Value& root, const Present& present) {
  std::vector<TunedBlock> blocks;
  const auto add = [&](const char* list, const std::string& name, const auto& change_of) {
    const auto block = root.find(name);
    if (!block || !lists(root, list, name)) return;
    if (Change change = change_of(*block); !change.empty()) blocks.push_back({name, std::move(change)});
  };
  using state::ControllerOutput;
  for (const auto& body : present.tuned_bodies) {
    const bool velocity = body.loaded.linear.output == ControllerOutput::velocity &&
                          body.loaded.angular.output == ControllerOutput::velocity;
    add("bodies", body.block, [&](const Value& block) { return changed(block, body, body_keys(), velocity); });
  }
  for (const auto& joint : present.tuned_joints) {
    const bool velocity = joint.loaded.gains.output == ControllerOutput::velocity;
    add("joints", joint.block, [&](const Value& block) { return changed(block, joint, joint_keys(), velocity); });
  }
  for (const CameraNow& camera : present.cameras)
    add("cameras", camera.place.block, [&](const Value&) { return changed(camera); });
  for (const LightNow& light : present.lights)
    add("lights", light.place.block, [&](const Value&) { return changed(light); });
  return blocks;
}

bool reads_as_tuned(const scene::Model& after, const Present& present, const std::string& block) {
  for (const auto& body : present.tuned_bodies) {
    if (body.block != block) continue;
    const scene::Body* read = find_block(after.bodies, block);
    return read != nullptr && read->linear.output == body.loaded.linear.output &&
           read->angular.output == body.loaded.angular.output &&
           same_where_changed(state::BodyParameters{read->surface, read->linear, read->angular}, body, body_keys());
  }
  for (const auto& joint : present.tuned_joints) {
    if (joint.block != block) continue;
    const scene::Joint* read = find_block(after.joints, block);
    return read != nullptr && read->controller.output == joint.loaded.gains.output &&
           same_where_changed(state::JointParameters{read->controller, read->damping}, joint, joint_keys());
  }
  for (const CameraNow& camera : present.cameras) {
    if (camera.place.block != block) continue;
    const scene::Camera* read = find_block(after.cameras, block);
    return read != nullptr && read->lens == camera.now;
  }
  for (const LightNow& light : present.lights) {
    if (light.place.block != block) continue;
    const scene::Light* read = find_block(after.lights, block);
    return read != nullptr && read->beam == light.now;
  }
  return true;
}

}  // namespace ambf::adf
