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
  static math::Pose away() {
    math::Pose made;
    made.position.z = 0.03;
    return made;
  }
  void stroke(const math::Pose& from, const math::Vec3& way, int steps) {
    along([&](double share) { return math::Pose{from.position + way * share, from.orientation}; }, steps);
  }
  // Poses by the share of the way, from 0 to 1.
  template <class PoseAt>
  void along(const PoseAt& pose_at, int steps) {
    blade.use(nullptr);
    hand.set_pose(pose_at(0.0));
    blade.use(&hand);
    for (int i = 1; i <= steps; ++i) {
      hand.move_to(pose_at(static_cast<double>(i) / steps));
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
  Body hand{mass_only(0.0, {}, away())};
  Blade blade;
  Tissue tissue;
};

}  // namespace ambf::physics::testing
