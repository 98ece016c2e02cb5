// The window's view: from where it looks, what it follows, what it shows beside the scene; cameras and lights.
#include <cmath>
#include <numbers>

#include "render/marks/layers.h"
#include "render/navigation/view_camera.h"
#include "render/panel/kinds/panel_kinds.h"
#include "render/panel/sections/sections.h"
#include "render/panel/view_actions.h"
#include "render/window/measure.h"
#include "render/window/window_recorder.h"

namespace ambf::render {

namespace {

math::Pose parent_of(const ViewCamera& view) {
  return view.camera().T_world_camera * math::inverse(view.view().T_parent_camera);
}

// The point of an object that the view centres on; none when it is gone.
std::optional<math::Vec3> place_of(const PanelScene& scene, state::ObjectId id) {
  const state::Structure& all = scene.model.structure();
  const std::uint32_t object = state::find(all, id);
  if (object == state::kNone) return std::nullopt;
  return drawn_centre(*scene.moment.poses, all, all.objects[object]);
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

// What the window's view follows.
struct Followed {
  state::ObjectId object;  // invalid: nothing
  math::Vec3 at;           // in the last picture
};

void draw_view(PanelScene& scene, Followed& followed) {
  Ui& ui = scene.ui;
  ViewCamera& view = *scene.moment.view;
  draw_sides(scene);
  const std::optional<math::Vec3> place = place_of(scene, scene.model.selection.id());
  if (button(ui, "view/centre", "Centre on selected", place.has_value())) {
    view.move(centred_on(view.view(), parent_of(view), *place), scene.moment.now_ns);
    view.rest();
  }
  ImGui::SameLine();
  bool following = followed.object.valid();
  ImGui::BeginDisabled(!following && !place);
  if (check_box(ui, "view/follow", "Follow", &following)) {
    followed.object = following ? scene.model.selection.id() : state::ObjectId{};
    if (following) followed.at = *place;
  }
  ImGui::EndDisabled();
  if (followed.object.valid()) {
    const std::uint32_t object = state::find(scene.model.structure(), followed.object);
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

constexpr const char* kOwnView = "Free view";

std::string name_of_view(const state::Structure& all, state::ObjectId camera) {
  const std::uint32_t object = state::find(all, camera);
  return object == state::kNone ? kOwnView : all.objects[object].local_name;
}

void draw_chosen_camera(PanelScene& scene) {
  Ui& ui = scene.ui;
  const state::Structure& all = scene.model.structure();
  const state::ObjectId now = scene.moment.view->object();
  if (scene.moment.choices.set_camera == nullptr || !begin_rows("camera")) return;
  row(ui, "Through");
  ImGui::SetNextItemWidth(-1.0F);
  const bool shown = ImGui::BeginCombo("##view/camera", name_of_view(all, now).c_str());
  note(ui, "view/camera");
  if (shown) {
    const auto choice = [&](state::ObjectId camera, const std::string& name) {
      ImGui::PushID(static_cast<int>(camera.index));
      if (ImGui::Selectable(name_of_view(all, camera).c_str(), camera == now))
        *scene.moment.choices.set_camera = camera;
      note(ui, "view/camera/" + name);
      if (camera.valid()) tool_tip(name.c_str());
      ImGui::PopID();
    };
    for (const state::CameraInfo& info : all.cameras)
      choice(all.objects[info.object].id, all.objects[info.object].name);
    choice({}, kOwnView);
    ImGui::EndCombo();
  }
  tool_tip(
      "the camera that this window looks through, and that its mouse moves; a free view belongs to the window alone");
  end_rows();
}

void draw_data_recording(PanelScene& scene, DataRecording& recording) {
  Ui& ui = scene.ui;
  const DataRecording::State state = recording.state();
  const std::string missing = recording.unavailable();
  const bool idle = state == DataRecording::State::idle, running = state == DataRecording::State::running;
  const char* label = idle ? "Record data" : running ? "End the recording" : "Completing the bag";
  if (button(ui, "record/data", label, missing.empty() && (idle || running))) {
    scene.model.toggle_recording();
  }
  tool_tip(missing.empty() ? "states, commands and rates of everything, to a bag (Ctrl+Shift+B)" : missing.c_str());
  if (idle) return;
  ImGui::SameLine();
  ImGui::TextColored(ui.bad, "%.1f s", recording.running_s());
  note(ui, "record/time");
  tool_tip(recording.file().c_str());
}

void draw_pictures(PanelScene& scene) {
  Ui& ui = scene.ui;
  PanelModel& model = scene.model;
  WindowRecorder& recorder = *scene.moment.recorder;
  if (button(ui, "pictures/screenshot", "Screenshot")) recorder.take_screenshot(model.settings.picture_folder);
  tool_tip("of what this window shows, without panel and labels (Ctrl+S)");
  ImGui::SameLine();
  const bool filming = recorder.filming();
  if (button(ui, "pictures/film", filming ? "End the film" : "Film")) {
    filming ? recorder.stop_film() : recorder.start_film(model.settings.picture_folder);
  }
  tool_tip("30 pictures a simulated second, to a file (Ctrl+Shift+S)");
  if (filming) {
    ImGui::SameLine();
    ImGui::TextColored(ui.bad, "%.1f s", recorder.film_s());
    note(ui, "pictures/filmed");
  }
  if (model.recording() != nullptr) draw_data_recording(scene, *model.recording());
  text_field(ui, "pictures/folder", "Folder (where the program was started)", &model.settings.picture_folder);
}

// At the right of a camera's line.
void draw_go_to(PanelScene& scene, const state::ObjectInfo& camera) {
  if (scene.moment.view == nullptr || scene.moment.view->object() == camera.id) return;
  Ui& ui = scene.ui;
  ViewCamera& view = *scene.moment.view;
  const float width = ImGui::GetFrameHeight() * 1.15F;
  ImGui::SameLine(ImGui::GetWindowContentRegionMax().x - width);
  if (icon_button(ui, "view/go/" + camera.name, Icon::target, "Move this view to where that camera is")) {
    const math::Pose* T_world_camera = scene.moment.poses->of(camera);
    if (T_world_camera == nullptr) return;
    view.move(moved_to(view.view(), parent_of(view), *T_world_camera), scene.moment.now_ns);
    view.rest();
  }
}

void draw_measure(PanelScene& scene) {
  Ui& ui = scene.ui;
  Measure& measure = *scene.moment.shows.measure;
  if (button(ui, "measure/on", measure.on() ? "End measuring" : "Measure")) measure.set_on(!measure.on());
  tool_tip("distances and angles between points that are clicked in the scene (Shift+D)");
  const std::vector<math::Vec3> at = measure.points(scene.model.structure(), *scene.moment.poses);
  if (at.size() < 2 || !begin_rows("measure")) return;
  for (std::size_t i = 1; i < at.size(); ++i) {
    const math::Vec3 way = at[i] - at[i - 1];
    text_row(ui, i == 1 ? "First to second" : "Second to third", "%s", Measure::distance_text(math::norm(way)).c_str());
    note(ui, "measure/distance/" + std::to_string(i));
    vector_row(ui, "along x y z", way, "%.4f", "m");
  }
  if (at.size() == 3) {
    text_row(ui, "Angle", "%.2f \u00b0", Measure::angle_rad(at[0], at[1], at[2]) * 180.0 / std::numbers::pi);
    note(ui, "measure/angle");
  }
  end_rows();
}

void draw_layers(PanelScene& scene) {
  Layers& layers = *scene.moment.shows.layers;
  if (!ImGui::BeginTable("layers", 2)) return;
  for (std::size_t i = 0; i < all_layers().size(); ++i) {
    const LayerInfo& info = all_layers()[i];
    bool shown = layers.shows(static_cast<LayerId>(i));
    ImGui::TableNextColumn();
    if (check_box(scene.ui, "layer/" + info.label, info.label.c_str(), &shown)) layers.toggle(static_cast<LayerId>(i));
    tool_tip(info.text.c_str());
  }
  ImGui::EndTable();
}

class ViewsTab final : public PanelTab {
 public:
  const char* name() const override { return "View"; }
  void draw(PanelScene& scene) override;
  void observe(PanelScene& scene) override;  // keeps the view on the object that it follows

 private:
  Followed followed_;
};

void ViewsTab::observe(PanelScene& scene) {
  if (!followed_.object.valid() || scene.moment.view == nullptr) return;
  const std::optional<math::Vec3> place = place_of(scene, followed_.object);
  if (!place) {
    followed_ = {};
    return;
  }
  const math::Vec3 shift = *place - followed_.at;
  followed_.at = *place;
  if (math::norm(shift) < 1e-6) return;
  ViewCamera& view = *scene.moment.view;
  view.move(shifted(view.view(), parent_of(view), shift), scene.moment.now_ns);
}

void ViewsTab::draw(PanelScene& scene) {
  Ui& ui = scene.ui;
  if (scene.moment.view != nullptr && section(ui, "This view", true)) {
    draw_chosen_camera(scene);
    draw_view(scene, followed_);
  }
  if (section(ui, "Show", true)) draw_layers(scene);
  if (scene.moment.shows.measure != nullptr && section(ui, "Measuring", true)) draw_measure(scene);
  if (scene.moment.recorder != nullptr && section(ui, "Pictures and recording", true)) draw_pictures(scene);
  const state::Structure& all = scene.model.structure();
  const auto list = [&](const char* title, const auto& infos, bool cameras) {
    if (!section(ui, title, true)) return;
    if (infos.empty()) ImGui::TextColored(ui.muted, "None");
    for (const auto& info : infos) {
      const state::ObjectInfo& object = all.objects[info.object];
      ImGui::PushID(static_cast<int>(info.object));
      ImGui::AlignTextToFramePadding();
      if (ImGui::Selectable(object.local_name.c_str(), scene.model.selection.id() == object.id,
                            ImGuiSelectableFlags_AllowItemOverlap)) {
        scene.model.selection.select(object.id);
      }
      note(ui, "view/object/" + object.name);
      tool_tip(object.name.c_str());
      if (cameras) draw_go_to(scene, object);
      ImGui::PopID();
    }
  };
  list("Cameras", all.cameras, true);
  list("Lights", all.lights, false);
}

}  // namespace

std::unique_ptr<PanelTab> make_views_tab() { return std::make_unique<ViewsTab>(); }

state::ObjectId next_camera(const state::Structure& structure, state::ObjectId now) {
  std::size_t next = 0;
  for (std::size_t i = 0; i < structure.cameras.size(); ++i) {
    if (structure.objects[structure.cameras[i].object].id == now) next = i + 1;
  }
  if (next >= structure.cameras.size()) return {};
  return structure.objects[structure.cameras[next].object].id;
}

}  // namespace ambf::render
