// A piece of tissue without gravity, and a hand with the edge of a blade, for tests of cuts.
#pragma once

#include <vector>

#include "physics/blade.h"
#include "physics/tissue.h"
#include "tests/physics/fixtures.h"

namespace ambf::physics::testing {

struct CutScene {
  CutScene(const TissueDefinition& given, const BladeOptions& edge)
      : world([] {
          WorldOptions options;
          options.gravity = {};
          return options;
        }()),
        blade(edge),
        tissue(given) {
    add(world, tissue);
    world.add(hand);
    add(world, blade);
    blade.use(&hand);
  }
  ~CutScene() {
    remove(world, blade);
    world.remove(hand);
    remove(world, tissue);
  }
  void stroke(const math::Pose& from, const math::Vec3& way, int steps) {
    blade.use(nullptr);
    hand.set_pose(from);
    blade.use(&hand);
    for (int i = 1; i <= steps; ++i) {
      hand.move_to({from.position + way * (static_cast<double>(i) / steps), from.orientation});
      world.step();
    }
  }
  std::vector<double> state() const {
    std::vector<double> all, edge;
    tissue.get_state(all);
    blade.get_state(edge);
    all.insert(all.end(), edge.begin(), edge.end());
    return all;
  }

  World world;
  Body hand{mass_only(0.0, {}, {{0, 0, 0.03}, {}})};
  Blade blade;
  Tissue tissue;
};

}  // namespace ambf::physics::testing
