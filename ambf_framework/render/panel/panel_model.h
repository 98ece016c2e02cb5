// What the panel knows and what its actions do: the selection, what is held, plotted, watched and changed, and every request to the
// simulation. No drawing: the sections (panel_ui.h) show it and call its actions; tests do the same. Main thread.
#pragma once

#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/log_tail.h"
#include "render/panel/detail/command_watch.h"
#include "render/panel/detail/held_joints.h"
#include "render/panel/detail/settings.h"
#include "render/panel/gizmo/gizmo.h"
#include "render/panel/object_tree.h"
#include "render/panel/plots/history.h"
#include "render/panel/plots/plot_zoom.h"
#include "render/panel/plots/values.h"
#include "render/window/data_recording.h"
#include "render/window/messages.h"
#include "state/abilities/abilities.h"

namespace ambf::render {

class PanelModel {
 public:
  struct Services {
    state::Abilities simulation;
    base::Log& log;
    const base::LogTail* tail = nullptr;  // null: no messages to show
    std::shared_ptr<Messages> messages;   // told to the user over the scene, too
    std::string settings_file;            // empty: nothing is remembered
    DataRecording* recording = nullptr;   // null: nobody can record data
    std::string scene;                    // the layout is remembered for it; empty: for all alike
  };
  explicit PanelModel(Services services);
  ~PanelModel();

  // Once a picture, shown or not: keeps alive what is held, samples what is plotted, notices what is gone. `frame` stays valid until
  // the next call.
  void observe(const state::Frame& frame, std::int64_t now_ns);
  const state::Frame& frame() const { return *frame_; }
  const state::Structure& structure() const { return *frame_->structure; }
  bool has_frame() const { return frame_ != nullptr; }
  std::int64_t now_ns() const { return now_ns_; }

  // --- Selection: any object.
  state::ObjectId selected() const { return selected_; }
  const state::ObjectInfo* selected_info() const;  // null: nothing, or gone
  void select(state::ObjectId object);
  // The body above it: of a body by the joint that holds it, of a joint its parent, of a camera or light what it hangs on.
  state::ObjectId parent_of(state::ObjectId object) const;
  void select_parent() { select(parent_of(selected_)); }

  // --- Run control.
  void toggle_pause();
  void step(unsigned steps);  // while paused; remembers the state before it
  bool can_step_back() const { return !steps_back_.empty() && steps_back_epoch_ == frame_->epoch; }
  void step_back();
  void set_speed(double factor);
  void reset_world();
  void reset_bodies();
  // A body and all that is jointed to it, but what is static.
  void reset_mechanism(state::ObjectId body);
  std::vector<state::ObjectId> mechanism_of(state::ObjectId body) const;
  void push(state::ObjectId body, const state::Push& push);
  // Newtons by which any pointer pulls at the body; 0: none.
  double pulled_by(state::ObjectId body) const;

  // --- Joints.
  HeldJoints held;
  void hold_joint(std::uint32_t joint, const state::JointCommand& command);

  // --- Moving the selected object in the scene.
  Gizmo gizmo;

  // --- Live parameters.
  struct Changed {
    state::ObjectId object;
    state::Parameter parameter;
    math::Vec3 loaded, now;
  };
  math::Vec3 parameter_now(const state::ObjectInfo& object, state::Parameter parameter) const;
  math::Vec3 parameter_loaded(const state::ObjectInfo& object, state::Parameter parameter) const;
  void set_parameter(state::ObjectId object, state::Parameter parameter, const math::Vec3& value);
  void revert(state::ObjectId object, state::Parameter parameter);
  const std::vector<Changed>& changed() const { return changed_; }
  void revert_all();
  void set_gravity(const math::Vec3& gravity);
  const math::Vec3& gravity_loaded() const { return gravity_loaded_; }

  // What the simulation would refuse is said instead.
  void set_lens(state::ObjectId camera, const state::Lens& lens);
  void set_beam(state::ObjectId light, const state::Beam& beam);

  // --- Loading, removing, snapshots. Outcomes are told to the user and logged.
  void load(const std::string& path, const std::string& prefix);
  void unload(const std::string& model);
  void remove(state::ObjectId object);
  void take_snapshot(const std::string& name, const std::string& path);
  void restore_snapshot(const std::string& name, const std::string& path);
  std::vector<std::string> snapshots() const;  // those of users, not of steps back

  // --- Plots and watch lines.
  Traces traces;
  void plot(const std::string& name, bool shown);
  void watch(const std::string& name, bool shown);
  bool watched(const std::string& name) const;
  void clear_plots();
  // Shows a part of the time, and of the values of this plot; holds them still until all is shown again.
  PlotZoom zoom;
  void zoom_plot(const std::string& name, const std::optional<PlotSpan>& time_s, const std::optional<PlotSpan>& values);
  void zoom_out();
  void export_csv(const std::string& path);
  History history;
  CommandWatch commands;

  // --- Recording of what is published. Null: nobody can.
  DataRecording* recording() const { return services_.recording; }
  void toggle_recording();  // into the folder of pictures

  // --- Messages.
  const base::LogTail* tail() const { return services_.tail; }

  ObjectTree tree;
  PanelSettings settings;
  void say(const std::string& text);  // to the user, over the scene
  void save_settings();               // when they differ from what was saved

 private:
  struct Notice;
  state::Completion tell(const std::string& done, const std::string& not_done);
  void list_changed();

  Services services_;
  const state::Frame* frame_ = nullptr;
  std::int64_t now_ns_ = 0, saved_ns_ = 0;
  state::ObjectId selected_;
  PanelSettings saved_;
  std::string layout_file_;  // of this scene; empty: none
  math::Vec3 gravity_loaded_;
  bool gravity_seen_ = false, save_refused_ = false;
  std::vector<Changed> changed_;
  std::uint64_t parameters_version_ = 0, structure_version_ = 0;
  std::deque<std::string> steps_back_;  // names of snapshots, newest last
  unsigned next_step_back_ = 0;
  std::uint64_t steps_back_epoch_ = 0;
};

}  // namespace ambf::render
