#include "render/drawing/detail/sky_cube.h"

namespace ambf::render {

namespace {

constexpr float kCorners[] = {-1, -1, -1, 1, -1, -1, -1, 1, -1, 1, 1, -1, -1, -1, 1, 1, -1, 1, -1, 1, 1, 1, 1, 1};
constexpr unsigned char kTriangles[] = {0, 1, 3, 0, 3, 2, 4, 6, 7, 4, 7, 5, 0, 4, 5, 0, 5, 1,
                                        2, 3, 7, 2, 7, 6, 0, 2, 6, 0, 6, 4, 1, 5, 7, 1, 7, 3};

}  // namespace

SkyCube::SkyCube(const Gl& gl) : gl_(gl), vertex_array_(gl), corners_(gl), indices_(gl) {
  gl_.BindVertexArray(vertex_array_.name());
  gl_.BindBuffer(GL_ARRAY_BUFFER, corners_.name());
  gl_.BufferData(GL_ARRAY_BUFFER, sizeof kCorners, kCorners, GL_STATIC_DRAW);
  gl_.EnableVertexAttribArray(0);
  gl_.VertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, 3 * sizeof(float), nullptr);
  gl_.BindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices_.name());
  gl_.BufferData(GL_ELEMENT_ARRAY_BUFFER, sizeof kTriangles, kTriangles, GL_STATIC_DRAW);
  gl_.BindVertexArray(0);
}

void SkyCube::draw() const {
  gl_.BindVertexArray(vertex_array_.name());
  gl_.DrawElementsInstanced(GL_TRIANGLES, sizeof kTriangles, GL_UNSIGNED_BYTE, nullptr, 1);
  gl_.BindVertexArray(0);
}

}  // namespace ambf::render
