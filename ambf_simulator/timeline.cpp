#include "timeline.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdint>

namespace ambf::simulator {

namespace {

using namespace std::chrono_literals;

constexpr auto kLook = 50ms;                    // at signals
constexpr unsigned kMaxStepsPerRequest = 1000;  // so that a signal is served soon

class Stepped final : public Timeline {
 public:
  Stepped(state::RunAbility& run, state::ObserveAbility& observe, Signals& signals)
      : run_(run), signals_(signals), reader_(observe.make_reader()) {
    run_.set_paused(true);
  }

  const state::Frame* now() override {
    const state::Frame* frame = reader_ == nullptr ? nullptr : reader_->latest();
    while (frame != nullptr && !frame->run.paused && !signals_.stop_requested()) {  // not yet taken notice of
      reader_->wait_newer(frame->sequence, kLook);
      frame = reader_->latest();
    }
    return frame;
  }

  const state::Frame* at(double sim_time_s) override {
    while (!signals_.stop_requested()) {
      const state::Frame* frame = now();
      if (frame == nullptr || frame->run.diverged) return nullptr;
      const double steps = std::round((sim_time_s - frame->sim_time) / frame->run.step_s);
      if (steps < 1.0) return frame;
      if (!step(static_cast<unsigned>(std::min<double>(steps, kMaxStepsPerRequest)))) return nullptr;
    }
    return nullptr;
  }

 private:
  bool step(unsigned count) {
    const std::unique_ptr<state::StepTicket> ticket = run_.step(count, {}, false);
    while (!ticket->wait(kLook)) {
      if (signals_.stop_requested()) return false;
    }
    return ticket->outcome().success;
  }

  state::RunAbility& run_;
  Signals& signals_;
  std::unique_ptr<state::FrameReader> reader_;
};

class Watched final : public Timeline {
 public:
  Watched(state::ObserveAbility& observe, Signals& signals) : signals_(signals), reader_(observe.make_reader()) {}

  const state::Frame* now() override { return reader_ == nullptr ? nullptr : reader_->latest(); }

  const state::Frame* at(double sim_time_s) override {
    while (!signals_.stop_requested()) {
      const state::Frame* frame = now();
      if (frame == nullptr) return nullptr;
      if (frame->sim_time >= sim_time_s) return frame;
      reader_->wait_newer(frame->sequence, kLook);
    }
    return nullptr;
  }

 private:
  Signals& signals_;
  std::unique_ptr<state::FrameReader> reader_;
};

}  // namespace

std::unique_ptr<Timeline> Timeline::stepped(state::RunAbility& run, state::ObserveAbility& observe, Signals& signals) {
  return std::make_unique<Stepped>(run, observe, signals);
}

std::unique_ptr<Timeline> Timeline::watched(state::ObserveAbility& observe, Signals& signals) {
  return std::make_unique<Watched>(observe, signals);
}

}  // namespace ambf::simulator
