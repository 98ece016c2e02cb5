// What a request of the service Tune asks for, checked as a whole before any of it is done. Private to ros_comm. C++17.
#pragma once

#include <ambf_msgs/Tune.h>

#include <optional>
#include <string>
#include <vector>

#include "math/types.h"
#include "state/ids.h"
#include "state/parameters.h"
#include "state/structure.h"

namespace ambf::ros_comm {

struct Tuning {
  struct Change {
    state::ObjectId object;
    state::Parameter parameter;
    math::Vec3 value;
  };
  std::vector<Change> changes;
  std::optional<math::Vec3> gravity_world;  // m/s^2
};

// Empty, or why the request is refused.
std::string read_tuning(const ambf_msgs::Tune::Request& request, const state::Structure& structure, Tuning& tuning);

}  // namespace ambf::ros_comm
