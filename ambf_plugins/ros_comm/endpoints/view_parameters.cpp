#include "ros_comm/endpoints/view_parameters.h"

#include <algorithm>
#include <cmath>

namespace ambf::ros_comm {

namespace {

struct LensNumber {
  const char* name;
  double state::Lens::*value;
};
constexpr LensNumber kLensNumbers[] = {
    {"near_plane", &state::Lens::near_m},
    {"far_plane", &state::Lens::far_m},
    {"field_view_angle", &state::Lens::field_of_view_rad},
    {"orthographic_view_width", &state::Lens::orthographic_width_m},
    {"stereo_eye_separation", &state::Lens::eye_separation_m},
    {"stereo_focal_length", &state::Lens::focal_length_m},
};
constexpr const char *kProjection = "projection", *kMode = "mode", *kType = "type", *kCutoff = "cutoff_angle";
constexpr const char *kPerspective = "PERSPECTIVE", *kOrthographic = "ORTHOGRAPHIC";
constexpr const char *kMono = "MONO", *kStereo = "STEREO";
constexpr const char* kLightTypes[] = {"SPOT", "POINT", "DIRECTIONAL"};  // in the order of state::LightType

const Parameter* find(const Parameters& all, const char* name) {
  const auto found = all.find(name);
  return found != all.end() ? &found->second : nullptr;
}

// One of two words, if it is given.
std::string choose(const Parameters& changed, const char* name, const char* no, const char* yes, bool& value) {
  const Parameter* given = find(changed, name);
  if (given == nullptr) return {};
  const auto* word = std::get_if<std::string>(given);
  if (word == nullptr || (*word != no && *word != yes)) return std::string(name) + " must be " + no + " or " + yes;
  value = *word == yes;
  return {};
}

std::string number(const Parameters& changed, const char* name, double& value) {
  const Parameter* given = find(changed, name);
  if (given == nullptr) return {};
  const auto* got = std::get_if<double>(given);
  if (got == nullptr) return std::string(name) + " must be a number";
  value = *got;
  return {};
}

}  // namespace

Parameters parameters_of(const state::Frame& frame, state::ObjectKind kind, std::uint32_t slot) {
  Parameters out;
  if (kind == state::ObjectKind::camera) {
    const state::Lens& lens = frame.cameras[slot].lens;
    for (const LensNumber& each : kLensNumbers) out[each.name] = lens.*each.value;
    out[kProjection] = std::string(lens.orthographic ? kOrthographic : kPerspective);
    out[kMode] = std::string(lens.stereo ? kStereo : kMono);
    out[kParentName] = frame.structure->cameras[slot].parent_name;
  } else {
    const state::Beam& beam = frame.lights[slot].beam;
    out[kCutoff] = beam.cutoff_angle_rad;
    out[kType] = std::string(kLightTypes[static_cast<int>(beam.type)]);
    out[kParentName] = frame.structure->lights[slot].parent_name;
  }
  return out;
}

bool same(const Parameter& a, const Parameter& b) {
  const auto *x = std::get_if<double>(&a), *y = std::get_if<double>(&b);
  if (x == nullptr || y == nullptr) return a == b;
  return std::abs(*x - *y) <= 1e-9 * std::max({1.0, std::abs(*x), std::abs(*y)});
}

std::string change(state::Lens& lens, const Parameters& changed, double width_m) {
  state::Lens wanted = lens;
  for (const LensNumber& each : kLensNumbers) {
    if (std::string why = number(changed, each.name, wanted.*each.value); !why.empty()) return why;
  }
  if (std::string why = choose(changed, kProjection, kPerspective, kOrthographic, wanted.orthographic); !why.empty())
    return why;
  if (std::string why = choose(changed, kMode, kMono, kStereo, wanted.stereo); !why.empty()) return why;
  if (wanted.orthographic && wanted.orthographic_width_m == 0.0) wanted.orthographic_width_m = width_m;
  if (std::string why = state::check(wanted); !why.empty()) return why;
  lens = wanted;
  return {};
}

std::string change(state::Beam& beam, const Parameters& changed) {
  state::Beam wanted = beam;
  if (std::string why = number(changed, kCutoff, wanted.cutoff_angle_rad); !why.empty()) return why;
  if (const Parameter* given = find(changed, kType)) {
    const auto* word = std::get_if<std::string>(given);
    const auto* known =
        word == nullptr ? std::end(kLightTypes) : std::find(std::begin(kLightTypes), std::end(kLightTypes), *word);
    if (known == std::end(kLightTypes)) return std::string(kType) + " must be SPOT, POINT or DIRECTIONAL";
    wanted.type = static_cast<state::LightType>(known - std::begin(kLightTypes));
  }
  if (std::string why = state::check(wanted); !why.empty()) return why;
  beam = wanted;
  return {};
}

}  // namespace ambf::ros_comm
