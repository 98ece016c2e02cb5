// The parts of the panel, one function each, and what they keep between pictures. Private to render/panel/. Main thread.
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

// What is typed and chosen but not acted upon yet.
struct PanelDrafts {
  int steps = 10;
  std::string search_objects, search_joints, search_values, search_parameters, search_messages;
  state::Push push;
  state::ObjectId renamed;
  bool show_warnings = true, show_errors = true, show_information = true;
  std::string load_path, load_prefix, snapshot_name, snapshot_file, csv_path = "ambf_plot.csv";
  bool confirm_reset = false;
  std::vector<base::LogLine> lines;
  std::uint64_t lines_taken = 0;
  // Joints that show a velocity or effort field instead of the position slider.
  std::map<std::uint64_t, state::JointCommandType> joint_modes;
  std::map<std::uint64_t, double> joint_values;
  state::ObjectId followed;  // by the window's view
  math::Vec3 followed_at;
  state::ObjectId scrolled_to;
  float tree_height = 0.0F;      // px, in the last picture
  float selected_height = 0.0F;  // px, of what was last shown of the selected object
  std::vector<std::string> completions;
  std::string completed;
};

struct PanelScene {
  PanelModel& model;
  Ui& ui;
  PanelDrafts& drafts;
  const PanelHost& host;
  const WindowMoment& moment;
};

void draw_run(PanelScene& scene);      // always on top
void draw_objects(PanelScene& scene);  // tree and what is selected
void draw_joints(PanelScene& scene);   // one row a joint
void draw_views(PanelScene& scene);    // camera, lights, layers
void draw_physics(PanelScene& scene);  // times, gravity, what was changed, contacts
void draw_plots(PanelScene& scene);
void draw_messages(PanelScene& scene);
void draw_files(PanelScene& scene);  // load, unload, snapshots, settings

// A sign that plots these values of an object, or no longer: in the layout, or beside the label of the row that was just made.
void plot_sign(PanelScene& scene, const std::string& object, std::initializer_list<const char*> components, float side);
void plot_sign_of_row(PanelScene& scene, const std::string& object, std::initializer_list<const char*> components);

// Of the selected body or joint.
void draw_parameters(PanelScene& scene, const state::ObjectInfo& object);
void draw_look(PanelScene& scene, const state::ObjectInfo& body);  // in this window
void draw_move(PanelScene& scene, const state::ObjectInfo& object);
// Of a body, camera or light: where it is, as the keys of its ADF block.
std::string pose_as_adf(const state::Frame& frame, const state::ObjectInfo& object);
void draw_lens(PanelScene& scene, const state::ObjectInfo& camera);
void draw_beam(PanelScene& scene, const state::ObjectInfo& light);
void draw_commands(PanelScene& scene);  // who commands what
// The camera behind the one the window looks through now, its own view behind the last.
state::ObjectId next_camera(const state::Structure& structure, state::ObjectId now);
// Keeps the view on the body it follows.
void follow(PanelScene& scene);

}  // namespace ambf::render
