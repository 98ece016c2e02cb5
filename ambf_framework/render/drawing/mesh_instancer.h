// Draws the instances of a draw list with whatever program is in use. One a context (vertex arrays are not shared).
// Main thread, context current. Private to render/.
#pragma once

#include <functional>

#include "render/drawing/gpu_store.h"
#include "render/scene/scene_batches.h"

namespace ambf::render {

class MeshInstancer {
 public:
  explicit MeshInstancer(const Gl& gl) : gl_(gl), vertex_array_(gl), instances_(gl) {}

  // Hands the instances of `list` to the card. To be called before draw().
  void upload(const DrawList& list);
  // Called with each batch that is about to be drawn: for its uniforms and culling.
  using Before = std::function<void(const DrawBatch&, const GpuStore::Part&, const DrawCommand&)>;
  void draw(const GpuStore& store, const SceneBatches& scene, const std::vector<DrawCommand>& commands, bool with_lines,
            const Before& before);

 private:
  void point_at(const GpuStore::MeshBuffers& buffers, std::uint32_t first_instance);

  const Gl& gl_;
  GlVertexArray vertex_array_;
  GlBuffer instances_;
};

}  // namespace ambf::render
