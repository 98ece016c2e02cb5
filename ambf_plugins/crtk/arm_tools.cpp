// ArmControl: the tool at the end of the arm.
#include <algorithm>
#include <cmath>

#include "crtk/arm_control.h"

namespace ambf::crtk {

namespace {

constexpr double kRests = 2e-3;  // rad/s, m/s: slower is no motion that a new instrument would jump by

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

std::optional<std::string> ArmControl::take_exchange() {
  if (!exchanging() || exchange_taken_) return std::nullopt;
  exchange_taken_ = true;
  return next_tool_;
}

bool ArmControl::may_exchange() const {
  if (state_ == OperatingState::fault) return true;
  const bool holds = state_ == OperatingState::disabled && !arm_.brakes;
  if (!holds && (measured_.motion.note & kKeepsOthers) == 0) return false;
  return std::all_of(measured_.velocity.begin(), measured_.velocity.end(),
                     [](double velocity) { return std::abs(velocity) < kRests; });
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
