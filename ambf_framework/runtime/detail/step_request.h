// n steps although paused or throttled, and who waits for them. Scripts step thousands of times a second and wait each
// time: the physics thread wakes the waiting thread itself.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "exchange/signal.h"
#include "runtime/detail/request.h"
#include "state/abilities/command.h"
#include "state/abilities/observe.h"
#include "state/abilities/run.h"

namespace ambf::runtime {

// Shared by the request and its ticket.
class StepResult {
 public:
  // A reader for the frame of the last step; null: it is not kept.
  explicit StepResult(std::unique_ptr<state::FrameReader> reader) : reader_(std::move(reader)) {}

  // The one thread that finishes it, once.
  void finish(state::Outcome outcome);  // nothing was run
  void show();                          // physics thread: what outcome() says was run, the frame is published
  state::Outcome& outcome() { return outcome_; }
  void set_first_step(std::uint32_t step) { first_step_ = step; }

  // The one thread that waits.
  bool wait(std::chrono::nanoseconds timeout);
  const state::Frame* frame() const { return frame_; }
  std::uint32_t first_step() const { return first_step_; }
  void let_go();  // of the frame; the request itself may wait for its destruction for a while

 private:
  void wake();

  std::unique_ptr<state::FrameReader> reader_;
  const state::Frame* frame_ = nullptr;
  state::Outcome outcome_;
  std::uint32_t first_step_ = 0;
  std::atomic<bool> finished_{false};
  exchange::Signal signal_;
};

class StepTicket final : public state::StepTicket {
 public:
  explicit StepTicket(std::shared_ptr<StepResult> result) : result_(std::move(result)) {}
  ~StepTicket() override { result_->let_go(); }
  StepTicket(const StepTicket&) = delete;
  StepTicket& operator=(const StepTicket&) = delete;
  bool wait(std::chrono::nanoseconds timeout) override { return result_->wait(timeout); }
  const state::Outcome& outcome() const override { return result_->outcome(); }
  const state::Frame* frame() const override { return result_->frame(); }
  std::uint32_t first_step() const override { return result_->first_step(); }

 private:
  const std::shared_ptr<StepResult> result_;
};

// The commands take effect in the first step.
class StepRequest final : public Request {
 public:
  using Commands = std::vector<std::pair<std::unique_ptr<state::CommandPort>, state::Command>>;
  StepRequest(unsigned n, Commands commands, std::int64_t received_ns, std::shared_ptr<StepResult> result)
      : n_(n), commands_(std::move(commands)), received_ns_(received_ns), result_(std::move(result)) {}

  bool takes_steps() const override { return true; }
  Progress run(RequestScope& scope) override;
  bool shown() override;
  void answer(bool ran) override;

 private:
  const unsigned n_;
  Commands commands_;
  const std::int64_t received_ns_;
  const std::shared_ptr<StepResult> result_;
  bool started_ = false;
};

}  // namespace ambf::runtime
