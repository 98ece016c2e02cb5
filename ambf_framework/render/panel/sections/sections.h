// The tabs of the panel, and the parts of the panel that several of them show. Main thread.
#pragma once

#include <initializer_list>
#include <memory>
#include <string>
#include <vector>

#include "render/panel/panel_model.h"
#include "render/panel/panel_ui.h"
#include "render/panel/ui.h"
#include "render/window/window_part.h"

namespace ambf::render {

// What a tab is drawn with.
struct PanelScene {
  PanelModel& model;
  Ui& ui;
  state::Push& push;  // that the user prepares for the selected body
  const PanelHost& host;
  const WindowMoment& moment;
};

// Shows a part of PanelModel, and keeps what is typed and chosen in it but not acted upon yet.
class PanelTab {
 public:
  virtual ~PanelTab() = default;
  virtual const char* name() const = 0;
  virtual void draw(PanelScene& scene) = 0;
  // Once a picture, shown or not.
  virtual void observe(PanelScene&) {}
};

std::unique_ptr<PanelTab> make_objects_tab();  // tree and what is selected
std::unique_ptr<PanelTab> make_joints_tab();   // one row a joint
std::unique_ptr<PanelTab> make_views_tab();    // camera, lights, layers
std::unique_ptr<PanelTab> make_physics_tab();  // times, gravity, what was changed, contacts
std::unique_ptr<PanelTab> make_plots_tab();
std::unique_ptr<PanelTab> make_log_tab();
std::unique_ptr<PanelTab> make_files_tab();    // load, unload, snapshots, settings
std::unique_ptr<PanelTab> make_devices_tab();  // only where there are input devices

// Above the tabs: pause, steps, speed. `steps`: how many the button runs.
void draw_run(PanelScene& scene, int& steps);

// A sign that plots these values of an object, or no longer: in the layout, or beside the label of the row that was
// just made.
void plot_sign(PanelScene& scene, const std::string& object, std::initializer_list<const char*> components, float side);
void plot_sign_of_row(PanelScene& scene, const std::string& object, std::initializer_list<const char*> components);

// How the live parameters of a kind of object are shown.
struct ParameterRows {
  bool open = false;  // the section, at first
  const char* (*unit)(const state::Structure& structure, std::uint32_t slot, state::Parameter parameter) = nullptr;
  // Whether it has an effect on this object. Null: all have.
  bool (*in_use)(const state::Structure& structure, std::uint32_t slot, state::Parameter parameter) = nullptr;
};
void draw_parameters(PanelScene& scene, const state::ObjectInfo& object, const ParameterRows& rows);
void draw_look(PanelScene& scene, const state::ObjectInfo& body);  // in this window
void draw_move(PanelScene& scene, const state::ObjectInfo& object);
// Of a body, camera or light: where it is, as the keys of its ADF block.
std::string pose_as_adf(const state::Frame& frame, const state::ObjectInfo& object);
void draw_lens(PanelScene& scene, const state::ObjectInfo& camera);
void draw_beam(PanelScene& scene, const state::ObjectInfo& light);
void draw_commands(PanelScene& scene);  // who commands what
// The camera behind the one the window looks through now, its own view behind the last.
state::ObjectId next_camera(const state::Structure& structure, state::ObjectId now);

}  // namespace ambf::render
