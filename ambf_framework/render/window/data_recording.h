// How the windows have recorded what the simulation publishes: by whoever made them, in whatever way. render/ knows neither middleware nor
// programs. Nothing here waits. Main thread.
#pragma once

#include <string>
#include <vector>

namespace ambf::render {

class DataRecording {
 public:
  enum class State { idle, running, ending };  // ending: asked to, its file is being completed

  virtual ~DataRecording() = default;
  virtual std::string unavailable() const = 0;  // why there can be none, in words; empty: there can
  virtual void start(const std::string& file) = 0;
  virtual void stop() = 0;
  virtual State state() const = 0;
  virtual double running_s() const = 0;         // since it was started; 0 while idle
  virtual const std::string& file() const = 0;  // of the recording started last
  // What the user is to be told since the last call, oldest first. Logged already.
  virtual std::vector<std::string> take_messages() = 0;
};

}  // namespace ambf::render
