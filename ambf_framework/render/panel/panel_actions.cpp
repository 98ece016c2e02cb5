// What PanelModel asks of the simulation.
#include <fstream>

#include "render/panel/panel_model.h"
#include "render/pictures/window_recorder.h"

namespace ambf::render {

namespace {

constexpr const char* kStepBackName = "panel: before step ";
constexpr unsigned kStepsBack = 20;

}  // namespace

// Completions come from other threads, perhaps after the panel is gone.
state::Completion PanelModel::tell(const std::string& done, const std::string& not_done) {
  return [messages = services_.messages, &log = services_.log, done, not_done](const state::Outcome& outcome) {
    if (!outcome.success) {
      log.error("%s: %s", not_done.c_str(), outcome.message.c_str());
      messages->add(not_done + ": " + outcome.message);
    } else if (!done.empty()) {
      log.info("%s", done.c_str());
      messages->add(done);
    }
  };
}

void PanelModel::toggle_pause() {
  services_.simulation.run.set_paused(!frame_->run.paused);
  say(frame_->run.paused ? "running" : "paused");
}

// The state before each step is kept for a while: going back is restoring it.
void PanelModel::step(unsigned steps) {
  if (steps == 0) return;
  if (steps_back_epoch_ != frame_->epoch) steps_back_.clear();
  steps_back_epoch_ = frame_->epoch;
  const std::string name = kStepBackName + std::to_string(next_step_back_);
  next_step_back_ = (next_step_back_ + 1) % kStepsBack;
  std::erase(steps_back_, name);
  steps_back_.push_back(name);
  services_.simulation.run.snapshot(
      name, "", [&run = services_.simulation.run, steps](const state::Outcome&) { run.step_paused(steps); });
}

void PanelModel::step_back() {
  if (!can_step_back()) return;
  const std::string name = steps_back_.back();
  steps_back_.pop_back();
  ++steps_back_epoch_;  // what restoring makes of it
  services_.simulation.run.restore(name, "", tell("", "cannot step back"));
}

void PanelModel::set_speed(double factor) { services_.simulation.run.set_speed(factor); }

void PanelModel::reset_world() {
  held.release_all();
  services_.simulation.run.reset_world();
  say("world reset");
}

void PanelModel::reset_bodies() {
  services_.simulation.run.reset_bodies();
  say("bodies reset");
}

void PanelModel::reset_mechanism(state::ObjectId body) {
  std::vector<state::ObjectId> bodies = mechanism_of(body);
  if (bodies.empty()) return;
  say(bodies.size() == 1 ? "body reset" : std::to_string(bodies.size()) + " bodies reset");
  services_.simulation.run.reset_bodies(std::move(bodies));
}

void PanelModel::push(state::ObjectId body, const state::Push& push) {
  services_.simulation.command.push(body, push, tell("", "not pushed"));
}

void PanelModel::set_parameter(state::ObjectId object, state::Parameter parameter, const math::Vec3& value) {
  const std::string what = state::info_of(parameter).name;
  services_.simulation.tune.set_parameter(object, parameter, value,
                                          [messages = services_.messages, what](const state::Outcome& outcome) {
                                            if (!outcome.message.empty()) messages->add(what + ": " + outcome.message);
                                          });
}

void PanelModel::set_gravity(const math::Vec3& gravity) { services_.simulation.tune.set_gravity(gravity); }

void PanelModel::set_lens(state::ObjectId camera, const state::Lens& lens) {
  const std::string why = state::check(lens);
  why.empty() ? services_.simulation.tune.set_lens(camera, lens) : say("lens: " + why);
}

void PanelModel::set_beam(state::ObjectId light, const state::Beam& beam) {
  const std::string why = state::check(beam);
  why.empty() ? services_.simulation.tune.set_beam(light, beam) : say("beam: " + why);
}

void PanelModel::load(const std::string& path, const std::string& prefix) {
  state::LoadRequest request;
  request.path = path;
  request.name_prefix = prefix;
  say("loading '" + path + "'");
  settings.used_file(path);
  services_.simulation.edit.load(std::move(request), tell("loaded '" + path + "'", "not loaded: '" + path + "'"));
}

void PanelModel::unload(const std::string& model) {
  services_.simulation.edit.unload(model, tell("unloaded '" + model + "'", "not unloaded"));
}

void PanelModel::remove(state::ObjectId object) {
  const std::uint32_t index = state::find(structure(), object);
  if (index == state::kNone) return;
  const std::string name = structure().objects[index].name;
  services_.simulation.edit.remove(name, tell("removed '" + name + "'", "not removed"));
}

void PanelModel::take_snapshot(const std::string& name, const std::string& path) {
  const std::string done = "snapshot " + (name.empty() ? std::string() : "'" + name + "' ") + "taken";
  services_.simulation.run.snapshot(name, path, tell(done, "no snapshot"));
}

void PanelModel::restore_snapshot(const std::string& name, const std::string& path) {
  held.release_all();
  services_.simulation.run.restore(name, path, tell("restored '" + (path.empty() ? name : path) + "'", "not restored"));
}

std::vector<std::string> PanelModel::snapshots() const {
  std::vector<std::string> names = services_.simulation.run.snapshots();
  std::erase_if(names, [](const std::string& name) { return name.rfind(kStepBackName, 0) == 0; });
  return names;
}

void PanelModel::clear_plots() {
  traces.clear();
  zoom_out();
}

void PanelModel::zoom_plot(const std::string& name, const std::optional<PlotSpan>& time_s,
                           const std::optional<PlotSpan>& values) {
  if (!zoom.any()) zoom.was_paused = traces.paused();
  traces.set_paused(true);
  if (time_s) zoom.time_s = time_s;
  if (values) zoom.values[name] = *values;
}

void PanelModel::zoom_out() {
  if (!zoom.any()) return;
  traces.set_paused(zoom.was_paused);
  zoom = {};
}

void PanelModel::export_csv(const std::string& path) {
  std::ofstream out(path);
  out << traces.csv();
  out.close();
  say(out ? "written: " + path : "cannot write " + path);
}

void PanelModel::toggle_recording() {
  DataRecording* recording = services_.recording;
  const std::string missing = recording == nullptr ? "nobody here records data" : recording->unavailable();
  if (!missing.empty()) return say("no recording: " + missing);
  switch (recording->state()) {
    case DataRecording::State::idle: recording->start(dated_file(settings.picture_folder, ".bag")); break;
    case DataRecording::State::running: recording->stop(); break;
    case DataRecording::State::ending: say("the bag of the last recording is still being completed"); break;
  }
}

}  // namespace ambf::render
