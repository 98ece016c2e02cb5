// Keeps the panel's settings in the user's file, and its layout in one of the scene. Main thread.
#pragma once

#include <string>

#include "base/log.h"
#include "render/panel/detail/settings.h"

namespace ambf::render {

class SettingsFiles {
 public:
  // `file` empty: nothing is kept. `scene`: the files it comes from, one a line; empty: one layout for all scenes.
  SettingsFiles(base::Log& log, std::string file, std::string scene);

  PanelSettings read();
  void save(const PanelSettings& settings);  // when they differ from what was read or saved last

 private:
  base::Log& log_;
  const std::string file_, scene_, layout_file_;
  PanelSettings saved_;
  bool refusal_logged_ = false;
};

}  // namespace ambf::render
