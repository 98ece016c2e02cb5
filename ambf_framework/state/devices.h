// Input devices as others see them: what a device file says of each one, what its thread publishes, and what can be
// changed while it runs. Read and set through state/abilities/devices.h. Plain data, SI units, C++17.
//
// Frames: W is the world; U the operator's view: x towards the operator, y to the right, z up; SDE the body that the
// device moves (its effector); CAM the first of the device's cameras, x backwards, y right, z up.
#pragma once

#include <cstdint>
#include <string>
#include <type_traits>
#include <vector>

#include "math/types.h"
#include "state/ids.h"
#include "state/set_point.h"

namespace ambf::state {

// The 17 frames of one device, its effector and its camera: Table 3.3 of the dissertation in its order, each expressed
// as in Table 3.1 (corrected). S-W (1) is the world itself.
struct MappingFrames {
  math::Pose T_world_u;           //  2 U: that of the first camera (its inverse: Table 3.1 #8)
  math::Pose T_u_iid;             //  3 IID: the hand's tip after the driver's offsets
  math::Pose T_u_base;            //  4 IID-B
  math::Pose T_base_e;            //  5 IID-E
  math::Pose T_base_bo;           //  6 IID-BO
  math::Pose T_e_to;              //  7 IID-TO
  math::Pose T_u_iid_cl;          //  8 IID-CL: the hand where REF-O was anchored
  math::Pose T_u_iid_pre_cl;      //  9 IID-PRE-CL: the hand before the camera clutch
  math::Pose T_world_sde;         // 10 SDE: body (mesh) frame
  math::Pose T_world_sde_bo;      // 11 SDE-BO: `location`
  math::Pose T_sde_to;            // 12 SDE-TO: `orientation offset`, in the effector's axes
  math::Pose T_world_ref;         // 13 SDE-REF
  math::Pose T_world_ref_o;       // 14 SDE-REF-O: REF where it was anchored
  math::Pose T_world_cam;         // 15 CAM
  math::Pose T_world_cam_cl;      // 16 CAM-CL: where the device wants the camera while its camera clutch is pressed
  math::Pose T_world_cam_pre_cl;  // 17 CAM-PRE-CL: the camera before the camera clutch
};

// Whose axes the hand's rotation follows: keys c and w.
enum class RotationReference : std::uint8_t { camera, world };

// What the device's buttons a1 and a2 do; `next mode` and `prev mode` (key n) go through them in this order.
enum class DeviceMode : std::uint8_t {
  clutch,  // a1 clutch, a2 camera clutch
  jaw,     // a1, a2: the jaw by +-0.1
  linear_stiffness,
  angular_stiffness,
  linear_damping,
  angular_damping,
  haptic_linear,
  haptic_angular,
  count,
};
const char* name_of(DeviceMode mode);  // for labels: "clutch", "jaw", "linear stiffness" ...

// Who of two users moves their tool and who feels it (dissertation, Fig. 3.22): symmetric or asymmetric input, and
// symmetric, asymmetric or no output. as_in_files: the gains of the device files.
enum class SharingScheme : std::uint8_t { as_in_files, siso, siao, aiso, aiao, sino, aino, count };
const char* name_of(SharingScheme scheme);  // "siso" ...

// Why a device exerts nothing. After each of them, force falls to 0 within kDeviceReleaseS and the device counts as
// clutched; it goes on where the hand then is.
enum class DeviceFault : std::uint8_t {
  none,
  not_found,       // the hardware does not answer (yet): it is searched
  lost,            // it was unplugged, or its topic or window is gone: it is searched
  silent,          // no sample for three periods, at least 30 ms
  bad_sample,      // NaN, infinities, no unit quaternion
  jump,            // faster than any hand
  backward_stamp,  // samples older than those before
  not_ready,       // powered off, not homed, nobody holds it (DeviceStatus::not_ready says which)
  no_effector,     // its body is not loaded, or was removed
  paused,
  restarted,  // the world was reset or restored
  diverged,   // the effector is frozen
  no_frame,   // no frame of the simulation for 0.3 s
  count,
};
const char* name_of(DeviceFault fault);  // for messages: "no sample arrives"

inline constexpr double kDeviceReleaseS = 0.03;      // a fault ends the force within it
inline constexpr double kDeviceFrameTimeoutS = 0.3;  // DeviceFault::no_frame
inline constexpr double kDeviceCommandS = 0.1;       // life of an external wrench or target (DeviceAbility)

enum class OnLoss : std::uint8_t { hold, release };

struct ButtonMapping {
  int clutch = -1, camera_clutch = -1, gripper = -1, next_mode = -1, previous_mode = -1;  // bits; -1: none
};

// Limits of what a hand feels. 0: none besides the hardware's own.
struct HandLimits {
  double deadband_N = 0.0;
  double max_force_N = 0.0;
  double max_torque_Nm = 0.0;
  double max_jerk_N_per_ms = 0.0;  // applies to forces; torques: the same in N m per ms
};

// Of the device's thread, as debuggers and top show it: "device 0". Not over 15 characters.
std::string thread_name_of(unsigned device);

// What is known of a device; a new one is made when its effector is found or lost, or its hardware is opened.
struct DeviceInfo {
  std::string name;  // block's name in the device file
  std::string hardware_name;
  std::string driver;  // type of the driver; empty: none answers to the hardware name
  Source source = Source::device_0;
  ObjectId effector;              // invalid while its root link is not loaded
  std::string effector_name;      // full name, or the root link that is waited for
  std::string multibody;          // model file that was loaded for it; empty: none
  std::vector<ObjectId> cameras;  // first: its frame of reference
  std::vector<std::string> camera_names;
  math::Vec3 color{1.0, 1.0, 1.0};  // of tool, title and label: 0 .. 1
  bool orientation = true;          // six degrees of freedom; else three
  bool force = false, torque = false, gripper = false;
  unsigned buttons = 0;
  double rate_hz = 0.0;  // of its thread
  double device_max_force_N = 0.0, device_max_torque_Nm = 0.0, device_max_stiffness_N_m = 0.0;
  HandLimits limits;
  ButtonMapping button_mapping;
  bool joint_control = true;  // it may drive the joints below its effector
  bool visible = false;       // show a marker at REF
  double visible_size = 1.0;  // m
  math::Vec3 visible_color{1.0, 1.0, 1.0};
  OnLoss on_loss = OnLoss::hold;
  bool on_demand = false;  // its user takes it in hand at will: while nobody does it is not ready, which is no fault
  std::string message;     // why it does not work now, and what to set; empty: it does
};

// Over the whole run.
struct RunPercentiles {
  std::uint64_t count = 0;
  double p50_s = 0.0, p99_s = 0.0, p999_s = 0.0, max_s = 0.0;  // exact to 1/32; the maximum exactly
};

// One cycle of a device's thread, whole.
struct DeviceStatus {
  std::uint64_t cycle = 0;      // + 1 a cycle of the thread; 0: it has not run
  std::uint64_t sample = 0;     // number of the newest sample
  std::int64_t steady_ns = 0;   // end of the cycle
  std::int64_t sampled_ns = 0;  // stamp of the newest sample, steady clock
  MappingFrames frames;
  math::Twist twist_world_ref;  // of REF, as posted

  bool connected = false;  // the driver is open
  bool ready = false;      // Sample::ready
  bool started = false;    // the hold at the start is over
  bool engaged = false;    // it moves its effector
  bool clutched = false, camera_clutched = false;
  bool camera_locked = false;    // it moves its cameras now; false with camera_clutched: another source does
  bool forces_on = false;        // -e
  bool follows_partner = false;  // clutched, and REF follows the body, since another one moves it
  bool at_limit = false;         // the force was cut to a limit in this cycle
  bool pulls_effector = false;   // SetPoint::pulls
  DeviceFault fault = DeviceFault::none;
  std::int64_t fault_since_ns = 0;  // steady clock
  const char* not_ready = "";       // with DeviceFault::not_ready: why, static text

  DeviceMode mode = DeviceMode::clutch;
  RotationReference rotation = RotationReference::camera;
  SharingScheme scheme = SharingScheme::as_in_files;  // the last one set; gains may have been changed since
  std::uint64_t buttons = 0;
  double jaw_hand = 0.0, jaw_tool = 0.0;  // 0 closed .. 1 open: the hand's, and what is asked of the tool
  bool jaw_follows = false;               // the hand's opening has met the tool's

  EffectorGains gains;  // of the effector, with dominance in them, before bounds (Frame::effectors has those in force)
  EffectorGains hand_gains;  // of the hand's force, in force
  double workspace_scaling = 1.0, camera_scaling = 10.0;
  double dominance = 0.5;  // 0.5: the file's gains; gains are multiplied by twice this
  HandLimits limits;

  math::Wrench wrench_u_wanted;   // by the law and external commands, before limits
  math::Wrench wrench_u_written;  // to the device

  RunPercentiles period;           // between two cycles
  RunPercentiles set_point_age;    // from reading a sample to the first step that obeyed it
  RunPercentiles sample_to_force;  // from reading a sample to the force that answers it
  double rate_hz = 0.0;            // cycles a second, over the last one
  double sample_rate_hz = 0.0;     // samples a second, over the last one
  std::uint64_t slips = 0;         // cycles that began over a period late
  std::uint64_t faults = 0;        // since the start
  std::uint64_t refused_samples = 0;
  bool fifo = false;  // the thread has real-time priority
};
static_assert(std::is_trivially_copyable_v<DeviceStatus>);

// What can be changed while a device runs. Vectors by axis as in EffectorGains; single numbers in x.
enum class DeviceParameter : std::uint8_t {
  linear_stiffness,
  linear_damping,
  angular_stiffness,
  angular_damping,
  haptic_linear,  // stiffness
  haptic_angular,
  haptic_linear_damping,
  haptic_angular_damping,
  workspace_scaling,
  camera_scaling,
  deadband,
  max_force,
  max_torque,
  max_jerk,
  dominance,
  rotation_reference,  // RotationReference as a number
  mode,                // DeviceMode as a number
  scheme,              // SharingScheme as a number; of both devices that share the tool, in their order
  count,
};

struct DeviceParameterInfo {
  const char* name;  // "linear stiffness"
  const char* unit;
  bool by_axis;
  double min, max;
};
const DeviceParameterInfo& info_of(DeviceParameter parameter);
// Empty, or why the value is refused.
std::string check(DeviceParameter parameter, const math::Vec3& value);
// What the status says of it.
math::Vec3 value_of(const DeviceStatus& status, DeviceParameter parameter);

}  // namespace ambf::state
