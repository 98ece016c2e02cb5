// How this window shows the selected body: hidden, as a wireframe, see-through.
#include <cmath>

#include "render/panel/sections/sections.h"
#include "render/scene/body_looks.h"

namespace ambf::render {

namespace {

void look_alike(const state::Structure& all, const state::ObjectInfo& body, BodyLooks& looks) {
  const BodyLook look = looks.of(body.id);
  for (const state::BodyInfo& other : all.bodies) {
    const state::ObjectInfo& object = all.objects[other.object];
    if (object.model == body.model) looks.set(object.id, look);
  }
}

}  // namespace

void draw_look(PanelScene& scene, const state::ObjectInfo& body) {
  if (scene.moment.shows.looks == nullptr) return;
  Ui& ui = scene.ui;
  BodyLooks& looks = *scene.moment.shows.looks;
  if (!section(ui, "Look in this window", true) || !begin_rows("look")) return;
  BodyLook look = looks.of(body.id);
  row(ui, "Show");
  bool shown = !look.hidden;
  if (check_box(ui, "look/shown", "Visible", &shown)) look.hidden = !shown;
  ImGui::SameLine();
  check_box(ui, "look/wireframe", "Wireframe", &look.wireframe);
  tool_tip("edges instead of faces");
  row(ui, "Opacity");
  float percent = 100.0F * look.opacity;
  ImGui::SetNextItemWidth(-1.0F);
  ImGui::SliderFloat("##look/opacity", &percent, 0.0F, 100.0F, "%.0f %%", ImGuiSliderFlags_AlwaysClamp);
  note(ui, "look/opacity");
  look.opacity = std::round(percent) / 100.0F;
  looks.set(body.id, look);
  row(ui, "");
  if (button(ui, "look/model", "Same for its model")) look_alike(scene.model.structure(), body, looks);
  tool_tip("all bodies that were loaded with it look like this one");
  ImGui::SameLine();
  if (button(ui, "look/revert", "All as loaded", looks.any())) looks.clear();
  tool_tip("all bodies, in this window");
  end_rows();
}

}  // namespace ambf::render
