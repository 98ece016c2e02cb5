// Our robots beside the original's: what tests of both share. One thread.
#pragma once

#include <gtest/gtest.h>

#include <numbers>
#include <string>

#include "tests/runtime/model_rig.h"

namespace ambf::runtime::test {

using state::JointCommandType;

constexpr double kPi = std::numbers::pi;

// Names of objects have no spaces.
inline std::string spaceless(std::string name) {
  std::erase(name, ' ');
  return name;
}

// The arms' remote centres are below z = 0, where other worlds have their floor.
inline scene::World nothing_else() { return world_of(own_descriptions() + "world/empty_world.yaml"); }

// Names, order, types and passive marks are equal, and frames at home within 10 mm and 1 degree, but for the place of
// the body `misplaced`. What is ours comes last.
inline void expect_same_interface(const scene::Model& own, const scene::Model& original,
                                  const std::string& misplaced = {}) {
  ASSERT_GE(own.bodies.size(), original.bodies.size());
  for (std::size_t i = 0; i < original.bodies.size(); ++i) {
    const scene::Body &ours = own.bodies[i], &theirs = original.bodies[i];
    EXPECT_EQ(ours.identity.identifier, theirs.identity.identifier);
    EXPECT_EQ(ours.identity.name, theirs.identity.name);
    EXPECT_EQ(ours.identity.name_space, theirs.identity.name_space) << theirs.identity.name;
    EXPECT_EQ(ours.identity.passive, theirs.identity.passive) << theirs.identity.name;
    if (theirs.identity.name == misplaced) continue;
    EXPECT_LT(norm(ours.T_world_body.position - theirs.T_world_body.position), 10e-3) << theirs.identity.name;
    EXPECT_LT(norm(math::log(math::inverse(ours.T_world_body.orientation) * theirs.T_world_body.orientation)),
              kPi / 180.0)
        << theirs.identity.name;
  }
  ASSERT_GE(own.joints.size(), original.joints.size());
  for (std::size_t i = 0; i < original.joints.size(); ++i) {
    const scene::Joint &ours = own.joints[i], &theirs = original.joints[i];
    EXPECT_EQ(ours.identity.name, theirs.identity.name);
    EXPECT_EQ(ours.identity.passive, theirs.identity.passive) << theirs.identity.name;
    EXPECT_EQ(ours.type, theirs.type) << theirs.identity.name;
    EXPECT_EQ(ours.parent, theirs.parent) << theirs.identity.name;
    EXPECT_EQ(ours.child, theirs.child) << theirs.identity.name;
  }
}

}  // namespace ambf::runtime::test
