// Interface through which the windows start and stop recording of published data. Implemented outside render/, which
// knows neither middleware nor child programs. No call waits. Main thread.
#pragma once

#include <string>
#include <vector>

namespace ambf::render {

class DataRecording {
 public:
  enum class State { idle, running, ending };  // ending: stopped, its file is being completed

  virtual ~DataRecording() = default;
  virtual std::string unavailable() const = 0;  // why recording is impossible; empty: it is possible
  virtual void start(const std::string& file) = 0;
  virtual void stop() = 0;
  virtual State state() const = 0;
  virtual double running_s() const = 0;         // since it was started; 0 while idle
  virtual const std::string& file() const = 0;  // of the recording started last
  // Messages for the user since the last call, oldest first. Logged already.
  virtual std::vector<std::string> take_messages() = 0;
};

}  // namespace ambf::render
