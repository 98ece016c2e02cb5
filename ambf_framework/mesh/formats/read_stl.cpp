// STL, binary and ascii. Facet normals in the file are ignored: many exporters leave them zero or wrong, the corners'
// order is right. So are the two attribute bytes of binary facets (no agreed meaning).
#include <cmath>
#include <cstring>

#include "mesh/detail/position_table.h"
#include "mesh/formats/read_context.h"
#include "mesh/formats/text.h"

namespace ambf::mesh {

namespace {

constexpr std::size_t kHeaderBytes = 84;
constexpr std::size_t kFacetBytes = 50;

std::uint32_t read_u32(const char* p) {
  const auto* b = reinterpret_cast<const unsigned char*>(p);
  return static_cast<std::uint32_t>(b[0]) | static_cast<std::uint32_t>(b[1]) << 8 |
         static_cast<std::uint32_t>(b[2]) << 16 | static_cast<std::uint32_t>(b[3]) << 24;
}

float read_float(const char* p) {
  const std::uint32_t bits = read_u32(p);
  float value = 0.0F;
  std::memcpy(&value, &bits, sizeof value);
  return value;
}

void add_triangle(const float xyz[9], PositionTable& table, RawMesh& out) {
  RawFace face;
  face.first = static_cast<std::uint32_t>(out.corners.size());
  face.count = 3;
  for (int corner = 0; corner < 3; ++corner) {
    RawCorner c;
    c.position = table.index_of(xyz + 3 * corner, out.positions);
    out.corners.push_back(c);
  }
  out.faces.push_back(face);
}

bool read_binary(std::string_view bytes, ReadContext& context, RawMesh& out) {
  if (bytes.size() < kHeaderBytes) {
    return context.fail("this is no STL file: expected 'solid' or a binary header of 84 bytes, found only " +
                            std::to_string(bytes.size()) + " bytes",
                        "export the mesh again");
  }
  const std::size_t count = read_u32(bytes.data() + 80);
  const std::size_t room = (bytes.size() - kHeaderBytes) / kFacetBytes;
  if (count > room) {
    return context.fail("binary STL is cut short: its header announces " + std::to_string(count) + " triangles (" +
                            std::to_string(kHeaderBytes + kFacetBytes * count) + " bytes), found " +
                            std::to_string(bytes.size()) + " bytes, enough for " + std::to_string(room),
                        "copy or export the file again");
  }
  if (!context.allow_triangles(count)) return false;
  if (bytes.size() != kHeaderBytes + kFacetBytes * count) {
    context.warn(std::to_string(bytes.size() - kHeaderBytes - kFacetBytes * count) + " bytes after the last of " +
                     std::to_string(count) + " triangles are ignored",
                 "check that the file was exported completely");
  }
  PositionTable table(count / 2);
  out.corners.reserve(3 * count);
  out.faces.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const char* facet = bytes.data() + kHeaderBytes + kFacetBytes * i + 12;  // after the normal
    float xyz[9];
    for (int k = 0; k < 9; ++k) {
      xyz[k] = read_float(facet + 4 * k);
      if (!std::isfinite(xyz[k])) {
        return context.fail("triangle " + std::to_string(i + 1) + " has a coordinate that is not a finite number",
                            "export the mesh again; coordinates must be finite");
      }
    }
    add_triangle(xyz, table, out);
    if (!context.allow_vertices(out.position_count())) return false;
  }
  return true;
}

bool read_ascii(std::string_view bytes, ReadContext& context, RawMesh& out) {
  WordScanner words(bytes);
  PositionTable table(bytes.size() / 500);
  float xyz[9];
  int corners = -1;  // -1: outside a facet
  for (std::string_view word = words.next(); !word.empty(); word = words.next()) {
    if (equal_ignoring_case(word, "vertex")) {
      if (corners < 0 || corners > 2) {
        return context.not_understood(
            corners < 0 ? "'vertex' stands outside a facet" : "a facet has more than three vertices",
            "an STL facet is: facet normal, outer loop, three vertices, endloop, endfacet", words.line());
      }
      for (int k = 0; k < 3; ++k) {
        const std::string_view number = words.next();
        if (!parse_float(number, xyz[3 * corners + k])) {
          return context.fail("expected a finite coordinate after 'vertex', found " + in_quotes(number),
                              "export the mesh again", words.line());
        }
      }
      ++corners;
    } else if (equal_ignoring_case(word, "facet")) {
      if (corners >= 0) {
        return context.fail("a facet begins before 'endfacet' of the last one", "export the mesh again", words.line());
      }
      corners = 0;
      for (int k = 0; k < 4; ++k) words.next();  // normal x y z
    } else if (equal_ignoring_case(word, "endfacet")) {
      if (corners != 3) {
        return context.fail("a facet ends with " + std::to_string(corners < 0 ? 0 : corners) + " vertices, expected 3",
                            "export the mesh again", words.line());
      }
      corners = -1;
      if (!context.allow_triangles(out.faces.size() + 1, words.line())) return false;
      add_triangle(xyz, table, out);
      if (!context.allow_vertices(out.position_count(), words.line())) return false;
    } else if (equal_ignoring_case(word, "solid") || equal_ignoring_case(word, "endsolid")) {
      words.skip_line();  // the name may be anything
    } else if (!equal_ignoring_case(word, "outer") && !equal_ignoring_case(word, "loop") &&
               !equal_ignoring_case(word, "endloop")) {
      return context.not_understood("expected 'facet', 'vertex' or 'endfacet', found " + in_quotes(word),
                                    "export the mesh again", words.line());
    }
  }
  if (corners >= 0) {
    return context.fail("ascii STL is cut short: the last facet has no 'endfacet'", "copy or export the file again",
                        words.line());
  }
  return true;
}

}  // namespace

bool read_stl(std::string_view bytes, ReadContext& context, RawMesh& out) {
  // Many binary files begin with "solid" as well: the size decides first.
  const bool exact_size =
      bytes.size() >= kHeaderBytes && bytes.size() == kHeaderBytes + kFacetBytes * read_u32(bytes.data() + 80);
  if (exact_size) return read_binary(bytes, context, out);
  const bool text = bytes.substr(0, 512).find('\0') == std::string_view::npos;
  if (text && starts_with_ignoring_case(trim(bytes.substr(0, 512)), "solid")) return read_ascii(bytes, context, out);
  return read_binary(bytes, context, out);
}

}  // namespace ambf::mesh
