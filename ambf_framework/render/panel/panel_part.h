// The panel among the parts of the windows: in one window at a time, the one where Tab was pressed last. Main thread.
// Private to render/.
#pragma once

#include <memory>

#include "render/panel/detail/panel_renderer.h"
#include "render/panel/panel_model.h"
#include "render/panel/panel_ui.h"
#include "render/window/window_part.h"

namespace ambf::render {

class PanelPart final : public WindowPart {
 public:
  PanelPart(const PanelModel::Services& services, PanelHost host, const Gl& gl);

  bool on_input(const WindowMoment& moment, const Input& input) override;
  void draw_debug(const WindowMoment& moment, WorldShapes& debug) override;
  void draw_over(const WindowMoment& moment) override;
  int covered(unsigned window) const override;
  void on_close(unsigned window) override;

  PanelModel& model() { return model_; }
  PanelUi& ui() { return ui_; }

 private:
  void keep_selection(const WindowMoment& moment);

  base::Log& log_;
  PanelModel model_;
  PanelUi ui_;
  PanelRenderer renderer_;
  unsigned window_ = 0;           // that shows it; 0: none yet
  std::int64_t observed_ns_ = 0;  // the picture that the model has seen
  state::ObjectId picked_;        // as last seen
  bool broken_ = false;
};

}  // namespace ambf::render
