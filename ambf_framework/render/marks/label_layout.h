// Places the words of a WorldShapes on a picture so that they can be read: none covers another, what is small in the
// picture fades away, and where there is not enough room the near come first. Pure functions, any thread.
#pragma once

#include <vector>

#include "render/camera/camera.h"
#include "render/marks/world_shapes.h"
#include "render/text/text_drawing.h"

namespace ambf::render {

struct Label {
  double left_px = 0.0, top_px = 0.0, width_px = 0.0, height_px = 0.0;  // of its paper
  const DebugText* text = nullptr;
  float alpha = 1.0F;
};

std::vector<Label> lay_out(const std::vector<DebugText>& texts, const Camera& camera, int width_px, int height_px,
                           const Lettering& letters);
void draw_labels(const std::vector<Label>& labels, TextDrawing& drawing);

}  // namespace ambf::render
