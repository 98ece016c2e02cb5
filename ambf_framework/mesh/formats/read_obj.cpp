// Wavefront OBJ: polygons, polylines, texture coordinates, normals, materials, smoothing groups. Objects and groups are
// joined: a body is one rigid thing. Free-form curves and points are reported and left out.
#include <algorithm>
#include <map>
#include <set>
#include <string>

#include "mesh/formats/detail/read_mtl.h"
#include "mesh/formats/read_context.h"
#include "mesh/formats/text.h"

namespace ambf::mesh {

namespace {

constexpr const char* kExportAgain = "export the mesh again, or mend this line";

class ObjReader {
 public:
  ObjReader(ReadContext& context, RawMesh& out) : context_(context), out_(out) {}

  bool read(std::string_view bytes) {
    std::string_view line;
    while (take_line(bytes, line)) {
      ++line_;
      // A backslash at the end continues a line.
      const std::string_view content = trim(line);
      if (!content.empty() && content.back() == '\\') {
        joined_.append(content.substr(0, content.size() - 1));
        joined_ += ' ';
        continue;
      }
      bool ok = false;
      if (joined_.empty()) {
        ok = read_statement(content);
      } else {
        joined_.append(content);
        ok = read_statement(joined_);
        joined_.clear();
      }
      if (!ok) return false;
    }
    return joined_.empty() || read_statement(joined_);
  }

 private:
  bool read_statement(std::string_view rest) {
    const std::string_view keyword = take_word(rest);
    if (keyword.empty() || keyword.front() == '#') return true;
    if (keyword == "v") return read_numbers(rest, 3, out_.positions, "a vertex position");
    if (keyword == "vt") return read_texcoord(rest);
    if (keyword == "vn") return read_numbers(rest, 3, out_.normals, "a normal");
    if (keyword == "f" || keyword == "fo") return read_face(rest);
    if (keyword == "l") return read_polyline(rest);
    if (keyword == "usemtl") return use_material(trim(rest));
    if (keyword == "mtllib") return read_libraries(trim(rest));
    if (keyword == "s") return read_smoothing(trim(rest));
    if (keyword == "o" || keyword == "g" || keyword == "mg" || keyword == "lod") return true;
    if (unknown_.size() < 8 && unknown_.insert(std::string(keyword.substr(0, 40))).second) {
      context_.warn("statement " + in_quotes(keyword) + " is not supported and ignored",
                    "only polygons and polylines are read; convert curves and points to polygons", line_);
    }
    return true;
  }

  bool read_numbers(std::string_view rest, int count, std::vector<float>& into, const char* what) {
    if (!context_.allow_vertices(into.size() / static_cast<std::size_t>(count) + 1, line_)) return false;
    for (int i = 0; i < count; ++i) {
      const std::string_view word = take_word(rest);
      float value = 0.0F;
      if (!parse_float(word, value)) {
        return context_.not_understood("expected " + std::string(what) + " of " + std::to_string(count) +
                                           " finite numbers, found " +
                                           (word.empty() ? "the end of the line" : in_quotes(word)),
                                       kExportAgain, line_);
      }
      into.push_back(value);
    }
    return true;  // what follows is a weight or a vertex colour, neither of which is used
  }

  bool read_texcoord(std::string_view rest) {
    if (!context_.allow_vertices(out_.texcoords.size() / 2 + 1, line_)) return false;
    std::string_view first = rest;
    take_word(first);
    if (trim(first).empty()) {  // one-dimensional
      if (!read_numbers(rest, 1, one_, "a texture coordinate")) return false;
      out_.texcoords.insert(out_.texcoords.end(), {one_.back(), 0.0F});
      one_.clear();
      return true;
    }
    return read_numbers(rest, 2, out_.texcoords, "a texture coordinate");
  }

  // One of "p", "p/t", "p//n", "p/t/n"; counted from 1, or backwards from the last one with negative numbers.
  bool read_corner(std::string_view word, RawCorner& out) {
    const std::string_view whole = word;
    std::uint32_t* fields[3] = {&out.position, &out.texcoord, &out.normal};
    const std::size_t counts[3] = {out_.positions.size() / 3, out_.texcoords.size() / 2, out_.normals.size() / 3};
    const char* names[3] = {"vertices", "texture coordinates", "normals"};
    for (int i = 0; i < 3; ++i) {
      const std::size_t slash = std::min(word.find('/'), word.size());
      const std::string_view field = word.substr(0, slash);
      const bool last = slash == word.size();
      word.remove_prefix(last ? slash : slash + 1);
      if (!field.empty()) {
        std::int64_t number = 0;
        if (!parse_integer(field, number)) {
          return context_.not_understood("expected an index like 1/2/3, found " + in_quotes(whole), kExportAgain,
                                         line_);
        }
        const auto count = static_cast<std::int64_t>(counts[i]);
        if (number == 0 || number > count || number < -count) {
          return context_.fail("index " + in_quotes(field) + " is outside the " + std::to_string(count) + " " +
                                   names[i] + " given before this line",
                               "indices run from 1, or from -1 backwards; " + std::string(kExportAgain), line_);
        }
        *fields[i] = static_cast<std::uint32_t>(number > 0 ? number - 1 : count + number);
      } else if (i == 0) {
        return context_.not_understood("expected an index like 1/2/3, found " + in_quotes(whole), kExportAgain, line_);
      }
      if (last) break;
    }
    return true;
  }

  bool read_face(std::string_view rest) {
    RawFace face;
    face.first = static_cast<std::uint32_t>(out_.corners.size());
    face.material = material_;
    face.smoothing = smoothing_;
    for (std::string_view word = take_word(rest); !word.empty() && word.front() != '#'; word = take_word(rest)) {
      RawCorner corner;
      if (!read_corner(word, corner)) return false;
      out_.corners.push_back(corner);
      if (out_.corners.size() - face.first > 3 &&
          !context_.allow_triangles(out_.corners.size() - face.first - 2, line_)) {
        return false;
      }
    }
    face.count = static_cast<std::uint32_t>(out_.corners.size()) - face.first;
    if (face.count < 3) {
      return context_.fail("a face has " + std::to_string(face.count) + " corners, expected at least 3", kExportAgain,
                           line_);
    }
    triangles_ += face.count - 2;
    out_.faces.push_back(face);
    return context_.allow_triangles(triangles_, line_);
  }

  bool read_polyline(std::string_view rest) {
    std::uint32_t previous = kNoIndex;
    int count = 0;
    for (std::string_view word = take_word(rest); !word.empty() && word.front() != '#'; word = take_word(rest)) {
      RawCorner corner;
      if (!read_corner(word, corner)) return false;
      if (count > 0 && previous != corner.position) out_.lines.push_back({previous, corner.position, material_});
      previous = corner.position;
      ++count;
    }
    if (count < 2) return context_.fail("a polyline needs at least 2 vertices", kExportAgain, line_);
    return context_.allow_vertices(2 * out_.lines.size(), line_);
  }

  bool use_material(std::string_view name) {
    material_ = -1;
    if (name.empty() || equal_ignoring_case(name, "(null)") || equal_ignoring_case(name, "none")) return true;
    const auto found = material_by_name_.find(name);
    if (found != material_by_name_.end()) material_ = found->second;
    if (material_ < 0 && missing_.size() < 8 && missing_.insert(std::string(name.substr(0, 200))).second) {
      context_.warn("material " + in_quotes(name) + " is not defined in a material library; the default colour is used",
                    "check the 'mtllib' line and the library beside the mesh", line_);
    }
    return true;
  }

  bool read_libraries(std::string_view names) {
    // One name that may hold spaces, or several names.
    if (read_library(names)) return true;
    for (std::string_view word = take_word(names); !word.empty(); word = take_word(names)) {
      if (!read_library(word) && missing_.size() < 8 &&
          missing_.insert("mtllib " + std::string(word.substr(0, 200))).second) {
        context_.warn("material library " + in_quotes(word) + " was not found beside the mesh or cannot be read",
                      "put it into the same folder, or remove the 'mtllib' line", line_);
      }
    }
    return true;
  }

  // Each library is read once, and at most so many are looked for.
  bool read_library(std::string_view name) {
    constexpr std::size_t kMaxLibraries = 64;
    const auto known = libraries_.find(name);
    if (known != libraries_.end()) return known->second;
    if (libraries_.size() >= kMaxLibraries) return false;
    std::string path, bytes;
    const bool found = context_.read_beside(std::string(name), path, bytes);
    libraries_.emplace(std::string(name), found);
    if (found) read_mtl(bytes, path, context_, out_.materials);
    for (std::size_t i = 0; i < out_.materials.size(); ++i) {
      material_by_name_[out_.materials[i].name] = static_cast<std::int32_t>(i);
    }
    return found;
  }

  bool read_smoothing(std::string_view group) {
    std::int64_t number = 0;
    if (equal_ignoring_case(group, "off") || group == "0") {
      smoothing_ = 0;
    } else if (parse_integer(group, number)) {
      smoothing_ = 1U << (static_cast<std::uint64_t>(number) % 31U);
    } else {
      smoothing_ = kSmoothByAngle;
    }
    return true;
  }

  ReadContext& context_;
  RawMesh& out_;
  std::string joined_;
  std::vector<float> one_;
  std::set<std::string> unknown_, missing_;
  std::map<std::string, bool, std::less<>> libraries_;  // by name as written: found
  std::map<std::string, std::int32_t, std::less<>> material_by_name_;
  std::size_t triangles_ = 0;
  std::int32_t material_ = -1;
  std::uint32_t smoothing_ = kSmoothByAngle;
  int line_ = 0;
};

}  // namespace

bool read_obj(std::string_view bytes, ReadContext& context, RawMesh& out) {
  return ObjReader(context, out).read(bytes);
}

}  // namespace ambf::mesh
