// The description of a sensor, whatever its type: members of other types keep their defaults. Beside description.h,
// because few files read it.
#pragma once

#include <string>
#include <vector>

#include "math/types.h"
#include "scene/block_kinds.h"
#include "state/sensors.h"
#include "state/view.h"

namespace ambf::scene {

inline constexpr int kMaxRayResolution = 64;  // 4096 rays a sensor

// One ray of `array`: from `offset` to offset + direction * range, in the sensor's frame; the direction's length
// counts.
struct SensorRayBlock {
  math::Vec3 offset, direction;
};

// resolution^2 rays about +x of the sensor, each turned by RPY(0, v, h): v and h run over the two angles, centred.
struct ParametricRays {
  int resolution = 0;  // 0: not given
  double horizontal_rad = 0.0, vertical_rad = 0.0;
  double start_offset_m = 0.0;
};

// Where on a mesh rays are.
struct RayPlacement {
  bool faces = true, edges = false, vertices = false;
};

// The mesh of rays is laid onto another one first (Alg. 13).
struct RayWrap {
  std::vector<std::string> onto_files;  // where `onto` may be, best first; empty: as it is
  double offset_m = 0.0;                // above it
};

// What the friction of a resistive sensor grows with (EQUATIONS 6.1, 6.12).
enum class FrictionScale { none, normal_force, depth };

// The tangential forces of a resistive sensor (docs/sensors.md). With `scale`, `stick` is multiplied by the normal
// force (N) or the depth (0 .. 1).
struct ResistiveFriction {
  double stick = 0.0;    // N/m; 1/m with the normal force
  double damping = 0.1;  // N s/m, times a millisecond: of the stretch, while it sticks
  double slide = 0.0;    // N s/m, of the relative velocity
  FrictionScale scale = FrictionScale::none;
};

// Standard deviations of normal noise on each axis. IMU: m/s^2 and rad/s; Force Torque: N and N m.
struct SensorNoise {
  double linear = 0.0, angular = 0.0;
};

struct Sensor {
  std::string parent;  // empty: the world
  state::SensorType type = state::SensorType::proximity;
  math::Pose T_parent_sensor;
  double range_m = 0.5;
  std::vector<SensorRayBlock> array;
  std::vector<std::string> mesh_files;  // where `mesh` may be, best first; empty: not given
  ParametricRays parametric;
  bool visible = false;
  double visible_size_m = 0.02;
  std::string matching_key;
  state::SuccessWhen success_when = state::SuccessWhen::never;
  double hold_s = 0.0;
  // Range.
  state::DepthNoise range_noise;
  int noise_seed = 0;
  // Resistance.
  ResistiveFriction friction;
  double contact_area_m = 0.1;        // stretch at which it slips
  double contact_stiffness = 0.0;     // N at full depth
  double contact_damping = 0.0;       // N s
  double depth_m = 0.0;               // of `mesh`: how far below the triangles the rays begin
  double mesh_scale = 1.0;            // of a body's resistive surface: the body's
  std::string joint;                  // Force Torque: as written
  double distance_threshold_m = 0.0;  // Contact
  bool contact_details = true;
  SensorNoise noise;
  int rays_per_step = 0;   // 0: all
  RayPlacement placement;  // of `mesh`
  RayWrap wrap;            // of `mesh`
};

namespace group {
extern const Group kSensor, kSensorFriction;
}
namespace kind {
extern const BlockKind kSensor;
}

}  // namespace ambf::scene
