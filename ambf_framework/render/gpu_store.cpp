#include "render/gpu_store.h"

#include <algorithm>
#include <set>

#include "mesh/mesh.h"
#include "render/image_file.h"

namespace ambf::render {

namespace {

constexpr std::size_t kFloatsPerVertex = 8;

void append_vertices(const mesh::Submesh& part, std::vector<float>& out) {
  const bool textured = part.texcoords.size() >= 2 * part.vertex_count();
  const bool lit = part.normals.size() >= 3 * part.vertex_count();
  for (std::size_t i = 0; i < part.vertex_count(); ++i) {
    out.insert(out.end(), {part.positions[3 * i], part.positions[3 * i + 1], part.positions[3 * i + 2]});
    if (lit) {
      out.insert(out.end(), {part.normals[3 * i], part.normals[3 * i + 1], part.normals[3 * i + 2]});
    } else {
      out.insert(out.end(), {0.0F, 0.0F, 1.0F});
    }
    out.push_back(textured ? part.texcoords[2 * i] : 0.0F);
    out.push_back(textured ? part.texcoords[2 * i + 1] : 0.0F);
  }
}

// OpenGL's first row is the lowest one (v = 0); files begin at the top.
void flip_rows(Image& image) {
  const std::size_t row = std::size_t{4} * static_cast<std::size_t>(image.width);
  for (std::size_t top = 0, bottom = static_cast<std::size_t>(image.height); top + 1 < bottom; ++top) {
    --bottom;
    const auto at = [&](std::size_t y) { return image.rgba.begin() + static_cast<std::ptrdiff_t>(y * row); };
    std::swap_ranges(at(top), at(top + 1), at(bottom));
  }
}

}  // namespace

// Blending two levels costs the processor twice the time.
GpuStore::GpuStore(const Gl& gl)
    : gl_(gl), min_filter_(draws_in_software(gl) ? GL_LINEAR_MIPMAP_NEAREST : GL_LINEAR_MIPMAP_LINEAR), white_(gl) {
  const std::uint8_t texel[4] = {255, 255, 255, 255};
  gl_.BindTexture(GL_TEXTURE_2D, white_.name());
  gl_.TexImage2D(GL_TEXTURE_2D, 0, GL_SRGB8_ALPHA8, 1, 1, 0, GL_RGBA, GL_UNSIGNED_BYTE, texel);
  gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
}

base::Diagnostics GpuStore::prepare(const DrawScene& scene) {
  base::Diagnostics diagnostics;
  std::set<const mesh::Mesh*> named;
  std::set<std::string> files;
  for (const DrawBatch& batch : scene.batches) {
    named.insert(batch.mesh.get());
    if (!batch.surface.texture_file.empty()) files.insert(batch.surface.texture_file);
  }
  std::erase_if(meshes_, [&](const auto& entry) { return named.count(entry.first) == 0; });
  std::erase_if(textures_, [&](const auto& entry) { return files.count(entry.first) == 0; });
  for (const DrawBatch& batch : scene.batches) {
    if (meshes_.count(batch.mesh.get()) == 0) upload_mesh(batch.mesh);
  }
  for (const std::string& file : files) {
    if (textures_.count(file) == 0) textures_.emplace(file, upload_texture(file, diagnostics));
  }
  return diagnostics;
}

void GpuStore::upload_mesh(const std::shared_ptr<const mesh::Mesh>& mesh) {
  std::vector<float> vertices;
  std::vector<std::uint32_t> indices;
  MeshBuffers buffers{mesh, GlBuffer(gl_), GlBuffer(gl_), {}};
  for (const mesh::Submesh& part : mesh->submeshes) {
    const auto base = static_cast<std::uint32_t>(vertices.size() / kFloatsPerVertex);
    append_vertices(part, vertices);
    buffers.parts.push_back({indices.size(), part.triangles.size(), 2 * part.lines.size()});
    for (const std::uint32_t index : part.triangles) indices.push_back(base + index);
    for (const auto& line : part.lines) indices.insert(indices.end(), {base + line[0], base + line[1]});
  }
  gl_.BindVertexArray(0);  // else the index buffer would be noted in whichever vertex array is bound
  gl_.BindBuffer(GL_ARRAY_BUFFER, buffers.vertices.name());
  gl_.BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(vertices.size() * sizeof(float)), vertices.data(),
                 GL_STATIC_DRAW);
  gl_.BindBuffer(GL_ARRAY_BUFFER, buffers.indices.name());
  gl_.BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(indices.size() * sizeof(std::uint32_t)), indices.data(),
                 GL_STATIC_DRAW);
  meshes_.emplace(mesh.get(), std::move(buffers));
}

GlTexture GpuStore::upload_texture(const std::string& file, base::Diagnostics& diagnostics) const {
  Image image;
  std::string why;
  if (!read_image(file, image, why)) {
    base::Diagnostic finding;
    finding.severity = base::Severity::warning;
    finding.file = file;
    finding.message = "texture cannot be read: " + why;
    finding.hint = "the surface is drawn in its plain colour; convert the picture to PNG or JPEG";
    diagnostics.push_back(finding);
    return {};
  }
  flip_rows(image);
  GlTexture texture(gl_);
  gl_.BindTexture(GL_TEXTURE_2D, texture.name());
  gl_.PixelStorei(GL_UNPACK_ALIGNMENT, 4);
  gl_.TexImage2D(GL_TEXTURE_2D, 0, GL_SRGB8_ALPHA8, image.width, image.height, 0, GL_RGBA, GL_UNSIGNED_BYTE,
                 image.rgba.data());
  gl_.GenerateMipmap(GL_TEXTURE_2D);
  gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, min_filter_);
  gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  return texture;
}

GLuint GpuStore::texture(const std::string& file) const {
  const auto found = textures_.find(file);
  return found == textures_.end() || !found->second ? white_.name() : found->second.name();
}

}  // namespace ambf::render
