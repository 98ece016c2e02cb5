// Live parameters of an object as values that are compared, read from and written to ROS's parameter server, and what a
// kind defines to offer them (ParameterAccess). Pure data and functions; any thread. Private to ros_comm. C++17.
#pragma once

#include <map>
#include <string>
#include <variant>

#include "base/log.h"
#include "state/abilities/tune.h"
#include "state/frame.h"

namespace ambf::ros_comm {

// near_plane, projection, ...: numbers and words.
using Parameter = std::variant<double, std::string>;
using Parameters = std::map<std::string, Parameter>;

// Every object with a parent has this parameter; ParameterServer itself acts on it.
inline constexpr const char* kParentName = "parent_name";

// Whether two values mean the same; numbers to the precision that survives being written as text.
bool same(const Parameter& a, const Parameter& b);

// A parameter that takes one of up to three words.
struct ParameterChoice {
  const char* name;
  const char* words[3] = {};  // unused ones null
  std::string word(int index) const { return words[index]; }
};

// Puts the parameter into `value` if it is among the changed ones. Where it cannot be, and no earlier problem stands
// there, writes why into `problem`.
void read_number(const Parameters& changed, const char* name, double& value, std::string& problem);
void read_choice(const Parameters& changed, const ParameterChoice& choice, int& index, std::string& problem);

// What a user changed on the parameter server of the object in this slot of the frame.
struct ParameterChange {
  const state::ObjectInfo& object;
  const Parameters& changed;
  const state::Frame& frame;
  std::uint32_t slot;
  state::TuneAbility& tune;
  base::Log& log;
};

// The parameters of one kind.
struct ParameterAccess {
  Parameters (*values)(const state::Frame& frame, std::uint32_t slot);  // in force
  std::string (*apply)(const ParameterChange& change);                  // empty, or why nothing was changed
};

}  // namespace ambf::ros_comm
