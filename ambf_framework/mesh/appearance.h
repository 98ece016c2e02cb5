// How a body looks: meshes or primitives placed in the body frame, with their materials. Immutable once made by the
// loader; shared by frames' Structure and render/. Any thread.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "math/types.h"
#include "state/view.h"

namespace ambf::mesh {

struct Mesh;  // mesh/mesh.h

// Overrides the mesh's own materials. Linear components in [0, 1].
struct SurfaceMaterial {
  float ambient[3] = {0.3f, 0.3f, 0.3f};
  float diffuse[3] = {0.7f, 0.7f, 0.7f};
  float specular[3] = {1.0f, 1.0f, 1.0f};
  float emission[3] = {0.0f, 0.0f, 0.0f};
  float alpha = 1.0f;
  float shininess = 64.0f;
  float metallic = 0.0f;  // 0..1: share of the surface that is bare metal
};

struct AppearancePart {
  std::shared_ptr<const Mesh> mesh;
  math::Pose T_body_part;
  double scale = 1.0;
  std::optional<SurfaceMaterial> material = {};  // goes before that of the whole
};

struct Appearance {
  std::vector<AppearancePart> parts;
  bool has_material = false;  // false: each mesh's own
  SurfaceMaterial material;
  bool visible = true;
  state::ShaderFiles shaders;  // of the body or its model; none: the world's
};

}  // namespace ambf::mesh
