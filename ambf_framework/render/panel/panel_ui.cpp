#include "render/panel/panel_ui.h"

#include <algorithm>
#include <cmath>
#include <deque>

#include "render/panel/detail/panel_renderer.h"
#include "render/panel/detail/ui_inputs.h"
#include "render/panel/sections/sections.h"
#include "render/panel/ui.h"
#include "render/text/detail/fonts.h"
#include "render/window/window_part.h"

namespace ambf::render {

namespace {

constexpr float kFont_points = 14.5F;
constexpr float kUsualWidth_points = 400.0F, kLeastWidth_points = 300.0F;
constexpr float kMostOfWindow = 0.75F;
constexpr float kEdge_points = 5.0F;  // of the panel, where it is dragged wider

struct Tab {
  const char* name;
  void (*draw)(PanelScene&);
};
constexpr Tab kTabs[] = {{"Objects", draw_objects}, {"Joints", draw_joints}, {"View", draw_views},
                         {"Physics", draw_physics}, {"Plots", draw_plots},   {"Log", draw_messages},
                         {"Files", draw_files}};
constexpr int kTabCount = static_cast<int>(std::size(kTabs));

}  // namespace

struct PanelUi::Impl {
  Impl(PanelModel& panel_model, PanelHost panel_host) : model(panel_model), host(std::move(panel_host)) {
    context = ImGui::CreateContext();
    const Use use(*this);
    ImGuiIO& io = ImGui::GetIO();
    io.IniFilename = nullptr;  // settings.h remembers
    io.LogFilename = nullptr;
    io.ConfigFlags |= ImGuiConfigFlags_NavEnableKeyboard;
    io.ConfigWindowsMoveFromTitleBarOnly = true;
    for (int key = 0; key < ImGuiKey_COUNT; ++key) io.KeyMap[key] = key;
    io.ClipboardUserData = this;
    io.SetClipboardTextFn = [](void* self, const char* text) {
      auto& impl = *static_cast<Impl*>(self);
      if (impl.host.set_clipboard) impl.host.set_clipboard(text);
    };
    io.GetClipboardTextFn = [](void* self) -> const char* {
      auto& impl = *static_cast<Impl*>(self);
      impl.pasted = impl.host.clipboard ? impl.host.clipboard() : std::string();
      return impl.pasted.c_str();
    };
  }
  ~Impl() { ImGui::DestroyContext(context); }

  // Dear ImGui works on a current context; nobody else's is disturbed.
  struct Use {
    explicit Use(Impl& impl) : before(ImGui::GetCurrentContext()) { ImGui::SetCurrentContext(impl.context); }
    ~Use() { ImGui::SetCurrentContext(before); }
    Use(const Use&) = delete;
    Use& operator=(const Use&) = delete;
    ImGuiContext* before;
  };

  bool inside(double x, double y) const;
  bool take(const WindowMoment& moment, const Input& input);
  void set_look(float scale);
  void take_inputs();
  void layout(const WindowMoment& moment);
  void draw_edge(float height);

  PanelModel& model;
  PanelHost host;
  ImGuiContext* context = nullptr;
  Ui ui;
  PanelDrafts drafts;
  bool open = false, just_opened = false, built = false;
  std::deque<Input> waiting;  // not shown to Dear ImGui yet; positions in pixels of the picture
  bool pressed_here[3] = {}, pressed_in_scene[3] = {};
  double x = -1.0, y = -1.0;  // of the pointer
  float left = 0.0F, width_points = 0.0F;
  int wanted_tab = -1;
  unsigned fonts_version = 0;
  std::int64_t last_ns = 0;
  std::string pasted;
};

PanelUi::PanelUi(PanelModel& model, PanelHost host) : impl_(std::make_unique<Impl>(model, std::move(host))) {}
PanelUi::~PanelUi() = default;

bool PanelUi::open() const { return impl_->open; }

void PanelUi::set_open(bool open) {
  if (open == impl_->open) return;
  impl_->open = open;
  impl_->just_opened = open;
  impl_->waiting.clear();
  impl_->built = false;
  std::fill(std::begin(impl_->pressed_here), std::end(impl_->pressed_here), false);
  const Impl::Use use(*impl_);
  ImGuiIO& io = ImGui::GetIO();
  std::fill(std::begin(io.MouseDown), std::end(io.MouseDown), false);
  std::fill(std::begin(io.KeysDown), std::end(io.KeysDown), false);
  if (open) return;
  if (impl_->model.has_frame()) impl_->model.gizmo.let_go(impl_->model.frame(), impl_->model.now_ns());
  impl_->model.save_settings();
}

bool PanelUi::Impl::inside(double px, double py) const {
  if (!built) return false;
  if (px >= left) return true;
  const Use use(const_cast<Impl&>(*this));
  return ImGui::GetIO().WantCaptureMouse && !pressed_in_scene[0] && !pressed_in_scene[1] && !pressed_in_scene[2] &&
         py >= 0.0 && ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopupId | ImGuiPopupFlags_AnyPopupLevel);
}

bool PanelUi::on_input(const WindowMoment& moment, const Input& input) {
  if (!impl_->open) return false;
  Gizmo& gizmo = impl_->model.gizmo;
  if (impl_->take(moment, input)) {
    gizmo.forget_pointer();
    return true;
  }
  std::string told;
  const bool taken = gizmo.on_input(moment, input, impl_->model.selected(), told);
  if (!told.empty()) impl_->model.say(told);
  return taken;
}

bool PanelUi::Impl::take(const WindowMoment& moment, const Input& input) {
  const double px_x = moment.width > 0.0 ? moment.picture_width / moment.width : 1.0;
  const double px_y = moment.height > 0.0 ? moment.picture_height / moment.height : 1.0;
  const Use use(*this);
  const ImGuiIO& io = ImGui::GetIO();
  if (const auto* motion = std::get_if<MotionInput>(&input)) {
    x = motion->x * px_x;
    y = motion->y * px_y;
    waiting.push_back(MotionInput{x, y, motion->left_shift});
    const bool scene = pressed_in_scene[0] || pressed_in_scene[1] || pressed_in_scene[2];
    const bool here = pressed_here[0] || pressed_here[1] || pressed_here[2];
    return here || (!scene && inside(x, y));
  }
  if (const auto* button = std::get_if<ButtonInput>(&input)) {
    const int index = button_of(button->button);
    ButtonInput here = *button;
    x = here.x = button->x * px_x;
    y = here.y = button->y * px_y;
    if (!button->pressed) {
      const bool ours = pressed_here[index];
      pressed_here[index] = pressed_in_scene[index] = false;
      if (ours) waiting.push_back(here);
      return ours;
    }
    const bool ours = inside(x, y);
    (ours ? pressed_here : pressed_in_scene)[index] = true;
    if (ours) {
      waiting.push_back(here);
    } else {
      ImGui::SetWindowFocus(nullptr);  // the scene was clicked: keys are the window's again
    }
    return ours;
  }
  if (const auto* wheel = std::get_if<WheelInput>(&input)) {
    if (!inside(x, y)) return false;
    waiting.push_back(*wheel);
    return true;
  }
  if (std::get_if<TextInput>(&input) != nullptr) {
    if (!io.WantTextInput) return false;
    waiting.push_back(input);
    return true;
  }
  if (const auto* key = std::get_if<KeyInput>(&input)) {
    if (key->released) {
      waiting.push_back(*key);
      return false;  // nobody acts on it
    }
    const auto is_one_of = [&](std::initializer_list<const char*> names) {
      return std::any_of(names.begin(), names.end(), [&](const char* name) { return key->key == name; });
    };
    const bool plain = !key->modifiers.control && !key->modifiers.alt;
    const bool popup = ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopupId | ImGuiPopupFlags_AnyPopupLevel);
    const bool moves = io.NavActive && is_one_of({"Left", "Right", "Up", "Down", "PgUp", "PgDn", "Home", "End"});
    // What acts does so only where one sees on what.
    const bool acts = (popup || (io.NavActive && io.NavVisible)) && is_one_of({"Space", "Enter", "Esc"});
    if (io.WantTextInput || (plain && (moves || acts))) {
      waiting.push_back(*key);
      return true;
    }
    return false;
  }
  return false;
}

// Dear ImGui looks at the state of buttons and keys once a picture: what changes twice between two pictures is spread over two, so that no
// quick click is lost where pictures are slow.
void PanelUi::Impl::take_inputs() {
  ImGuiIO& io = ImGui::GetIO();
  const auto hold = [&](const Modifiers& modifiers) {
    io.KeyCtrl = modifiers.control;
    io.KeyShift = modifiers.shift;
    io.KeyAlt = modifiers.alt;
  };
  bool button_changed[3] = {}, key_changed[ImGuiKey_COUNT] = {}, pressed = false, moved = false, keyed = false;
  while (!waiting.empty()) {
    const Input& input = waiting.front();
    if (const auto* motion = std::get_if<MotionInput>(&input)) {
      if (pressed) break;
      const ImVec2 to = whole_pixel(motion->x, motion->y);
      moved = moved || to.x != io.MousePos.x || to.y != io.MousePos.y;
      io.MousePos = to;
    } else if (const auto* button = std::get_if<ButtonInput>(&input)) {
      const int index = button_of(button->button);
      const ImVec2 to = whole_pixel(button->x, button->y);
      moved = moved || to.x != io.MousePos.x || to.y != io.MousePos.y;
      io.MousePos = to;
      // It must have seen the pointer over something before that can be pressed.
      if (button_changed[index] || (button->pressed && moved)) break;
      button_changed[index] = pressed = true;
      io.MouseDown[index] = button->pressed;
      hold(button->modifiers);  // those of the last key may have been let go since
    } else if (const auto* wheel = std::get_if<WheelInput>(&input)) {
      io.MouseWheel += static_cast<float>(wheel->notches);
    } else if (const auto* text = std::get_if<TextInput>(&input)) {
      io.AddInputCharacter(text->character);
      keyed = true;
    } else if (const auto* key = std::get_if<KeyInput>(&input)) {
      // With Ctrl nothing is typed, and without it Ctrl+A is a letter: what comes with it and without it is spread, too.
      if (keyed && key->modifiers.control != io.KeyCtrl) break;
      hold(key->modifiers);
      keyed = true;
      const int index = key_of(key->key);
      if (index >= 0 && !key->held) {
        if (key_changed[index]) break;
        key_changed[index] = true;
        io.KeysDown[index] = !key->released;
        // Dear ImGui presses buttons with Space; people do with either.
        if (index == ImGuiKey_Enter && (key->released || !io.WantTextInput))
          io.KeysDown[ImGuiKey_Space] = !key->released;
      }
    }
    waiting.pop_front();
  }
}

void PanelUi::Impl::set_look(float scale) {
  const bool rescaled = fonts_version == 0 || std::abs(scale - ui.scale) > 0.01F;
  if (rescaled) {
    ui.scale = scale;
    ImFontAtlas& fonts = *ImGui::GetIO().Fonts;
    fonts.Clear();
    fonts.Flags |= ImFontAtlasFlags_NoMouseCursors;
    add_font(fonts, FontWeight::regular, kFont_points * scale);
    ui.strong = add_font(fonts, FontWeight::strong, kFont_points * scale);
    fonts.Build();
    ++fonts_version;
  }
  if (rescaled || ui.dark != model.settings.dark) apply_theme(ui, model.settings.dark);
}

void PanelUi::Impl::draw_edge(float height) {
  const float grip = ui.points(kEdge_points);
  ImGui::SetNextWindowPos({left - 0.5F * grip, 0.0F});
  ImGui::SetNextWindowSize({grip, height});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0.0F, 0.0F});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, {1.0F, 1.0F});
  constexpr ImGuiWindowFlags kFlags = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoNav |
                                      ImGuiWindowFlags_NoBackground | ImGuiWindowFlags_NoSavedSettings |
                                      ImGuiWindowFlags_NoFocusOnAppearing;
  ImGui::Begin("edge", nullptr, kFlags);
  ImGui::InvisibleButton("edge", {grip, height});
  note(ui, "panel/edge");
  if (ImGui::IsItemHovered() || ImGui::IsItemActive()) {
    ImGui::GetWindowDrawList()->AddRectFilled({left - ui.points(1.0F), 0.0F}, {left + ui.points(1.0F), height},
                                              ImGui::ColorConvertFloat4ToU32(ui.accent));
  }
  if (ImGui::IsItemActive()) {
    width_points -= ImGui::GetIO().MouseDelta.x / ui.scale;
    model.settings.width_points = std::max(kLeastWidth_points, width_points);
  }
  ImGui::End();
  ImGui::PopStyleVar(2);
}

void PanelUi::Impl::layout(const WindowMoment& moment) {
  const auto width = static_cast<float>(moment.picture_width), height = static_cast<float>(moment.picture_height);
  width_points =
      model.settings.width_points > 0.0 ? static_cast<float>(model.settings.width_points) : kUsualWidth_points;
  const float panel = std::min(ui.points(std::max(kLeastWidth_points, width_points)), kMostOfWindow * width);
  left = std::floor(width - panel);
  PanelScene scene{model, ui, drafts, host, moment};

  ImGui::SetNextWindowPos({left, 0.0F});
  ImGui::SetNextWindowSize({panel, height});
  if (just_opened) ImGui::SetNextWindowFocus();
  constexpr ImGuiWindowFlags kFlags = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                                      ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoBringToFrontOnFocus |
                                      ImGuiWindowFlags_NoBackground;  // paper() is
  ImGui::Begin("AMBF", nullptr, kFlags);
  draw_run(scene);
  ImGui::Spacing();
  const int wanted = just_opened ? std::clamp(model.settings.tab, 0, kTabCount - 1) : -1;
  const auto narrow = [&] {  // all tabs fit into the usual width
    ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {ui.points(4.0F), ui.points(4.0F)});
    ImGui::PushStyleVar(ImGuiStyleVar_ItemInnerSpacing, {ui.points(3.0F), ImGui::GetStyle().ItemInnerSpacing.y});
  };
  narrow();
  if (ImGui::BeginTabBar("tabs", ImGuiTabBarFlags_FittingPolicyScroll | ImGuiTabBarFlags_NoTooltip)) {
    for (int i = 0; i < kTabCount; ++i) {
      const bool shown = ImGui::BeginTabItem(kTabs[i].name, nullptr, i == wanted ? ImGuiTabItemFlags_SetSelected : 0);
      note(ui, std::string("tab/") + kTabs[i].name);
      if (!shown) continue;
      if (wanted < 0) model.settings.tab = i;
      ImGui::PopStyleVar(2);
      ImGui::BeginChild("tab", {0.0F, 0.0F}, false, ImGuiWindowFlags_NoBackground);
      kTabs[i].draw(scene);
      ImGui::EndChild();
      narrow();
      ImGui::EndTabItem();
    }
    ImGui::EndTabBar();
  }
  ImGui::PopStyleVar(2);
  ImGui::End();
  draw_edge(height);
  just_opened = false;
}

void PanelUi::build(const WindowMoment& moment) {
  Impl& impl = *impl_;
  if (moment.frame == nullptr || !impl.model.has_frame()) return;
  {
    PanelScene scene{impl.model, impl.ui, impl.drafts, impl.host, moment};
    follow(scene);
  }
  if (!impl.open || moment.picture_width <= 0 || moment.picture_height <= 0) {
    impl.built = false;
    return;
  }
  const Impl::Use use(impl);
  const double density = moment.width > 0.0 ? moment.picture_width / moment.width : 1.0;
  impl.set_look(static_cast<float>(std::clamp(std::max(moment.scale, density), 0.5, 4.0)));
  ImGuiIO& io = ImGui::GetIO();
  io.DisplaySize = {static_cast<float>(moment.picture_width), static_cast<float>(moment.picture_height)};
  const double seconds = 1e-9 * static_cast<double>(moment.now_ns - impl.last_ns);
  impl.last_ns = moment.now_ns;
  io.DeltaTime = static_cast<float>(std::clamp(seconds, 1e-4, 0.5));
  impl.take_inputs();
  // Dear ImGui learns the widths of tabs and tables by drawing them: what is new is laid out twice, so that its first picture is whole.
  for (int round = impl.just_opened ? 0 : 1; round < 2; ++round) {
    impl.ui.places.clear();
    ImGui::NewFrame();
    impl.layout(moment);
    ImGui::Render();
  }
  impl.built = true;
}

const ImDrawData* PanelUi::drawing() const {
  if (!impl_->built) return nullptr;
  const Impl::Use use(*impl_);
  return ImGui::GetDrawData();
}

ImFontAtlas& PanelUi::fonts() {
  const Impl::Use use(*impl_);
  return *ImGui::GetIO().Fonts;
}
unsigned PanelUi::fonts_version() const { return impl_->fonts_version; }

const WidgetPlace* PanelUi::place(const std::string& widget) const {
  const auto found = impl_->ui.places.find(widget);
  return found == impl_->ui.places.end() ? nullptr : &found->second;
}

PanelPaper PanelUi::paper() const {
  const Impl::Use use(*impl_);
  const ImVec4& color = ImGui::GetStyle().Colors[ImGuiCol_WindowBg];
  return {impl_->left, color.x, color.y, color.z};
}

float PanelUi::left_edge() const { return impl_->left; }

}  // namespace ambf::render
