// ArmControl: the tool at the end of the arm.
#include <algorithm>
#include <cmath>

#include "crtk/arm_control.h"

namespace ambf::crtk {

namespace {

constexpr double kRests = 2e-3;  // rad/s, m/s: slower is no motion that a new instrument would be left behind by

}  // namespace

const kinematics::Arm* ArmControl::find_tool(const std::string& name) const {
  const auto found = std::find_if(arm_.tools.begin(), arm_.tools.end(),
                                  [&](const kinematics::Arm& tool) { return tool.tool == name; });
  return found == arm_.tools.end() ? nullptr : &*found;
}

void ArmControl::keep_place() {
  end_arm_move(), end_jaw_move();
  if (state_ != OperatingState::enabled && state_ != OperatingState::paused) return;
  goal_follows_ = true;
  way_ = Way::position;
  order_arm(Mode::hold);
}

void ArmControl::use_tool(const kinematics::Arm& tool) {
  keep_place();
  arm_.kinematics = tool;
}

std::string ArmControl::set_tool_type(const std::string& name) {
  const kinematics::Arm* tool = find_tool(name);
  if (tool == nullptr) {
    std::string known;
    for (const kinematics::Arm& each : arm_.tools) known += (known.empty() ? "" : ", ") + each.tool;
    report(Event::Kind::tool_request, {});
    return refuse("set_tool_type", "there is no tool '" + name.substr(0, 60) + "'; known: " + known);
  }
  if (exchanging()) return refuse("set_tool_type", "its tool is being exchanged");
  const bool there = tool->tool == arm_.kinematics.tool && state_ != OperatingState::fault;
  const bool has_instrument = std::any_of(arm_.instruments.begin(), arm_.instruments.end(),
                                          [&](const adf::CrtkInstrument& each) { return each.tool == name; });
  if (has_instrument && !there) {
    keep_place();
    if (arm_.has_jaw() && (state_ == OperatingState::enabled || state_ == OperatingState::paused)) {
      jaw_effort_.reset();
      order_jaw(Mode::hold);
    }
    next_tool_ = name;
    exchange_taken_ = false;
    ++exchange_number_;
    tell_state();
    return {};
  }
  if (!there) use_tool(*tool);
  if (!there && !arm_.instruments.empty()) {
    warn("the model keeps its instrument: the arm's description has no file of " + name + " in `instruments`");
  }
  report(Event::Kind::tool, name);
  return {};
}

std::optional<ArmControl::Exchange> ArmControl::take_exchange() {
  if (!exchanging() || exchange_taken_) return std::nullopt;
  exchange_taken_ = true;
  return Exchange{next_tool_, exchange_number_};
}

// Each instrument brings the same joints.
bool ArmControl::goes_with_instrument(std::size_t joint) const {
  const auto& named = arm_.kinematics.adf_joints;
  const auto& halves = arm_.kinematics.adf_jaw;
  if (arm_.instruments.empty() || (joint >= named.size() && halves.empty())) return false;
  const std::vector<std::string>& brought = arm_.instruments.front().joints;
  const std::string& name = joint < named.size() ? named[joint].name : halves.front().name;
  return std::find(brought.begin(), brought.end(), name) != brought.end();
}

bool ArmControl::may_exchange() const {
  // A world that stands obeys what it has been sent before it moves again.
  if (state_ == OperatingState::fault || measured_.stands) return true;
  const bool holds = state_ == OperatingState::disabled && !arm_.brakes;
  if (!holds && (measured_.motion.note & kKeepsOthers) == 0) return false;
  for (std::size_t i = 0; i < size(); ++i) {
    if (!goes_with_instrument(i) && std::abs(measured_.velocity[i]) >= kRests) return false;
  }
  return true;
}

// Its limits may be narrower: the set-points go there at once, as the model's joints did.
void ArmControl::exchanged() {
  const kinematics::Arm* tool = find_tool(next_tool_);
  next_tool_.clear();
  if (tool == nullptr) return;
  const bool holds = state_ == OperatingState::enabled || state_ == OperatingState::paused;
  const Joints position = set_position();
  const double opening = arm_.has_jaw() ? jaw_position() : 0.0;
  arm_.kinematics = *tool;
  if (holds) {
    for (std::size_t i = 0; i < size(); ++i) {
      command_.values[i] = std::clamp(position[i], tool->lower[i], tool->upper[i]);
    }
    order_arm(Mode::position);
    if (arm_.has_jaw()) {
      command_.values[size()] = std::clamp(opening, tool->jaw->lower, tool->jaw->upper);
      order_jaw(Mode::position);
    }
  }
  report(Event::Kind::tool, tool->tool);
  tell_state();
}

void ArmControl::not_exchanged(const std::string& reason) {
  const std::string tool = next_tool_;
  next_tool_.clear();
  warn("the tool was not exchanged for " + tool + ": " + reason);
  report(Event::Kind::tool, arm_.kinematics.tool);
  tell_state();
}

// NONE: the arm's flange is where a straight endoscope's tip is.
std::string ArmControl::set_endoscope_type(const std::string& type) {
  static const std::vector<std::string> kTypes = {"NONE",        "SD_STRAIGHT", "SD_UP",  "SD_DOWN",
                                                  "HD_STRAIGHT", "HD_UP",       "HD_DOWN"};
  if (std::find(kTypes.begin(), kTypes.end(), type) == kTypes.end()) {
    return refuse(
        "set_endoscope_type",
        "'" + type.substr(0, 60) + "' is none of NONE, SD_STRAIGHT, SD_UP, SD_DOWN, HD_STRAIGHT, HD_UP, HD_DOWN");
  }
  const std::string name = type == "NONE" ? "STRAIGHT" : type.substr(3);
  const kinematics::Arm* tool = find_tool(name);
  if (tool == nullptr) return refuse("set_endoscope_type", "the kinematics have no tool " + name);
  if (tool->tool != arm_.kinematics.tool) use_tool(*tool);
  endoscope_ = type;
  report(Event::Kind::endoscope, type);
  return {};
}

}  // namespace ambf::crtk
