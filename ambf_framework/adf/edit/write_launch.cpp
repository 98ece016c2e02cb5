// Launch files of saved scenes.
#include <algorithm>

#include "adf/detail/exact_rpy.h"
#include "adf/detail/text_edit.h"
#include "adf/save.h"
#include "scene/keys.h"

namespace ambf::adf {

namespace {

std::string text_of(const math::Vec3& v, const char* const (&names)[3]) {
  const double numbers[] = {v.x, v.y, v.z};
  std::string text;
  for (int i = 0; i < 3; ++i)
    text += (i == 0 ? "{" : ", ") + std::string(names[i]) + ": " + scene::text_of(numbers[i] == 0.0 ? 0.0 : numbers[i]);
  return text + "}";
}

std::string text_of(const Placement& placed) {
  std::string text;
  if (!placed.name_prefix.empty()) text += "name prefix: " + as_scalar(placed.name_prefix);
  if (!(placed.T_world_model == math::Pose{}))
    text += (text.empty() ? "" : ", ") +
            ("location: {position: " + text_of(placed.T_world_model.position, {"x", "y", "z"}) +
             ", orientation: " + text_of(exact_rpy(placed.T_world_model.orientation), {"r", "p", "y"}) + "}");
  return "{" + text + "}";
}

}  // namespace

std::string write_launch(const std::string& world, const std::string& colors, const std::string& input_devices,
                         const std::vector<std::string>& models, const std::vector<Placement>& placements) {
  std::string all;
  for (std::size_t i = 0; i < models.size(); ++i) all += (i == 0 ? "" : ",") + std::to_string(i);
  std::string text = "# A saved scene. Start it: ambf_simulator --launch_file THIS FILE";
  text += (all.empty() ? "" : " -l " + all) + "\n";
  text += "world config: " + as_scalar(world) + "\n";
  if (!colors.empty()) text += "color config: " + as_scalar(colors) + "\n";
  if (!input_devices.empty()) text += "input devices config: " + as_scalar(input_devices) + "\n";
  text += models.empty() ? "multibody configs: []\n" : "multibody configs:\n";
  for (const std::string& model : models) text += "  - " + as_scalar(model) + "\n";
  const bool placed = std::any_of(placements.begin(), placements.end(), [](const Placement& placement) {
    return !placement.name_prefix.empty() || !(placement.T_world_model == math::Pose{});
  });
  if (placed) {
    text += "multibody placements:  # one for each of the models\n";
    for (const Placement& placement : placements) text += "  - " + text_of(placement) + "\n";
  }
  return text;
}

}  // namespace ambf::adf
