#include "render/drawing/gpu_store.h"

#include <algorithm>
#include <set>

#include "mesh/mesh.h"
#include "mesh/tangents.h"

namespace ambf::render {

namespace {

constexpr std::size_t kFloatsPerVertex = 8;
constexpr int kSoftwareTextureSide = 2048;
// From EXT_texture_filter_anisotropic, part of OpenGL only since 4.6 but offered everywhere.
constexpr GLenum kMaxAnisotropy = 0x84FF, kAnisotropy = 0x84FE;

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

void append_tangents(const mesh::Submesh& part, std::vector<float>& out) {
  const std::size_t count = part.vertex_count();
  if (part.texcoords.size() < 2 * count || part.normals.size() < 3 * count) {
    for (std::size_t i = 0; i < count; ++i) out.insert(out.end(), {1.0F, 0.0F, 0.0F, 1.0F, 0.0F, 1.0F, 0.0F});
    return;
  }
  mesh::Submesh computed;
  const mesh::Submesh* from = &part;
  if (part.tangents.size() < 4 * count) {
    computed = part;
    mesh::compute_tangents(computed);
    from = &computed;
  }
  for (std::size_t i = 0; i < count; ++i) {
    const float *n = &part.normals[3 * i], *t = &from->tangents[4 * i];
    out.insert(out.end(), {t[0], t[1], t[2], t[3], t[3] * (n[1] * t[2] - n[2] * t[1]),
                           t[3] * (n[2] * t[0] - n[0] * t[2]), t[3] * (n[0] * t[1] - n[1] * t[0])});
  }
}

// Do the triangles, seen counter-clockwise, face against their normals?
bool inside_out(const mesh::Submesh& part) {
  if (part.normals.size() < part.positions.size()) return false;
  std::size_t against = 0;
  for (std::size_t t = 0; t + 2 < part.triangles.size(); t += 3) {
    const std::uint32_t* i = &part.triangles[t];
    const math::Vec3 a = part.vertex(i[0]);
    const math::Vec3 facing = math::cross(part.vertex(i[1]) - a, part.vertex(i[2]) - a);
    const float* n = &part.normals[3 * std::size_t{i[0]}];
    if (math::dot(facing, {n[0], n[1], n[2]}) < 0.0) ++against;
  }
  return 2 * against > part.triangle_count();
}

}  // namespace

GpuStore::GpuStore(const Gl& gl)
    : gl_(gl), software_(draws_in_software(gl)), white_(gl), loader_(software_ ? kSoftwareTextureSide : kMaxImageSide) {
  const std::uint8_t texel[4] = {255, 255, 255, 255};
  gl_.BindTexture(GL_TEXTURE_2D, white_.name());
  gl_.TexImage2D(GL_TEXTURE_2D, 0, GL_SRGB8_ALPHA8, 1, 1, 0, GL_RGBA, GL_UNSIGNED_BYTE, texel);
  gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  if (!software_) {
    gl_.GetFloatv(kMaxAnisotropy, &anisotropy_);
    if (gl_.GetError() != GL_NO_ERROR) anisotropy_ = 1.0F;  // not offered
    anisotropy_ = std::clamp(anisotropy_, 1.0F, 16.0F);
  }
}

void GpuStore::prepare(const SceneBatches& scene, const Wishes& wishes) {
  std::set<const mesh::Mesh*> named;
  std::set<TextureKey> files;
  for (const DrawBatch& batch : scene.batches) {
    named.insert(batch.mesh.get());
    const Surface& surface = batch.surface;
    if (!surface.texture_file.empty()) files.insert({surface.texture_file, TextureUse::color});
    if (!surface.normal_map_file.empty()) files.insert({surface.normal_map_file, TextureUse::normal});
  }
  for (const std::string& file : wishes.raw_textures) files.insert({file, TextureUse::raw});
  std::erase_if(meshes_, [&](const auto& entry) { return named.count(entry.first) == 0; });
  std::erase_if(textures_, [&](const auto& entry) { return files.count(entry.first) == 0; });
  for (const DrawBatch& batch : scene.batches) {
    if (meshes_.count(batch.mesh.get()) == 0) upload_mesh(batch.mesh);
    MeshBuffers& buffers = meshes_.at(batch.mesh.get());
    const bool bumpy = !batch.surface.normal_map_file.empty() || wishes.tangents.count(batch.mesh.get()) != 0;
    if (bumpy && !buffers.tangents) upload_tangents(buffers, batch.mesh->submeshes, GL_STATIC_DRAW);
  }
  for (const TextureKey& file : files) {
    const auto picture = scene.pictures.find(file.file);
    const bool is_within = picture != scene.pictures.end();
    if (textures_.try_emplace(file).second) loader_.ask(file, is_within ? picture->second : nullptr);
  }
}

void GpuStore::upload_mesh(const std::shared_ptr<const mesh::Mesh>& mesh) {
  std::vector<float> vertices;
  std::vector<std::uint32_t> indices;
  MeshBuffers buffers{mesh, GlBuffer(gl_), GlBuffer(gl_), {}, {}};
  for (const mesh::Submesh& part : mesh->submeshes) {
    const auto base = static_cast<std::uint32_t>(vertices.size() / kFloatsPerVertex);
    append_vertices(part, vertices);
    buffers.parts.push_back(
        {indices.size(), part.triangles.size(), 2 * part.lines.size(), inside_out(part), mesh::facing_of(part)});
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

void GpuStore::reshape(const mesh::Mesh* mesh, const std::vector<mesh::Submesh>& now) {
  MeshBuffers& buffers = meshes_.at(mesh);
  std::vector<float> vertices;
  for (const mesh::Submesh& part : now) append_vertices(part, vertices);
  gl_.BindBuffer(GL_ARRAY_BUFFER, buffers.vertices.name());
  gl_.BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(vertices.size() * sizeof(float)), vertices.data(),
                 GL_STREAM_DRAW);
  if (buffers.tangents) upload_tangents(buffers, now, GL_STREAM_DRAW);
}

void GpuStore::upload_tangents(MeshBuffers& buffers, const std::vector<mesh::Submesh>& submeshes, GLenum usage) {
  std::vector<float> tangents;
  for (const mesh::Submesh& part : submeshes) append_tangents(part, tangents);
  if (!buffers.tangents) buffers.tangents = GlBuffer(gl_);
  gl_.BindBuffer(GL_ARRAY_BUFFER, buffers.tangents.name());
  gl_.BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(tangents.size() * sizeof(float)), tangents.data(), usage);
}

base::Diagnostics GpuStore::collect() {
  base::Diagnostics diagnostics;
  for (const Decoded& decoded : loader_.take_finished()) {
    if (textures_.count(decoded.key) == 0) continue;  // unloaded meanwhile
    if (!decoded.levels.empty()) {
      upload_texture(decoded);
      continue;
    }
    base::Diagnostic finding;
    finding.severity = base::Severity::warning;
    finding.file = decoded.key.file;
    if (decoded.key.use == TextureUse::raw) continue;  // said for the other use of the file
    const bool color = decoded.key.use == TextureUse::color;
    finding.message = std::string(color ? "texture" : "normal map") + " cannot be read: " + decoded.why;
    finding.hint = color ? "the surface is drawn in its plain colour; convert the picture to PNG or JPEG"
                         : "the surface is drawn smooth; convert the picture to PNG or JPEG";
    diagnostics.push_back(finding);
  }
  return diagnostics;
}

base::Diagnostics GpuStore::finish() {
  loader_.wait();
  return collect();
}

void GpuStore::upload_texture(const Decoded& decoded) {
  ++textures_taken_;
  const Image& largest = decoded.levels.front();
  Texture texture{GlTexture(gl_), decoded.has_alpha, std::max(largest.width, largest.height)};
  gl_.BindTexture(GL_TEXTURE_2D, texture.name.name());
  const bool as_is = decoded.key.use == TextureUse::normal || decoded.key.use == TextureUse::raw;
  gl_.PixelStorei(GL_UNPACK_ALIGNMENT, 4);
  GLint level = 0;
  for (const Image& image : decoded.levels) {
    gl_.TexImage2D(GL_TEXTURE_2D, level++, as_is ? GL_RGBA8 : GL_SRGB8_ALPHA8, image.width, image.height, 0, GL_RGBA,
                   GL_UNSIGNED_BYTE, image.rgba.data());
  }
  // Of one level alone, small prints shimmer when the view moves; blending two costs the processor some percent of a
  // picture.
  gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
  gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  if (anisotropy_ > 1.0F) gl_.TexParameterf(GL_TEXTURE_2D, kAnisotropy, anisotropy_);
  textures_.insert_or_assign(decoded.key, std::move(texture));
}

const GpuStore::Texture* GpuStore::texture(const std::string& file, TextureUse use) const {
  const auto found = textures_.find({file, use});
  return found == textures_.end() || !found->second.name ? nullptr : &found->second;
}

}  // namespace ambf::render
