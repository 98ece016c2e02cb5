#include "render/marks/world_shapes_renderer.h"

#include <cstddef>
#include <map>

#include "render/marks/detail/world_shape_geometry.h"
#include "render/shaders/world_shape_shaders.h"

namespace ambf::render {

namespace {

constexpr float kHiddenShare = 0.4F;  // of what shows through
const void* offset(std::size_t bytes) { return reinterpret_cast<const void*>(bytes); }
float f(double x) { return static_cast<float>(x); }

}  // namespace

bool WorldShapesRenderer::build(std::string& why) {
  vertex_array_ = GlVertexArray(gl_);
  stream_ = GlBuffer(gl_);
  return line_program_.build(gl_, kDebugLineVertex, kDebugLineFragment,
                             {"from_point", "to_point", "half_widths", "tone"}, why) &&
         fill_program_.build(gl_, kDebugFillVertex, kDebugFillFragment, {"point", "tone"}, why) &&
         mesh_program_.build(gl_, kDebugMeshVertex, kDebugMeshFragment,
                             {"point", "row0", "row1", "row2", "face_tone", "edge_tone"}, why);
}

bool WorldShapesRenderer::draw(const WorldShapes& list, const Camera& camera, int width_px, int height_px,
                               std::string& why) {
  if (list.empty()) {
    meshes_.clear();
    identity_.forget_unused();
    return true;
  }
  if (!built_ && !build(why)) return false;
  built_ = true;
  const double aspect = static_cast<double>(width_px) / height_px;
  world_to_clip_ = projection_matrix(camera, aspect) * view_matrix(camera.T_world_camera);
  eye_ = camera.T_world_camera.position;
  gl_.BindVertexArray(vertex_array_.name());
  gl_.Enable(GL_DEPTH_TEST);
  gl_.Enable(GL_BLEND);
  gl_.BlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
  gl_.DepthMask(GL_FALSE);
  draw_meshes(list);
  draw_triangles(list);
  draw_lines(list, width_px, height_px);
  gl_.DepthMask(GL_TRUE);
  gl_.DepthFunc(GL_LEQUAL);
  gl_.Disable(GL_BLEND);
  gl_.BindVertexArray(0);
  return true;
}

void WorldShapesRenderer::stream(const void* data, std::size_t bytes) {
  gl_.BindBuffer(GL_ARRAY_BUFFER, stream_.name());
  gl_.BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(bytes), data, GL_STREAM_DRAW);
}

template <class Draw>
void WorldShapesRenderer::draw_seen(Program& program, bool in_front, bool through, bool always, Draw&& draw) {
  if (through) {
    gl_.DepthFunc(GL_GREATER);
    program.set("share", kHiddenShare);
    draw(Seen::through);
    gl_.DepthFunc(GL_LEQUAL);
    program.set("share", 1.0F);
    draw(Seen::through);
  }
  program.set("share", 1.0F);
  if (in_front) {
    gl_.DepthFunc(GL_LEQUAL);
    draw(Seen::in_front);
  }
  if (always) {
    gl_.DepthFunc(GL_ALWAYS);
    draw(Seen::always);
  }
}

const WorldShapesRenderer::MeshBuffers& WorldShapesRenderer::buffers_of(const std::shared_ptr<const mesh::Mesh>& mesh) {
  MeshBuffers& buffers = meshes_[mesh.get()];
  buffers.used = true;
  if (buffers.mesh != nullptr) return buffers;
  buffers.mesh = mesh;
  DebugGeometry geometry = debug_geometry(*mesh);
  buffers.vertices = GlBuffer(gl_);
  buffers.indices = GlBuffer(gl_);
  buffers.triangle_indices = static_cast<GLsizei>(geometry.triangles.size());
  buffers.sharp_indices = static_cast<GLsizei>(2 * geometry.sharp);
  buffers.edge_indices = static_cast<GLsizei>(geometry.edges.size());
  std::vector<std::uint32_t>& indices = geometry.triangles;
  indices.insert(indices.end(), geometry.edges.begin(), geometry.edges.end());
  gl_.BindBuffer(GL_ARRAY_BUFFER, buffers.vertices.name());
  gl_.BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(geometry.vertices.size() * sizeof(float)),
                 geometry.vertices.data(), GL_STATIC_DRAW);
  gl_.BindBuffer(GL_ELEMENT_ARRAY_BUFFER, buffers.indices.name());
  gl_.BufferData(GL_ELEMENT_ARRAY_BUFFER, static_cast<GLsizeiptr>(indices.size() * sizeof(std::uint32_t)),
                 indices.data(), GL_STATIC_DRAW);
  return buffers;
}

// Meshes of equal content are one draw.
void WorldShapesRenderer::draw_meshes(const WorldShapes& list) {
  for (auto& [mesh, buffers] : meshes_) buffers.used = false;
  std::vector<Group> groups;
  std::map<std::pair<const MeshBuffers*, bool>, std::size_t> group_of;
  for (const DebugMesh& mesh : list.meshes()) {
    const MeshBuffers& buffers = buffers_of(identity_.representative(mesh.mesh));
    const auto [at, is_new] = group_of.emplace(std::pair{&buffers, mesh.all_edges}, groups.size());
    if (is_new) groups.push_back({&buffers, mesh.all_edges, {}});
    Instance instance{{}, mesh.faces, mesh.edges};
    const Mat4 m = to_matrix(mesh.T_world_mesh, mesh.scale);
    for (std::size_t row = 0; row < 3; ++row) {
      for (std::size_t column = 0; column < 4; ++column) instance.rows[4 * row + column] = m.m[4 * column + row];
    }
    groups[at->second].instances.push_back(instance);
  }
  identity_.forget_unused();
  std::erase_if(meshes_, [](const auto& entry) { return !entry.second.used; });
  if (groups.empty()) return;

  mesh_program_.use();
  mesh_program_.set("world_to_clip", world_to_clip_);
  mesh_program_.set("eye", f(eye_.x), f(eye_.y), f(eye_.z));
  gl_.Enable(GL_POLYGON_OFFSET_FILL);  // before the surface that the body shows there
  gl_.PolygonOffset(-1.0F, -1.0F);
  for (const bool edges : {false, true}) {
    mesh_program_.set("edges", edges ? 1 : 0);
    draw_seen(mesh_program_, false, true, false, [&](Seen) {
      for (const Group& group : groups) draw_group(group, edges);
    });
  }
  gl_.Disable(GL_POLYGON_OFFSET_FILL);
}

void WorldShapesRenderer::draw_group(const Group& group, bool edges) {
  bool any = false;
  for (const Instance& instance : group.instances) any = any || (edges ? instance.edges : instance.faces)[3] > 0.0F;
  if (!any) return;
  gl_.BindBuffer(GL_ARRAY_BUFFER, group.buffers->vertices.name());
  gl_.EnableVertexAttribArray(0);
  gl_.VertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, 3 * sizeof(float), nullptr);
  gl_.VertexAttribDivisor(0, 0);
  stream(group.instances.data(), group.instances.size() * sizeof(Instance));
  for (GLuint i = 1; i < 6; ++i) {
    gl_.EnableVertexAttribArray(i);
    gl_.VertexAttribPointer(i, 4, GL_FLOAT, GL_FALSE, sizeof(Instance), offset((i - 1) * 4 * sizeof(float)));
    gl_.VertexAttribDivisor(i, 1);
  }
  gl_.BindBuffer(GL_ELEMENT_ARRAY_BUFFER, group.buffers->indices.name());
  const MeshBuffers& buffers = *group.buffers;
  const auto instances = static_cast<GLsizei>(group.instances.size());
  if (edges) {
    const auto first = static_cast<std::size_t>(buffers.triangle_indices);
    gl_.DrawElementsInstanced(GL_LINES, group.all_edges ? buffers.edge_indices : buffers.sharp_indices, GL_UNSIGNED_INT,
                              offset(first * sizeof(std::uint32_t)), instances);
  } else {
    gl_.DrawElementsInstanced(GL_TRIANGLES, buffers.triangle_indices, GL_UNSIGNED_INT, nullptr, instances);
  }
  for (GLuint i = 1; i < 6; ++i) gl_.DisableVertexAttribArray(i);
}

void WorldShapesRenderer::draw_triangles(const WorldShapes& list) {
  const auto some = [&](Seen seen) { return !list.triangles(seen).empty(); };
  if (!some(Seen::in_front) && !some(Seen::through) && !some(Seen::always)) return;
  fill_program_.use();
  fill_program_.set("world_to_clip", world_to_clip_);
  draw_seen(fill_program_, some(Seen::in_front), some(Seen::through), some(Seen::always), [&](Seen seen) {
    const std::vector<DebugVertex>& vertices = list.triangles(seen);
    stream(vertices.data(), vertices.size() * sizeof(DebugVertex));
    for (GLuint i = 0; i < 2; ++i) {
      gl_.EnableVertexAttribArray(i);
      gl_.VertexAttribDivisor(i, 0);
    }
    gl_.VertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, sizeof(DebugVertex), offset(offsetof(DebugVertex, point)));
    gl_.VertexAttribPointer(1, 4, GL_UNSIGNED_BYTE, GL_TRUE, sizeof(DebugVertex), offset(offsetof(DebugVertex, color)));
    gl_.DrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(vertices.size()));
  });
}

void WorldShapesRenderer::draw_lines(const WorldShapes& list, int width_px, int height_px) {
  const auto some = [&](Seen seen) { return !list.lines(seen).empty(); };
  if (!some(Seen::in_front) && !some(Seen::through) && !some(Seen::always)) return;
  line_program_.use();
  line_program_.set("world_to_clip", world_to_clip_);
  line_program_.set("half_picture", 0.5F * static_cast<float>(width_px), 0.5F * static_cast<float>(height_px));
  draw_seen(line_program_, some(Seen::in_front), some(Seen::through), some(Seen::always), [&](Seen seen) {
    const std::vector<DebugLine>& lines = list.lines(seen);
    stream(lines.data(), lines.size() * sizeof(DebugLine));
    for (GLuint i = 0; i < 4; ++i) {
      gl_.EnableVertexAttribArray(i);
      gl_.VertexAttribDivisor(i, 1);
    }
    constexpr GLsizei kStride = sizeof(DebugLine);
    gl_.VertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, kStride, offset(offsetof(DebugLine, from)));
    gl_.VertexAttribPointer(1, 3, GL_FLOAT, GL_FALSE, kStride, offset(offsetof(DebugLine, to)));
    gl_.VertexAttribPointer(2, 2, GL_FLOAT, GL_FALSE, kStride, offset(offsetof(DebugLine, from_half_px)));
    gl_.VertexAttribPointer(3, 4, GL_UNSIGNED_BYTE, GL_TRUE, kStride, offset(offsetof(DebugLine, color)));
    gl_.DrawArraysInstanced(GL_TRIANGLES, 0, 6, static_cast<GLsizei>(lines.size()));
    for (GLuint i = 0; i < 4; ++i) gl_.DisableVertexAttribArray(i);
  });
}

}  // namespace ambf::render
