// COLLADA (.dae) 1.4 and 1.5: the geometry of the scene with its node transforms and its unit (to metres), skinned meshes in their
// bind shape. The file's axes are kept: `up_axis` is reported, not applied, because ADF poses refer to the file's own axes.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>

#include "mesh/formats/detail/collada_faces.h"
#include "mesh/formats/detail/collada_materials.h"
#include "mesh/formats/detail/collada_transform.h"
#include "mesh/formats/detail/xml.h"
#include "mesh/formats/read_context.h"
#include "mesh/formats/text.h"

namespace ambf::mesh {

namespace {

constexpr std::uint32_t kNone = XmlTree::kNone;

class ColladaReader {
 public:
  ColladaReader(const XmlTree& xml, ReadContext& context, RawMesh& out)
      : xml_(xml), ids_(xml), context_(context), out_(out), materials_(xml, ids_, context, out), faces_(context, out) {}

  bool read() {
    const std::uint32_t root = xml_.root();
    if (xml_[root].name != "COLLADA") {
      return context_.fail("expected element COLLADA, found " + in_quotes(xml_[root].name),
                           "export the mesh again as .dae", xml_[root].line);
    }
    const std::uint32_t asset = xml_.child(root, "asset");
    double unit = 1.0;
    const std::string meter = xml_.attribute(xml_.child(asset, "unit"), "meter");
    if (!meter.empty() && (!parse_double(meter, unit) || !(unit > 0.0))) {
      return context_.fail("expected a unit in metres, found " + in_quotes(meter), "mend asset/unit of the file");
    }
    const std::string up = xml_.text(xml_.child(asset, "up_axis"));
    if (!up.empty() && up != "Z_UP") {
      context_.inform("up_axis is " + in_quotes(up) + ", which is not applied: coordinates stay as the file gives them",
                      "turn the body by its 'location', or export with z up");
    }
    Matrix to_metres = kIdentity;
    to_metres[0] = to_metres[5] = to_metres[10] = unit;

    const std::uint32_t instance = xml_.child(xml_.child(root, "scene"), "instance_visual_scene");
    std::uint32_t scene = ids_.find(xml_.attribute(instance, "url"), "visual_scene");
    if (scene == kNone) scene = xml_.child(xml_.child(root, "library_visual_scenes"), "visual_scene");
    if (scene != kNone) return visit_children(scene, to_metres, 0);
    context_.warn("there is no scene; all geometries are taken as they are", "export the scene with the mesh");
    for (std::uint32_t g = xml_.child(xml_.child(root, "library_geometries"), "geometry"); g != kNone;
         g = xml_.next_same(g)) {
      if (!read_geometry(g, to_metres, kNone)) return false;
    }
    return true;
  }

 private:
  // Instances can repeat each other exponentially: all reading is paid from one budget of characters.
  bool spend(std::size_t characters) {
    constexpr std::size_t kBudget = 500'000'000;
    spent_ += characters;
    return spent_ <= kBudget ||
           context_.fail("the instances of this scene repeat too much geometry", "simplify the scene");
  }

  bool fail_at(std::uint32_t node, const std::string& message) {
    return context_.fail(message, "export the mesh again", node == kNone ? 0 : xml_[node].line);
  }

  bool read_values(std::uint32_t node, std::size_t count, std::array<double, 16>& out) {
    const std::string text = xml_.text(node);
    WordScanner words(text);
    for (std::size_t i = 0; i < count; ++i) {
      if (!parse_double(words.next(), out[i])) {
        return fail_at(
            node, "expected " + std::to_string(count) + " finite numbers in element " + in_quotes(xml_[node].name));
      }
    }
    return spend(text.size());
  }

  bool visit_children(std::uint32_t parent, const Matrix& T_mesh_parent, int depth) {
    constexpr int kDeepest = 300;
    constexpr std::size_t kCostOfNode = 500;
    if (depth > kDeepest) return fail_at(parent, "nodes are nested too deeply, or instance each other in a circle");
    for (std::uint32_t c = xml_[parent].first_child; c != kNone; c = xml_[c].next_sibling) {
      if (xml_[c].name == "node" && (!spend(kCostOfNode) || !visit_node(c, T_mesh_parent, depth + 1))) return false;
    }
    return true;
  }

  bool visit_node(std::uint32_t node, const Matrix& T_mesh_parent, int depth) {
    Matrix T = T_mesh_parent;
    for (std::uint32_t c = xml_[node].first_child; c != kNone; c = xml_[c].next_sibling) {
      if (!spend(100 + xml_[c].content.size()) || !apply_transform(c, T)) return false;
    }
    for (std::uint32_t c = xml_[node].first_child; c != kNone; c = xml_[c].next_sibling) {
      const std::string_view name = xml_[c].name;
      if (name == "instance_geometry") {
        const std::uint32_t geometry = ids_.find(xml_.attribute(c, "url"), "geometry");
        if (geometry == kNone) {
          return fail_at(c, "geometry " + in_quotes(xml_.attribute(c, "url")) + " is not defined in this file");
        }
        if (!read_geometry(geometry, T, c)) return false;
      } else if (name == "instance_controller") {
        if (!read_controller(c, T)) return false;
      } else if (name == "instance_node") {
        const std::uint32_t other = ids_.find(xml_.attribute(c, "url"), "node");
        if (other == kNone)
          return fail_at(c, "node " + in_quotes(xml_.attribute(c, "url")) + " is not defined in this file");
        if (depth > 300) return fail_at(c, "nodes are nested too deeply, or instance each other in a circle");
        if (!spend(500) || !visit_node(other, T, depth + 1)) return false;
      }
    }
    return visit_children(node, T, depth);
  }

  bool apply_transform(std::uint32_t c, Matrix& T) {
    const std::string_view name = xml_[c].name;
    if (name == "lookat" || name == "skew") {
      context_.warn("transform " + in_quotes(name) + " is not supported and ignored", "export with plain transforms",
                    xml_[c].line);
    }
    const std::size_t count = name == "matrix"                         ? 16
                              : name == "rotate"                       ? 4
                              : name == "translate" || name == "scale" ? 3
                                                                       : 0;
    std::array<double, 16> values{};
    if (count == 0) return true;
    if (!read_values(c, count, values)) return false;
    T = T * transform_of(name, values);
    return true;
  }

  bool read_controller(std::uint32_t instance, const Matrix& T) {
    const std::uint32_t controller = ids_.find(xml_.attribute(instance, "url"), "controller");
    const std::uint32_t skin = xml_.child(controller, "skin");
    const std::uint32_t geometry = ids_.find(xml_.attribute(skin, "source"), "geometry");
    if (geometry == kNone) {
      context_.warn(
          "controller " + in_quotes(xml_.attribute(instance, "url")) + " has no skinned geometry and is ignored",
          "export the mesh without animation", xml_[instance].line);
      return true;
    }
    Matrix bind = kIdentity;
    const std::uint32_t matrix = xml_.child(skin, "bind_shape_matrix");
    if (matrix != kNone && !read_values(matrix, 16, bind)) return false;
    return read_geometry(geometry, T * bind, instance);
  }

  // One geometry placed in the scene.
  struct Placed {
    Matrix T;
    std::uint32_t mesh = kNone;
    std::map<std::string, std::string> materials;      // symbol -> material reference
    std::map<std::uint32_t, std::uint32_t> positions;  // source element -> first index in RawMesh::positions, likewise
    std::map<std::uint32_t, std::uint32_t> normals;
    std::map<std::uint32_t, std::uint32_t> texcoords;
  };

  bool read_geometry(std::uint32_t geometry, const Matrix& T, std::uint32_t instance) {
    Placed placed;
    placed.T = T;
    placed.mesh = xml_.child(geometry, "mesh");
    if (placed.mesh == kNone) {
      context_.warn("geometry " + in_quotes(xml_.attribute(geometry, "id")) + " is no mesh and is ignored",
                    "convert curves and convex hulls to meshes", xml_[geometry].line);
      return spend(1000);
    }
    const std::uint32_t bindings = xml_.child(xml_.child(instance, "bind_material"), "technique_common");
    for (std::uint32_t b = xml_.child(bindings, "instance_material"); b != kNone; b = xml_.next_same(b)) {
      placed.materials[xml_.attribute(b, "symbol")] = xml_.attribute(b, "target");
      if (!spend(100)) return false;
    }
    static constexpr std::string_view kPrimitives[] = {"triangles", "polylist", "polygons",  "tristrips",
                                                       "trifans",   "lines",    "linestrips"};
    for (std::uint32_t c = xml_[placed.mesh].first_child; c != kNone; c = xml_[c].next_sibling) {
      if (!spend(100 + xml_[c].content.size())) return false;
      if (std::find(std::begin(kPrimitives), std::end(kPrimitives), xml_[c].name) != std::end(kPrimitives) &&
          !read_primitive(c, placed)) {
        return false;
      }
    }
    return true;
  }

  // Appends a source's tuples of `width` numbers to `into`; on success `out_count` tuples were added.
  bool read_source(std::uint32_t source, std::size_t width, std::vector<float>& into, std::size_t& out_count) {
    const std::uint32_t array = xml_.child(source, "float_array");
    const std::uint32_t accessor = xml_.child(xml_.child(source, "technique_common"), "accessor");
    if (array == kNone) return fail_at(source, "a source has no float_array");
    std::int64_t stride = static_cast<std::int64_t>(width), offset = 0;
    const std::string stride_text = xml_.attribute(accessor, "stride"),
                      offset_text = xml_.attribute(accessor, "offset");
    if ((!stride_text.empty() && (!parse_integer(stride_text, stride) || stride < 1 || stride > 1024)) ||
        (!offset_text.empty() && (!parse_integer(offset_text, offset) || offset < 0))) {
      return fail_at(accessor, "expected a stride from 1 to 1024 and an offset of at least 0");
    }
    std::size_t index = 0;
    float tuple[3] = {};
    bool ok = true;
    const std::size_t used = std::min(width, static_cast<std::size_t>(stride)), before = into.size() / width;
    xml_.each_text(array, [&](std::string_view piece) {
      ok = ok && spend(piece.size());
      WordScanner words(piece);
      for (std::string_view word = ok ? words.next() : std::string_view(); ok && !word.empty();
           word = words.next(), ++index) {
        float value = 0.0F;
        if (!parse_float(word, value)) ok = fail_at(array, "expected finite numbers, found " + in_quotes(word));
        if (index < static_cast<std::size_t>(offset)) continue;
        const std::size_t k = (index - static_cast<std::size_t>(offset)) % static_cast<std::size_t>(stride);
        if (k < used) tuple[k] = value;
        if (k + 1 == static_cast<std::size_t>(stride)) into.insert(into.end(), tuple, tuple + width);
        if (ok && k + 1 == static_cast<std::size_t>(stride)) ok = context_.allow_vertices(into.size() / width);
      }
    });
    out_count = into.size() / width - before;
    return ok;
  }

  struct Inputs {
    std::size_t stride = 1;
    std::size_t position_at = 0, normal_at = 0, texcoord_at = 0;
    std::uint32_t position_source = kNone, normal_source = kNone, texcoord_source = kNone;
  };

  bool read_inputs(std::uint32_t primitive, Inputs& out) {
    constexpr std::int64_t kMostInputs = 16;
    for (std::uint32_t input = xml_.child(primitive, "input"); input != kNone; input = xml_.next_same(input)) {
      std::int64_t offset = 0;
      const std::string text = xml_.attribute(input, "offset");
      if (!text.empty() && (!parse_integer(text, offset) || offset < 0 || offset >= kMostInputs)) {
        return fail_at(input, "expected an input offset from 0 to 15, found " + in_quotes(text));
      }
      const auto at = static_cast<std::size_t>(offset);
      out.stride = std::max(out.stride, at + 1);
      const std::string semantic = xml_.attribute(input, "semantic"), source = xml_.attribute(input, "source");
      if (semantic == "VERTEX") {
        const std::uint32_t vertices = ids_.find(source, "vertices");
        for (std::uint32_t v = xml_.child(vertices, "input"); v != kNone; v = xml_.next_same(v)) {
          use_input(xml_.attribute(v, "semantic"), ids_.find(xml_.attribute(v, "source"), "source"), at, out);
        }
      } else {
        use_input(semantic, ids_.find(source, "source"), at, out);
      }
      if (!spend(100)) return false;
    }
    if (out.position_source == kNone) return fail_at(primitive, "there is no source with semantic POSITION");
    return true;
  }

  static void use_input(const std::string& semantic, std::uint32_t source, std::size_t at, Inputs& out) {
    if (source == kNone) return;
    if (semantic == "POSITION") out.position_source = source, out.position_at = at;
    if (semantic == "NORMAL") out.normal_source = source, out.normal_at = at;
    // The first set of several.
    if (semantic == "TEXCOORD" && out.texcoord_source == kNone) out.texcoord_source = source, out.texcoord_at = at;
  }

  bool place_sources(const Inputs& inputs, Placed& placed) {
    std::size_t count = 0;
    if (placed.positions.count(inputs.position_source) == 0) {
      const std::size_t base = out_.positions.size() / 3;
      placed.positions[inputs.position_source] = static_cast<std::uint32_t>(base);
      if (!read_source(inputs.position_source, 3, out_.positions, count)) return false;
      for (std::size_t i = base; i < base + count; ++i) {
        float* p = out_.positions.data() + 3 * i;
        const double x = p[0], y = p[1], z = p[2];
        for (std::size_t k = 0; k < 3; ++k) {
          const Matrix& T = placed.T;
          const double moved = T[4 * k] * x + T[4 * k + 1] * y + T[4 * k + 2] * z + T[4 * k + 3];
          if (!(std::abs(moved) <= 3.0e38)) {
            return fail_at(inputs.position_source, "a vertex placed in the scene is not finite");
          }
          p[k] = static_cast<float>(moved);
        }
      }
    }
    if (inputs.normal_source != kNone && placed.normals.count(inputs.normal_source) == 0) {
      const std::size_t base = out_.normals.size() / 3;
      placed.normals[inputs.normal_source] = static_cast<std::uint32_t>(base);
      if (!read_source(inputs.normal_source, 3, out_.normals, count)) return false;
      const double sign = determinant(placed.T) < 0.0 ? -1.0 : 1.0;
      for (std::size_t i = base; i < base + count; ++i) {
        float* n = out_.normals.data() + 3 * i;
        const math::Vec3 turned = turn_normal(placed.T, n[0], n[1], n[2]);
        const double length = math::norm(turned);
        const math::Vec3 unit = length > 0.0 && std::isfinite(length) ? turned * (sign / length) : math::Vec3{};
        n[0] = static_cast<float>(unit.x);
        n[1] = static_cast<float>(unit.y);
        n[2] = static_cast<float>(unit.z);
      }
    }
    if (inputs.texcoord_source != kNone && placed.texcoords.count(inputs.texcoord_source) == 0) {
      placed.texcoords[inputs.texcoord_source] = static_cast<std::uint32_t>(out_.texcoords.size() / 2);
      if (!read_source(inputs.texcoord_source, 2, out_.texcoords, count)) return false;
    }
    return true;
  }

  bool read_integers(std::uint32_t node, std::vector<std::uint32_t>& out) {
    bool ok = true;
    xml_.each_text(node, [&](std::string_view piece) {
      ok = ok && spend(piece.size());
      WordScanner words(piece);
      for (std::string_view word = ok ? words.next() : std::string_view(); ok && !word.empty(); word = words.next()) {
        std::int64_t value = 0;
        if (!parse_integer(word, value) || value < 0 || value >= kNoIndex) {
          ok = fail_at(node, "expected indices of at least 0, found " + in_quotes(word));
        } else {
          out.push_back(static_cast<std::uint32_t>(value));
        }
      }
    });
    return ok;
  }

  bool to_corner(const std::vector<std::uint32_t>& p, std::size_t corner, const Inputs& inputs, const Placed& placed,
                 RawCorner& out, std::uint32_t node) {
    const auto index = [&](std::size_t at, std::uint32_t base, std::size_t total, std::uint32_t& into) {
      const std::size_t value = std::size_t{base} + p[corner * inputs.stride + at];
      into = static_cast<std::uint32_t>(value);
      return value < total || fail_at(node, "index " + std::to_string(value - base) + " is outside its source");
    };
    if (!index(inputs.position_at, placed.positions.at(inputs.position_source), out_.positions.size() / 3,
               out.position)) {
      return false;
    }
    if (inputs.normal_source != kNone &&
        !index(inputs.normal_at, placed.normals.at(inputs.normal_source), out_.normals.size() / 3, out.normal)) {
      return false;
    }
    return inputs.texcoord_source == kNone || index(inputs.texcoord_at, placed.texcoords.at(inputs.texcoord_source),
                                                    out_.texcoords.size() / 2, out.texcoord);
  }

  bool read_primitive(std::uint32_t node, Placed& placed) {
    Inputs inputs;
    if (xml_.child(node, "p") == kNone && xml_.child(node, "ph") == kNone)
      return true;  // empty, as exporters like to write
    if (!read_inputs(node, inputs) || !place_sources(inputs, placed)) return false;
    const std::string symbol = xml_.attribute(node, "material");
    const auto bound = placed.materials.find(symbol);
    const std::int32_t material =
        symbol.empty() ? -1 : materials_.index_of(bound == placed.materials.end() ? symbol : bound->second);
    if (xml_.child(node, "ph") != kNone) {
      context_.warn("polygons with holes are not supported and ignored", "export triangles", xml_[node].line);
    }
    std::vector<std::uint32_t> vcount;
    const bool polylist = xml_[node].name == "polylist";
    if (polylist && !read_integers(xml_.child(node, "vcount"), vcount)) return false;
    std::vector<std::uint32_t> p;
    for (std::uint32_t list = xml_.child(node, "p"); list != kNone; list = xml_.next_same(list)) {
      p.clear();
      if (!spend(100) || !read_integers(list, p)) return false;
      const std::size_t corners = p.size() / inputs.stride;
      std::vector<RawCorner> c(corners);
      for (std::size_t i = 0; i < corners; ++i) {
        if (!to_corner(p, i, inputs, placed, c[i], list)) return false;
      }
      if (!faces_.add(xml_[node].name, c, vcount, material, determinant(placed.T) < 0.0, xml_[list].line)) return false;
    }
    return true;
  }

  const XmlTree& xml_;
  ColladaIds ids_;
  ReadContext& context_;
  RawMesh& out_;
  ColladaMaterials materials_;
  ColladaFaces faces_;
  std::size_t spent_ = 0;
};

}  // namespace

bool read_collada(std::string_view bytes, ReadContext& context, RawMesh& out) {
  if (bytes.substr(0, 2) == "\xFF\xFE" || bytes.substr(0, 2) == "\xFE\xFF") {
    return context.fail("the file is written in UTF-16, expected UTF-8", "save it as UTF-8");
  }
  XmlTree xml;
  std::string error;
  int line = 0;
  if (!xml.parse(bytes, error, line)) {
    return context.fail("the XML is not well-formed: " + error, "export the mesh again", line);
  }
  return ColladaReader(xml, context, out).read();
}

}  // namespace ambf::mesh
