// Strokes of a blade through a block and through a sheet of tissue, and how far the surface of the cut is from what the
// edge swept.
#pragma once

#include <algorithm>
#include <cmath>

#include "math/rotation.h"
#include "tests/physics/cut_scene.h"
#include "tests/physics/tissue_block.h"
#include "tests/physics/tissue_rectangle.h"

namespace ambf::physics::testing {

// In elements: the node that is the furthest, the root of the mean square, and how far off the one was as loaded that
// was the furthest: at the elements between which it was opened.
struct OffSwept {
  double most = 0.0, mean = 0.0, loaded = 0.0;
  std::size_t nodes = 0, pieces = 0;
};

// A scene that knows where its nodes were.
struct LoadedScene : CutScene {
  LoadedScene(const TissueDefinition& given, const BladeOptions& edge) : CutScene(given, edge) {
    for (std::size_t i = 0; i < tissue.node_count(); ++i) loaded.push_back(tissue.position(i));
  }
  std::vector<math::Vec3> loaded;
};

struct CutStrokes {
  static constexpr double kBlockElement = 0.005, kSheetElement = 0.0034, kMeshElement = 0.006;  // m

  template <class Distance>
  static OffSwept measure(const LoadedScene& scene, double element, const Distance& distance) {
    OffSwept found;
    for (const std::size_t node : scene.tissue.cut_nodes()) {
      const double far = std::abs(distance(scene.tissue.position(node))) / element;
      found.most = std::max(found.most, far);
      found.mean += far * far;
      found.loaded = std::max(found.loaded, std::abs(distance(scene.loaded[node])) / element);
      ++found.nodes;
    }
    found.mean = std::sqrt(found.mean / static_cast<double>(std::max<std::size_t>(found.nodes, 1)));
    found.pieces = scene.tissue.pieces();
    return found;
  }
  static LoadedScene block_scene() {
    return {tissue_of(block({0.04, 0.02, 0.02}), kBlockElement, 2e4, 0.45, 8000), {{{0, -0.03, 0}, {0, 0.03, 0}}, 0.0}};
  }
  static LoadedScene sheet_scene(Mesh mesh) {
    return {sheet_of(rectangle(0.06, 0.04, 20, 13, mesh), 0.0005, 1e5, 0.4, 4000),
            {{{0, 0, -0.004}, {0, 0, 0.004}}, 0.0}};
  }

  // Straight through a solid: turned about y, and the edge about the way.
  static OffSwept solid_straight(LoadedScene& scene, double element, const math::Vec3& through, double turn,
                                 double roll) {
    const math::Quat turned = math::exp({0, turn, 0}) * math::exp({0, 0, roll});
    const math::Vec3 down = math::rotate(turned, {0, 0, -1});
    const math::Vec3 normal = math::cross(down, math::rotate(turned, {0, 1, 0}));
    scene.stroke({through - down * 0.04, turned}, down * 0.08, 160);
    return measure(scene, element, [&](const math::Vec3& at) { return math::dot(normal, at - through); });
  }
  static OffSwept block_straight(double turn, double roll) {
    LoadedScene scene = block_scene();
    return solid_straight(scene, kBlockElement, {0.0213, 0.0101, 0.0101}, turn, roll);
  }
  static OffSwept mesh_straight(const TissueSurface& mesh, double turn, double roll) {
    TissueDefinition given = tissue_of(mesh, kMeshElement, 2e4, 0.45, 8000);
    given.touches_itself = false;
    LoadedScene scene(given, {{{0, -0.04, 0}, {0, 0.04, 0}}, 0.0});
    return solid_straight(scene, kMeshElement, {0.0013, 0.0, 0.0011}, turn, roll);
  }
  // How far the cut goes on ahead of an edge that stops halfway.
  static double ahead_of_edge() {
    LoadedScene scene = block_scene();
    constexpr double kStops = 0.0111;  // m
    scene.stroke({{0.0213, 0.0101, 0.03}, {}}, {0, 0, kStops - 0.03}, 60);
    double most = 0.0;
    for (const std::size_t node : scene.tissue.cut_nodes())
      most = std::max(most, (kStops - scene.tissue.position(node).z) / kBlockElement);
    return most;
  }
  // About an axis along y, at this distance from it.
  static OffSwept block_round(double radius) {
    LoadedScene scene = block_scene();
    const math::Vec3 centre{0.0213 - radius, 0.01, 0.0101};
    scene.along(
        [&](double share) {
          const double angle = (1.0 - 2.0 * share) * 0.0156 / radius;
          return math::Pose{centre + math::Vec3{radius * std::cos(angle), 0, radius * std::sin(angle)}, {}};
        },
        150);
    return measure(scene, kBlockElement,
                   [&](const math::Vec3& at) { return std::hypot(at.x - centre.x, at.z - centre.z) - radius; });
  }
  // Straight through a sheet: turned about z, with the edge aslant across the way by `lean`.
  static OffSwept sheet_straight(Mesh mesh, double turn, double lean) {
    LoadedScene scene = sheet_scene(mesh);
    const math::Quat turned = math::exp({0, 0, turn}) * math::exp({0, lean, 0});
    const math::Vec3 along = math::rotate(math::exp({0, 0, turn}), {0, 1, 0}), through{0.0011, 0.0007, 0};
    const math::Vec3 normal = math::cross(along, math::rotate(turned, {0, 0, 1}));
    scene.stroke({through - along * 0.035, turned}, along * 0.07, 200);
    return measure(scene, kSheetElement, [&](const math::Vec3& at) { return math::dot(normal, at - through); });
  }
  static OffSwept sheet_round(Mesh mesh, double radius) {
    LoadedScene scene = sheet_scene(mesh);
    const math::Vec3 centre{0.0011 - radius, 0, 0};
    const double most = std::asin(std::min(0.99, 0.022 / radius));
    scene.along(
        [&](double share) {
          const double angle = (2.0 * share - 1.0) * most;
          return math::Pose{centre + math::Vec3{radius * std::cos(angle), radius * std::sin(angle), 0}, {}};
        },
        200);
    return measure(scene, kSheetElement,
                   [&](const math::Vec3& at) { return std::hypot(at.x - centre.x, at.y - centre.y) - radius; });
  }
};

}  // namespace ambf::physics::testing
