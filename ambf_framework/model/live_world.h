// The live object graph: objects of all kinds with their controllers, stepped and read by the physics thread. It knows
// no files, names no topics and talks to nobody: structure comes in as Prepared, commands through the CommandTable,
// values go out by fill(). Physics thread only. step(), fill() and take_commands() neither allocate, lock nor wait
// (Bullet's own allocations excepted).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "math/types.h"
#include "model/command_table.h"
#include "model/effectors/effector_table.h"
#include "model/law.h"
#include "model/pick_table.h"
#include "model/prepared.h"
#include "state/abilities/pick.h"
#include "state/frame.h"

namespace ambf::physics {
class World;  // physics/world.h
}

namespace ambf::inputs {
class Channel;  // inputs/recorder.h
}

namespace ambf::model {

struct SavedState;  // model/saved_state.h

// A body that diverged and was frozen (physics/world.h).
struct FrozenReport {
  std::uint32_t body = state::kNone;               // slot
  std::size_t jointed = 0;                         // bodies that were frozen with it
  double linear_speed = 0.0, angular_speed = 0.0;  // m/s, rad/s; may be NaN
};

// What was cut for a body or a sensor, for the first time.
struct CutReport {
  enum class Of : std::uint8_t {
    speed,       // a command, push or law of the source asked for more than base::kMaxCommandedSpeed
    gains,       // of all input devices and the controller together: more than steps of this length can bear
    touch,       // of a resistive sensor, for what it met
    uncuttable,  // a blade is in use beside the soft body of slot `body`, which cannot be cut
    full,        // that soft body has no room for further cuts
    touches,     // tissue or bodies touch that soft body in more places than there is room for
    // Of the needle in the actuator's slot `body`:
    nothing_to_tie,  // it was to tie, and fewer than two stitches are in no knot
    knots,           // likewise, and there are as many knots as there may be
    stitches,        // its rear passed what it has no room for
    holders          // more hold its thread than are felt
  };
  // Of a resistive sensor's friction: how much of a gain counts at most; 0: all of it.
  struct Touch {
    std::uint32_t sensor = state::kNone;  // slot
    std::uint32_t elements = 0;           // that touch the body
    double stick = 0.0, damping = 0.0, slide = 0.0;
    double stick_limit = 0.0, damping_limit = 0.0, slide_limit = 0.0;
  };
  std::uint32_t body = state::kNone;  // slot
  state::Source source{};
  Of of = Of::speed;
  Touch touch{};
};

class LiveWorld {
 public:
  // `commands` must outlive it.
  LiveWorld(std::unique_ptr<physics::World> world, CommandTable& commands);
  ~LiveWorld();
  LiveWorld(const LiveWorld&) = delete;
  LiveWorld& operator=(const LiveWorld&) = delete;

  // Links the new, unlinks the old, switches to the new Structure. Cannot fail as long as all that Catalogue made comes
  // here in its order; returns what the loader must free.
  [[nodiscard]] Garbage apply(Prepared&& prepared);
  const std::shared_ptr<const state::Structure>& structure() const;

  // Takes what was commanded since the last call and ends what has expired. `watchdog_s` is the watchdog's clock (s,
  // never falling, reset or not): it stands still while the simulation is paused or waits, and in free fixed-step runs
  // advances by h a step. Once a turn, also when no step runs, so that "active" is true and cameras and lights obey;
  // and before each step.
  void take_commands(double watchdog_s);

  // One internal step of h seconds, after commands were taken: laws, forces, physics, readings (model/step_actors.h).
  // Counts one in sim_step.
  void step(double h_s);

  // Writes everything that was computed into a frame made for the current structure; leaves clocks, rates and sequence
  // alone.
  void fill(state::Frame& frame) const;

  // Whether anything changed since the last fill(): a step, the structure, a reset or restore, an active flag, a camera
  // moved.
  bool changed() const;

  // All bodies to where they were loaded, at rest; reset() also cameras, lights, controllers, time and step count, and
  // it forgets all commands: the world is as it was when it had just been loaded, bit for bit.
  void reset();
  void reset_bodies();
  void reset_bodies(const std::vector<state::ObjectId>& bodies);  // these only; unknown ones are passed over
  void set_gravity(const math::Vec3& gravity_world);
  math::Vec3 gravity() const;

  // What state::check has passed; returns what is in force then (gains are cut to what is stable), nothing when there
  // is no such object (any more) or it has no such parameter. reset() undoes it.
  std::optional<math::Vec3> set_parameter(state::ObjectId object, state::Parameter parameter, const math::Vec3& value);
  // Whether position targets of a body (its pose, and joints commanded through it) or of a joint stay in force when
  // their command expires. reset() goes back to what was loaded. False: there is no such body or joint.
  bool set_hold(state::ObjectId id, bool hold);
  // From the next step on `law` acts on the body as `source`, beside commands and laws of other sources, until let_go()
  // or until the body is removed; resets and restores leave it. One for each (body, source): a new one replaces the old
  // one. The law must outlive that. False: there is no such moving body, or no room (base::kSpareLaws beyond one a
  // body).
  bool hold(state::ObjectId body, state::Source source, Law& law);
  void let_go(state::ObjectId body, state::Source source);
  // False when there is no such moving body.
  bool push(state::ObjectId body, const state::Push& push);
  // The parameters and gravity of a frame; cheap while nothing changes. fill() leaves them alone.
  void fill_parameters(state::Frame& frame) const;
  void set_lens(state::ObjectId camera, const state::Lens& lens);  // does nothing when that is gone
  void set_beam(state::ObjectId light, const state::Beam& beam);

  std::uint32_t sim_step() const;
  double sim_time() const;      // s
  std::uint64_t epoch() const;  // + 1 a reset or restore

  // Slot of the first body whose state is not finite or absurd since the last step, or state::kNone. Its name is in the
  // structure.
  std::uint32_t diverged_body() const;
  // Freezes what diverged, each body with all that joints connect to it, and ends what acts on it, until a reset, a
  // restore or a command within bounds. Allocates.
  std::vector<FrozenReport> freeze_diverged();
  // Whether there is a moving body that is not frozen.
  bool anything_moves() const;
  std::optional<CutReport> take_cut_report();
  // Steps so far in which crowded triangle meshes waited more than four steps between two looks at their contacts, and
  // slots of the two bodies that are deepest inside each other (state::kNone: none touch).
  std::uint64_t crowded_steps() const;
  std::array<std::uint32_t, 2> max_depth_meshes() const;
  // Ends all commands and switches all controllers and motors off (divergence); commands work again when posted anew.
  void controllers_off();

  // The whole state (bodies, joints, controllers, commands, time) as bytes of one version, at a canonical restart that
  // the live world makes too: continuing here and continuing after restore() is the same, bit for bit, in this or
  // another process. May allocate.
  std::vector<std::uint8_t> save();
  // What decode() has let pass; cameras and lights must hang on what they hung on then (Catalogue::prepare_hang). May
  // allocate.
  void restore(const SavedState& saved);
  // The same from bytes, where nothing was hung elsewhere since. Empty when done; else why not, and nothing has
  // changed.
  std::string restore(const std::vector<std::uint8_t>& bytes);

  // Pointers (pick_table.h): what the ray meets first is held by that one's press from now on. False: it meets nothing.
  bool pick(std::size_t slot, std::uint64_t press, const math::Vec3& from_world, const math::Vec3& to_world,
            state::PickHit& hit);
  // Once a turn. `still`: the world is paused and no step is asked for.
  void take_picks(bool still);
  PickTable& pick_table();

  // Input devices (effector_table.h). Once an iteration, before its `steps` steps and before take_commands; by the
  // watchdog's clock as there. Ends of holds are seen in take_commands, too.
  void take_effectors(double watchdog_s, std::uint64_t steps);
  EffectorTable& effector_table();

  // Notes in `channel` what is found of commands, devices and pointers, and when (decision 0032); null: nowhere. It
  // must outlive this, or be ended by null.
  void record_to(inputs::Channel* channel);

  // Thread CPU seconds a step spends in each phase, mean over recent sampled steps (publish is the caller's).
  struct PhaseTimes {
    double seconds_per_step[state::kPhaseCount] = {};
  };
  PhaseTimes phase_times() const;

  physics::World& physics();

  struct Impl;  // model/detail/live_impl.h: for kinds (model/kinds/)

 private:
  std::unique_ptr<Impl> impl_;
};

}  // namespace ambf::model
