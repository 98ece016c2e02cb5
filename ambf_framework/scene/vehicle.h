// The description of a vehicle: a chassis and its wheels (ADF_REFERENCE 13). Beside description.h, because few files
// read it.
#pragma once

#include <string>
#include <vector>

#include "math/types.h"
#include "scene/block_kinds.h"

namespace ambf::scene {

// Vectors are in the frame of the chassis' centre of mass.
struct Wheel {
  std::string body;  // that becomes the wheel
  std::string mesh;  // as written; a body that is the wheel is made of it
  double width_m = 0.0, radius_m = 0.0;
  double friction = 10.5;
  // Suspension; the first three act by the chassis' mass.
  double stiffness = 5.88;    // 1/s^2
  double compression = 0.83;  // 1/s, damping while it is compressed
  double damping = 0.88;      // 1/s, while it expands
  double rest_length_m = 0.0;
  double roll_influence = 0.1;
  math::Vec3 down{0.0, 0.0, -1.0}, axle{0.0, -1.0, 0.0};  // unit
  math::Vec3 connection;                                  // upper end of the suspension, m
  bool front = false;
  double steering_low = 0.0, steering_high = 0.0;  // rad
  double max_drive_N = 0.0, max_brake_N = 0.0;
};

struct Vehicle {
  std::string parent;  // the chassis
  std::vector<Wheel> wheels;
};

namespace kind {
extern const BlockKind kVehicle;
}

namespace group {
extern const Group kWheel;
}

}  // namespace ambf::scene
