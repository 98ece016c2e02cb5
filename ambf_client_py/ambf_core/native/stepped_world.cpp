#include "stepped_world.h"

#include <utility>

#include "adf/adf.h"
#include "base/clock.h"

namespace ambf::python {

struct ReadWorld {
  scene::World world;
  scene::ColorTable colors;
};

namespace {

ReadWorld read_world(const WorldSettings& settings) {
  ReadWorld read;
  if (!settings.colors_file.empty()) {
    adf::ColorsResult colors = adf::load_colors(settings.colors_file);
    if (!colors.colors) throw RefusedError(settings.colors_file, colors.diagnostics);
    read.colors = std::move(*colors.colors);
  }
  if (!settings.world_file.empty()) {
    adf::Options options;
    options.colors = &read.colors;
    adf::WorldResult world = adf::load_world(settings.world_file, options);
    if (!world.world) throw RefusedError(settings.world_file, world.diagnostics);
    read.world = std::move(*world.world);
  }
  return read;
}

std::string with_findings(std::string text, const base::Diagnostics& findings) {
  for (const base::Diagnostic& each : findings) text += "\n" + base::to_string(each);
  return text;
}

}  // namespace

RefusedError::RefusedError(const std::string& file, const base::Diagnostics& findings)
    : std::runtime_error(with_findings("'" + file + "' was refused", findings)) {}

SteppedWorld::SteppedWorld(const WorldSettings& settings) : SteppedWorld(settings, read_world(settings)) {}

SteppedWorld::SteppedWorld(const WorldSettings& settings, ReadWorld read)
    : simulation_(settings.options, read.world, std::move(read.colors), log_, settings.meshes) {}

void SteppedWorld::attach(Memory state, Memory commands, bool keep_commands) {
  state_memory_ = std::move(state);
  command_memory_ = std::move(commands);
  if (!keep_commands) clear_commands(*simulation_.structure(), command_memory_);
  commands_.follow(simulation_);
  show_frame();
}

state::Outcome SteppedWorld::snapshot(const std::string& name) {
  state::Outcome outcome = simulation_.snapshot(name);
  if (outcome.success) commanded_[outcome.model] = commands_.commanded();
  return outcome;
}

state::Outcome SteppedWorld::restore(const std::string& name) {
  state::Outcome outcome = simulation_.restore(name);
  if (outcome.success) commands_.restore(commanded_[name]);
  return outcome;
}

state::Outcome SteppedWorld::forget(const std::string& name) {
  state::Outcome outcome = simulation_.forget(name);
  if (outcome.success) commanded_.erase(name);
  return outcome;
}

state::Outcome SteppedWorld::set_parameter(const std::string& object, state::Parameter parameter,
                                           const math::Vec3& value) {
  const state::Structure& structure = *simulation_.structure();
  const std::uint32_t index = state::find(structure, object, state::info_of(parameter).kind);
  if (index != state::kNone) return simulation_.set_parameter(structure.objects[index].id, parameter, value);
  state::Outcome outcome;
  outcome.message = "no object with this parameter, or more than one, is called '" + object + "'";
  return outcome;
}

bool SteppedWorld::parameter(const std::string& object, state::Parameter parameter, math::Vec3& value) const {
  const state::Frame& frame = simulation_.frame();
  const state::ObjectKind kind = state::info_of(parameter).kind;
  const std::uint32_t index = state::find(*frame.structure, object, kind);
  if (index == state::kNone) return false;
  const std::uint32_t slot = frame.structure->objects[index].slot;
  value = kind == state::ObjectKind::joint ? state::value_of(frame.joint_parameters[slot], parameter)
                                           : state::value_of(frame.body_parameters[slot], parameter);
  return true;
}

bool SteppedWorld::run(unsigned n) {
  const bool good = simulation_.step(n);
  show_frame();
  return good;
}

void SteppedWorld::reset() {
  commands_.release();
  clear_commands(*simulation_.structure(), command_memory_);
  simulation_.step(0);  // commands end before the reset, which then forgets what they did to motors
  simulation_.reset();
  show_frame();
}

std::vector<std::string> SteppedWorld::frozen() const {
  const state::Frame& frame = simulation_.frame();
  const state::Structure& structure = *frame.structure;
  std::vector<std::string> names;
  const auto add = [&](std::size_t slot) { names.push_back(structure.objects[structure.bodies[slot].object].name); };
  const std::uint32_t first = frame.run.diverged ? frame.run.diverged_body : state::kNone;
  if (first != state::kNone) add(first);
  for (std::size_t slot = 0; slot < frame.bodies.size(); ++slot) {
    if (frame.bodies[slot].frozen && slot != first) add(slot);
  }
  return names;
}

bool SteppedWorld::read_log() {
  base::LogRecord record;
  while (log_.take(record)) {
    filter_.accept(record, base::steady_ns(), [this](const base::LogLine& line) { log_lines_.push_back(line); });
  }
  return !log_lines_.empty();
}

std::vector<base::LogLine> SteppedWorld::take_log() {
  read_log();
  return std::exchange(log_lines_, {});
}

}  // namespace ambf::python
