// Which of a window's inputs are meant for the panel, and how Dear ImGui gets them. The panel's context is current in
// every call. Main thread.
#pragma once

#include <deque>
#include <optional>

#include "render/window/input.h"

namespace ambf::render {

struct WindowSizes;

class PanelInputs {
 public:
  // True: it was meant for the panel, whose left edge (px) was there in the last picture; none: it was not shown.
  bool take(const WindowSizes& sizes, std::optional<float> left, const Input& input);
  // Before a picture: hands Dear ImGui what it can take in one.
  void feed();
  void clear();  // forgets all keys and buttons

 private:
  bool inside(std::optional<float> left, double px, double py) const;

  std::deque<Input> waiting_;  // not shown to Dear ImGui yet; positions in pixels of the picture
  bool pressed_here_[3] = {}, pressed_in_scene_[3] = {};
  double x_ = -1.0, y_ = -1.0;  // of the pointer
};

}  // namespace ambf::render
