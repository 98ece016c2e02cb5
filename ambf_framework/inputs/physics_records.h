// Records of the physics thread: what it did, each followed by what it found by that.
#pragma once

#include <cstdint>
#include <vector>

#include "inputs/records.h"
#include "state/command.h"
#include "state/parameters.h"
#include "state/view.h"

namespace ambf::inputs {

// An iteration: pointers and devices are read. `watch_s`: the watchdogs' clock.
struct IterationRecord {
  static constexpr Type kType = Type::iteration;
  double watch_s = 0.0;
  std::uint64_t steps = 0;  // planned
  bool still = false;

  template <class Self, class Archive>
  static void members(Self& r, Archive& a) {
    a(r.watch_s), a(r.steps), a(r.still);
  }
};

// Commands are read; with `step`, a step obeys them.
struct TakeRecord {
  static constexpr Type kType = Type::take;
  double watch_s = 0.0;
  bool step = false;

  template <class Self, class Archive>
  static void members(Self& r, Archive& a) {
    a(r.watch_s), a(r.step);
  }
};

struct PublishedRecord {
  static constexpr Type kType = Type::published;
  std::uint64_t frame = 0;  // Frame::sequence
  std::int64_t now_ns = 0;  // Frame::steady_ns
  std::uint64_t state_hash = 0;
  std::uint32_t sim_step = 0;
  bool throttled = false;  // devices see it in the frame: between toggles no time passes

  template <class Self, class Archive>
  static void members(Self& r, Archive& a) {
    a(r.frame), a(r.now_ns), a(r.state_hash), a(r.sim_step), a(r.throttled);
  }
};

// What the loader prepared comes into force, or the state is taken for it.
struct SceneRequestRecord {
  static constexpr Type kType = Type::scene_request;
  std::uint64_t change = 0;  // which SceneChangeRecord it belongs to: the first one is 1
  double watch_s = 0.0;

  template <class Self, class Archive>
  static void members(Self& r, Archive& a) {
    a(r.change), a(r.watch_s);
  }
};

struct PauseRecord {
  static constexpr Type kType = Type::pause;
  bool paused = false;

  template <class Self, class Archive>
  static void members(Self& r, Archive& a) {
    a(r.paused);
  }
};

enum class ResetOf : std::uint8_t { world, bodies, some_bodies, count };

// Writers have a reference as List: they must not allocate.
template <class List>
struct BasicReset {
  static constexpr Type kType = Type::reset;
  ResetOf of = ResetOf::world;
  List some;

  template <class Self, class Archive>
  static void members(Self& r, Archive& a) {
    a(r.of), a(r.some);
  }
};
using ResetRecord = BasicReset<std::vector<state::ObjectId>>;
using ResetRef = BasicReset<const std::vector<state::ObjectId>&>;

struct ParameterRecord {
  static constexpr Type kType = Type::parameter;
  state::ObjectId object;
  state::Parameter parameter{};
  math::Vec3 value;

  template <class Self, class Archive>
  static void members(Self& r, Archive& a) {
    a(r.object), a(r.parameter), a(r.value);
  }
};

struct PushRecord {
  static constexpr Type kType = Type::push;
  state::ObjectId body;
  state::Push push;

  template <class Self, class Archive>
  static void members(Self& r, Archive& a) {
    a(r.body), a(r.push.force_world), a(r.push.torque_world), a(r.push.point_body), a(r.push.seconds), a(r.push.source);
  }
};

struct GravityRecord {
  static constexpr Type kType = Type::gravity;
  math::Vec3 gravity_world;

  template <class Self, class Archive>
  static void members(Self& r, Archive& a) {
    a(r.gravity_world);
  }
};

struct HoldRecord {
  static constexpr Type kType = Type::hold;
  state::ObjectId object;
  bool hold = false;

  template <class Self, class Archive>
  static void members(Self& r, Archive& a) {
    a(r.object), a(r.hold);
  }
};

struct LensRecord {
  static constexpr Type kType = Type::lens;
  state::ObjectId camera;
  state::Lens lens;

  template <class Self, class Archive>
  static void members(Self& r, Archive& a) {
    a(r.camera), a(r.lens.near_m), a(r.lens.far_m), a(r.lens.field_of_view_rad), a(r.lens.orthographic);
    a(r.lens.orthographic_width_m), a(r.lens.stereo), a(r.lens.eye_separation_m), a(r.lens.focal_length_m);
    a(r.lens.optics.focal_ratio), a(r.lens.optics.axis_right), a(r.lens.optics.axis_down), a(r.lens.optics.skew);
  }
};

struct BeamRecord {
  static constexpr Type kType = Type::beam;
  state::ObjectId light;
  state::Beam beam;

  template <class Self, class Archive>
  static void members(Self& r, Archive& a) {
    a(r.light), a(r.beam.type), a(r.beam.cutoff_angle_rad), a(r.beam.spot_exponent), a(r.beam.attenuation_constant);
    a(r.beam.attenuation_linear), a(r.beam.attenuation_quadratic), a(r.beam.shadow_quality);
  }
};

struct PickRecord {
  static constexpr Type kType = Type::pick;
  std::uint32_t pointer = 0;
  std::uint64_t press = 0;
  math::Vec3 from_world, to_world;

  template <class Self, class Archive>
  static void members(Self& r, Archive& a) {
    a(r.pointer), a(r.press), a(r.from_world), a(r.to_world);
  }
};

// ---- What it found.

// The newest set-point that a device had posted to the effectors' table; posted between two cycles of that device.
struct SetPointRecord {
  static constexpr Type kType = Type::set_point;
  std::uint32_t slot = 0;
  std::uint64_t hold = 0;
  state::ObjectId body;
  state::Source source{};
  std::int64_t posted_ns = 0;

  template <class Self, class Archive>
  static void members(Self& r, Archive& a) {
    a(r.slot), a(r.hold), a(r.body), a(r.source), a(r.posted_ns);
  }
};

struct EffectorEndedRecord {
  static constexpr Type kType = Type::effector_ended;
  std::uint32_t slot = 0;
  std::uint64_t hold = 0;
  bool released = false;  // let go for now; else the hold is over for good

  template <class Self, class Archive>
  static void members(Self& r, Archive& a) {
    a(r.slot), a(r.hold), a(r.released);
  }
};

// A command of one source to one object. Of several that are found at once, the one that was posted last counts last.
template <class Command>
struct BasicCommand {
  static constexpr Type kType = Type::command;
  state::ObjectId object;
  state::Source source{};
  std::int64_t received_ns = 0, posted_ns = 0;
  Command command;

  template <class Self, class Archive>
  static void members(Self& r, Archive& a) {
    a(r.object), a(r.source), a(r.received_ns), a(r.posted_ns), a(r.command);
  }
};
using CommandRecord = BasicCommand<state::Command>;
using CommandRef = BasicCommand<const state::Command&>;

// A command of a registered kind's own type, as its kind writes it into saved states.
template <class List>
struct BasicKindCommand {
  static constexpr Type kType = Type::kind_command;
  state::ObjectId object;
  state::Source source{};
  std::int64_t received_ns = 0, posted_ns = 0;
  List bytes;

  template <class Self, class Archive>
  static void members(Self& r, Archive& a) {
    a(r.object), a(r.source), a(r.received_ns), a(r.posted_ns), a(r.bytes);
  }
};
using KindCommandRecord = BasicKindCommand<Bytes>;
using KindCommandRef = BasicKindCommand<const Bytes&>;

struct CommandKeptRecord {  // a sign of life of the source
  static constexpr Type kType = Type::command_kept;
  state::ObjectId object;
  state::Source source{};
  std::int64_t posted_ns = 0;

  template <class Self, class Archive>
  static void members(Self& r, Archive& a) {
    a(r.object), a(r.source), a(r.posted_ns);
  }
};

struct CommandEndedRecord {
  static constexpr Type kType = Type::command_ended;
  state::ObjectId object;
  state::Source source{};

  template <class Self, class Archive>
  static void members(Self& r, Archive& a) {
    a(r.object), a(r.source);
  }
};

struct CommandLastingRecord {  // whether the watchdog leaves it alone
  static constexpr Type kType = Type::command_lasting;
  state::ObjectId object;
  state::Source source{};
  bool lasting = false;

  template <class Self, class Archive>
  static void members(Self& r, Archive& a) {
    a(r.object), a(r.source), a(r.lasting);
  }
};

struct PickTargetRecord {
  static constexpr Type kType = Type::pick_target;
  std::uint32_t pointer = 0;
  std::uint64_t press = 0;
  math::Vec3 point_world;

  template <class Self, class Archive>
  static void members(Self& r, Archive& a) {
    a(r.pointer), a(r.press), a(r.point_world);
  }
};

struct PickEndedRecord {
  static constexpr Type kType = Type::pick_ended;
  std::uint32_t pointer = 0;
  std::uint64_t press = 0;

  template <class Self, class Archive>
  static void members(Self& r, Archive& a) {
    a(r.pointer), a(r.press);
  }
};

}  // namespace ambf::inputs
