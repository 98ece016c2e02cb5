// How a camera sees and how a light shines.
#include <algorithm>
#include <array>
#include <cstdio>
#include <numbers>
#include <string>

#include "render/panel/sections/sections.h"

namespace ambf::render {

namespace {

constexpr double kDegrees = 180.0 / std::numbers::pi;

bool degrees_field(Ui& ui, const std::string& name, double* radians, double most) {
  double shown = *radians * kDegrees;
  if (!number_field(ui, name, &shown, 0.1, most, "%.4g \u00b0", 110.0F)) return false;
  *radians = shown / kDegrees;
  return true;
}

std::string millimetres(double metres) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.4g mm", 1e3 * metres);
  return text.data();
}

std::string stereo_message(const state::Lens& lens) {
  if (!lens.stereo) return "stereo off: one picture";
  return "stereo: both eyes side by side, " + millimetres(lens.eye_separation_m) + " apart; what is " +
         millimetres(lens.focal_length_m) + " away is in the same place of both";
}

}  // namespace

void draw_lens(PanelScene& scene, const state::ObjectInfo& camera) {
  Ui& ui = scene.ui;
  const state::Lens& loaded = scene.model.structure().cameras[camera.slot].lens;
  state::Lens lens = scene.model.frame().cameras[camera.slot].lens;
  const bool changed = !(lens == loaded);
  if (!section(ui, "Lens", true) || !begin_rows("lens")) return;
  bool edited = false;
  row(ui, "Orthographic");
  if (check_box(ui, "lens/orthographic", "", &lens.orthographic)) {
    edited = true;
    if (lens.orthographic_width_m <= 0.0) lens.orthographic_width_m = 1.0;
  }
  if (lens.orthographic) {
    row(ui, "Width");
    edited |= number_field(ui, "lens/width", &lens.orthographic_width_m, 1e-4, 1e4, "%.4g m", 110.0F);
  } else {
    row(ui, "Field of view");
    edited |= degrees_field(ui, "lens/field", &lens.field_of_view_rad, 170.0);
  }
  if (!lens.orthographic && !(lens.optics == state::Optics{})) {
    text_row(ui, "Focal lengths", "fx = %.4g fy", lens.optics.focal_ratio);
    text_row(ui, "Axis", "%.3g %% right, %.3g %% down", 100.0 * lens.optics.axis_right, 100.0 * lens.optics.axis_down);
    tool_tip("from the picture's middle, of its height; as the file's intrinsics say");
  }
  row(ui, "Near");
  edited |= number_field(ui, "lens/near", &lens.near_m, 1e-5, 1e5, "%.4g m", 110.0F);
  row(ui, "Far");
  edited |= number_field(ui, "lens/far", &lens.far_m, 1e-4, 1e6, "%.4g m", 110.0F);
  row(ui, "Stereo");
  if (check_box(ui, "lens/stereo", "", &lens.stereo)) {
    edited = true;
    scene.model.say(stereo_message(lens));
  }
  if (lens.stereo) {
    row(ui, "Eyes apart");
    edited |= number_field(ui, "lens/eyes", &lens.eye_separation_m, 0.0, 10.0, "%.4g m", 110.0F);
    row(ui, "Both see at");
    edited |= number_field(ui, "lens/focus", &lens.focal_length_m, 1e-3, 1e4, "%.4g m", 110.0F);
  }
  end_rows();
  if (edited) scene.model.tune.set_lens(camera.id, lens);
  if (changed && button(ui, "lens/revert", "Back to what was loaded")) scene.model.tune.set_lens(camera.id, loaded);
}

void draw_beam(PanelScene& scene, const state::ObjectInfo& light) {
  Ui& ui = scene.ui;
  const state::Beam& loaded = scene.model.structure().lights[light.slot].beam;
  state::Beam beam = scene.model.frame().lights[light.slot].beam;
  const bool changed = !(beam == loaded);
  if (!section(ui, "Beam", true) || !begin_rows("beam")) return;
  bool edited = false;
  constexpr const char* kTypes[] = {"Spot", "Point", "Directional"};
  int type = static_cast<int>(beam.type);
  row(ui, "Kind");
  ImGui::SetNextItemWidth(ui.points(130.0F));
  if (ImGui::Combo("##beam/type", &type, kTypes, 3)) {
    beam.type = static_cast<state::LightType>(type);
    edited = true;
  }
  note(ui, "beam/type");
  if (beam.type == state::LightType::spot) {
    row(ui, "Cone");
    edited |= degrees_field(ui, "beam/cone", &beam.cutoff_angle_rad, 89.0);
    row(ui, "Exponent");
    edited |= number_field(ui, "beam/exponent", &beam.spot_exponent, 0.0, 1000.0, "%.4g", 110.0F);
  }
  row(ui, "Attenuation");
  math::Vec3 attenuation{beam.attenuation_constant, beam.attenuation_linear, beam.attenuation_quadratic};
  if (vector_field(ui, "beam/attenuation", &attenuation, 0.0, 1e6, "%.3g")) {
    beam.attenuation_constant = attenuation.x;
    beam.attenuation_linear = attenuation.y;
    beam.attenuation_quadratic = attenuation.z;
    edited = true;
  }
  tool_tip("constant, linear (1/m) and quadratic (1/m\u00b2)");
  row(ui, "Shadow");
  int quality = beam.shadow_quality;
  ImGui::SetNextItemWidth(ui.points(130.0F));
  if (ImGui::SliderInt("##beam/shadow", &quality, 0, 5, quality == 0 ? "none" : "quality %d")) {
    beam.shadow_quality = quality;
    edited = true;
  }
  note(ui, "beam/shadow");
  end_rows();
  if (edited) scene.model.tune.set_beam(light.id, beam);
  if (changed && button(ui, "beam/revert", "Back to what was loaded")) scene.model.tune.set_beam(light.id, loaded);
}

}  // namespace ambf::render
