// A tool's file as it is loaded onto an arm that stands somewhere: its bodies where the arm's body and the joints'
// positions put them. Never throws; reads files. Any thread; calls share nothing. C++17.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/diagnostic.h"
#include "kinematics/arm.h"
#include "math/types.h"

namespace ambf::scene {
struct Joint;
struct Model;
}  // namespace ambf::scene

namespace ambf::adf {

// Names of an arm's joints in models, in their order; of two halves of a jaw both.
std::vector<std::string> moved_joints(const kinematics::Arm& arm);
// By name, blanks do not count; null: there is none.
const scene::Joint* find_joint(const scene::Model& model, const std::string& name);
// The block of another file on which the joint hangs; "": it hangs on a body of the model.
std::string carrier_of(const scene::Model& model, const scene::Joint& joint);

struct Place {
  std::string name_space;  // of the arm's bodies, in place of the file's; ends in '/'
  std::string carrier;     // block of the arm's body that carries the tool
  // Of all the arm's bodies: with a conflict number, where another arm has the same name space.
  std::vector<std::string> identifiers;
  math::Pose T_world_carrier;
  std::map<std::string, double> positions;  // of joints, by name without blanks; 0 where none is given
};

// A joint takes the nearest position within its limits. No text: diagnostics say why.
struct Mounted {
  std::optional<std::string> text;  // relative paths lead from the file's folder
  base::Diagnostics diagnostics;
};
Mounted mounted(const std::string& file, const Place& place);

}  // namespace ambf::adf
