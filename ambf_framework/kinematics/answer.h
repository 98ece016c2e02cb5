// What inverse kinematics answers. Values are always finite. m and rad.
#pragma once

#include <vector>

namespace ambf::kinematics {

// One position a joint, m or rad, in the order of the chain.
using Joints = std::vector<double>;

enum class Status {
  solved,         // `joints` reach the pose within their limits
  singular,       // they do, but the pose leaves some of them free: these are as in the seed
  out_of_limits,  // only joints beyond their limits reach it
  unreachable,    // no joint positions reach it, even without limits
  invalid,        // pose or seed is not finite, or the seed's length is wrong
};

// "solved", "singular", "out_of_limits", "unreachable", "invalid".
const char* to_string(Status status);

struct Answer {
  Status status = Status::invalid;
  // Within limits in every case. Unless solved or singular they lead to the nearest pose that was found: the solution
  // without limits, clipped.
  Joints joints;
  int joint = -1;          // out_of_limits: the one furthest beyond its limit, relative to its range
  double excess = 0.0;     // how far, rad or m
  double distance = 0.0;   // m from the pose to what `joints` reach
  double angle = 0.0;      // rad
  std::vector<bool> free;  // singular: the joints that are as in the seed

  bool reached() const { return status == Status::solved || status == Status::singular; }
};

}  // namespace ambf::kinematics
