// One picture or two: what the eyes of a camera see in a window, side by side. Pure functions, any thread.
#pragma once

#include <vector>

#include "render/camera/camera.h"

namespace ambf::render {

// An eye and the part of the window that shows what it sees: where that begins and how wide it is, in the unit of the
// window's width.
struct EyeView {
  Camera camera;
  double left = 0.0, width = 0.0;
};

// One in the middle; of a stereo lens the left eye, then the right one (intrinsics.h).
std::vector<EyeView> eyes_of(const Camera& middle, const state::Lens& lens, double window_width);
// That which shows this place of the window.
const EyeView& eye_at(const std::vector<EyeView>& eyes, double x);

}  // namespace ambf::render
