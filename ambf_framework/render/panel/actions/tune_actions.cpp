#include "render/panel/actions/tune_actions.h"

#include "render/scene/object_kind.h"

namespace ambf::render {

void TuneActions::observe(const state::Frame& frame) {
  if (frame_ == nullptr) gravity_loaded_ = frame.gravity_world;
  frame_ = &frame;
  if (frame.parameters_version != parameters_version_ || frame.structure->version != structure_version_) list_changed();
}

math::Vec3 TuneActions::now(const state::ObjectInfo& object, state::Parameter parameter) const {
  return is_body(object) ? state::value_of(frame_->body_parameters[object.slot], parameter)
                         : state::value_of(frame_->joint_parameters[object.slot], parameter);
}

math::Vec3 TuneActions::loaded(const state::ObjectInfo& object, state::Parameter parameter) const {
  return is_body(object) ? state::value_of(structure().bodies[object.slot].parameters, parameter)
                         : state::value_of(structure().joints[object.slot].parameters, parameter);
}

void TuneActions::list_changed() {
  parameters_version_ = frame_->parameters_version;
  structure_version_ = structure().version;
  changed_.clear();
  for (const state::ObjectInfo& object : structure().objects) {
    if (!is_body(object) && !is_joint(object)) continue;
    const bool same = is_body(object)
                          ? frame_->body_parameters[object.slot] == structure().bodies[object.slot].parameters
                          : frame_->joint_parameters[object.slot] == structure().joints[object.slot].parameters;
    if (same) continue;
    for (int i = 0; i < state::kParameterCount; ++i) {
      const auto parameter = static_cast<state::Parameter>(i);
      if (state::info_of(parameter).kind != object.kind) continue;
      const math::Vec3 value = now(object, parameter), before = loaded(object, parameter);
      if (!(value == before)) changed_.push_back({object.id, parameter, before, value});
    }
  }
}

void TuneActions::set(state::ObjectId object, state::Parameter parameter, const math::Vec3& value) {
  tune_.set_parameter(object, parameter, value, notices_.remark(state::info_of(parameter).name));
}

void TuneActions::revert(state::ObjectId object, state::Parameter parameter) {
  const std::uint32_t index = state::find(structure(), object);
  if (index != state::kNone) set(object, parameter, loaded(structure().objects[index], parameter));
}

void TuneActions::revert_all() {
  for (const Changed& change : changed_) set(change.object, change.parameter, change.loaded);
  if (!(frame_->gravity_world == gravity_loaded_)) set_gravity(gravity_loaded_);
}

void TuneActions::set_lens(state::ObjectId camera, const state::Lens& lens) {
  const std::string why = state::check(lens);
  why.empty() ? tune_.set_lens(camera, lens) : notices_.show("lens: " + why);
}

void TuneActions::set_beam(state::ObjectId light, const state::Beam& beam) {
  const std::string why = state::check(beam);
  why.empty() ? tune_.set_beam(light, beam) : notices_.show("beam: " + why);
}

}  // namespace ambf::render
