// Loading and unloading, saving, snapshots, and how the panel looks.
#include <algorithm>
#include <filesystem>

#include "render/panel/sections/sections.h"

namespace ambf::render {

namespace {

constexpr std::size_t kMaxCompletions = 12;

struct LoadDraft {
  std::string path, prefix;
  std::string completed;  // the path that `completions` belong to
  std::vector<std::string> completions;
};
struct SnapshotDraft {
  std::string name, file;
};

struct SaveDraft {
  std::string folder;       // of the scene
  std::string model, path;  // one model; the path that was last typed for it
  bool as_it_is_now = true, meshes = false, overwrite = false;
};

bool is_model(const std::filesystem::path& path) {
  const std::string extension = path.extension().string();
  return extension == ".yaml" || extension == ".yml" || extension == ".adf" || extension == ".urdf";
}

// Folders and files of models whose paths begin with what was typed.
std::vector<std::string> completions_of(const std::string& typed) {
  std::vector<std::string> found;
  const std::size_t slash = typed.rfind('/');
  const std::string folder = slash == std::string::npos ? "." : typed.substr(0, slash + 1);
  const std::string begin = slash == std::string::npos ? typed : typed.substr(slash + 1);
  std::error_code failed;
  for (const auto& entry : std::filesystem::directory_iterator(folder, failed)) {
    const std::string name = entry.path().filename().string();
    if (name.rfind(begin, 0) != 0 || (begin.empty() && name.front() == '.')) continue;
    std::error_code ignored;
    const bool is_folder = entry.is_directory(ignored);
    if (!is_folder && !is_model(entry.path())) continue;
    found.push_back((slash == std::string::npos ? std::string() : folder) + name + (is_folder ? "/" : ""));
  }
  std::sort(found.begin(), found.end());
  if (found.size() > kMaxCompletions) found.resize(kMaxCompletions);
  if (found.size() == 1 && found.front() == typed) found.clear();
  return found;
}

// The end of a path, short enough for a line of the panel: its name, with the slash of a folder.
std::string name_in(const std::string& path) {
  const std::size_t slash = path.size() < 2 ? std::string::npos : path.rfind('/', path.size() - 2);
  return slash == std::string::npos ? path : path.substr(slash + 1);
}

void draw_load(PanelScene& scene, LoadDraft& draft) {
  Ui& ui = scene.ui;
  PanelModel& model = scene.model;
  const float width = ImGui::GetContentRegionAvail().x - ImGui::CalcTextSize("Load").x - ui.points(28.0F);
  text_field(ui, "load/path", "Path of an ADF or URDF file, or drop it on the window", &draft.path, width / ui.scale);
  const bool entered = ImGui::IsItemDeactivated() && ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Enter), false);
  ImGui::SameLine();
  if ((button(ui, "load/go", "Load", !draft.path.empty()) || entered) && !draft.path.empty()) {
    model.edit.load(draft.path, draft.prefix);
  }
  text_field(ui, "load/prefix", "Namespace put before it (optional)", &draft.prefix);
  if (!draft.path.empty() && draft.completed != draft.path) {
    draft.completed = draft.path;
    draft.completions = completions_of(draft.path);
  }
  if (!draft.path.empty()) {
    for (const std::string& path : draft.completions) {
      if (ImGui::Selectable(name_in(path).c_str())) draft.path = path;
      note(ui, "load/complete/" + path);
      tool_tip(path.c_str());
    }
  } else if (!model.settings.recent_files.empty()) {
    ImGui::TextColored(ui.muted, "Recent");
    for (const std::string& path : model.settings.recent_files) {
      ImGui::PushID(path.c_str());
      if (ImGui::Selectable(name_in(path).c_str())) draft.path = path;
      ImGui::PopID();
      note(ui, "load/recent/" + path);
      tool_tip(path.c_str());
    }
  }
}

// `path` as a request takes it: a folder's ends in / where meshes are wanted, too.
state::SaveModelRequest request_of(const SaveDraft& draft, const std::string& model, std::string path) {
  while (path.size() > 1 && path.back() == '/') path.pop_back();
  if (draft.meshes && !path.empty()) path += "/";
  return {model, path, draft.as_it_is_now, draft.overwrite};
}

void draw_how(Ui& ui, SaveDraft& draft) {
  check_box(ui, "save/now", "As it is now", &draft.as_it_is_now);
  tool_tip("poses, joints, cameras, lights and changed values; else as it was read");
  ImGui::SameLine();
  check_box(ui, "save/meshes", "Meshes", &draft.meshes);
  tool_tip("copies meshes and textures into the folder, so that it can be moved anywhere");
  ImGui::SameLine();
  check_box(ui, "save/overwrite", "Overwrite", &draft.overwrite);
}

void draw_save(PanelScene& scene, SaveDraft& draft) {
  Ui& ui = scene.ui;
  const float width = ImGui::GetContentRegionAvail().x - ImGui::CalcTextSize("Save scene").x - ui.points(28.0F);
  text_field(ui, "save/folder", "Folder for the whole scene", &draft.folder, width / ui.scale);
  ImGui::SameLine();
  if (button(ui, "save/scene", "Save scene", !draft.folder.empty()))
    scene.model.edit.save(request_of(draft, "", draft.folder));
  tool_tip("a launch file, a world file and a file for each model; the simulator starts again from it");
  draw_how(ui, draft);
}

// Beneath the model whose Save was pressed.
void draw_save_model(PanelScene& scene, SaveDraft& draft) {
  Ui& ui = scene.ui;
  const float width = ImGui::GetContentRegionAvail().x - ImGui::CalcTextSize("Write").x - ui.points(28.0F);
  text_field(ui, "save/path", draft.meshes ? "Folder for the model and its meshes" : "File; empty: its own",
             &draft.path, width / ui.scale);
  ImGui::SameLine();
  if (button(ui, "save/model", "Write")) {
    scene.model.edit.save(request_of(draft, draft.model, draft.path));
    draft.model.clear();
  }
  tool_tip("with what is chosen beneath Save");
}

void draw_models(PanelScene& scene, SaveDraft& save) {
  Ui& ui = scene.ui;
  std::string gone;
  int shown = 0;
  for (const state::ModelInfo& loaded : scene.model.structure().models) {
    if (loaded.id == state::kWorldModel) continue;
    ++shown;
    ImGui::PushID(static_cast<int>(loaded.id));
    if (button(ui, "models/unload/" + loaded.name, "Unload")) gone = loaded.name;
    ImGui::SameLine();
    const bool has_text = !loaded.file.empty() || !loaded.environment;  // a walled ground has none
    if (button(ui, "models/save/" + loaded.name, "Save", has_text))
      save.model = save.model == loaded.name ? std::string() : loaded.name;
    ImGui::SameLine();
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted(loaded.name.c_str());
    tool_tip(loaded.file.c_str());
    if (save.model == loaded.name) draw_save_model(scene, save);
    ImGui::PopID();
  }
  if (shown == 0) ImGui::TextColored(ui.muted, "None");
  if (!gone.empty()) scene.model.edit.unload(gone);
}

void draw_snapshots(PanelScene& scene, SnapshotDraft& draft) {
  Ui& ui = scene.ui;
  if (button(ui, "snapshot/take", "Take")) scene.model.run.take_snapshot(draft.name, draft.file);
  tool_tip("the whole state, kept in memory, and in the file if one is named");
  ImGui::SameLine();
  const float half = (ImGui::GetContentRegionAvail().x - ImGui::GetStyle().ItemSpacing.x) * 0.5F / ui.scale;
  text_field(ui, "snapshot/name", "Name (optional)", &draft.name, half);
  ImGui::SameLine();
  text_field(ui, "snapshot/file", "File (optional)", &draft.file, half);
  if (!draft.file.empty() && button(ui, "snapshot/restore_file", "Restore from the file")) {
    scene.model.run.restore_snapshot("", draft.file);
  }
  const std::vector<std::string> names = scene.model.run.snapshots();
  for (const std::string& name : names) {
    if (button(ui, "snapshot/restore/" + name, "Restore")) scene.model.run.restore_snapshot(name, "");
    ImGui::SameLine();
    if (button(ui, "snapshot/forget/" + name, "Forget")) scene.model.run.forget_snapshot(name);
    tool_tip("lets it go; a file that was written stays");
    ImGui::SameLine();
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted(name.c_str());
  }
  if (names.empty()) ImGui::TextColored(ui.muted, "None was taken yet.");
}

class FilesTab final : public PanelTab {
 public:
  const char* name() const override { return "Files"; }
  void draw(PanelScene& scene) override;

 private:
  LoadDraft load_;
  SaveDraft save_;
  SnapshotDraft snapshot_;
};

void FilesTab::draw(PanelScene& scene) {
  Ui& ui = scene.ui;
  if (section(ui, "Load", true)) draw_load(scene, load_);
  if (section(ui, "Loaded models", true)) draw_models(scene, save_);
  if (section(ui, "Save", true)) draw_save(scene, save_);
  if (section(ui, "Snapshots", true)) draw_snapshots(scene, snapshot_);
  if (section(ui, "Reset", true)) {
    if (button(ui, "files/reset_bodies", "Bodies to where they started")) scene.model.run.reset_bodies();
    ImGui::SameLine();
    if (button(ui, "files/reset_world", "Whole world")) scene.model.run.reset_world();
  }
  if (section(ui, "Panel", true)) {
    bool light = !scene.model.settings.dark;
    if (check_box(ui, "panel/light", "Light colours", &light)) scene.model.settings.dark = !light;
  }
}

}  // namespace

std::unique_ptr<PanelTab> make_files_tab() { return std::make_unique<FilesTab>(); }

}  // namespace ambf::render
