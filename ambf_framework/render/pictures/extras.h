// What a window shows over the scene, for its user alone; published pictures have none of it.
#pragma once

#include <vector>

#include "render/marks/world_shapes.h"
#include "render/scene/scene_batches.h"
#include "render/text/text_drawing.h"

namespace ambf::render {

struct Extras {
  std::vector<std::uint32_t> outlined;  // slots of bodies that pointers hold
  const WorldShapes* debug = nullptr;   // in space; its texts are laid out by label_layout.h
  const TextDrawing* text = nullptr;    // over everything
  std::vector<BodyLook> looks{};        // of bodies, by slot; empty: all as loaded
};

}  // namespace ambf::render
