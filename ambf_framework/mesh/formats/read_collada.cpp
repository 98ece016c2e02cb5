// COLLADA (.dae) 1.4 and 1.5: the geometry of the scene with its node transforms and its unit (to metres), skinned
// meshes in their bind shape. The file's axes are kept: `up_axis` is reported, not applied, because ADF poses refer to
// the file's own axes.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>

#include "mesh/formats/detail/collada_faces.h"
#include "mesh/formats/detail/collada_materials.h"
#include "mesh/formats/detail/collada_sources.h"
#include "mesh/formats/detail/collada_transform.h"
#include "mesh/formats/read_context.h"
#include "mesh/formats/text.h"

namespace ambf::mesh {

namespace {

using Node = ColladaDocument::Node;

class ColladaReader {
 public:
  ColladaReader(const ColladaDocument& xml, ReadContext& context, RawMesh& out)
      : xml_(xml),
        task_(xml, context),
        context_(context),
        sources_(xml, task_, context, out),
        materials_(xml, context, out),
        faces_(context, out) {}

  bool read() {
    const Node root = xml_.root();
    if (xml_.name(root) != "COLLADA") {
      return context_.not_understood("expected element COLLADA, found " + in_quotes(xml_.name(root)),
                                     "export the mesh again as .dae", xml_.line(root));
    }
    const Node asset = xml_.child(root, "asset");
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

    const Node instance = xml_.child(xml_.child(root, "scene"), "instance_visual_scene");
    Node scene = xml_.find(xml_.attribute(instance, "url"), "visual_scene");
    if (!scene) scene = xml_.child(xml_.child(root, "library_visual_scenes"), "visual_scene");
    if (scene) return visit_children(scene, to_metres, 0);
    context_.warn("there is no scene; all geometries are taken as they are", "export the scene with the mesh");
    for (Node g = xml_.child(xml_.child(root, "library_geometries"), "geometry"); g; g = xml_.next_same(g)) {
      if (!read_geometry(g, to_metres, Node())) return false;
    }
    return true;
  }

 private:
  bool read_values(Node node, std::size_t count, std::array<double, 16>& out) {
    const std::string text = xml_.text(node);
    WordScanner words(text);
    for (std::size_t i = 0; i < count; ++i) {
      if (!parse_double(words.next(), out[i])) {
        return task_.fail_at(
            node, "expected " + std::to_string(count) + " finite numbers in element " + in_quotes(xml_.name(node)));
      }
    }
    return task_.spend(text.size());
  }

  bool visit_children(Node parent, const Matrix& T_mesh_parent, int depth) {
    constexpr int kMaxDepth = 300;
    constexpr std::size_t kCostOfNode = 500;
    if (depth > kMaxDepth)
      return task_.fail_at(parent, "nodes are nested too deeply, or instance each other in a circle");
    for (const Node& c : parent.children()) {
      if (xml_.name(c) == "node" && (!task_.spend(kCostOfNode) || !visit_node(c, T_mesh_parent, depth + 1)))
        return false;
    }
    return true;
  }

  bool visit_node(Node node, const Matrix& T_mesh_parent, int depth) {
    Matrix T = T_mesh_parent;
    for (const Node& c : node.children()) {
      if (!task_.spend(100 + xml_.length(c)) || !apply_transform(c, T)) return false;
    }
    for (const Node& c : node.children()) {
      const std::string_view name = xml_.name(c);
      if (name == "instance_geometry") {
        const Node geometry = xml_.find(xml_.attribute(c, "url"), "geometry");
        if (!geometry) {
          return task_.fail_at(c, "geometry " + in_quotes(xml_.attribute(c, "url")) + " is not defined in this file");
        }
        if (!read_geometry(geometry, T, c)) return false;
      } else if (name == "instance_controller") {
        if (!read_controller(c, T)) return false;
      } else if (name == "instance_node") {
        const Node other = xml_.find(xml_.attribute(c, "url"), "node");
        if (!other)
          return task_.fail_at(c, "node " + in_quotes(xml_.attribute(c, "url")) + " is not defined in this file");
        if (depth > 300) return task_.fail_at(c, "nodes are nested too deeply, or instance each other in a circle");
        if (!task_.spend(500) || !visit_node(other, T, depth + 1)) return false;
      }
    }
    return visit_children(node, T, depth);
  }

  bool apply_transform(Node c, Matrix& T) {
    const std::string_view name = xml_.name(c);
    if (name == "lookat" || name == "skew") {
      context_.warn("transform " + in_quotes(name) + " is not supported and ignored", "export with plain transforms",
                    xml_.line(c));
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

  bool read_controller(Node instance, const Matrix& T) {
    const Node controller = xml_.find(xml_.attribute(instance, "url"), "controller");
    const Node skin = xml_.child(controller, "skin");
    const Node geometry = xml_.find(xml_.attribute(skin, "source"), "geometry");
    if (!geometry) {
      context_.warn(
          "controller " + in_quotes(xml_.attribute(instance, "url")) + " has no skinned geometry and is ignored",
          "export the mesh without animation", xml_.line(instance));
      return true;
    }
    Matrix bind = kIdentity;
    const Node matrix = xml_.child(skin, "bind_shape_matrix");
    if (matrix && !read_values(matrix, 16, bind)) return false;
    return read_geometry(geometry, T * bind, instance);
  }

  bool read_geometry(Node geometry, const Matrix& T, Node instance) {
    ColladaGeometry placed;
    placed.T_scene_geometry = T;
    placed.mesh = xml_.child(geometry, "mesh");
    if (!placed.mesh) {
      context_.warn("geometry " + in_quotes(xml_.attribute(geometry, "id")) + " is no mesh and is ignored",
                    "convert curves and convex hulls to meshes", xml_.line(geometry));
      return task_.spend(1000);
    }
    const Node bindings = xml_.child(xml_.child(instance, "bind_material"), "technique_common");
    for (Node b = xml_.child(bindings, "instance_material"); b; b = xml_.next_same(b)) {
      placed.materials[xml_.attribute(b, "symbol")] = xml_.attribute(b, "target");
      if (!task_.spend(100)) return false;
    }
    static constexpr std::string_view kPrimitives[] = {"triangles", "polylist", "polygons",  "tristrips",
                                                       "trifans",   "lines",    "linestrips"};
    for (const Node& c : placed.mesh.children()) {
      if (!task_.spend(100 + xml_.length(c))) return false;
      if (std::find(std::begin(kPrimitives), std::end(kPrimitives), xml_.name(c)) != std::end(kPrimitives) &&
          !read_primitive(c, placed)) {
        return false;
      }
    }
    return true;
  }

  bool read_integers(Node node, std::vector<std::uint32_t>& out) {
    bool ok = true;
    xml_.each_text(node, [&](std::string_view piece) {
      ok = ok && task_.spend(piece.size());
      WordScanner words(piece);
      for (std::string_view word = ok ? words.next() : std::string_view(); ok && !word.empty(); word = words.next()) {
        std::int64_t value = 0;
        if (!parse_integer(word, value) || value < 0 || value >= kNoIndex) {
          ok = task_.fail_at(node, "expected indices of at least 0, found " + in_quotes(word));
        } else {
          out.push_back(static_cast<std::uint32_t>(value));
        }
      }
    });
    return ok;
  }

  bool read_primitive(Node node, ColladaGeometry& placed) {
    ColladaInputs inputs;
    // Empty, as exporters like to write.
    if (!xml_.child(node, "p") && !xml_.child(node, "ph")) return true;
    if (!sources_.read_inputs(node, inputs) || !sources_.place(inputs, placed)) return false;
    const std::string symbol = xml_.attribute(node, "material");
    const auto bound = placed.materials.find(symbol);
    const std::int32_t material =
        symbol.empty() ? -1 : materials_.index_of(bound == placed.materials.end() ? symbol : bound->second);
    if (xml_.child(node, "ph")) {
      context_.warn("polygons with holes are not supported and ignored", "export triangles", xml_.line(node));
    }
    std::vector<std::uint32_t> vcount;
    const bool polylist = xml_.name(node) == "polylist";
    if (polylist && !read_integers(xml_.child(node, "vcount"), vcount)) return false;
    std::vector<std::uint32_t> p;
    for (Node list = xml_.child(node, "p"); list; list = xml_.next_same(list)) {
      p.clear();
      if (!task_.spend(100) || !read_integers(list, p)) return false;
      const std::size_t corners = p.size() / inputs.stride;
      std::vector<RawCorner> c(corners);
      for (std::size_t i = 0; i < corners; ++i) {
        if (!sources_.to_corner(p, i, inputs, placed, c[i], list)) return false;
      }
      if (!faces_.add(xml_.name(node), c, vcount, material, determinant(placed.T_scene_geometry) < 0.0,
                      xml_.line(list)))
        return false;
    }
    return true;
  }

  const ColladaDocument& xml_;
  ColladaTask task_;
  ReadContext& context_;
  ColladaSources sources_;
  ColladaMaterials materials_;
  ColladaFaces faces_;
};

}  // namespace

bool read_collada(std::string_view bytes, ReadContext& context, RawMesh& out) {
  if (bytes.substr(0, 2) == "\xFF\xFE" || bytes.substr(0, 2) == "\xFE\xFF") {
    return context.fail("the file is written in UTF-16, expected UTF-8", "save it as UTF-8");
  }
  ColladaDocument xml;
  std::string error;
  int line = 0;
  if (!xml.parse(bytes, error, line)) {
    return context.not_understood("the XML is not well-formed: " + error, "export the mesh again", line);
  }
  return ColladaReader(xml, context, out).read();
}

}  // namespace ambf::mesh
