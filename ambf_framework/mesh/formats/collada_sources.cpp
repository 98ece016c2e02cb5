#include "mesh/formats/detail/collada_sources.h"

#include <algorithm>
#include <cmath>
#include <string_view>

#include "mesh/formats/text.h"

namespace ambf::mesh {

namespace {

using Node = ColladaDocument::Node;

const void* key(const Node& node) { return node.internal_object(); }

void use_input(const std::string& semantic, Node source, std::size_t at, ColladaInputs& out) {
  if (!source) return;
  if (semantic == "POSITION") out.position_source = source, out.position_at = at;
  if (semantic == "NORMAL") out.normal_source = source, out.normal_at = at;
  // The first set of several.
  if (semantic == "TEXCOORD" && !out.texcoord_source) out.texcoord_source = source, out.texcoord_at = at;
}

}  // namespace

bool ColladaTask::spend(std::size_t characters) {
  constexpr std::size_t kBudget = 500'000'000;
  spent_ += characters;
  return spent_ <= kBudget ||
         context_.fail("the instances of this scene repeat too much geometry", "simplify the scene");
}

bool ColladaTask::fail_at(const Node& node, const std::string& message) {
  return context_.fail(message, "export the mesh again", xml_.line(node));
}

// Appends a source's tuples of `width` numbers to `into`; on success `out_count` tuples were added.
bool ColladaSources::read_source(Node source, std::size_t width, std::vector<float>& into, std::size_t& out_count) {
  const Node array = xml_.child(source, "float_array");
  const Node accessor = xml_.child(xml_.child(source, "technique_common"), "accessor");
  if (!array) return task_.fail_at(source, "a source has no float_array");
  std::int64_t stride = static_cast<std::int64_t>(width), offset = 0;
  const std::string stride_text = xml_.attribute(accessor, "stride"), offset_text = xml_.attribute(accessor, "offset");
  if ((!stride_text.empty() && (!parse_integer(stride_text, stride) || stride < 1 || stride > 1024)) ||
      (!offset_text.empty() && (!parse_integer(offset_text, offset) || offset < 0))) {
    return task_.fail_at(accessor, "expected a stride from 1 to 1024 and an offset of at least 0");
  }
  std::size_t index = 0;
  float tuple[3] = {};
  bool ok = true;
  const std::size_t used = std::min(width, static_cast<std::size_t>(stride)), before = into.size() / width;
  xml_.each_text(array, [&](std::string_view piece) {
    ok = ok && task_.spend(piece.size());
    WordScanner words(piece);
    for (std::string_view word = ok ? words.next() : std::string_view(); ok && !word.empty();
         word = words.next(), ++index) {
      float value = 0.0F;
      if (!parse_float(word, value)) ok = task_.fail_at(array, "expected finite numbers, found " + in_quotes(word));
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

bool ColladaSources::read_inputs(Node primitive, ColladaInputs& out) {
  constexpr std::int64_t kMaxInputs = 16;
  for (Node input = xml_.child(primitive, "input"); input; input = xml_.next_same(input)) {
    std::int64_t offset = 0;
    const std::string text = xml_.attribute(input, "offset");
    if (!text.empty() && (!parse_integer(text, offset) || offset < 0 || offset >= kMaxInputs)) {
      return task_.fail_at(input, "expected an input offset from 0 to 15, found " + in_quotes(text));
    }
    const auto at = static_cast<std::size_t>(offset);
    out.stride = std::max(out.stride, at + 1);
    const std::string semantic = xml_.attribute(input, "semantic"), source = xml_.attribute(input, "source");
    if (semantic == "VERTEX") {
      const Node vertices = xml_.find(source, "vertices");
      for (Node v = xml_.child(vertices, "input"); v; v = xml_.next_same(v)) {
        use_input(xml_.attribute(v, "semantic"), xml_.find(xml_.attribute(v, "source"), "source"), at, out);
      }
    } else {
      use_input(semantic, xml_.find(source, "source"), at, out);
    }
    if (!task_.spend(100)) return false;
  }
  if (!out.position_source) return task_.fail_at(primitive, "there is no source with semantic POSITION");
  return true;
}

bool ColladaSources::place_positions(Node source, ColladaGeometry& geometry) {
  const std::size_t base = out_.positions.size() / 3;
  if (!geometry.positions.emplace(key(source), static_cast<std::uint32_t>(base)).second) return true;
  std::size_t count = 0;
  if (!read_source(source, 3, out_.positions, count)) return false;
  const Matrix& T = geometry.T_scene_geometry;
  for (std::size_t i = base; i < base + count; ++i) {
    float* p = out_.positions.data() + 3 * i;
    const double x = p[0], y = p[1], z = p[2];
    for (std::size_t k = 0; k < 3; ++k) {
      const double moved = T[4 * k] * x + T[4 * k + 1] * y + T[4 * k + 2] * z + T[4 * k + 3];
      if (!(std::abs(moved) <= 3.0e38)) {
        return task_.fail_at(source, "a vertex placed in the scene is not finite");
      }
      p[k] = static_cast<float>(moved);
    }
  }
  return true;
}

bool ColladaSources::place_normals(Node source, ColladaGeometry& geometry) {
  const std::size_t base = out_.normals.size() / 3;
  if (!geometry.normals.emplace(key(source), static_cast<std::uint32_t>(base)).second) return true;
  std::size_t count = 0;
  if (!read_source(source, 3, out_.normals, count)) return false;
  const Matrix& T = geometry.T_scene_geometry;
  const double sign = determinant(T) < 0.0 ? -1.0 : 1.0;
  for (std::size_t i = base; i < base + count; ++i) {
    float* n = out_.normals.data() + 3 * i;
    const math::Vec3 turned = turn_normal(T, n[0], n[1], n[2]);
    const double length = math::norm(turned);
    const math::Vec3 unit = length > 0.0 && std::isfinite(length) ? turned * (sign / length) : math::Vec3{};
    n[0] = static_cast<float>(unit.x);
    n[1] = static_cast<float>(unit.y);
    n[2] = static_cast<float>(unit.z);
  }
  return true;
}

bool ColladaSources::place(const ColladaInputs& inputs, ColladaGeometry& geometry) {
  if (!place_positions(inputs.position_source, geometry)) return false;
  if (inputs.normal_source && !place_normals(inputs.normal_source, geometry)) return false;
  const auto first = static_cast<std::uint32_t>(out_.texcoords.size() / 2);
  std::size_t count = 0;
  return !inputs.texcoord_source || !geometry.texcoords.emplace(key(inputs.texcoord_source), first).second ||
         read_source(inputs.texcoord_source, 2, out_.texcoords, count);
}

bool ColladaSources::to_corner(const std::vector<std::uint32_t>& p, std::size_t corner, const ColladaInputs& inputs,
                               const ColladaGeometry& geometry, RawCorner& out, Node node) {
  const auto index = [&](std::size_t at, std::uint32_t base, std::size_t total, std::uint32_t& into) {
    const std::size_t value = std::size_t{base} + p[corner * inputs.stride + at];
    into = static_cast<std::uint32_t>(value);
    return value < total || task_.fail_at(node, "index " + std::to_string(value - base) + " is outside its source");
  };
  if (!index(inputs.position_at, geometry.positions.at(key(inputs.position_source)), out_.positions.size() / 3,
             out.position)) {
    return false;
  }
  if (inputs.normal_source &&
      !index(inputs.normal_at, geometry.normals.at(key(inputs.normal_source)), out_.normals.size() / 3, out.normal)) {
    return false;
  }
  return !inputs.texcoord_source || index(inputs.texcoord_at, geometry.texcoords.at(key(inputs.texcoord_source)),
                                          out_.texcoords.size() / 2, out.texcoord);
}

}  // namespace ambf::mesh
