// What a window shows over the scene, for its user alone; published pictures have none of it.
#pragma once

#include <vector>

#include "render/marks/debug_draw.h"
#include "render/scene/draw_scene.h"
#include "render/text/text_drawing.h"

namespace ambf::render {

struct Extras {
  std::vector<Tint> tints;            // of picked bodies
  const DebugDraw* debug = nullptr;   // in space; its texts are laid out by label_layout.h
  const TextDrawing* text = nullptr;  // over everything
  std::vector<BodyLook> looks{};      // of bodies, by slot; empty: all as loaded
};

}  // namespace ambf::render
