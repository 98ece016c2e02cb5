#include "render/panel/panel_model.h"

#include <algorithm>

#include "render/scene/object_kind.h"
#include "state/kind_rows.h"

namespace ambf::render {

namespace {

constexpr std::int64_t kSaveEvery_ns = 3'000'000'000;

}  // namespace

PanelModel::PanelModel(Services services)
    : held(services.simulation.command),
      gizmo(services.simulation.command, services.simulation.pick),
      services_(std::move(services)) {
  if (services_.messages == nullptr) services_.messages = std::make_shared<Messages>();
  if (!services_.settings_file.empty()) {
    std::string problem;
    const auto complain = [&](const std::string& file) {
      if (!problem.empty()) services_.log.warning("the panel's settings, %s: %s", file.c_str(), problem.c_str());
    };
    settings = read_settings(services_.settings_file, problem);
    complain(services_.settings_file);
    if (!services_.scene.empty()) {
      layout_file_ = layout_path(services_.settings_file, services_.scene);
      read_layout(layout_file_, settings, problem);
      complain(layout_file_);
    }
  }
  saved_ = settings;
  for (const std::string& name : settings.plotted) traces.add(name);
}

PanelModel::~PanelModel() {
  held.release_all();
  save_settings();
}

void PanelModel::observe(const state::Frame& frame, std::int64_t now_ns) {
  frame_ = &frame;
  now_ns_ = now_ns;
  if (services_.recording != nullptr) {
    for (const std::string& text : services_.recording->take_messages()) say(text);
  }
  if (!gravity_seen_) {
    gravity_seen_ = true;
    gravity_loaded_ = frame.gravity_world;
  }
  held.keep_alive(frame, now_ns);
  if (const std::string told = gizmo.observe(frame, now_ns); !told.empty()) say(told);
  history.take(frame, now_ns);
  commands.take(frame, now_ns);
  traces.take(frame);
  if (frame.parameters_version != parameters_version_ || frame.structure->version != structure_version_) list_changed();
  structure_version_ = frame.structure->version;
  if (selected_.valid() && state::find(*frame.structure, selected_) == state::kNone) selected_ = {};
  if (now_ns - saved_ns_ > kSaveEvery_ns) {
    saved_ns_ = now_ns;
    save_settings();
  }
}

void PanelModel::say(const std::string& text) { services_.messages->add(text); }

void PanelModel::save_settings() {
  if (services_.settings_file.empty() || settings == saved_) return;
  saved_ = settings;
  const bool kept = write_settings(services_.settings_file, settings);
  const bool layout_kept = layout_file_.empty() || write_layout(layout_file_, services_.scene, settings);
  if ((kept && layout_kept) || save_refused_) return;
  save_refused_ = true;  // said once
  services_.log.warning("the panel's settings cannot be kept in '%s'", services_.settings_file.c_str());
}

// --- Selection.

const state::ObjectInfo* PanelModel::selected_info() const {
  if (frame_ == nullptr) return nullptr;
  const std::uint32_t object = state::find(structure(), selected_);
  return object == state::kNone ? nullptr : &structure().objects[object];
}

void PanelModel::select(state::ObjectId object) {
  if (object == selected_) return;
  selected_ = object;
  tree.reveal(object);
}

state::ObjectId PanelModel::parent_of(state::ObjectId object) const {
  const state::Structure& all = structure();
  const std::uint32_t index = state::find(all, object);
  if (index == state::kNone) return {};
  const state::ObjectInfo& info = all.objects[index];
  const auto id_of_body = [&](std::uint32_t slot) { return all.objects[all.bodies[slot].object].id; };
  const auto id_of = [&](std::uint32_t i) { return i == state::kNone ? state::ObjectId{} : all.objects[i].id; };
  if (is_joint(info)) return id_of_body(all.joints[info.slot].parent_body);
  if (is_body(info)) {
    for (const state::JointInfo& joint : all.joints) {
      if (joint.child_body == info.slot) return id_of_body(joint.parent_body);
    }
    return {};
  }
  const state::PlacedInfo* placed = state::rows_of(info.kind).placed(all, info.slot);
  return placed == nullptr ? state::ObjectId{} : id_of(placed->parent_object);
}

std::vector<state::ObjectId> PanelModel::mechanism_of(state::ObjectId body) const {
  const state::Structure& all = structure();
  const std::uint32_t object = state::find(all, body);
  if (object == state::kNone || !is_body(all.objects[object])) return {};
  std::vector<bool> in(all.bodies.size());
  std::vector<std::uint32_t> open{all.objects[object].slot};
  in[open.front()] = true;
  std::vector<state::ObjectId> found;
  while (!open.empty()) {
    const std::uint32_t slot = open.back();
    open.pop_back();
    found.push_back(all.objects[all.bodies[slot].object].id);
    if (all.bodies[slot].mass <= 0.0) continue;  // what else hangs on it does not move with it
    for (const state::JointInfo& joint : all.joints) {
      if (joint.parent_body != slot && joint.child_body != slot) continue;
      const std::uint32_t other = joint.parent_body == slot ? joint.child_body : joint.parent_body;
      if (in[other] || all.bodies[other].mass <= 0.0) continue;
      in[other] = true;
      open.push_back(other);
    }
  }
  return found;
}

double PanelModel::pulled_by(state::ObjectId body) const {
  const std::uint32_t object = state::find(structure(), body);
  if (object == state::kNone || !is_body(structure().objects[object])) return 0.0;
  math::Vec3 force;
  for (const state::PickState& pick : frame_->picks) {
    if (pick.body == structure().objects[object].slot) force += pick.force_world;
  }
  return math::norm(force);
}

// --- Joints.

void PanelModel::hold_joint(std::uint32_t joint, const state::JointCommand& command) {
  const std::string why = held.hold(structure(), joint, command);
  if (!why.empty()) say(structure().joints[joint].name + ": " + why);
}

// --- Parameters.

math::Vec3 PanelModel::parameter_now(const state::ObjectInfo& object, state::Parameter parameter) const {
  return is_body(object) ? state::value_of(frame_->body_parameters[object.slot], parameter)
                         : state::value_of(frame_->joint_parameters[object.slot], parameter);
}

math::Vec3 PanelModel::parameter_loaded(const state::ObjectInfo& object, state::Parameter parameter) const {
  return is_body(object) ? state::value_of(structure().bodies[object.slot].parameters, parameter)
                         : state::value_of(structure().joints[object.slot].parameters, parameter);
}

void PanelModel::list_changed() {
  parameters_version_ = frame_->parameters_version;
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
      const math::Vec3 now = parameter_now(object, parameter), loaded = parameter_loaded(object, parameter);
      if (!(now == loaded)) changed_.push_back({object.id, parameter, loaded, now});
    }
  }
}

void PanelModel::revert(state::ObjectId object, state::Parameter parameter) {
  const std::uint32_t index = state::find(structure(), object);
  if (index != state::kNone) set_parameter(object, parameter, parameter_loaded(structure().objects[index], parameter));
}

void PanelModel::revert_all() {
  for (const Changed& change : changed_) set_parameter(change.object, change.parameter, change.loaded);
  if (!(frame_->gravity_world == gravity_loaded_)) set_gravity(gravity_loaded_);
}

// --- Plots.

void PanelModel::plot(const std::string& name, bool shown) {
  if (shown == traces.has(name)) return;
  if (shown && !traces.add(name)) return say("six plots at most");
  if (!shown) {
    traces.remove(name);
    zoom.values.erase(name);
    if (traces.traces().empty()) zoom_out();
  }
  settings.plotted.clear();
  for (const Traces::Trace& trace : traces.traces()) settings.plotted.push_back(trace.name);
}

bool PanelModel::watched(const std::string& name) const {
  return std::find(settings.watched.begin(), settings.watched.end(), name) != settings.watched.end();
}

void PanelModel::watch(const std::string& name, bool shown) {
  if (shown == watched(name)) return;
  if (shown) settings.watched.push_back(name);
  if (!shown) std::erase(settings.watched, name);
}

}  // namespace ambf::render
