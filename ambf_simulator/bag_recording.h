// Records the simulation's topics for the panel's button, by a child process that runs `ambf-cli record`. A thread of
// its own starts it, reads its output and ends it, so that neither drawing nor physics waits for it. All calls from one
// thread.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "base/log.h"
#include "render/window/data_recording.h"
#include "watched_program.h"

namespace ambf::simulator {

struct BagRecorderOptions {
  std::string unavailable;          // why nothing can be recorded; empty: it can
  std::vector<std::string> places;  // where ambf-cli may be; the first executable one is used
  double patience_s = 10.0;         // limit for its start, and for completing its bag when this object is destroyed
};

class BagRecording final : public render::DataRecording {
 public:
  // Construct it before the thread lowers its priority: child processes inherit the priority.
  BagRecording(BagRecorderOptions options, base::Log& log);
  ~BagRecording() override;  // ends the recording under way; waits for its bag, within bounds

  std::string unavailable() const override { return options_.unavailable; }
  void start(const std::string& file) override;
  void stop() override;
  State state() const override;
  double running_s() const override;
  const std::string& file() const override { return file_; }
  std::vector<std::string> take_messages() override;

 private:
  void run();  // on the thread
  void record(const std::string& file);
  // Exit code; nothing when it had to be killed.
  std::optional<int> until_it_ends(WatchedProgram& recorder);
  void report(const std::string& file, std::optional<int> code, const std::vector<std::string>& lines);
  void report(base::Severity severity, const std::string& text);

  const BagRecorderOptions options_;
  base::Log& log_;
  std::string file_;
  std::int64_t began_ns_ = 0;

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  State state_ = State::idle;
  bool over_ = false;  // this object ends
  std::vector<std::string> messages_;

  std::thread thread_;  // last: it uses the rest
};

}  // namespace ambf::simulator
