// A model's joints for kinematics. Pure functions, any thread.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "kinematics/chain.h"
#include "kinematics/mechanism.h"
#include "scene/description.h"

namespace ambf::scene {

struct ChainResult {
  std::optional<kinematics::Chain> chain;
  std::string problem;  // why there is none
};

// The chain from the body frame of `root` to that of `tip`, through the fewest joints that lead from parents to
// children. Points in loops (p2p) carry nothing and are left out; other joints that are neither revolute, prismatic nor
// fixed are a problem. Bodies are named as a joint names them (scene/lookup.h). Joints without limits have infinite
// ones.
ChainResult chain_between(const Model& model, const std::string& root, const std::string& tip);

// Nothing: the joint leaves its bodies several free directions.
std::optional<kinematics::MechanismJoint::Kind> mechanism_kind(state::JointType type);

// The model's joints that have such a kind, with its bodies where the file puts them. Bodies are numbered as in the
// model.
std::vector<kinematics::MechanismJoint> mechanism_joints(const Model& model);

}  // namespace ambf::scene
