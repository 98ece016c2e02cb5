// Requests of the panel that change what exists, or save it. Outcomes are shown and logged. Main thread.
#pragma once

#include <string>

#include "render/panel/detail/settings.h"
#include "render/panel/notices.h"
#include "state/abilities/edit.h"

namespace ambf::render {

class EditActions {
 public:
  EditActions(state::EditAbility& edit, const Notices& notices, PanelSettings& settings)
      : edit_(edit), notices_(notices), settings_(settings) {}

  void load(const std::string& path, const std::string& prefix);  // remembers the file
  void unload(const std::string& model);
  void remove(const std::string& object);
  void save(state::SaveModelRequest request);  // a model, or the scene

 private:
  state::EditAbility& edit_;
  const Notices& notices_;
  PanelSettings& settings_;
};

}  // namespace ambf::render
