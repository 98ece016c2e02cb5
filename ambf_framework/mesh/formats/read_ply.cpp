// PLY: ascii and both binary byte orders; polygons, triangle strips, edges (as lines), per-vertex and per-corner
// texture coordinates, normals, the texture named in a comment as MeshLab writes it. Other properties and elements are
// skipped.
#include <cmath>
#include <limits>
#include <string>

#include "mesh/formats/detail/ply_numbers.h"
#include "mesh/formats/read_context.h"
#include "mesh/formats/text.h"

namespace ambf::mesh {

namespace {

// What a property means to us.
enum class Use { skip, x, y, z, nx, ny, nz, u, v, vertex_list, texcoord_list, edge_a, edge_b };

struct Property {
  std::string name;
  PlyType type = PlyType::none;        // of the value, or of a list's items
  PlyType count_type = PlyType::none;  // none: no list
  Use use = Use::skip;
};

struct Element {
  std::string name;
  std::size_t count = 0;
  std::vector<Property> properties;
};

class PlyReader {
 public:
  PlyReader(ReadContext& context, RawMesh& out) : context_(context), out_(out) {}

  bool read(std::string_view bytes) {
    if (!read_header(bytes)) return false;
    assign_uses();
    PlyNumbers body(bytes, format_ == "ascii", format_ == "binary_big_endian", line_ + 1);
    for (const Element& element : elements_) {
      if (!read_element(element, body)) return false;
    }
    return check_indices();
  }

 private:
  bool fail_header(const std::string& what) {
    return context_.not_understood("PLY header: " + what, "export the mesh again", line_);
  }

  bool read_header(std::string_view& bytes) {
    std::string_view line;
    for (line_ = 1; take_line(bytes, line); ++line_) {
      std::string_view rest = trim(line);
      const std::string_view keyword = take_word(rest);
      if (line_ == 1) {
        if (keyword != "ply") return fail_header("expected 'ply' on the first line, found " + in_quotes(keyword));
      } else if (keyword == "end_header") {
        if (format_.empty()) return fail_header("there is no 'format' line");
        return true;
      } else if (keyword == "format") {
        format_ = std::string(take_word(rest));
        if (format_ != "ascii" && format_ != "binary_little_endian" && format_ != "binary_big_endian") {
          return fail_header("expected format ascii, binary_little_endian or binary_big_endian, found " +
                             in_quotes(format_));
        }
      } else if (keyword == "element") {
        if (!read_element_line(rest)) return false;
      } else if (keyword == "property") {
        if (!read_property_line(rest)) return false;
      } else if (keyword == "comment") {
        if (equal_ignoring_case(take_word(rest), "TextureFile")) texture_ = std::string(trim(rest));
      } else if (!keyword.empty() && keyword != "obj_info") {
        return fail_header("expected 'element', 'property' or 'end_header', found " + in_quotes(keyword));
      }
    }
    return fail_header("there is no 'end_header' line");
  }

  bool read_element_line(std::string_view rest) {
    constexpr std::size_t kMaxElements = 100;
    Element element;
    element.name = std::string(take_word(rest));
    std::int64_t count = 0;
    const std::string_view number = take_word(rest);
    if (!parse_integer(number, count) || count < 0) {
      return fail_header("expected 'element NAME COUNT', found count " + in_quotes(number));
    }
    element.count = static_cast<std::size_t>(count);
    if (elements_.size() >= kMaxElements) return fail_header("there are more than 100 elements");
    elements_.push_back(std::move(element));
    return true;
  }

  bool read_property_line(std::string_view rest) {
    constexpr std::size_t kMaxProperties = 1000;
    if (elements_.empty()) return fail_header("a property stands before the first element");
    Property property;
    std::string_view word = take_word(rest);
    if (word == "list") {
      const std::string_view count_type = take_word(rest);
      property.count_type = ply_type_named(count_type);
      if (property.count_type == PlyType::none) return fail_header("unknown type " + in_quotes(count_type));
      word = take_word(rest);
    }
    property.type = ply_type_named(word);
    if (property.type == PlyType::none) return fail_header("unknown type " + in_quotes(word));
    property.name = std::string(take_word(rest));
    if (elements_.back().properties.size() >= kMaxProperties) return fail_header("there are more than 1000 properties");
    elements_.back().properties.push_back(std::move(property));
    return true;
  }

  void assign_uses() {
    struct Meaning {
      const char *element, *property;
      bool list;
      Use use;
    };
    static constexpr Meaning kMeanings[] = {{"vertex", "x", false, Use::x},
                                            {"vertex", "y", false, Use::y},
                                            {"vertex", "z", false, Use::z},
                                            {"vertex", "nx", false, Use::nx},
                                            {"vertex", "ny", false, Use::ny},
                                            {"vertex", "nz", false, Use::nz},
                                            {"vertex", "u", false, Use::u},
                                            {"vertex", "s", false, Use::u},
                                            {"vertex", "texture_u", false, Use::u},
                                            {"vertex", "v", false, Use::v},
                                            {"vertex", "t", false, Use::v},
                                            {"vertex", "texture_v", false, Use::v},
                                            {"face", "vertex_indices", true, Use::vertex_list},
                                            {"face", "vertex_index", true, Use::vertex_list},
                                            {"face", "texcoord", true, Use::texcoord_list},
                                            {"tristrips", "vertex_indices", true, Use::vertex_list},
                                            {"edge", "vertex1", false, Use::edge_a},
                                            {"edge", "vertex2", false, Use::edge_b}};
    for (Element& element : elements_) {
      for (Property& property : element.properties) {
        for (const Meaning& m : kMeanings) {
          const bool list = property.count_type != PlyType::none;
          if (element.name == m.element && property.name == m.property && list == m.list) property.use = m.use;
        }
      }
    }
    if (!texture_.empty()) {
      Material material;
      material.texture_file = context_.find_texture(texture_, context_.path());
      out_.materials.push_back(material);
      material_ = 0;
    }
  }

  static bool has(const Element& element, Use use) {
    for (const Property& p : element.properties) {
      if (p.use == use) return true;
    }
    return false;
  }

  bool read_element(const Element& element, PlyNumbers& body) {
    if (element.properties.empty() || element.count == 0) return true;
    const bool vertices = element.name == "vertex";
    if (vertices) {
      if (!has(element, Use::x) || !has(element, Use::y) || !has(element, Use::z)) {
        return context_.fail("PLY header: element vertex needs the properties x, y and z", "export the mesh again");
      }
      if (!context_.allow_vertices(out_.position_count() + element.count)) return false;
    }
    if (element.name == "edge" && !context_.allow_vertices(2 * element.count)) return false;
    has_normals_ =
        has_normals_ || (vertices && has(element, Use::nx) && has(element, Use::ny) && has(element, Use::nz));
    has_texcoords_ = has_texcoords_ || (vertices && has(element, Use::u) && has(element, Use::v));
    for (std::size_t i = 0; i < element.count; ++i) {
      double values[16] = {};
      list_.clear();
      texcoords_.clear();
      for (const Property& property : element.properties) {
        if (!read_property(element, property, i, body, values)) return false;
      }
      if (!add(element, vertices, i, body, values)) return false;
    }
    return true;
  }

  bool read_property(const Element& element, const Property& property, std::size_t item, PlyNumbers& body,
                     double* values) {
    if (property.count_type == PlyType::none) {
      return body.read(property.type, values[static_cast<int>(property.use)]) || fail_short(element, item, body);
    }
    double count = 0.0;
    if (!body.read(property.count_type, count) || !(count >= 0.0) || count != std::floor(count)) {
      return fail_short(element, item, body);
    }
    if (!context_.allow_vertices(count > 1e18 ? SIZE_MAX : static_cast<std::size_t>(count), body.line())) return false;
    const auto items = static_cast<std::size_t>(count);
    if (property.use == Use::skip && !body.ascii()) {
      return body.skip(items * ply_size_of(property.type)) || fail_short(element, item, body);
    }
    for (std::size_t k = 0; k < items; ++k) {
      double value = 0.0;
      if (!body.read(property.type, value)) return fail_short(element, item, body);
      if (property.use == Use::vertex_list) list_.push_back(value);
      if (property.use == Use::texcoord_list) texcoords_.push_back(value);
    }
    return true;
  }

  bool fail_short(const Element& element, std::size_t item, PlyNumbers& body) {
    return context_.fail("expected " + std::to_string(element.count) + " times element " + in_quotes(element.name) +
                             ", number " + std::to_string(item + 1) + " is cut short or not made of numbers",
                         "copy or export the file again", body.line());
  }

  // Beyond the range of float: infinity, which is refused where it matters.
  static float to_float(double value) {
    constexpr double kMost = std::numeric_limits<float>::max();
    return std::abs(value) <= kMost ? static_cast<float>(value) : std::numeric_limits<float>::infinity();
  }

  bool add(const Element& element, bool vertex, std::size_t item, PlyNumbers& body, const double* values) {
    const auto value = [values](Use use) { return to_float(values[static_cast<int>(use)]); };
    if (vertex) {
      for (Use use : {Use::x, Use::y, Use::z}) {
        if (!std::isfinite(value(use))) {
          return context_.fail("vertex " + std::to_string(item + 1) + " has a coordinate that is not a finite number",
                               "export the mesh again", body.line());
        }
        out_.positions.push_back(value(use));
      }
      if (has_normals_) out_.normals.insert(out_.normals.end(), {value(Use::nx), value(Use::ny), value(Use::nz)});
      if (has_texcoords_) out_.texcoords.insert(out_.texcoords.end(), {value(Use::u), value(Use::v)});
      return true;
    }
    if (element.name == "edge" && has(element, Use::edge_a) && has(element, Use::edge_b)) {
      RawLine line;
      if (!to_index(values[static_cast<int>(Use::edge_a)], line.a, body) ||
          !to_index(values[static_cast<int>(Use::edge_b)], line.b, body)) {
        return false;
      }
      if (line.a != line.b) out_.lines.push_back(line);
      return true;
    }
    if (element.name == "face" && has(element, Use::vertex_list)) return add_face(list_, body);
    return element.name != "tristrips" || add_strips(body);
  }

  bool to_index(double value, std::uint32_t& out, PlyNumbers& body) {
    if (!(value >= 0.0 && value < 4294967295.0 && value == std::floor(value))) {
      return context_.fail("expected a vertex index, found " + std::to_string(value), "export the mesh again",
                           body.line());
    }
    out = static_cast<std::uint32_t>(value);
    return true;
  }

  bool add_face(const std::vector<double>& indices, PlyNumbers& body) {
    if (indices.size() < 3) {
      return context_.fail("a face has " + std::to_string(indices.size()) + " corners, expected at least 3",
                           "export the mesh again", body.line());
    }
    triangles_ += indices.size() - 2;
    if (!context_.allow_triangles(triangles_, body.line())) return false;
    RawFace face;
    face.first = static_cast<std::uint32_t>(out_.corners.size());
    face.count = static_cast<std::uint32_t>(indices.size());
    face.material = material_;
    const bool own_texcoords = texcoords_.size() == 2 * indices.size();
    for (std::size_t k = 0; k < indices.size(); ++k) {
      RawCorner corner;
      if (!to_index(indices[k], corner.position, body)) return false;
      if (has_normals_) corner.normal = corner.position;
      if (has_texcoords_) corner.texcoord = corner.position;
      if (own_texcoords) {
        corner.texcoord = static_cast<std::uint32_t>(out_.texcoords.size() / 2);
        out_.texcoords.push_back(to_float(texcoords_[2 * k]));
        out_.texcoords.push_back(to_float(texcoords_[2 * k + 1]));
      }
      out_.corners.push_back(corner);
    }
    out_.faces.push_back(face);
    return true;
  }

  // Strips are ended by -1; every second triangle of one runs the other way round.
  bool add_strips(PlyNumbers& body) {
    std::size_t start = 0;
    const std::vector<double> strip = list_;
    for (std::size_t k = 0; k < strip.size(); ++k) {
      if (strip[k] < 0.0) {
        start = k + 1;
      } else if (k >= start + 2) {
        const bool odd = (k - start) % 2 == 1;
        const double a = strip[k - 2], b = strip[k - 1], c = strip[k];
        if (a == b || b == c || a == c) continue;
        if (!add_face(odd ? std::vector<double>{b, a, c} : std::vector<double>{a, b, c}, body)) return false;
      }
    }
    return true;
  }

  // Faces may stand before the vertices, so indices are checked at the end.
  bool check_indices() {
    const std::size_t count = out_.position_count();
    const auto bad = [&](std::uint32_t index) {
      return index >= count &&
             !context_.fail("a face or edge names vertex " + std::to_string(index) + ", but there are " +
                                std::to_string(count) + " vertices (counted from 0)",
                            "export the mesh again");
    };
    for (const RawCorner& corner : out_.corners) {
      if (bad(corner.position)) return false;
    }
    for (const RawLine& line : out_.lines) {
      if (bad(line.a) || bad(line.b)) return false;
    }
    // Faces that stood before a vertex element with normals or texture coordinates have none of them: indices stay
    // valid.
    for (RawCorner& corner : out_.corners) {
      if (corner.normal != kNoIndex && corner.normal >= out_.normals.size() / 3) corner.normal = kNoIndex;
      if (corner.texcoord != kNoIndex && corner.texcoord >= out_.texcoords.size() / 2) corner.texcoord = kNoIndex;
    }
    return true;
  }

  ReadContext& context_;
  RawMesh& out_;
  std::vector<Element> elements_;
  std::string format_, texture_;
  std::vector<double> list_, texcoords_;
  std::size_t triangles_ = 0;
  std::int32_t material_ = -1;
  int line_ = 0;
  bool has_normals_ = false, has_texcoords_ = false;
};

}  // namespace

bool read_ply(std::string_view bytes, ReadContext& context, RawMesh& out) {
  return PlyReader(context, out).read(bytes);
}

}  // namespace ambf::mesh
