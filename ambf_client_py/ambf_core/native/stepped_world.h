// A world that a Python program drives on its own thread: a LocalSimulation whose state and commands are arrays. Knows
// nothing of Python, so that tests and sanitizers run it without. One thread at a time.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "base/log.h"
#include "base/log_drain.h"
#include "command_writer.h"
#include "fields.h"
#include "runtime/local_simulation.h"

namespace ambf::python {

struct WorldSettings {
  std::string world_file;   // empty: gravity and ground as where a world file says nothing
  std::string colors_file;  // empty: colours have no names
  runtime::SimulationOptions options;
  std::shared_ptr<mesh::MeshCache> meshes;  // shared with other worlds; null: its own
};

// A world file or a file of colours is refused; what() has the findings, one a line.
class RefusedError : public std::runtime_error {
 public:
  RefusedError(const std::string& file, const base::Diagnostics& findings);
};

class SteppedWorld {
 public:
  // Throws RefusedError.
  explicit SteppedWorld(const WorldSettings& settings);

  // After each of these, attach() with memory of the new sizes if structure() has changed.
  state::Outcome load(const state::LoadRequest& request) { return simulation_.load(request); }
  state::Outcome unload(const std::string& model) { return simulation_.unload(model); }
  state::Outcome remove(const std::string& object) { return simulation_.remove(object); }

  // What the program commanded is kept with the state of the world.
  state::Outcome snapshot(const std::string& name);
  state::Outcome restore(const std::string& name);
  state::Outcome forget(const std::string& name);
  // `object`: as state::find takes names. Errors: no such object, or state::check.
  state::Outcome set_parameter(const std::string& object, state::Parameter parameter, const math::Vec3& value);
  // False: no such object.
  bool parameter(const std::string& object, state::Parameter parameter, math::Vec3& value) const;
  void set_gravity(const math::Vec3& gravity_world) { simulation_.set_gravity(gravity_world); }

  // State is written to this memory from now on, commands are read from it. The memory must outlive this object or the
  // next attach(); its commands are cleared unless `keep_commands`.
  void attach(Memory state, Memory commands, bool keep_commands);

  // Puts what the command arrays hold in force. Empty, or why nothing was changed.
  std::string post() { return commands_.post(CommandArrays(command_memory_)); }
  // What post() would return for commands in other memory of the same layout.
  std::string check(const Memory& commands) { return commands_.check(CommandArrays(commands)); }
  // n steps, then the state is written. False when the world has diverged: it does not step until reset or restored.
  bool run(unsigned n);
  // As loaded, with nothing commanded.
  void reset();

  std::uint64_t hash() const { return state::state_hash(simulation_.frame()); }
  const state::Frame& frame() const { return simulation_.frame(); }
  std::shared_ptr<const state::Structure> structure() const { return simulation_.structure(); }
  // Names of the bodies that diverged and stand still: the one that stopped the world first.
  std::vector<std::string> frozen() const;
  bool has_log() { return !log_lines_.empty() || read_log(); }
  // What was logged since the last call, repetitions counted.
  std::vector<base::LogLine> take_log();

 private:
  SteppedWorld(const WorldSettings& settings, struct ReadWorld read);
  bool read_log();
  void show_frame() { show(simulation_.frame(), state_memory_); }

  base::Log log_;
  base::RepeatFilter filter_;
  std::vector<base::LogLine> log_lines_;
  runtime::LocalSimulation simulation_;
  CommandWriter commands_;
  std::map<std::string, std::vector<state::ObjectId>> commanded_;  // joints, by snapshot
  Memory state_memory_, command_memory_;
};

}  // namespace ambf::python
