// Tissue of a soft body: the grid within its collision mesh, or the sheet of its triangles, its regions, and what is
// reported when there can be none.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "mesh/mesh.h"
#include "model/kinds/soft_body/detail/builder.h"
#include "model/kinds/soft_body/detail/skin.h"
#include "physics/tissue_grid.h"
#include "scene/soft_limits.h"

namespace ambf::model {

bool is_within(const scene::TissueRegion& region, const math::Vec3& at, double slack) {
  const math::Vec3 p = math::inverse(region.location) * at;
  if (region.sphere > 0.0) return math::norm(p) <= region.sphere + slack;
  if (!region.box) return false;
  const math::Vec3 half = *region.box * 0.5;
  return std::abs(p.x) <= half.x + slack && std::abs(p.y) <= half.y + slack && std::abs(p.z) <= half.z + slack;
}

namespace {

constexpr auto kMaxElements = static_cast<double>(scene::kMaxTissueElements);
constexpr std::size_t kMaxPoints = scene::kMaxSoftNodes;  // of the surface
// s, of a step of one core of 2020: for each element, and for each of its iterations.
constexpr double kTimeOfElement = 0.3e-6, kTimeOfIteration = 0.03e-6;
constexpr double kTimeOfTriangle = 0.3e-6, kTimeOfTriangleIteration = 0.04e-6;  // likewise, of a sheet
constexpr double kSlow_s = 0.005;  // a step: then a warning says how to make it faster
constexpr double kCubesOfLongest = 10.0;
constexpr double kTrianglesOfLongest = 3.0;  // fewer along the longest side do not bend
constexpr double kThinnest = 1e-4;           // area of a triangle by its longest side, squared

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", value);
  return text;
}

double expected_s(double elements, double iterations) {
  return elements * (kTimeOfElement + iterations * kTimeOfIteration);
}

// What is in a region: corners and elements.
class Part {
 public:
  Part(const scene::TissueRegion& region, const physics::TissueGrid& grid, std::vector<std::uint32_t> points)
      : region_(region), grid_(grid) {
    is_in_.assign(grid.corners.size(), false);
    for (std::size_t i = 0; i < grid.corners.size(); ++i) is_in_[i] = holds(grid.corners[i]);
    const bool any = std::find(is_in_.begin(), is_in_.end(), true) != is_in_.end();
    if (!any)  // of what is only partly within, corners are outside
      for (std::uint32_t i = 0; i < grid.points.size(); ++i)
        if (holds(place(grid.points[i]))) points.push_back(i);
    for (const std::uint32_t point : points)
      for (std::size_t k = 0; k < 4; ++k)
        if (grid.points[point].weight[k] > kMinWeight) is_in_[grid.points[point].corner[k]] = true;
  }
  std::vector<std::uint32_t> corners() const {
    std::vector<std::uint32_t> found;
    for (std::uint32_t i = 0; i < is_in_.size(); ++i)
      if (is_in_[i]) found.push_back(i);
    return found;
  }
  // By its middle, or all corners of it.
  template <class Element>
  bool holds_element(const Element& element) const {
    math::Vec3 middle{};
    bool all = true;
    for (const std::uint32_t corner : element.corner) {
      middle += grid_.corners[corner] / static_cast<double>(element.corner.size());
      all = all && is_in_[corner];
    }
    return all || holds(middle);
  }

 private:
  static constexpr double kMinWeight = 1e-3;

  bool holds(const math::Vec3& at) const { return is_within(region_, at, 1e-6 * grid_.element_size); }
  math::Vec3 place(const physics::TissuePoint& point) const {
    math::Vec3 at{};
    for (std::size_t k = 0; k < 4; ++k) at += grid_.corners[point.corner[k]] * point.weight[k];
    return at;
  }

  const scene::TissueRegion& region_;
  const physics::TissueGrid& grid_;
  std::vector<bool> is_in_;
};

class TissueMaker {
 public:
  TissueMaker(const scene::KindBlock& block, const SoftNodes& nodes, Findings& findings)
      : block_(block), tissue_(block.as<scene::SoftBody>().tissue), nodes_(nodes), findings_(findings) {}

  // False: an error said why.
  bool make(physics::TissueDefinition& made, std::vector<std::string>& attach_to) {
    if (!(is_sheet() ? make_sheet(made) : make_solid(made))) return false;
    made.material = {tissue_.young,    tissue_.poisson,          tissue_.density,
                     tissue_.friction, tissue_.relaxation.share, tissue_.relaxation.time};
    made.touches_itself = tissue_.touches == scene::TissueTouches::all;
    made.touches_others = tissue_.touches != scene::TissueTouches::none;
    for (std::size_t i = 0; i < tissue_.regions.size(); ++i) add_region(i, made, attach_to);
    std::sort(made.fixed.begin(), made.fixed.end());
    made.fixed.erase(std::unique(made.fixed.begin(), made.fixed.end()), made.fixed.end());
    return true;
  }

 private:
  bool is_sheet() const { return tissue_.kind == scene::TissueKind::sheet; }
  bool make_solid(physics::TissueDefinition& made) {
    physics::TissueSurface surface{nodes_.at, nodes_.triangles};
    if (!closed(surface)) return false;
    const double longest = std::max({extent().x, extent().y, extent().z});
    const double size = tissue_.element_size.value_or(longest / kCubesOfLongest);
    const double most = physics::max_elements(surface, size);
    if (most > 3.0 * kMaxElements) return too_many(most, size);
    made.grid = physics::make_tissue_grid(surface, size, tissue_.max_nodes > 0);
    const auto count = static_cast<double>(made.grid.elements.size());
    if (count > kMaxElements) return too_many(count, size);
    if (made.grid.elements.empty())
      return fail("tissue/element size", "no element of " + number(size) + " m fits into the mesh",
                  "it is thinner: give a smaller one; the soft body is left out");
    leave_room(made);
    // Points within are seen only where it is cut.
    if ((made.max_corners > 0 ? made.grid.first_inner_point : made.grid.points.size()) > kMaxPoints)
      return fail("collision mesh",
                  "expected at most " + std::to_string(kMaxPoints) + " points of its surface, found " +
                      std::to_string(made.grid.points.size()),
                  "give a coarse `collision mesh`, which the fine `mesh` follows; the soft body is left out");
    return true;
  }
  bool make_sheet(physics::TissueDefinition& made) {
    const physics::TissueSurface surface{nodes_.at, nodes_.triangles};
    if (!is_of_triangles(surface)) return false;
    const double size = tissue_.element_size.value_or(0.0), thickness = *tissue_.thickness;
    double area = 0.0;
    for (const auto& t : surface.triangles) area += area_of(t);
    // Before they are made: that many would take long.
    if (size > 0.0 && area / (size * size) > 3.0 * kMaxElements) return too_many_triangles(2.0 * area / (size * size));
    made.grid = physics::make_sheet_grid(surface, thickness, size, tissue_.max_nodes > 0);
    const auto count = static_cast<double>(made.grid.triangles.size());
    if (count > kMaxElements || made.grid.points.size() > kMaxPoints) return too_many_triangles(count);
    leave_room(made);
    const double longest = std::max({extent().x, extent().y, extent().z}), mean = made.grid.element_size;
    if (mean * kTrianglesOfLongest > longest)
      return fail("tissue/element size",
                  "triangles of " + number(mean) + " m are too coarse for a sheet of " + number(longest) +
                      " m: it could hardly bend",
                  "give " + number(longest / kCubesOfLongest) + " or so; the soft body is left out");
    if (mean < thickness)
      return fail(
          "tissue/element size",
          "triangles of " + number(mean) + " m are too fine for a sheet that is " + number(thickness) + " m thick",
          "give a coarser `collision mesh`, or a larger `element size`, or use `kind: solid`; the soft body is "
          "left out");
    return true;
  }
  // For the corners that cuts make.
  void leave_room(physics::TissueDefinition& made) {
    made.max_corners = static_cast<std::size_t>(tissue_.max_nodes);
    if (made.max_corners == 0 || made.max_corners > made.grid.corners.size()) return;
    findings_.warning(block_.identity, "tissue/max nodes",
                      "of " + std::to_string(made.max_corners) + " leaves no room for cuts: it has " +
                          std::to_string(made.grid.corners.size()) + " corners as loaded",
                      "three times as many are plenty; it cannot be cut");
  }
  double area_of(const std::array<std::uint32_t, 3>& t) const {
    return 0.5 * math::norm(math::cross(nodes_.at[t[1]] - nodes_.at[t[0]], nodes_.at[t[2]] - nodes_.at[t[0]]));
  }
  bool too_many_triangles(double count) {
    return fail(
        tissue_.element_size ? "tissue/element size" : "collision mesh",
        "makes some " + number(count) + " triangles; at most " +
            (tissue_.max_nodes > 0 ? std::to_string(kMaxPoints / 3) + ", of what can be cut, "
                                   : number(kMaxElements) + ", with " + std::to_string(kMaxPoints) + " corners, ") +
            "are simulated",
        "half as many along each side are a quarter; the soft body is left out");
  }
  bool is_of_triangles(const physics::TissueSurface& surface) {
    std::vector<bool> used(surface.vertices.size());
    for (std::size_t i = 0; i < surface.triangles.size(); ++i) {
      const auto& t = surface.triangles[i];
      double longest = 0.0;
      for (std::size_t k = 0; k < 3; ++k) {
        used[t[k]] = true;
        longest = std::max(longest, math::norm(surface.vertices[t[(k + 1) % 3]] - surface.vertices[t[k]]));
      }
      if (!(area_of(t) > kThinnest * longest * longest))
        return fail("collision mesh", "triangle " + std::to_string(i) + " of it, counted from 0, has hardly an area",
                    "a sheet is made of its triangles: give it better ones; the soft body is left out");
    }
    const auto unused = std::count(used.begin(), used.end(), false);
    if (surface.triangles.empty() || unused > 0)
      return fail("collision mesh",
                  "a sheet is made of triangles, and of its " + std::to_string(used.size()) + " vertices " +
                      std::to_string(unused) + " are in none",
                  "leave out its lines; the soft body is left out");
    const std::size_t crowded = physics::crowded_edges(surface);
    if (crowded > 0)
      return fail("collision mesh", "more than two triangles meet at " + std::to_string(crowded) + " of its edges",
                  "a sheet has two sides everywhere: make two of it; the soft body is left out");
    return true;
  }
  bool fail(const char* key, const std::string& message, const std::string& hint) {
    findings_.error(block_.identity, key, message, hint);
    return false;
  }
  bool too_many(double count, double size) {
    return fail("tissue/element size",
                "of " + number(size) + " m makes some " + number(count) + " elements, and a step some " +
                    number(1e3 * expected_s(count, 10.0)) + " ms; at most " + number(kMaxElements) + " are simulated",
                "half as many along each side are an eighth; the soft body is left out");
  }
  math::Vec3 extent() const {
    const mesh::BoundingBox box = mesh::bounds_of(nodes_.at);
    return box.size();
  }
  bool closed(physics::TissueSurface& surface) {
    const std::size_t open = surface.triangles.empty() ? 1 : physics::open_edges(surface);
    if (open > 0)
      return fail("collision mesh",
                  "a solid needs a closed surface, and this one is open along " + std::to_string(open) + " edges",
                  "close it, or give another `collision mesh`; the soft body is left out");
    const double volume = physics::volume_within(surface);
    if (volume < 0.0) {
      findings_.warning(block_.identity, "collision mesh", "its triangles are seen from within", "they are turned");
      for (auto& t : surface.triangles) std::swap(t[1], t[2]);
    }
    if (!(std::abs(volume) > 1e-15)) return fail("collision mesh", "it encloses nothing", "the soft body is left out");
    return true;
  }
  std::vector<std::uint32_t> points_of(const scene::TissueRegion& region, const std::string& key) {
    std::vector<std::uint32_t> points;
    const NodeNumbers numbers(block_.as<scene::SoftBody>().collision, nodes_);
    for (const int vertex : region.vertices) {
      const auto found = numbers.find(vertex);
      if (found)
        points.push_back(*found);
      else
        findings_.warning(block_.identity, key + "/vertices",
                          "there is no vertex " + std::to_string(vertex) + ": the mesh has " +
                              std::to_string(numbers.count()) + ", counted from 0",
                          "it is left out");
    }
    return points;
  }
  void add_region(std::size_t index, physics::TissueDefinition& made, std::vector<std::string>& attach_to) {
    const scene::TissueRegion& region = tissue_.regions[index];
    const std::string key = "tissue/regions[" + std::to_string(index) + "]";
    const Part part(region, made.grid, points_of(region, key));
    const std::vector<std::uint32_t> corners = part.corners();
    if (corners.empty()) {
      findings_.warning(block_.identity, key, "nothing of the tissue is in this region",
                        "its location is in the body frame; it is left out");
      return;
    }
    if (region.fixed) made.fixed.insert(made.fixed.end(), corners.begin(), corners.end());
    const auto change = [&](auto& elements) {
      for (auto& element : elements)
        if (part.holds_element(element)) {
          element.density *= region.density;
          element.stiffness *= region.stiffness;
        }
    };
    change(made.grid.elements);
    change(made.grid.triangles);
    if (region.attach_to.empty()) return;
    made.attached.push_back(corners);
    attach_to.push_back(region.attach_to);
  }

  const scene::KindBlock& block_;
  const scene::Tissue& tissue_;
  const SoftNodes& nodes_;
  Findings& findings_;
};

}  // namespace

void build_tissue(const scene::KindBlock& block, const SoftNodes& nodes, const math::Pose& T_world_model, double step_s,
                  const std::shared_ptr<const mesh::Appearance>& appearance, Findings& findings, BuiltSoftBody& built) {
  const auto& soft = block.as<scene::SoftBody>();
  physics::TissueDefinition definition;
  if (!TissueMaker(block, nodes, findings).make(definition, built.row.attach_to)) return;
  definition.T_world_body = T_world_model * soft.T_model_body;
  definition.margin = soft.collision.margin;
  definition.step_s = step_s;
  definition.collision_groups = soft.collision.groups;
  auto body = std::make_unique<physics::Tissue>(definition);
  const std::size_t wanted = body->wanted_iterations();
  const double softened = soften(definition, body);
  const auto elements = static_cast<double>(body->link_count()), iterations = static_cast<double>(body->iterations());
  const double step = body->is_sheet() ? elements * (kTimeOfTriangle + iterations * kTimeOfTriangleIteration)
                                       : expected_s(elements, iterations);
  const std::string what = std::to_string(body->link_count()) + (body->is_sheet() ? " triangles, " : " elements, ") +
                           std::to_string(body->node_count()) + " nodes, " + std::to_string(body->iterations()) +
                           " iterations a step: some " + number(1e3 * step) + " ms a step";
  if (step > kSlow_s)
    findings.warning(block.identity, "tissue/element size", what,
                     "larger elements make it faster, and so does a lower `young modulus`");
  else
    findings.information(block.identity, "tissue", what, "");
  if (wanted > body->iterations())
    findings.warning(block.identity, "tissue/young modulus",
                     "steps of " + number(1e3 * step_s) + " ms would need " + std::to_string(wanted) +
                         " iterations, and " + std::to_string(body->iterations()) +
                         " are made: it moves more slowly than it should" +
                         (softened > 0.0 ? ", and nothing in it is stiffer than " + number(softened) + " Pa" : ""),
                     "larger elements need fewer, and so do a lower `young modulus` and a smaller `fixed timestep`");

  std::vector<math::Vec3> surface;
  for (const physics::TissuePoint& point : definition.grid.points) {
    math::Vec3 at{};
    for (std::size_t k = 0; k < 4; ++k) at += definition.grid.corners[point.corner[k]] * point.weight[k];
    surface.push_back(at);
  }
  auto shape = std::make_shared<state::SoftShape>();
  shape->faces = definition.grid.faces;
  const bool to_be_cut = !definition.grid.seams.empty();
  const auto first = definition.grid.faces.begin();
  const auto seen = to_be_cut ? definition.grid.first_inner_face : definition.grid.faces.size();
  shape->links = links_of({surface, {first, first + static_cast<std::ptrdiff_t>(seen)}, {}});
  built.row.appearance = appearance;
  if (to_be_cut && body->is_sheet() && appearance != nullptr)
    built.row.appearance = look_of_cut_sheet(shape->faces, surface, *appearance, shape->skin);
  else if (to_be_cut && !body->is_sheet())
    built.row.appearance = look_of_cuts(definition.grid, surface, appearance.get(), shape->skin);
  else if (appearance != nullptr)
    shape->skin = make_skin(*appearance, surface, shape->faces);
  built.row.shape = std::move(shape);
  built.row.nodes = static_cast<std::uint32_t>(body->node_count());
  for (std::size_t node = 0; node < body->node_count(); ++node) built.row.fixed.push_back(body->fixed(node));
  built.row.mass = body->mass();
  built.row.saved = static_cast<std::uint32_t>(body->state_size());
  built.body = std::move(body);
}

}  // namespace ambf::model
