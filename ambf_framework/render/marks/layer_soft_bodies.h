// The layers of soft bodies, for the table of layers. Pure functions, any thread.
#pragma once

#include "render/marks/layer_shapes.h"

namespace ambf::render {

// Nodes (free grey, fixed red, held orange) and the links between them.
void draw_soft_nodes(const LayerInput& in, WorldShapes& out);
// Links by how far they are from their length as loaded: blue shorter, grey as it was, red longer, full at 10 %.
void draw_soft_strain(const LayerInput& in, WorldShapes& out);

// Of a link whose length is that times its length as loaded.
DebugColor strain_color(double stretch);

}  // namespace ambf::render
