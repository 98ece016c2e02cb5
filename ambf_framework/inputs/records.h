// What a recording of inputs holds (docs/input_recordings.md): all that steps obeyed, in the order in which the physics
// thread found it, and what each cycle of an input device saw. Replayed in the same order it gives the same frames, bit
// for bit (decision 0032). Plain data; times are of the recording's steady clock.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "inputs/bytes.h"
#include "state/ids.h"

namespace ambf::inputs {

inline constexpr char kMagic[8] = {'A', 'M', 'B', 'F', 'I', 'N', 'P', '\n'};
inline constexpr std::uint32_t kVersion = 4;

// Each record is one producer's; those of one producer are in order.
using Stream = std::uint16_t;
inline constexpr Stream kSceneStream = 0, kPhysicsStream = 1, kFirstDeviceStream = 2;

// The numbers are part of the format.
enum class Type : std::uint16_t {
  // Scene stream.
  session = 1,
  device = 2,
  scene_change = 3,
  gap = 4,
  end = 5,
  // Physics stream: what the thread did.
  iteration = 20,
  take = 21,
  published = 22,
  scene_request = 23,
  pause = 24,
  reset = 25,
  parameter = 26,
  push = 27,
  gravity = 28,
  hold = 29,
  lens = 30,
  beam = 31,
  pick = 32,
  // Physics stream: what it found by that; follows the record of what it did.
  set_point = 40,
  effector_ended = 41,
  command = 42,
  command_kept = 43,
  command_ended = 44,
  command_lasting = 45,
  pick_target = 46,
  pick_ended = 47,
  kind_command = 48,
  // A device's stream.
  cycle = 60,
  binding = 61,
};
constexpr bool is_found(Type type) { return type >= Type::set_point && type <= Type::kind_command; }

// How the simulation was run, and the device file as it was then.
struct SessionRecord {
  static constexpr Type kType = Type::session;
  std::string launch_file, ns, solver, device_file, device_text;
  // What -l and -a named: the first of them decides which world file it is.
  std::vector<std::int32_t> model_indices;
  std::vector<std::string> model_files;
  std::int32_t physics_frequency_hz = 1000, solver_iterations = 0, friction_directions = 2;
  bool fixed_step = false, sleeping = true, fixed_device_dt = false;
  double speed_factor = 1.0;
  std::int64_t start_ns = 0, start_system_ns = 0;  // the same moment by both clocks

  template <class Self, class Archive>
  static void members(Self& r, Archive& a) {
    a(r.launch_file), a(r.ns), a(r.solver), a(r.device_file), a(r.device_text);
    a(r.model_indices), a(r.model_files);
    a(r.physics_frequency_hz), a(r.solver_iterations), a(r.friction_directions);
    a(r.fixed_step), a(r.sleeping), a(r.fixed_device_dt), a(r.speed_factor), a(r.start_ns), a(r.start_system_ns);
  }
};

// A device that runs; its cycles are in the stream kFirstDeviceStream + number.
struct DeviceRecord {
  static constexpr Type kType = Type::device;
  std::uint16_t number = 0;
  std::string name;  // block of the device file
  double period_s = 1e-3;
  bool orientation = true, force = false, torque = false, gripper = false, event_driven = false, on_demand = false;
  std::uint32_t buttons = 0;
  double rate_hz = 0.0, max_force_N = 0.0, max_torque_Nm = 0.0, max_stiffness_N_m = 0.0, hold_at_start_s = 3.0;

  template <class Self, class Archive>
  static void members(Self& r, Archive& a) {
    a(r.number), a(r.name), a(r.period_s);
    a(r.orientation), a(r.force), a(r.torque), a(r.gripper), a(r.event_driven), a(r.on_demand), a(r.buttons);
    a(r.rate_hz), a(r.max_force_N), a(r.max_torque_Nm), a(r.max_stiffness_N_m), a(r.hold_at_start_s);
  }
};

// What the loader did, in its order.
struct SceneChangeRecord {
  static constexpr Type kType = Type::scene_change;
  enum class Kind : std::uint8_t {
    world,  // of the launch file
    load,
    unload,
    remove,
    set_parent,
    reset_parents,
    snapshot,
    restore,
    forget,
    start_state,  // the state in which the simulation was set going: `bytes`
    count
  };
  Kind kind = Kind::world;
  std::string path, text, prefix, name;  // name: of the model, the object, the parent or the snapshot
  math::Pose T_world_model;
  bool check_only = false;
  state::ObjectId object;
  Bytes bytes;  // of a state file, or of the start
  // Of a device's own model.
  bool of_device = false;
  std::string device, root_link;
  std::optional<math::Pose> T_world_root;
  bool free_base = false, merge_fixed = false;  // of a URDF file

  template <class Self, class Archive>
  static void members(Self& r, Archive& a) {
    a(r.kind), a(r.path), a(r.text), a(r.prefix), a(r.name), a(r.T_world_model), a(r.check_only);
    a(r.object), a(r.bytes), a(r.of_device), a(r.device), a(r.root_link), a(r.T_world_root);
    a(r.free_base), a(r.merge_fixed);
  }
};

// Records of a stream that found no room, all after the last one that is there.
struct GapRecord {
  static constexpr Type kType = Type::gap;
  Stream stream = 0;

  template <class Self, class Archive>
  static void members(Self& r, Archive& a) {
    a(r.stream);
  }
};

struct EndRecord {  // the recording was ended, not cut off
  static constexpr Type kType = Type::end;

  template <class Self, class Archive>
  static void members(Self&, Archive&) {}
};

}  // namespace ambf::inputs
