#include "render/panel/plots/values.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>

#include "math/rotation.h"
#include "render/panel/object_tree.h"

namespace ambf::render {

namespace {

struct Component {
  const char* name;
  const char* unit;
};

constexpr std::array<Component, 14> kWorld = {{{"real-time factor", ""},
                                               {"steps a second", "1/s"},
                                               {"contacts", ""},
                                               {"pictures a second", "1/s"},
                                               {"processor share of physics", ""},
                                               {"lateness, worst", "s"},
                                               {"time of a picture", "s"},
                                               {"time of comm", "s"},
                                               {"time of commands", "s"},
                                               {"time of controllers", "s"},
                                               {"time of collision", "s"},
                                               {"time of solver", "s"},
                                               {"time of integration", "s"},
                                               {"time of publishing", "s"}}};
constexpr std::array<Component, 18> kBody = {{{"position x", "m"},
                                              {"position y", "m"},
                                              {"position z", "m"},
                                              {"roll", "rad"},
                                              {"pitch", "rad"},
                                              {"yaw", "rad"},
                                              {"velocity x", "m/s"},
                                              {"velocity y", "m/s"},
                                              {"velocity z", "m/s"},
                                              {"angular velocity x", "rad/s"},
                                              {"angular velocity y", "rad/s"},
                                              {"angular velocity z", "rad/s"},
                                              {"force x", "N"},
                                              {"force y", "N"},
                                              {"force z", "N"},
                                              {"torque x", "Nm"},
                                              {"torque y", "Nm"},
                                              {"torque z", "Nm"}}};
constexpr std::array<Component, 4> kTurning = {
    {{"position", "rad"}, {"velocity", "rad/s"}, {"effort", "Nm"}, {"commanded", ""}}};
constexpr std::array<Component, 4> kSliding = {
    {{"position", "m"}, {"velocity", "m/s"}, {"effort", "N"}, {"commanded", ""}}};

bool slides(state::JointType type) {
  return type == state::JointType::prismatic || type == state::JointType::linear_spring;
}

// Calls use(value) for all; stops when it returns false.
template <class Use>
void each_value(const state::Structure& structure, Use use) {
  const auto all = [&](Value::Of of, std::uint32_t slot, const std::string& object, const auto& components) {
    for (std::size_t i = 0; i < components.size(); ++i) {
      Value value{of, slot, static_cast<int>(i), object + " " + components[i].name, components[i].unit};
      if (!use(std::move(value))) return false;
    }
    return true;
  };
  if (!all(Value::Of::world, 0, "world", kWorld)) return;
  for (std::uint32_t slot = 0; slot < structure.joints.size(); ++slot) {
    const state::JointInfo& joint = structure.joints[slot];
    const auto& components = slides(joint.type) ? kSliding : kTurning;
    if (!all(Value::Of::joint, slot, structure.objects[joint.object].name, components)) return;
  }
  for (std::uint32_t slot = 0; slot < structure.bodies.size(); ++slot) {
    if (!all(Value::Of::body, slot, structure.objects[structure.bodies[slot].object].name, kBody)) return;
  }
}

double component_of(const math::Vec3& v, int i) { return i == 0 ? v.x : i == 1 ? v.y : v.z; }

double read_world(const state::Frame& frame, int component) {
  const state::RunState& run = frame.run;
  constexpr int kFirstPhase = 8;
  switch (component) {
    case 0: return run.real_time_factor;
    case 1: return run.steps_per_second;
    case 2: return frame.contacts_total;
    case 3: return run.graphics_rate;
    case 4: return run.physics_cpu_share;
    case 5: return run.lateness_max;
    case 6: return run.seconds_per_picture;
    case 7: return run.comm_seconds_per_frame;
    default: return run.seconds_per_phase[std::clamp(component - kFirstPhase, 0, state::kPhaseCount - 1)];
  }
}

double read_body(const state::BodyState& body, int component) {
  const int axis = component % 3;
  switch (component / 3) {
    case 0: return component_of(body.T_world_body.position, axis);
    case 1: return component_of(math::to_rpy(body.T_world_body.orientation), axis);
    case 2: return component_of(body.twist_world.linear, axis);
    case 3: return component_of(body.twist_world.angular, axis);
    case 4: return component_of(body.wrench_body.force, axis);
    default: return component_of(body.wrench_body.torque, axis);
  }
}

double read_joint(const state::JointState& joint, int component) {
  switch (component) {
    case 0: return joint.position;
    case 1: return joint.velocity;
    case 2: return joint.effort;
    default: return joint.commanded;
  }
}

}  // namespace

std::vector<Value> find_values(const state::Structure& structure, const std::string& search, std::size_t most) {
  const std::vector<std::string> words = search_words(search);
  std::vector<Value> found;
  each_value(structure, [&](Value value) {
    if (has_words(value.name, words)) found.push_back(std::move(value));
    return found.size() < most;
  });
  return found;
}

std::optional<Value> find_value(const state::Structure& structure, const std::string& name) {
  std::optional<Value> found;
  each_value(structure, [&](Value value) {
    if (value.name != name) return true;
    found = std::move(value);
    return false;
  });
  return found;
}

double read_value(const state::Frame& frame, const Value& value) {
  switch (value.of) {
    case Value::Of::world: return read_world(frame, value.component);
    case Value::Of::body: return read_body(frame.bodies[value.slot], value.component);
    default: return read_joint(frame.joints[value.slot], value.component);
  }
}

bool Traces::has(const std::string& name) const {
  return std::any_of(traces_.begin(), traces_.end(), [&](const Trace& trace) { return trace.name == name; });
}

bool Traces::add(const std::string& name) {
  if (has(name) || traces_.size() >= kMost) return false;
  Trace trace;
  trace.name = name;
  trace.numbers.assign(times_.size(), std::numeric_limits<double>::quiet_NaN());
  traces_.push_back(std::move(trace));
  structure_version_ = 0;  // looked up with the next frame
  return true;
}

void Traces::remove(const std::string& name) {
  std::erase_if(traces_, [&](const Trace& trace) { return trace.name == name; });
  if (traces_.empty()) times_.clear();
}

void Traces::clear() {
  times_.clear();
  for (Trace& trace : traces_) trace.numbers.clear();
}

void Traces::take(const state::Frame& frame) {
  if (traces_.empty()) return;
  if (frame.structure->version != structure_version_) {
    structure_version_ = frame.structure->version;
    for (Trace& trace : traces_) trace.value = find_value(*frame.structure, trace.name);
  }
  if (frame.epoch != epoch_ && !paused_) {
    epoch_ = frame.epoch;
    if (!times_.empty() && frame.sim_time < times_.back()) clear();
  }
  if (paused_ || frame.sequence == sequence_ || (!times_.empty() && frame.sim_time <= times_.back())) return;
  sequence_ = frame.sequence;
  times_.push_back(frame.sim_time);
  for (Trace& trace : traces_) {
    trace.numbers.push_back(trace.value ? read_value(frame, *trace.value) : std::numeric_limits<double>::quiet_NaN());
  }
  while (times_.back() - times_.front() > kSeconds) {
    times_.pop_front();
    for (Trace& trace : traces_) trace.numbers.pop_front();
  }
}

std::string Traces::csv() const {
  std::string out = "time [s]";
  for (const Trace& trace : traces_) {
    out += ",\"" + trace.name;
    if (trace.value && *trace.value->unit != '\0') out += std::string(" [") + trace.value->unit + "]";
    out += "\"";
  }
  out += "\n";
  char number[40];
  for (std::size_t i = 0; i < times_.size(); ++i) {
    std::snprintf(number, sizeof number, "%.9g", times_[i]);
    out += number;
    for (const Trace& trace : traces_) {
      out += ",";
      if (std::isnan(trace.numbers[i])) continue;
      std::snprintf(number, sizeof number, "%.9g", trace.numbers[i]);
      out += number;
    }
    out += "\n";
  }
  return out;
}

}  // namespace ambf::render
