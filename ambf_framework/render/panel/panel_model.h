// What the panel knows, a part for each of its users, and what these parts share: the newest frame and the settings. No
// drawing: the tabs (sections/) show it and call its actions; tests do the same. Main thread.
#pragma once

#include <memory>
#include <string>

#include "base/log_tail.h"
#include "render/panel/actions/device_actions.h"
#include "render/panel/actions/edit_actions.h"
#include "render/panel/actions/run_actions.h"
#include "render/panel/actions/tune_actions.h"
#include "render/panel/detail/command_watch.h"
#include "render/panel/detail/held_joints.h"
#include "render/panel/detail/settings_files.h"
#include "render/panel/gizmo/gizmo.h"
#include "render/panel/notices.h"
#include "render/panel/plots/history.h"
#include "render/panel/plots/plots.h"
#include "render/panel/selection.h"
#include "render/window/data_recording.h"
#include "state/abilities/abilities.h"

namespace ambf::render {

class PanelModel {
 public:
  struct Services {
    state::Abilities simulation;
    base::Log& log;
    const base::LogTail* tail = nullptr;  // null: no messages to show
    std::shared_ptr<Messages> messages;   // shown to the user over the scene, too
    std::string settings_file;            // empty: nothing is remembered
    DataRecording* recording = nullptr;   // null: nobody can record data
    std::string scene;                    // the layout is remembered for it; empty: for all alike
  };
  explicit PanelModel(const Services& services);
  ~PanelModel();

  // Once a picture, shown or not: follows what is held, samples what is plotted, notices what is gone. `frame`
  // stays valid until the next call.
  void observe(const state::Frame& frame, std::int64_t now_ns);
  const state::Frame& frame() const { return *frame_; }
  const state::Structure& structure() const { return *frame_->structure; }
  bool has_frame() const { return frame_ != nullptr; }
  std::int64_t now_ns() const { return now_ns_; }

  void hold_joint(std::uint32_t joint, const state::JointCommand& command);
  void toggle_recording();  // of published data, into the folder of pictures
  void say(const std::string& text) { notices_.show(text); }
  void warn(const std::string& text) { notices_.warn(text); }
  void save_settings() { files_.save(settings); }

  // Null: nobody can record; no messages are kept.
  DataRecording* recording() const { return recording_; }
  const base::LogTail* tail() const { return tail_; }

 private:
  Notices notices_;
  SettingsFiles files_;
  DataRecording* recording_;
  const base::LogTail* tail_;
  const state::Frame* frame_ = nullptr;
  std::int64_t now_ns_ = 0, saved_ns_ = 0;

 public:
  PanelSettings settings;
  Selection selection;
  HeldJoints held;
  Gizmo gizmo;  // moves the selected object in the scene
  RunActions run;
  EditActions edit;
  TuneActions tune;
  DeviceActions devices;
  Plots plots;
  History history;
  CommandWatch commands;
};

}  // namespace ambf::render
