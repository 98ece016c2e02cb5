// Vertex attributes, as all programs that draw meshes bind them. Private to render/.
#pragma once

#include "render/gl/detail/functions.h"

namespace ambf::render {

// row0 to body are of each instance: InstanceData.
enum class Attribute : GLuint { position, normal, texcoord, row0, row1, row2, body, tangent, bitangent };
#define AMBF_MESH_ATTRIBUTES \
  { "position", "normal", "texcoord", "row0", "row1", "row2", "body", "tangent", "bitangent" }

}  // namespace ambf::render
