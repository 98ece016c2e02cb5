// The ability to read frames and the structure, and to report the reader's own pace. Any thread; nothing waits for the
// physics thread. C++17.
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>

#include "state/frame.h"

namespace ambf::state {

// Pinned view of published frames; register one per thread. A returned frame stays valid until the second next call.
class FrameReader {
 public:
  virtual ~FrameReader() = default;
  virtual const Frame* latest() = 0;    // newest frame; never null once the simulation has started
  virtual const Frame* previous() = 0;  // result of the previous latest(), for interpolation; may be null
  // Sleeps until a frame newer than `sequence` is published or the timeout has passed; returns whether there is one.
  virtual bool wait_newer(std::uint64_t sequence, std::chrono::nanoseconds timeout) = 0;
};

// Every step's frame, in order, from the reader's creation on. One thread.
class StepReader {
 public:
  virtual ~StepReader() = default;
  // The frame of the next step, valid until the next call; null: there is none now. Its `sequence` is that of the
  // published frame that shows this step or a later one.
  virtual const Frame* next() = 0;
};

class ObserveAbility {
 public:
  virtual ~ObserveAbility() = default;
  // Null when the maximum number of readers is registered.
  virtual std::unique_ptr<FrameReader> make_reader() = 0;
  // Null when there is one already. In real time, steps are left out while the reader is a quarter of a second behind;
  // otherwise the simulation waits for it. Must not outlive this object.
  virtual std::unique_ptr<StepReader> read_steps() = 0;
  virtual std::shared_ptr<const Structure> structure() = 0;  // newest
  // Pace of the graphics and of comm, published in RunState; call about once a second.
  virtual void report_graphics(double pictures_per_second, double seconds_per_picture) = 0;
  virtual void report_comm(double seconds_per_frame) = 0;
};

}  // namespace ambf::state
