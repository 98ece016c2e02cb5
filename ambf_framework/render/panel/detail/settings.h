// The panel's settings that last from run to run: its appearance, and the files, plots and watch lines used last. A
// small text file, "key value" a line. Main thread.
#pragma once

#include <string>
#include <vector>

namespace ambf::render {

struct PanelSettings {
  bool dark = true;
  bool degrees = false;       // joints in degrees and millimetres
  double width_points = 0.0;  // of the panel; 0: as wide as is usual
  int tab = 0;
  std::string picture_folder;             // for screenshots and films; empty: where the program was started
  std::vector<std::string> recent_files;  // newest first
  std::vector<std::string> plotted, watched;

  void used_file(const std::string& path);
  bool operator==(const PanelSettings&) const = default;
};

// $XDG_CONFIG_HOME/ambf/panel.conf, else ~/.config/ambf/panel.conf; empty when there is no home.
std::string settings_path();

// A missing or invalid value keeps its default; `problem` describes invalid lines, else it is empty.
PanelSettings read_settings(const std::string& path, std::string& problem);
// Replaces the file atomically. False when it cannot be written.
bool write_settings(const std::string& path, const PanelSettings& settings);

// The layout of one scene (width, tab, what is plotted and watched) is kept in a file of its own beside the user's: its
// path. `scene` names the scene's files, whatever they are.
std::string layout_path(const std::string& settings_path, const std::string& scene);
// Where there is such a file, its layout takes the place of the one in `settings`.
void read_layout(const std::string& path, PanelSettings& settings, std::string& problem);
bool write_layout(const std::string& path, const std::string& scene, const PanelSettings& settings);

}  // namespace ambf::render
