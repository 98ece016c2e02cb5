// Every number of a frame by name, for plots, watch lines and their search. A value is found again by name when the
// structure changes. No drawing. Main thread.
#pragma once

#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "state/frame.h"

namespace ambf::render {

struct Value {
  enum class Of : std::uint8_t { world, body, joint };
  Of of = Of::world;
  std::uint32_t slot = 0;  // of the body or joint
  int component = 0;       // which number of it
  std::string name;        // "/ambf/env/psm/baselink position x"
  const char* unit = "";
};

// All values of a structure whose names have all the words; at most `most`.
std::vector<Value> find_values(const state::Structure& structure, const std::string& search, std::size_t most);
std::optional<Value> find_value(const state::Structure& structure, const std::string& name);
double read_value(const state::Frame& frame, const Value& value);

// Values drawn over the last half minute of simulated time, and those watched as numbers.
class Traces {
 public:
  static constexpr double kSeconds = 30.0;
  static constexpr std::size_t kMost = 6;
  struct Trace {
    std::string name;
    std::optional<Value> value;  // none: nothing of that name is there now
    std::deque<double> numbers;  // as many as times()
  };

  // False when it is there already or there is no room.
  bool add(const std::string& name);
  void remove(const std::string& name);
  bool has(const std::string& name) const;
  void set_paused(bool paused) { paused_ = paused; }
  bool paused() const { return paused_; }
  void clear();

  // A sample of each, when the frame is a new one.
  void take(const state::Frame& frame);
  const std::vector<Trace>& traces() const { return traces_; }
  const std::deque<double>& times() const { return times_; }  // s, simulated

  // "time [s],name [unit],..." and a line a sample; empty cells where a value was not there.
  std::string csv() const;

 private:
  std::vector<Trace> traces_;
  std::deque<double> times_;
  bool paused_ = false;
  std::uint64_t sequence_ = 0, epoch_ = 0, structure_version_ = 0;
};

}  // namespace ambf::render
