// What a device file says of one device, ready for its thread. Plain data.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <vector>

#include "math/types.h"
#include "state/abilities/command.h"
#include "state/abilities/effector.h"
#include "state/devices.h"

namespace ambf::devices {

struct DeviceSettings {
  state::EffectorGains controller;  // of the file; where it gives none, the effector's own (EffectorBinding)
  bool linear_given = false, angular_given = false;
  // Haptic gains are shares of the effector's controller gains (EQUATIONS 6).
  bool haptic_is_ratio = false;
  math::Vec3 haptic_linear{10.0, 10.0, 10.0}, haptic_angular{10.0, 10.0, 10.0};  // N/m, N m/rad; or shares
  math::Vec3 haptic_linear_damping, haptic_angular_damping;  // N s/m, N m s/rad; of shares: as their stiffness
  state::HandLimits limits;
  double workspace_scaling = 1.0, camera_scaling = 10.0;
  double dominance = 0.5;
  double ramp_s = 1.0;
  state::OnLoss on_loss = state::OnLoss::hold;
  state::ButtonMapping buttons;
  bool joint_control = true;
  bool fixed_dt = false;         // -f: each cycle counts as one period, however late it is
  math::Pose T_world_sde_bo;     // `location`
  math::Quat R_sde_to;           // `orientation offset`
  math::Pose T_base_bo, T_e_to;  // of the driver's mounting
};

// Who moves a camera now: the first source that starts holds it until it stops. Any thread.
class CameraLock {
 public:
  bool acquire(state::Source source) {
    int none = kNobody;
    return holder_.compare_exchange_strong(none, static_cast<int>(source)) || none == static_cast<int>(source);
  }
  void release(state::Source source) {
    int mine = static_cast<int>(source);
    holder_.compare_exchange_strong(mine, kNobody);
  }

 private:
  static constexpr int kNobody = -1;
  std::atomic<int> holder_{kNobody};
};

// What a device moves now. The hub makes it; from then on it is the device thread's, which hands it back unused.
struct EffectorBinding {
  struct Camera {
    state::ObjectId id;
    std::unique_ptr<state::CommandPort> port;
    std::shared_ptr<CameraLock> lock;
  };
  state::ObjectId body;                       // invalid: none
  std::unique_ptr<state::EffectorPort> port;  // null: none
  state::EffectorGains own_gains;             // of the effector, where the device file gives none
  bool own_multibody = false;                 // it was loaded for this device, which always holds it
  std::vector<state::ObjectId> jaw_joints;    // below the body, with limits
  std::vector<Camera> cameras;                // first: the frame of reference
};

}  // namespace ambf::devices
