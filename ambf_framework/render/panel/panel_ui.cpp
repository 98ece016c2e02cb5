#include "render/panel/panel_ui.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "render/panel/detail/panel_inputs.h"
#include "render/panel/detail/panel_renderer.h"
#include "render/panel/sections/sections.h"
#include "render/panel/ui.h"
#include "render/text/fonts.h"
#include "render/window/window_part.h"

namespace ambf::render {

namespace {

constexpr float kFont_points = 14.5F;
constexpr float kUsualWidth_points = 400.0F, kMinWidth_points = 300.0F;
constexpr float kUsualShareOfWindow = 0.5F, kMaxShareOfWindow = 0.75F;
constexpr float kEdge_points = 5.0F;  // of the panel, where it is dragged wider

}  // namespace

struct PanelUi::Impl {
  Impl(PanelModel& panel_model, PanelHost panel_host) : model(panel_model), host(std::move(panel_host)) {
    for (const auto make : {make_objects_tab, make_joints_tab, make_views_tab, make_physics_tab, make_plots_tab,
                            make_log_tab, make_files_tab}) {
      tabs.push_back(make());
    }
    if (model.devices.count() > 0) tabs.push_back(make_devices_tab());
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

  void set_look(float scale);
  float tab_padding(float usual) const;
  void layout(const WindowMoment& moment);
  void draw_edge(float height);

  PanelModel& model;
  PanelHost host;
  ImGuiContext* context = nullptr;
  Ui ui;
  std::vector<std::unique_ptr<PanelTab>> tabs;
  int steps = 10;  // of the button above the tabs
  state::Push push;
  bool open = false, just_opened = false, built = false;
  PanelInputs inputs;
  float left = 0.0F, width_points = 0.0F;
  int window_width = 0;  // px
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
  impl_->built = false;
  const Impl::Use use(*impl_);
  impl_->inputs.clear();
  if (open) return;
  if (impl_->model.has_frame()) impl_->model.gizmo.let_go(impl_->model.frame(), impl_->model.now_ns());
  impl_->model.save_settings();
}

bool PanelUi::on_input(const WindowMoment& moment, const Input& input) {
  if (!impl_->open) return false;
  Gizmo& gizmo = impl_->model.gizmo;
  {
    const Impl::Use use(*impl_);
    if (impl_->inputs.take(moment.sizes, impl_->built ? std::optional(impl_->left) : std::nullopt, input)) {
      gizmo.forget_pointer();
      return true;
    }
  }
  std::string message;
  const bool taken = gizmo.on_input(moment, input, impl_->model.selection.id(), message);
  if (!message.empty()) impl_->model.say(message);
  return taken;
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
    model.settings.width_points = std::max(kMinWidth_points, width_points);
  }
  ImGui::End();
  ImGui::PopStyleVar(2);
}

// Beside the names of tabs: less than `usual` where they would not all fit.
float PanelUi::Impl::tab_padding(float usual) const {
  float names = 0.0F;
  for (const auto& tab : tabs) names += std::ceil(ImGui::CalcTextSize(tab->name()).x) + 1.0F;  // as Dear ImGui adds
  const auto count = static_cast<float>(tabs.size());
  const float spacing = ImGui::GetStyle().ItemInnerSpacing.x * count;
  const float room = ImGui::GetContentRegionAvail().x - names - spacing;
  return std::clamp(std::floor(room / (2.0F * count)), 1.0F, usual);
}

void PanelUi::Impl::layout(const WindowMoment& moment) {
  const auto width = static_cast<float>(moment.sizes.window_picture_width),
             height = static_cast<float>(moment.sizes.picture_height);
  const float usual = std::min(kUsualWidth_points, kUsualShareOfWindow * width / ui.points(1.0F));
  width_points = model.settings.width_points > 0.0 ? static_cast<float>(model.settings.width_points) : usual;
  const float panel = std::min(ui.points(std::max(kMinWidth_points, width_points)), kMaxShareOfWindow * width);
  left = std::floor(width - panel);
  window_width = moment.sizes.window_picture_width;
  PanelScene scene{model, ui, push, host, moment};

  ImGui::SetNextWindowPos({left, 0.0F});
  ImGui::SetNextWindowSize({panel, height});
  if (just_opened) ImGui::SetNextWindowFocus();
  constexpr ImGuiWindowFlags kFlags = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                                      ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoBringToFrontOnFocus |
                                      ImGuiWindowFlags_NoBackground;  // paper() is
  ImGui::Begin("AMBF", nullptr, kFlags);
  draw_run(scene, steps);
  ImGui::Spacing();
  const int wanted = just_opened ? std::clamp(model.settings.tab, 0, static_cast<int>(tabs.size()) - 1) : -1;
  const float usual_padding = ImGui::GetStyle().FramePadding.x;
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {tab_padding(usual_padding), ImGui::GetStyle().FramePadding.y});
  if (ImGui::BeginTabBar("tabs", ImGuiTabBarFlags_FittingPolicyScroll | ImGuiTabBarFlags_NoTooltip)) {
    for (int i = 0; i < static_cast<int>(tabs.size()); ++i) {
      PanelTab& tab = *tabs[static_cast<std::size_t>(i)];
      const bool shown = ImGui::BeginTabItem(tab.name(), nullptr, i == wanted ? ImGuiTabItemFlags_SetSelected : 0);
      note(ui, std::string("tab/") + tab.name());
      if (!shown) continue;
      if (wanted < 0) model.settings.tab = i;
      ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {usual_padding, ImGui::GetStyle().FramePadding.y});
      ImGui::BeginChild("tab", {0.0F, 0.0F}, false, ImGuiWindowFlags_NoBackground);
      tab.draw(scene);
      ImGui::EndChild();
      ImGui::PopStyleVar();
      ImGui::EndTabItem();
    }
    ImGui::EndTabBar();
  }
  ImGui::PopStyleVar();
  ImGui::End();
  draw_edge(height);
  just_opened = false;
}

void PanelUi::build(const WindowMoment& moment) {
  Impl& impl = *impl_;
  if (moment.frame == nullptr || !impl.model.has_frame()) return;
  {
    PanelScene scene{impl.model, impl.ui, impl.push, impl.host, moment};
    for (const auto& tab : impl.tabs) tab->observe(scene);
  }
  if (!impl.open || moment.sizes.window_picture_width <= 0 || moment.sizes.picture_height <= 0) {
    impl.built = false;
    return;
  }
  const Impl::Use use(impl);
  const double density = moment.sizes.width > 0.0 ? moment.sizes.picture_width / moment.sizes.width : 1.0;
  impl.set_look(static_cast<float>(std::clamp(std::max(moment.sizes.scale, density), 0.5, 4.0)));
  ImGuiIO& io = ImGui::GetIO();
  io.DisplaySize = {static_cast<float>(moment.sizes.window_picture_width),
                    static_cast<float>(moment.sizes.picture_height)};
  const double seconds = 1e-9 * static_cast<double>(moment.now_ns - impl.last_ns);
  impl.last_ns = moment.now_ns;
  io.DeltaTime = static_cast<float>(std::clamp(seconds, 1e-4, 0.5));
  impl.inputs.feed();
  // Dear ImGui learns the widths of tabs and tables by drawing them: what is new is laid out twice, so that its first
  // picture is whole.
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
int PanelUi::covered() const { return impl_->built ? impl_->window_width - static_cast<int>(impl_->left) : 0; }

}  // namespace ambf::render
