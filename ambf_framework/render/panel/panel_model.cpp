#include "render/panel/panel_model.h"

#include "render/window/window_recorder.h"

namespace ambf::render {

namespace {

constexpr std::int64_t kSaveEvery_ns = 3'000'000'000;

}  // namespace

PanelModel::PanelModel(const Services& services)
    : notices_(services.log, services.messages),
      files_(services.log, services.settings_file, services.scene),
      recording_(services.recording),
      tail_(services.tail),
      settings(files_.read()),
      held(services.simulation.command),
      gizmo(services.simulation.command, services.simulation.pick),
      run(services.simulation.run, services.simulation.command, held, notices_),
      edit(services.simulation.edit, notices_, settings),
      tune(services.simulation.tune, notices_),
      devices(services.simulation.devices, notices_),
      plots(settings, notices_) {}

PanelModel::~PanelModel() {
  held.release_all();
  save_settings();
}

void PanelModel::observe(const state::Frame& frame, std::int64_t now_ns) {
  frame_ = &frame;
  now_ns_ = now_ns;
  if (recording_ != nullptr) {
    for (const std::string& text : recording_->take_messages()) say(text);
  }
  if (const std::string notice = held.follow(frame, now_ns); !notice.empty()) warn(notice);
  if (const std::string notice = gizmo.observe(frame, now_ns); !notice.empty()) say(notice);
  history.take(frame, now_ns);
  commands.take(frame, now_ns);
  plots.traces.take(frame);
  run.observe(frame);
  tune.observe(frame);
  selection.observe(*frame.structure);
  if (now_ns - saved_ns_ > kSaveEvery_ns) {
    saved_ns_ = now_ns;
    save_settings();
  }
}

void PanelModel::hold_joint(std::uint32_t joint, const state::JointCommand& command) {
  const std::string why = held.hold(structure(), joint, command);
  if (!why.empty()) say(structure().joints[joint].name + ": " + why);
}

void PanelModel::toggle_recording() {
  const std::string missing = recording_ == nullptr ? "nobody here records data" : recording_->unavailable();
  if (!missing.empty()) return say("no recording: " + missing);
  switch (recording_->state()) {
    case DataRecording::State::idle: recording_->start(dated_file(settings.picture_folder, ".bag")); break;
    case DataRecording::State::running: recording_->stop(); break;
    case DataRecording::State::ending: say("the bag of the last recording is still being completed"); break;
  }
}

}  // namespace ambf::render
