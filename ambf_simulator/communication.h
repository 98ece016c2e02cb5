// The middleware that this program was built with, serving one simulation; ROS 1 or none.
#pragma once

#include <memory>
#include <string>

#include "base/log.h"
#include "command_line.h"
#include "state/abilities/abilities.h"
#include "state/picture.h"

namespace ambf::simulator {

class Communication {
 public:
  virtual ~Communication() = default;                           // closes all topics
  virtual state::PictureSink* pictures() { return nullptr; }    // where cameras' pictures go; null: nowhere
  virtual std::string nothing_published() const { return {}; }  // why nobody can listen, in words; empty: they can
  // Empty, or why the middleware cannot be started in this environment: a mistake as one on the command line.
  static std::string problem_of_environment(const CommandLine& options);
  // Kinds of objects that come with it; before the first world is made and the first file is read.
  static void register_kinds();
  // Drivers of input devices that come with it; before the first device is made. Their hardware is found once it is
  // started.
  static void register_drivers(base::Log& log);
  // Never null and never waits: what cannot be had (no ROS in this build, --no-ros, no master) is said once.
  static std::unique_ptr<Communication> start(const CommandLine& options, const state::Abilities& simulation,
                                              base::Log& log);
};

}  // namespace ambf::simulator
