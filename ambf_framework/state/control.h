// The one way into the simulation for everyone but the loader and the physics thread: read frames, post commands, send requests.
// Implemented by runtime/. All functions may be called from any thread and never wait for the physics thread, except
// StepTicket::wait. C++17.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "base/diagnostic.h"
#include "state/command.h"
#include "state/frame.h"

namespace ambf::state {

// Pinned view of published frames; register one per thread. A frame returned stays valid until the call after next.
class FrameReader {
 public:
  virtual ~FrameReader() = default;
  virtual const Frame* latest() = 0;    // newest frame (never null once the simulation has started)
  virtual const Frame* previous() = 0;  // the one returned by the latest() call before, for interpolation; may be null
  // Sleeps until a frame with sequence > `sequence` is published, or until the deadline; returns whether there is one.
  virtual bool wait_newer(std::uint64_t sequence, std::chrono::nanoseconds timeout) = 0;
};

// Where one source writes the commands of one object; one writer thread at a time. The object may die meanwhile: then nothing happens.
class CommandPort {
 public:
  virtual ~CommandPort() = default;
  // Takes a checked command (state::check). Never blocks; effective at the beginning of the next step.
  virtual void post(const Command& command) = 0;
  // The same with a command that has been waiting since then (steady clock).
  virtual void post(const Command& command, std::int64_t received_ns) = 0;
  // Keeps what was posted in force for another watchdog period.
  virtual void keep_alive() = 0;
  // Ends this source's command now, as the watchdog would.
  virtual void release() = 0;
};

// What a pointer's ray met.
struct PickHit {
  ObjectId object;
  math::Vec3 point_world;
  double distance_m = 0.0;
};

// With what one pointer (a window's mouse) holds a body: one at a time. Several pointers may hold several bodies, or the same. One
// thread at a time. Its end lets go.
class PickPort {
 public:
  virtual ~PickPort() = default;
  virtual std::uint32_t id() const = 0;  // PickState::picker
  // Casts a ray on the physics thread; what it meets first is held by that point from then on, until the next pick or release().
  // The answer comes through `done` (which must be quick), from another thread, after the frame that shows it.
  virtual void pick(const math::Vec3& from_world, const math::Vec3& to_world,
                    std::function<void(bool, const PickHit&)> done) = 0;
  // Where the held point is wanted. A moving body is pulled there by a spring, a static one is moved. While paused, also a moving
  // body is moved, with all that is jointed to it, unless joints hold it to something static.
  virtual void drag(const math::Vec3& target_world) = 0;
  virtual void release() = 0;
};

// Outcome of a request. For Load, `model` names what was loaded.
struct Outcome {
  bool success = false;
  std::string message;
  base::Diagnostics diagnostics;
  std::string model;
  std::uint32_t sim_step = 0;
  double sim_time = 0.0;
  std::size_t bytes = 0;  // of a snapshot
  double physics_cpu_s =
      0.0;  // of a structure change: thread CPU time that putting it in force took of the physics thread
};

// Called exactly once, from the loader or the comm side (never from the physics thread), when a request is finished.
using Completion = std::function<void(const Outcome&)>;

struct LoadRequest {
  std::string path;          // ADF file; or
  std::string text;          // ADF text (paths in it are relative to `path`, or to the working directory)
  std::string name_prefix;   // put before the model's namespaces
  math::Pose T_world_model;  // where the model is put
  bool check_only = false;   // parse and report, load nothing
};

// Commands that a Step request brings along, applied before its first step.
struct AddressedCommand {
  ObjectId object;
  Command command;
};

// Steps under way: see Control::step. One thread at a time; letting go of it does not stop them.
class StepTicket {
 public:
  virtual ~StepTicket() = default;
  // Sleeps until the last of them is done, or they are refused, or the timeout is over; returns whether there is an outcome.
  virtual bool wait(std::chrono::nanoseconds timeout) = 0;
  // Once there is one:
  virtual const Outcome& outcome() const = 0;
  // What the very last of the steps led to, whatever others do meanwhile; valid as long as the ticket. Null if it was not asked for, and
  // when nothing was run.
  virtual const Frame* frame() const = 0;
};

class Control {
 public:
  virtual ~Control() = default;

  virtual std::unique_ptr<FrameReader> make_reader() = 0;
  virtual std::shared_ptr<const Structure> structure() = 0;  // newest

  // Null when the object is gone.
  virtual std::unique_ptr<CommandPort> bind(ObjectId object, Source source) = 0;

  // World command topic: throttling. Every command counts, in order.
  virtual void post_world(const WorldCommand& command) = 0;
  // Its client has been silent for a watchdog's time. Releases the throttle only where the options say so.
  virtual void world_command_expired() = 0;
  virtual void count_refused_command(ObjectId object) = 0;  // invalid: it was for none that is there
  // For RunState; every second or so.
  virtual void report_graphics(double pictures_per_second, double seconds_per_picture) = 0;
  virtual void report_comm(double seconds_per_frame) = 0;

  // Run control; effective within the next turn.
  virtual void set_paused(bool paused) = 0;
  virtual void step_paused(unsigned steps) = 0;                 // while paused
  virtual void reset_world() = 0;                               // bodies, time, step count, controllers
  virtual void reset_bodies() = 0;                              // poses and velocities only
  virtual void reset_bodies(std::vector<ObjectId> bodies) = 0;  // of these; those that are gone are passed over
  virtual void set_gravity(const math::Vec3& gravity_world) = 0;
  // Simulated seconds a wall second; steps stay as long as they are. Without effect where time is not bound to the clock.
  virtual void set_speed(double factor) = 0;

  // Of a body or a joint, from the next turn on; `done` says whether it was (state::check, and that the object is there). A world reset
  // undoes it, as it undoes gravity; a reset of bodies does not.
  virtual void set_parameter(ObjectId object, Parameter parameter, const math::Vec3& value, Completion done) = 0;
  // One push a body at a time: a new one takes the place of the old.
  virtual void push(ObjectId body, const Push& push, Completion done) = 0;

  // Of a camera, of a light; what state::check refuses or what is gone is left as it is. A world reset undoes them.
  virtual void set_lens(ObjectId camera, const Lens& lens) = 0;
  virtual void set_beam(ObjectId light, const Beam& beam) = 0;
  // Hangs a camera or a light on the object that `parent` names (by the rules of the ADF key; empty: the world). It stays where it is.
  virtual void set_parent(ObjectId object, const std::string& parent, Completion done) = 0;

  // Steps exactly n steps although paused or throttled (the Step service); there is an outcome when the frame of step n is complete.
  // A ticket that keeps that frame counts as a reader, and must not outlive this object. Never null.
  virtual std::unique_ptr<StepTicket> step(unsigned n, std::vector<AddressedCommand> commands, bool keep_frame) = 0;

  // Structure changes, done by the loader.
  virtual void load(LoadRequest request, Completion done) = 0;
  virtual void unload(const std::string& model, Completion done) = 0;
  virtual void remove(const std::string& object, Completion done) = 0;

  // Whole state, kept in memory under `name` (empty: "snapshot<n>") and written to the file `path` unless that is empty. Restoring
  // takes it from the file when a path is given. Outcome::model is the name.
  virtual void snapshot(const std::string& name, const std::string& path, Completion done) = 0;
  virtual void restore(const std::string& name, const std::string& path, Completion done) = 0;
  virtual std::vector<std::string> snapshots() = 0;

  // Null when kMaxPicks are in use.
  virtual std::unique_ptr<PickPort> make_pick_port() = 0;
};

}  // namespace ambf::state
