// 3D Studio (.3ds): a tree of chunks {id, length, content}. Vertices lie in the file in the coordinates of the scene,
// so the objects' axes and the key framer are not needed, and nothing is turned to another "up": ADF poses refer to the
// file's own axes.
#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include "mesh/formats/detail/byte_reader.h"
#include "mesh/formats/read_context.h"
#include "mesh/formats/text.h"

namespace ambf::mesh {

namespace {

// Chunk ids.
constexpr std::uint16_t kMain = 0x4D4D;
constexpr std::uint16_t kEditor = 0x3D3D;
constexpr std::uint16_t kObject = 0x4000;
constexpr std::uint16_t kTriangleMesh = 0x4100;
constexpr std::uint16_t kVertices = 0x4110;
constexpr std::uint16_t kFaces = 0x4120;
constexpr std::uint16_t kFaceMaterial = 0x4130;
constexpr std::uint16_t kTexcoords = 0x4140;
constexpr std::uint16_t kSmoothing = 0x4150;
constexpr std::uint16_t kMaterial = 0xAFFF;
constexpr std::uint16_t kMaterialName = 0xA000;
constexpr std::uint16_t kAmbient = 0xA010;
constexpr std::uint16_t kDiffuse = 0xA020;
constexpr std::uint16_t kSpecular = 0xA030;
constexpr std::uint16_t kShininess = 0xA040;
constexpr std::uint16_t kTransparency = 0xA050;
constexpr std::uint16_t kTexture = 0xA200;
constexpr std::uint16_t kBump = 0xA230;
constexpr std::uint16_t kMapName = 0xA300;
constexpr std::uint16_t kColorFloat = 0x0010;
constexpr std::uint16_t kColorByte = 0x0011;
constexpr std::uint16_t kPercentInteger = 0x0030;
constexpr std::uint16_t kPercentFloat = 0x0031;

struct Chunk {
  std::uint16_t id = 0;
  std::string_view content;
};

// Takes the next chunk; false at the end, or with `broken` set when its length reaches beyond what holds it.
bool take_chunk(ByteReader& reader, Chunk& out, bool& broken) {
  constexpr std::size_t kHead = 6;
  if (reader.remaining() < kHead) return false;  // a few padding bytes are common
  out.id = reader.u16();
  const std::size_t length = reader.u32();
  broken = length < kHead || length - kHead > reader.remaining();
  if (!broken) out.content = reader.take(length - kHead);
  return !broken;
}

class Reader3ds {
 public:
  Reader3ds(ReadContext& context, RawMesh& out) : context_(context), out_(out) {}

  bool read(std::string_view bytes) {
    ByteReader reader(bytes);
    Chunk chunk;
    bool broken = false;
    if (!take_chunk(reader, chunk, broken) || chunk.id != kMain) {
      return broken ? fail_broken(chunk.id)
                    : context_.fail("this is no 3DS file: expected it to begin with chunk 0x4D4D",
                                    "export the mesh again as .3ds");
    }
    // Materials may stand after the objects that name them: two passes.
    return each(chunk.content, [this](const Chunk& c) { return c.id != kEditor || read_editor(c.content, true); }) &&
           each(chunk.content, [this](const Chunk& c) { return c.id != kEditor || read_editor(c.content, false); });
  }

 private:
  template <typename Visit>
  bool each(std::string_view content, const Visit& visit) {
    ByteReader reader(content);
    Chunk chunk;
    bool broken = false;
    while (take_chunk(reader, chunk, broken)) {
      if (!visit(chunk)) return false;
    }
    return !broken || fail_broken(chunk.id);
  }

  bool fail_broken(std::uint16_t id) {
    char name[8];
    std::snprintf(name, sizeof name, "0x%04X", static_cast<unsigned>(id));
    return context_.fail("3DS chunk " + std::string(name) + " is longer than what holds it, or cut short",
                         "copy or export the file again");
  }

  bool read_editor(std::string_view content, bool materials) {
    return each(content, [this, materials](const Chunk& c) {
      if (c.id == kMaterial) return !materials || read_material(c.content);
      return c.id != kObject || materials || read_object(c.content);
    });
  }

  bool read_material(std::string_view content) {
    Material material;
    const bool ok = each(content, [this, &material](const Chunk& c) {
      ByteReader reader(c.content);
      switch (c.id) {
        case kMaterialName: material.name = std::string(reader.text()); return true;
        case kAmbient: return read_color(c.content, material.ambient);
        case kDiffuse: return read_color(c.content, material.diffuse);
        case kSpecular: return read_color(c.content, material.specular);
        case kShininess: {
          float share = 0.5F;
          const bool read = read_percent(c.content, share);
          material.shininess = std::max(1.0F, 128.0F * share);
          return read;
        }
        case kTransparency: {
          float share = 0.0F;
          const bool read = read_percent(c.content, share);
          material.diffuse.a = 1.0F - share;
          return read;
        }
        case kTexture: return read_map(c.content, material.texture_file);
        case kBump: return read_map(c.content, material.normal_map_file);
        default: return true;
      }
    });
    if (!ok) return false;
    if (out_.materials.size() < 10000) {
      material_by_name_.emplace(material.name, static_cast<std::int32_t>(out_.materials.size()));
      out_.materials.push_back(material);
    }
    return true;
  }

  bool read_color(std::string_view content, Color& color) {
    return each(content, [&color](const Chunk& c) {
      ByteReader reader(c.content);
      float rgb[3] = {0.0F, 0.0F, 0.0F};
      if (c.id != kColorFloat && c.id != kColorByte) return true;  // gamma-corrected copies
      for (float& value : rgb) value = c.id == kColorFloat ? reader.f32() : static_cast<float>(reader.u8()) / 255.0F;
      if (!reader.ok() || !std::isfinite(rgb[0] + rgb[1] + rgb[2])) return true;
      color.r = std::clamp(rgb[0], 0.0F, 1.0F);
      color.g = std::clamp(rgb[1], 0.0F, 1.0F);
      color.b = std::clamp(rgb[2], 0.0F, 1.0F);
      return true;
    });
  }

  bool read_percent(std::string_view content, float& share) {
    return each(content, [&share](const Chunk& c) {
      ByteReader reader(c.content);
      float value = -1.0F;
      if (c.id == kPercentInteger) value = static_cast<float>(reader.u16()) / 100.0F;
      if (c.id == kPercentFloat) value = reader.f32();
      if (reader.ok() && value >= 0.0F) share = std::min(value, 1.0F);
      return true;
    });
  }

  bool read_map(std::string_view content, std::string& file) {
    return each(content, [this, &file](const Chunk& c) {
      if (c.id != kMapName) return true;
      ByteReader reader(c.content);
      const std::string name(reader.text());
      if (!name.empty()) file = context_.find_texture(name, context_.path());
      return true;
    });
  }

  bool read_object(std::string_view content) {
    ByteReader reader(content);
    object_ = std::string(reader.text());
    if (!reader.ok()) return context_.fail("a 3DS object has no name that ends", "export the mesh again");
    return each(reader.take(reader.remaining()),
                [this](const Chunk& c) { return c.id != kTriangleMesh || read_triangle_mesh(c.content); });
  }

  bool read_triangle_mesh(std::string_view content) {
    const std::size_t base = out_.position_count(), texcoord_base = out_.texcoords.size() / 2;
    std::size_t texcoords = 0;
    const std::size_t first_face = out_.faces.size();
    const bool ok = each(content, [&](const Chunk& c) {
      switch (c.id) {
        case kVertices: return read_floats(c.content, 3, out_.positions, "vertex position");
        case kTexcoords: {
          const bool read = read_floats(c.content, 2, out_.texcoords, "texture coordinate");
          texcoords = out_.texcoords.size() / 2 - texcoord_base;
          return read;
        }
        case kFaces: return read_faces(c.content);
        default: return true;
      }
    });
    if (!ok) return false;
    // Faces count vertices from the object's first one; vertices may come after them.
    const std::size_t count = out_.position_count() - base;
    for (std::size_t f = first_face; f < out_.faces.size(); ++f) {
      for (std::uint32_t k = 0; k < 3; ++k) {
        RawCorner& corner = out_.corners[out_.faces[f].first + k];
        if (corner.position >= count) {
          return context_.fail("object " + in_quotes(object_) + " has a face with vertex " +
                                   std::to_string(corner.position) + ", but only " + std::to_string(count) +
                                   " vertices",
                               "export the mesh again");
        }
        if (corner.position < texcoords) corner.texcoord = static_cast<std::uint32_t>(texcoord_base + corner.position);
        corner.position += static_cast<std::uint32_t>(base);
      }
    }
    return true;
  }

  bool read_floats(std::string_view content, std::size_t width, std::vector<float>& into, const char* what) {
    ByteReader reader(content);
    const std::size_t count = reader.u16();
    if (!context_.allow_vertices(into.size() / width + count)) return false;
    for (std::size_t i = 0; i < width * count; ++i) {
      const float value = reader.f32();
      if (!reader.ok() || !std::isfinite(value)) {
        return context_.fail("object " + in_quotes(object_) + ": expected " + std::to_string(count) + " times a " +
                                 what + " of finite numbers, number " + std::to_string(i / width + 1) +
                                 " is not, or missing",
                             "copy or export the file again");
      }
      into.push_back(value);
    }
    return true;
  }

  bool read_faces(std::string_view content) {
    ByteReader reader(content);
    const std::size_t count = reader.u16(), first = out_.faces.size();
    if (!context_.allow_triangles(first + count)) return false;
    for (std::size_t i = 0; i < count; ++i) {
      RawFace face;
      face.first = static_cast<std::uint32_t>(out_.corners.size());
      face.count = 3;
      for (int k = 0; k < 3; ++k) out_.corners.push_back({reader.u16(), kNoIndex, kNoIndex});
      reader.u16();  // edge visibility
      out_.faces.push_back(face);
    }
    if (!reader.ok()) {
      return context_.fail(
          "object " + in_quotes(object_) + " announces " + std::to_string(count) + " faces, but its chunk is shorter",
          "copy or export the file again");
    }
    return each(reader.take(reader.remaining()), [&](const Chunk& c) {
      ByteReader list(c.content);
      if (c.id == kFaceMaterial) {
        const auto material = material_by_name_.find(list.text());
        const std::size_t entries = list.u16();
        for (std::size_t i = 0; i < entries && list.remaining() >= 2; ++i) {
          const std::size_t face = list.u16();
          if (face < count && material != material_by_name_.end()) out_.faces[first + face].material = material->second;
        }
      } else if (c.id == kSmoothing) {
        for (std::size_t i = 0; i < count && list.remaining() >= 4; ++i) out_.faces[first + i].smoothing = list.u32();
      }
      return true;
    });
  }

  ReadContext& context_;
  RawMesh& out_;
  std::string object_;
  std::map<std::string, std::int32_t, std::less<>> material_by_name_;
};

}  // namespace

bool read_3ds(std::string_view bytes, ReadContext& context, RawMesh& out) {
  return Reader3ds(context, out).read(bytes);
}

}  // namespace ambf::mesh
