// The loader of a replay: repeats the changes of the scene that a recording holds, one after the other, when the
// physics stream comes to what they requested. All functions: the thread of the replay.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <string>

#include "inputs/recording.h"
#include "runtime/detail/loader.h"
#include "runtime/detail/loader_work.h"

namespace ambf::runtime {

class ReplayedScene {
 public:
  // All must outlive it.
  ReplayedScene(const SimulationOptions& options, const scene::World& world, scene::ColorTable colors,
                inputs::Recording& recording, base::Log& log);
  ~ReplayedScene();

  LoaderWork& work() { return work_; }
  // The next request of this change (the first one is 1), which the caller runs and answers; null: there is none,
  // with `problem`, or without one where the recording was cut off before it.
  RequestPtr next_request(std::uint64_t change, std::string& problem);
  // After that request was answered. False, with `problem`: it was the save of the state at the start, and that is
  // another one than the recording's.
  bool is_as_recorded(std::string& problem);
  // The state at the start was compared: what differs from now on is not the scene.
  bool start_seen() const { return start_seen_; }

 private:
  void submit(RequestPtr request);  // loader thread
  bool start_next(std::string& problem);

  const scene::World& world_;
  inputs::Recording& recording_;
  std::mutex mutex_;
  std::condition_variable changed_;
  RequestPtr request_;
  bool busy_ = false, stopping_ = false;
  std::string done_;  // what the last change said
  bool failed_ = false;
  std::uint64_t started_ = 0;
  bool at_start_ = false, start_seen_ = false;  // the change at hand is the save at the start; it was compared
  LoaderWork work_;
  Loader loader_;
};

}  // namespace ambf::runtime
