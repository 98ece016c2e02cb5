// A structure of joints that JointBlockSolver met before, with its storage. Private to physics/joints/.
#pragma once

#include <algorithm>

#include "physics/joints/joint_block_solver.h"

namespace ambf::physics {

// Keyed by the places of the joined bodies in the world's list, which are the same in every run.
struct JointBlockSolver::Mechanism {
  Mechanism(const std::vector<OrderedJoint>& joints, const JointSystem::Options& options)
      : structure(ends_of(joints)), system(structure, options) {}

  static std::vector<JointEnds> ends_of(const std::vector<OrderedJoint>& joints) {
    std::vector<JointEnds> ends;
    ends.reserve(joints.size());
    for (const auto& joint : joints) ends.push_back(joint.ends);
    return ends;
  }
  bool matches(std::uint64_t other_hash, const std::vector<OrderedJoint>& joints) const {
    if (hash != other_hash || structure.joints().size() != joints.size()) return false;
    return std::equal(joints.begin(), joints.end(), structure.joints().begin(),
                      [](const OrderedJoint& a, const JointEnds& b) { return a.ends == b; });
  }

  BlockStructure structure;
  JointSystem system;
  std::uint64_t hash = 0;
  std::uint64_t last_call = 0;
  std::uint64_t calls_with_contacts = 0;
};

}  // namespace ambf::physics
