#include "render/drawing/mesh_instancer.h"

namespace ambf::render {

namespace {

const void* offset(std::size_t bytes) { return reinterpret_cast<const void*>(bytes); }

constexpr GLsizei kVertexBytes = 8 * sizeof(float);

}  // namespace

void MeshInstancer::upload(const DrawList& list) {
  gl_.BindBuffer(GL_ARRAY_BUFFER, instances_.name());
  gl_.BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(list.instances.size() * sizeof(InstanceData)),
                 list.instances.data(), GL_STREAM_DRAW);
}

// OpenGL 3.3 has no base instance: the attribute pointers are moved to the first one.
void MeshInstancer::point_at(const GpuStore::MeshBuffers& buffers, std::uint32_t first_instance) {
  gl_.BindBuffer(GL_ARRAY_BUFFER, buffers.vertices.name());
  const GLint sizes[3] = {3, 3, 2};
  std::size_t at = 0;
  for (GLuint i = 0; i < 3; ++i) {
    gl_.EnableVertexAttribArray(i);
    gl_.VertexAttribPointer(i, sizes[i], GL_FLOAT, GL_FALSE, kVertexBytes, offset(at));
    at += static_cast<std::size_t>(sizes[i]) * sizeof(float);
  }
  gl_.BindBuffer(GL_ARRAY_BUFFER, instances_.name());
  at = first_instance * sizeof(InstanceData);
  const GLint of_instance[4] = {4, 4, 4, 1};
  for (GLuint i = 3; i < 7; ++i) {
    gl_.EnableVertexAttribArray(i);
    gl_.VertexAttribPointer(i, of_instance[i - 3], GL_FLOAT, GL_FALSE, sizeof(InstanceData), offset(at));
    gl_.VertexAttribDivisor(i, 1);
    at += static_cast<std::size_t>(of_instance[i - 3]) * sizeof(float);
  }
  constexpr GLuint kTangent = static_cast<GLuint>(Attribute::tangent), kBitangent = kTangent + 1;
  if (buffers.tangents) {
    constexpr GLsizei kBytes = 7 * sizeof(float);
    gl_.BindBuffer(GL_ARRAY_BUFFER, buffers.tangents.name());
    gl_.EnableVertexAttribArray(kTangent);
    gl_.EnableVertexAttribArray(kBitangent);
    gl_.VertexAttribPointer(kTangent, 4, GL_FLOAT, GL_FALSE, kBytes, offset(0));
    gl_.VertexAttribPointer(kBitangent, 3, GL_FLOAT, GL_FALSE, kBytes, offset(4 * sizeof(float)));
  } else {
    gl_.DisableVertexAttribArray(kTangent);
    gl_.DisableVertexAttribArray(kBitangent);
  }
  gl_.BindBuffer(GL_ELEMENT_ARRAY_BUFFER, buffers.indices.name());
}

void MeshInstancer::draw(const GpuStore& store, const SceneBatches& scene, const std::vector<DrawCommand>& commands,
                         bool with_lines, const Before& before) {
  gl_.BindVertexArray(vertex_array_.name());
  for (const DrawCommand& command : commands) {
    const DrawBatch& batch = scene.batches[command.batch];
    const GpuStore::MeshBuffers& buffers = store.mesh(batch.mesh.get());
    const GpuStore::Part& part = buffers.parts[batch.submesh];
    point_at(buffers, command.first);
    if (before) before(batch, part, command);
    const auto count = static_cast<GLsizei>(command.count);
    if (part.triangle_indices > 0) {
      gl_.DrawElementsInstanced(GL_TRIANGLES, static_cast<GLsizei>(part.triangle_indices), GL_UNSIGNED_INT,
                                offset(part.first_index * sizeof(std::uint32_t)), count);
    }
    if (with_lines && part.line_indices > 0) {
      gl_.DrawElementsInstanced(GL_LINES, static_cast<GLsizei>(part.line_indices), GL_UNSIGNED_INT,
                                offset((part.first_index + part.triangle_indices) * sizeof(std::uint32_t)), count);
    }
  }
  gl_.BindVertexArray(0);
}

}  // namespace ambf::render
