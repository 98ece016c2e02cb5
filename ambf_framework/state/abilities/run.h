// The ability to control the run: pause, step, throttle, speed, reset, snapshots. Any thread; nothing waits for the
// physics thread except StepTicket::wait. C++17.
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "state/abilities/outcome.h"
#include "state/command.h"
#include "state/frame.h"
#include "state/ids.h"

namespace ambf::state {

// A command sent along with a Step request, applied before its first step.
struct AddressedCommand {
  ObjectId object;
  Command command;
};

// A Step request in progress, see RunAbility::step. One thread at a time; destroying the ticket does not stop the
// steps.
class StepTicket {
 public:
  virtual ~StepTicket() = default;
  // Sleeps until the last step is done, the request is refused, or the timeout has passed; returns whether there is an
  // outcome.
  virtual bool wait(std::chrono::nanoseconds timeout) = 0;
  // Valid once wait() has returned true:
  virtual const Outcome& outcome() const = 0;
  // The frame of the last step, whatever happened since; valid as long as the ticket. Null if it was not requested or
  // nothing was run.
  virtual const Frame* frame() const = 0;
  // The number of its first step, which obeyed its commands; of a request of no steps: of the next step.
  virtual std::uint32_t first_step() const = 0;
};

class RunAbility {
 public:
  virtual ~RunAbility() = default;

  // Effective within the next iteration.
  virtual void set_paused(bool paused) = 0;
  virtual void step_paused(unsigned steps) = 0;                 // while paused
  virtual void reset_world() = 0;                               // bodies, time, step count, controllers
  virtual void reset_bodies() = 0;                              // poses and velocities only
  virtual void reset_bodies(std::vector<ObjectId> bodies) = 0;  // only of these; removed bodies are skipped
  // Simulated seconds per wall second; the step length stays. Without effect where time does not follow the clock.
  virtual void set_speed(double factor) = 0;

  // World command topic: throttling. Every command counts, in order.
  virtual void post_world(const WorldCommand& command) = 0;
  // The watchdog of the world command has expired. Releases the throttle only if the options say so.
  virtual void world_command_expired() = 0;

  // Runs exactly n steps even if paused or throttled (the Step service); finished when the frame of step n is complete.
  // A ticket that keeps that frame counts as a reader and must not outlive this object. Never null.
  virtual std::unique_ptr<StepTicket> step(unsigned n, std::vector<AddressedCommand> commands, bool keep_frame) = 0;

  // Whole state, kept in memory under `name` (empty: "snapshot<n>") and written to the file `path` unless that is
  // empty. restore() reads the file if a path is given. Outcome::model is the name. Bounds: base/bounds.h;
  // forget() lets one go.
  virtual void snapshot(const std::string& name, const std::string& path, Completion done) = 0;
  virtual void restore(const std::string& name, const std::string& path, Completion done) = 0;
  virtual void forget(const std::string& name, Completion done) = 0;
  virtual std::vector<std::string> snapshots() = 0;
};

}  // namespace ambf::state
