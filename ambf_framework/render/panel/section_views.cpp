// The window's view: from where it looks, what it follows, what it shows beside the scene; cameras and lights.
#include "render/layers.h"
#include "render/panel/sections.h"
#include "render/panel/view_actions.h"
#include "render/view_camera.h"

namespace ambf::render {

namespace {

math::Pose parent_of(const ViewCamera& view) {
  return view.camera().T_world_camera * math::inverse(view.view().T_parent_camera);
}

// Where an object is as drawn; nothing for joints and models.
std::optional<math::Vec3> place_of(const PanelScene& scene, state::ObjectId id) {
  const state::Structure& all = scene.model.structure();
  const std::uint32_t object = state::find(all, id);
  if (object == state::kNone) return std::nullopt;
  const std::uint32_t slot = all.objects[object].slot;
  const ScenePoses& poses = *scene.moment.poses;
  switch (all.objects[object].kind) {
    case state::ObjectKind::rigid_body: return poses.bodies[slot] * all.bodies[slot].T_body_com.position;
    case state::ObjectKind::camera: return poses.cameras[slot].position;
    case state::ObjectKind::light: return poses.lights[slot].position;
    case state::ObjectKind::joint: return poses.bodies[all.joints[slot].parent_body] * all.joints[slot].pivot_parent;
    case state::ObjectKind::world: break;
  }
  return std::nullopt;
}

void draw_sides(PanelScene& scene) {
  Ui& ui = scene.ui;
  ViewCamera& view = *scene.moment.view;
  const float gap = ImGui::GetStyle().ItemInnerSpacing.x;
  for (std::size_t i = 0; i < kSideNames.size(); ++i) {
    if (i != 0 && i != 4) ImGui::SameLine(0.0F, gap);
    if (button(ui, std::string("view/") + kSideNames[i], kSideNames[i])) {
      view.move(seen_from(view.view(), parent_of(view), static_cast<Side>(i)), scene.moment.now_ns);
      view.rest();
    }
  }
}

void draw_view(PanelScene& scene) {
  Ui& ui = scene.ui;
  ViewCamera& view = *scene.moment.view;
  PanelDrafts& drafts = scene.drafts;
  draw_sides(scene);
  const std::optional<math::Vec3> place = place_of(scene, scene.model.selected());
  if (button(ui, "view/centre", "Centre on selected", place.has_value())) {
    view.move(centred_on(view.view(), parent_of(view), *place), scene.moment.now_ns);
    view.rest();
  }
  ImGui::SameLine();
  bool following = drafts.followed.valid();
  ImGui::BeginDisabled(!following && !place);
  if (check_box(ui, "view/follow", "Follow", &following)) {
    drafts.followed = following ? scene.model.selected() : state::ObjectId{};
    if (following) drafts.followed_at = *place;
  }
  ImGui::EndDisabled();
  if (drafts.followed.valid()) {
    const std::uint32_t object = state::find(scene.model.structure(), drafts.followed);
    if (object != state::kNone) tool_tip(scene.model.structure().objects[object].name.c_str());
  }
  ImGui::SameLine();
  if (button(ui, "view/copy", "Copy as ADF", static_cast<bool>(scene.host.set_clipboard))) {
    const state::CameraInfo& info = view.info();
    const std::uint32_t object = state::find(scene.model.structure(), view.object());
    const std::string name = object == state::kNone ? "my_camera" : scene.model.structure().objects[object].local_name;
    scene.host.set_clipboard(as_adf(name, view.view(), view.camera(), info.parent_name));
    scene.model.say("the camera's block is in the clipboard");
  }
  tool_tip("the keys of a camera block that looks as this window does, for pasting into a world file");
}

void draw_layers(PanelScene& scene) {
  Layers& layers = *scene.moment.layers;
  if (!ImGui::BeginTable("layers", 2)) return;
  for (const LayerSwitch& one : kLayerSwitches) {
    ImGui::TableNextColumn();
    check_box(scene.ui, "layer/" + std::string(one.label), std::string(one.label).c_str(), &(layers.*one.shown));
    tool_tip(std::string(one.text).c_str());
  }
  ImGui::EndTable();
}

}  // namespace

void follow(PanelScene& scene) {
  PanelDrafts& drafts = scene.drafts;
  if (!drafts.followed.valid() || scene.moment.view == nullptr) return;
  const std::optional<math::Vec3> place = place_of(scene, drafts.followed);
  if (!place) {
    drafts.followed = {};
    return;
  }
  const math::Vec3 shift = *place - drafts.followed_at;
  drafts.followed_at = *place;
  if (math::norm(shift) < 1e-6) return;
  ViewCamera& view = *scene.moment.view;
  view.move(shifted(view.view(), parent_of(view), shift), scene.moment.now_ns);
}

void draw_views(PanelScene& scene) {
  Ui& ui = scene.ui;
  if (scene.moment.view != nullptr && section(ui, "This view", true)) draw_view(scene);
  if (section(ui, "Show", true)) draw_layers(scene);
  const state::Structure& all = scene.model.structure();
  const auto list = [&](const char* title, const auto& infos) {
    if (!section(ui, title, true)) return;
    if (infos.empty()) ImGui::TextColored(ui.muted, "None");
    for (const auto& info : infos) {
      const state::ObjectInfo& object = all.objects[info.object];
      if (ImGui::Selectable(object.local_name.c_str(), scene.model.selected() == object.id)) {
        scene.model.select(object.id);
      }
      note(ui, "view/object/" + object.name);
      tool_tip(object.name.c_str());
    }
  };
  list("Cameras", all.cameras);
  list("Lights", all.lights);
}

}  // namespace ambf::render
