// A cloth of links over a block or a sheet of tissue.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "tests/physics/soft_scene.h"
#include "tests/physics/soft_sheet.h"
#include "tests/physics/tissue_block.h"
#include "tests/physics/tissue_rectangle.h"

namespace ambf::physics::testing {

constexpr double kTop = 0.02, kMargin = 0.002, kClothMass = 0.006;

// `n` x `n` nodes, 28 mm wide, above the middle of the block. `flags` 0x11: its step is Bullet's.
inline SoftDefinition cloth(double height, int flags = 1, std::uint32_t n = 8) {
  SoftDefinition made = sheet(n, 0.028);
  made.T_world_body = {{0.006, 0.006, height}, {}};
  made.margin = kMargin;
  made.mass = kClothMass;
  made.config.kLST = 0.5;
  made.config.kDP = 0.02;
  made.config.kDF = 1.0;
  made.config.piterations = 4;
  made.config.flags = flags;
  return made;
}

// 40 x 40 x 20 mm of 20 kPa, fixed below.
inline TissueDefinition bed(double friction = 0.5) {
  TissueDefinition made = tissue_of(block({0.04, 0.04, kTop}), 0.01, 2e4);
  made.material.friction = friction;
  for (std::uint32_t i = 0; i < made.grid.corners.size(); ++i)
    if (made.grid.corners[i].z < 1e-9) made.fixed.push_back(i);
  return made;
}

// A sheet of 60 x 60 mm about the middle of the block, at z = 0, held at its rim.
inline TissueDefinition drum(double thickness = 0.0005) {
  TissueDefinition made = sheet_of(rectangle(0.06, 0.06, 9, 9, Mesh::crossed), thickness, 2e5);
  made.T_world_body.position = {0.02, 0.02, 0.0};
  made.fixed = those(made, [](const math::Vec3& at) { return std::max(std::abs(at.x), std::abs(at.y)) > 0.029; });
  return made;
}

struct Bed : Scene {
  explicit Bed(const SoftDefinition& of, const TissueDefinition& on = bed()) : tissue(on), soft(of) {
    add(world, tissue);
    add(world, soft);
  }
  ~Bed() {
    remove(world, soft);
    remove(world, tissue);
  }
  // Of cloth of 8 x 8 nodes: over four places at which the block, and nearly so the sheet, has vertices.
  std::vector<double> gaps() const {
    std::vector<double> all;
    for (const std::size_t node : {9U, 14U, 49U, 54U}) {
      const math::Vec3 at = soft.position(node);
      double aside = 1.0, gap = 0.0;
      for (std::size_t i = 0; i < tissue.node_count(); ++i) {
        const math::Vec3 way = at - tissue.position(i);
        if (std::abs(way.z) < 0.005 && std::hypot(way.x, way.y) < aside) aside = std::hypot(way.x, way.y), gap = way.z;
      }
      all.push_back(gap);
    }
    return all;
  }
  math::Vec3 middle() const {
    math::Vec3 sum{};
    for (std::size_t i = 0; i < soft.node_count(); ++i) sum += soft.position(i);
    return sum / static_cast<double>(soft.node_count());
  }
  Tissue tissue;
  SoftBody soft;
};

}  // namespace ambf::physics::testing
