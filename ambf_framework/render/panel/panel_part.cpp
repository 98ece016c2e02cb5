#include "render/panel/panel_part.h"

#include "render/panel/sections/sections.h"
#include "render/scene/object_kind.h"
#include "render/window/window_recorder.h"

namespace ambf::render {

PanelPart::PanelPart(const PanelModel::Services& services, PanelHost host, const Gl& gl)
    : log_(services.log), model_(services), ui_(model_, std::move(host)), renderer_(gl) {}

bool PanelPart::on_input(const WindowMoment& moment, const Input& input) {
  const bool here = moment.window == window_;
  if (here && ui_.on_input(moment, input)) return true;
  const auto* key = std::get_if<KeyInput>(&input);
  if (key == nullptr || key->released || key->held || moment.frame == nullptr) return false;
  switch (action_of(key->key, key->modifiers, false)) {
    case Action::panel:
      // In another window it comes over.
      ui_.set_open(here ? !ui_.open() : true);
      window_ = moment.window;
      return true;
    case Action::next_camera:
      *moment.choices.set_camera = next_camera(*moment.frame->structure, moment.camera_object);
      return true;
    case Action::screenshot: moment.recorder->take_screenshot(model_.settings.picture_folder); return true;
    case Action::film:
      if (moment.recorder->filming()) {
        moment.recorder->stop_film();
      } else {
        moment.recorder->start_film(model_.settings.picture_folder);
        model_.say("filming; Ctrl+Shift+S ends it");
      }
      return true;
    case Action::record_data: model_.toggle_recording(); return true;
    default: return false;
  }
}

// What is picked in the scene is selected here, and the other way round.
void PanelPart::keep_selection(const WindowMoment& moment) {
  if (moment.choices.picked != picked_) {
    picked_ = moment.choices.picked;
    if (picked_.valid()) model_.selection.select(picked_);
  }
  if (moment.choices.set_picked == nullptr || model_.selection.id() == picked_) return;
  const state::ObjectInfo* selected = model_.selection.info();
  if (selected == nullptr || !is_body(*selected)) return;
  *moment.choices.set_picked = picked_ = model_.selection.id();
}

void PanelPart::draw_debug(const WindowMoment& moment, WorldShapes& debug) {
  if (moment.window == window_ && ui_.open()) model_.gizmo.draw(moment, model_.selection.id(), debug);
}

void PanelPart::draw_over(const WindowMoment& moment) {
  if (moment.frame == nullptr) return;
  if (observed_ns_ != moment.now_ns) {  // once a picture, not once a window
    observed_ns_ = moment.now_ns;
    model_.observe(*moment.frame, moment.now_ns);
  }
  if (window_ == 0) window_ = moment.window;
  if (moment.window != window_ || broken_) return;
  keep_selection(moment);
  ui_.build(moment);
  const ImDrawData* drawing = ui_.drawing();
  if (drawing == nullptr) return;
  std::string why;
  if (renderer_.draw(*drawing, ui_.fonts(), ui_.fonts_version(), moment.window, ui_.paper(), why)) return;
  broken_ = true;
  ui_.set_open(false);
  log_.error("the panel cannot be drawn: %s", why.c_str());
}

int PanelPart::covered(unsigned window) const { return window == window_ ? ui_.covered() : 0; }

void PanelPart::on_close(unsigned window) {
  renderer_.forget(window);
  if (window != window_) return;
  ui_.set_open(false);
  window_ = 0;
}

}  // namespace ambf::render
