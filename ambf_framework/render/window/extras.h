// What a window shows over the scene, for its user alone: pictures that are published have none of it. Private to render/.
#pragma once

#include <vector>

#include "render/marks/debug_draw.h"
#include "render/marks/flat_drawing.h"
#include "render/scene/draw_scene.h"

namespace ambf::render {

struct Extras {
  std::vector<Tint> tints;             // of picked bodies
  const DebugDraw* debug = nullptr;    // in space; its words are laid out among the marks (label_layout.h)
  const FlatDrawing* marks = nullptr;  // over everything
  std::vector<BodyLook> looks{};       // of bodies, by slot; empty: all as loaded
};

}  // namespace ambf::render
