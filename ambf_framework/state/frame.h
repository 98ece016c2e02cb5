// One published instant of the simulation: all values belong to the same step. The physics thread fills a frame that
// nobody reads and publishes it; from then on it is immutable. Drawn, published, recorded and compared. Its columns are
// listed once, in state/columns.cpp. C++17.
#pragma once

#include <any>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "math/types.h"
#include "state/parameters.h"
#include "state/set_point.h"
#include "state/structure.h"

namespace ambf::state {

struct BodyState {
  math::Pose T_world_body;   // body (mesh) frame
  math::Twist twist_world;   // of the centre of mass, world axes
  math::Wrench wrench_body;  // sum of the reactions of joints with feedback, body axes
  bool active = false;       // a command is in force (its watchdog has not expired)
  bool asleep = false;
  bool frozen = false;  // it, or what joints connect it to, diverged: it stands still and obeys nothing
};

enum class JointCommandType : std::int8_t { none = -1, effort = 0, position = 1, velocity = 2 };

struct JointState {
  double position = 0.0;  // rad or m
  double velocity = 0.0;
  double effort = 0.0;  // Nm or N about or along the axis; 0 unless feedback is enabled
  double commanded = 0.0;
  JointCommandType commanded_type = JointCommandType::none;
};

struct CameraState {
  math::Pose T_parent_camera, T_world_camera;  // x backwards (position - look at), y right, z up
  Lens lens;
  bool active = false;
};

struct LightState {
  math::Pose T_parent_light, T_world_light;  // shines along +x of its frame
  Beam beam;
  bool active = false;
};

// What every registered kind with a pose in a parent has (state/kind_rows.h).
struct PlacedState {
  math::Pose T_parent_object, T_world_object;
  bool active = false;
};

// How a span of time varied within about one second.
struct Spread {
  std::uint32_t number = 0;  // + 1 a second that was measured; 0: none yet
  std::uint32_t count = 0;   // spans within it
  float min_s = 0.0F, mean_s = 0.0F, max_s = 0.0F, deviation_s = 0.0F;
};

// How commands to one object fare. Its source is the one that posted last: of those in force, else of all.
struct CommandState {
  std::uint32_t object = kNone;  // index into Structure::objects
  Source source = Source::ros;
  bool in_force = false;
  SourceSet sources = 0;         // those with a command in force
  std::int64_t received_ns = 0;  // steady clock: when it was taken from its sender; 0: never, or a snapshot brought it
  std::int64_t applied_ns = 0;  // steady clock: when a step (of cameras and lights: a turn) first obeyed it; 0: not yet
  double silent_s = 0.0;        // since its last sign of life, by the watchdog's clock; RunState::watchdog_s ends it
  // Of all sources, since the object was loaded; received = applied + coalesced + at most one a source that waits.
  std::uint64_t received = 0, applied = 0;
  std::uint64_t coalesced = 0;  // replaced by a newer one, or ended, before a step obeyed it
  std::uint64_t refused = 0;    // never received: not fit to act on
  std::uint64_t expired = 0;    // ended by the watchdog
  std::uint64_t beyond = 0;     // with entries for more joints than there are; the rest of it was obeyed
  std::uint64_t bounded = 0;    // steps in which one was cut to base::kMaxCommandedSpeed
  Spread period;                // of its source: between two received, unless the watchdog's time lies between them
  Spread delay;                 // of its source: from received to applied
};

struct ContactState {
  std::uint32_t body_a = kNone, body_b = kNone;  // slots
  math::Vec3 point_world;                        // on B
  math::Vec3 normal_world;                       // from B to A
  double distance = 0.0;                         // m, negative when penetrating
  double impulse = 0.0;                          // Ns in the last step
  math::Vec3 friction_world;                     // Ns on A in the last step
};

// A body held by a pointer.
struct PickState {
  std::uint32_t picker = 0;    // PickPort::id()
  std::uint32_t body = kNone;  // slot
  math::Vec3 point_body;       // where it is held
  math::Vec3 target_world;     // where that point is pulled to
  math::Vec3 force_world;      // N, on the body in the last step; 0 for what is moved instead
};

// What one source did to a moving body in the last step: its share of the forces that hold it. A command's wrench, the
// controller of a pose command, a twist command, a push, a pointer's pull and every law (model/law.h) have one;
// joint drives, gravity and contacts have none. Where a source sets the velocity (twist commands, controllers with
// velocity output), it is the wrench that changes the momentum as much within a step: m (v_set - v) / h.
struct LawShare {
  std::uint32_t body = kNone;  // slot
  Source source = Source::ros;
  math::Wrench wrench_world;  // N and N m at the centre of mass, world axes
};

// Phases of one turn of the physics thread, for seconds_per_phase.
enum class Phase : std::uint8_t { commands, controllers, collision, solver, integration, publish, count };
inline constexpr int kPhaseCount = static_cast<int>(Phase::count);

struct RunState {
  double real_time_factor = 1.0;  // simulated over wall seconds, over the last second; true also in overload
  double steps_per_second = 0.0;
  double turns_per_second = 0.0;
  std::uint64_t steps_given_up = 0;  // sub-steps that real time asked for and that were not done, since start
  std::uint64_t commands_refused = 0;
  double watchdog_s = 0.5;                     // a command lives that long without a sign of life
  double seconds_per_phase[kPhaseCount] = {};  // wall time a step, mean over recent sampled steps
  double lateness_p50 = 0.0, lateness_p99 = 0.0, lateness_p999 = 0.0, lateness_max = 0.0;  // s, of turns, last second
  double physics_cpu_share = 0.0;                                                          // of one core, last second
  double graphics_rate = 0.0;        // pictures a second, of the slowest window; 0 without one
  double seconds_per_picture = 0.0;  // wall time of drawing one in all windows, without waiting for displays; 0: none
  double comm_seconds_per_frame = 0.0;  // CPU time of handing a frame's states to clients; 0: nobody does
  double step_s = 0.0;                  // length of every step
  double speed_factor = 1.0;            // simulated seconds a wall second that were asked for
  unsigned max_steps_per_turn = 0;
  bool fixed_step = false;  // not bound to the wall clock
  bool paused = false;
  bool throttled = false;
  bool diverged = false;                // a body left the finite world
  std::uint32_t diverged_body = kNone;  // its slot
  const char* solver = "";              // name of the constraint solver in use; static text
};

struct Frame {
  std::uint64_t sequence = 0;  // + 1 a frame, never resets
  std::uint64_t epoch = 0;     // + 1 a reset or restore
  std::uint32_t sim_step = 0;
  double sim_time = 0.0;       // s, what was integrated
  double wall_time = 0.0;      // s since the simulation started
  std::int64_t steady_ns = 0;  // steady clock at publication
  std::int64_t system_ns = 0;  // system clock (since 1970) at publication: ROS stamps
  std::uint64_t toggles = 0;   // throttle clock toggles finished so far
  std::shared_ptr<const Structure> structure;

  std::uint32_t frozen_bodies = 0;  // BodyState::frozen
  std::vector<BodyState> bodies;
  std::vector<JointState> joints;
  std::vector<CameraState> cameras;
  std::vector<LightState> lights;
  // In force; equal as long as parameters_version is. What was loaded stands in the structure.
  std::uint64_t parameters_version = 0;
  std::vector<BodyParameters> body_parameters;
  std::vector<JointParameters> joint_parameters;
  math::Vec3 gravity_world;  // m/s^2, of bodies that have none of their own

  std::vector<ContactState> contacts;  // at most its capacity; more are counted in contacts_total
  std::uint32_t contacts_total = 0;
  std::vector<PickState> picks;          // by picker
  std::vector<LawShare> law_shares;      // by body and source; only of bodies that are held
  std::uint32_t law_shares_total = 0;    // more than law_shares has rows: not all of them fit
  std::vector<EffectorState> effectors;  // by body and source
  std::vector<CommandState> commands;    // of objects that were ever sent one, in no order
  RunState run;
  std::vector<std::any> registered;  // columns of registered kinds and others: state::rows(frame, id) (state/columns.h)
};

// "/ambf/env/a and 3 more bodies are frozen"; empty while none is.
std::string frozen_text(const Frame& frame);

// A frame whose columns fit `structure`, so that filling it allocates nothing.
std::unique_ptr<Frame> make_frame(std::shared_ptr<const Structure> structure);

// Hash (FNV-1a) of what was computed: step, time, poses, twists, joints, contacts, shares; not of clocks, rates, names.
std::uint64_t state_hash(const Frame& frame);

}  // namespace ambf::state
