// Cases of accuracy_benchmark.cpp: each runs at one step h (s) and says how far the motion is from what it should be.
#pragma once

#include <string>
#include <vector>

#include "tests/physics/fixtures.h"

namespace ambf::accuracy {

struct Figure {
  std::string name;  // with its unit
  double value;
};
using Figures = std::vector<Figure>;

inline physics::WorldOptions options(double h, const math::Vec3& gravity) {
  physics::WorldOptions result;
  result.step = h;
  result.gravity = gravity;
  result.sleeping = false;
  return result;
}

inline int steps_in(double seconds, double h) { return static_cast<int>(std::lround(seconds / h)); }

inline scene::Joint joint_of(state::JointType type, const math::Vec3& parent_pivot, const math::Vec3& child_pivot,
                             const math::Vec3& axis = {0.0, 1.0, 0.0}) {
  scene::Joint joint;
  joint.type = type;
  joint.parent_pivot = parent_pivot;
  joint.child_pivot = child_pivot;
  joint.parent_axis = joint.child_axis = axis;
  return joint;
}

// Kinetic and potential energy (J) from the pose and the twist that are shown.
double energy_of(const physics::Body& body, double g);

// accuracy_bricard.cpp
Figures bricard_mechanism(double h);
// accuracy_contacts.cpp
Figures cradle(double h);
Figures sliding_cube(double h);
Figures held_cube(double h);

}  // namespace ambf::accuracy
