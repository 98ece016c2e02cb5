// The parameters of cameras and lights, as values that are compared, read from and written to ROS's parameter server. Pure data and
// functions; any thread. Private to ros_comm. C++17.
#pragma once

#include <map>
#include <string>
#include <variant>

#include "state/frame.h"

namespace ambf::ros_comm {

// near_plane, projection, ...: numbers and words.
using Parameter = std::variant<double, std::string>;
using Parameters = std::map<std::string, Parameter>;

// All that the object in this slot has, as `frame` tells it; `kind` is camera or light.
Parameters parameters_of(const state::Frame& frame, state::ObjectKind kind, std::uint32_t slot);

// Whether two values mean the same; numbers to what survives being written as text.
bool same(const Parameter& a, const Parameter& b);

inline constexpr const char* kParentName = "parent_name";

// Brings what was `changed` into lens or beam (the parent is not part of them). Empty, or why that cannot be; then nothing is changed.
// `width_m`: of an orthographic view that was never given one.
std::string change(state::Lens& lens, const Parameters& changed, double width_m);
std::string change(state::Beam& beam, const Parameters& changed);

}  // namespace ambf::ros_comm
