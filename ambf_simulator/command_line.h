// The command line of ambf_simulator: the flags, short forms and defaults of the original, for users' scripts, and
// ours. Parsing never exits and never throws: the caller decides.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "render/gl/offscreen_backend.h"

namespace ambf::simulator {

// Of screenshots and videos; usual: fine of screenshots, normal of videos.
enum class PictureQuality { usual, draft, normal, fine };

// A file and the camera that it shows (empty: the first).
struct PictureFile {
  std::string file, camera;
};

struct CommandLine {
  // What to do instead of simulating.
  bool help = false, version = false, limits = false;  // print it, and end
  std::vector<std::string> check_files;                // --check FILE...
  bool strict = false;                                 // warnings fail the check, too
  std::vector<std::string> convert_files;              // --convert IN OUT: both, or none

  // Input devices.
  int device_count = 0;
  std::string device_indices;  // numbers and names, with commas
  bool enable_forces = false;
  int haptics_frequency_hz = 1000;
  bool fixed_haptics_timestep = false;

  // Recordings of inputs; empty: none.
  std::string record_input, replay_input;

  // Time.
  int physics_frequency_hz = 1000;
  bool fixed_physics_timestep = false;
  double speed_factor = 1.0;
  double run_for_seconds = 0.0;  // wall time; 0: until a stop is requested

  // Physics.
  std::string solver;           // "", "direct", "si", "mlcp"
  int solver_iterations = 0;    // 0: the solver's own default
  int friction_directions = 2;  // 1 or 2
  bool sleeping = true;
  bool release_silent_throttle = false;

  // Communication.
  std::string ns;
  std::optional<double> override_min_comm_hz, override_max_comm_hz;
  bool no_ros = false;
  std::string legacy_states;            // "", "g2" or "g4"
  std::vector<std::string> crtk_files;  // --crtk
  bool clock = false;                   // --clock: their stamps are in simulated time

  // What to load and show.
  bool keep_running_without_display = false;
  bool check_graphics = false;
  bool show_gui = true, gui_asked_for = false;                               // the second: -g true was given
  render::OffscreenBackend offscreen = render::OffscreenBackend::automatic;  // who draws pictures that no window shows
  std::vector<PictureFile> screenshots;
  PictureFile video;  // no file: none
  int video_fps = 30;
  double video_seconds = 10.0;
  std::optional<double> at_seconds;           // simulation time of the pictures; none: when the scene has come to rest
  int picture_width = 0, picture_height = 0;  // px; 0: as the camera publishes
  PictureQuality picture_quality = PictureQuality::usual;
  std::string launch_file;                      // empty: the shipped one
  std::vector<std::string> model_files;         // -a
  std::vector<int> model_indices;               // -l
  bool free_base = false, merge_fixed = false;  // how URDF files are read (adf/adf.h)
  std::string plugins;
  std::string log_file;
  std::vector<std::string> ros_arguments;  // name:=value, without what roslaunch gives to every program: not obeyed
};

struct ParsedCommandLine {
  std::optional<CommandLine> options;  // none: `error` says why
  std::string error;
};

// Empty, or why a simulation cannot be run so.
std::string check_values(const CommandLine& options);

ParsedCommandLine parse_command_line(int argc, const char* const* argv);

// Text for --help.
std::string help_text();

}  // namespace ambf::simulator
