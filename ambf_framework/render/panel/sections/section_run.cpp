// Run control: play, step, speed, and how it is doing.
#include <algorithm>
#include <cstdio>
#include <string>

#include "render/panel/sections/sections.h"

namespace ambf::render {

namespace {

void draw_rates(PanelScene& scene) {
  Ui& ui = scene.ui;
  const state::RunState& run = scene.model.frame().run;
  const double wanted = run.speed_factor;
  const ImVec4 color = run.paused || run.throttled            ? ui.muted
                       : run.real_time_factor > 0.97 * wanted ? ui.good
                       : run.real_time_factor > 0.7 * wanted  ? ui.warning
                                                              : ui.bad;
  ImGui::AlignTextToFramePadding();
  ImGui::TextColored(color, "%.2f", run.paused ? 0.0 : run.real_time_factor);
  note(ui, "run/rtf");
  tool_tip("true real-time factor: simulated over wall time, of the last second");
  ImGui::SameLine(0.0F, ui.points(4.0F));
  ImGui::TextColored(ui.muted, "of");
  ImGui::SameLine(0.0F, ui.points(4.0F));
  double speed = wanted;
  if (number_field(ui, "run/speed", &speed, 0.001, 1000.0, "%.3g x", 58.0F)) scene.model.run.set_speed(speed);
  tool_tip("simulated seconds a wall second that are asked for; drag, or double-click to type");
  ImGui::SameLine();
  ImGui::TextColored(ui.muted, "%.0f steps/s  %.*f pictures/s", run.steps_per_second, run.graphics_rate < 9.5 ? 1 : 0,
                     run.graphics_rate);
}

// A line of its own, always there: what appears on it moves nothing else.
void draw_state(PanelScene& scene) {
  Ui& ui = scene.ui;
  PanelModel& model = scene.model;
  const state::Frame& frame = model.frame();
  const char* release = "Let go of held joints";
  const float width = ImGui::CalcTextSize(release).x + 2.0F * ImGui::GetStyle().FramePadding.x;
  const float left = ImGui::GetCursorPosX(), right = ImGui::GetWindowContentRegionMax().x;
  const ImVec2 a = ImGui::GetCursorScreenPos();
  const float room = right - left - width - ImGui::GetStyle().ItemSpacing.x;
  ImGui::PushClipRect(a, {a.x + room, a.y + ImGui::GetFrameHeight()}, true);
  ImGui::AlignTextToFramePadding();
  std::string text;
  ImVec4 color = ui.bad;
  if (frame.run.diverged) {
    const std::uint32_t body = frame.run.diverged_body;
    const state::Structure& all = model.structure();
    text = (body < all.bodies.size() ? all.objects[all.bodies[body].object].name : "a body") +
           " diverged: reset the world to go on";
  } else if (frame.frozen_bodies > 0) {
    text = state::frozen_text(frame) + ": reset or command them";
  } else if (frame.run.throttled) {
    text = "Waits for the step clock of a client";
    color = ui.warning;
  }
  ImGui::TextColored(color, "%s", text.c_str());
  ImGui::PopClipRect();
  tool_tip(text.c_str());
  ImGui::SameLine();
  ImGui::SetCursorPosX(right - width);
  if (button(ui, "run/release", release, model.held.any())) model.held.release_all();
  tool_tip("all joints that are held here");
}

}  // namespace

void draw_run(PanelScene& scene, int& steps) {
  Ui& ui = scene.ui;
  PanelModel& model = scene.model;
  const state::Frame& frame = model.frame();
  const bool paused = frame.run.paused;
  if (icon_button(ui, "run/pause", paused ? Icon::play : Icon::pause, paused ? "Run (Ctrl+P)" : "Pause (Ctrl+P)",
                  !frame.run.diverged)) {
    model.run.toggle_pause();
  }
  ImGui::SameLine();
  if (icon_button(ui, "run/back", Icon::back, "Back to before the last step made here", model.run.can_step_back())) {
    model.run.step_back();
  }
  ImGui::SameLine();
  if (icon_button(ui, "run/step", Icon::step, "One step, while paused (Space)", paused)) model.run.step(1);
  ImGui::SameLine();
  ImGui::BeginDisabled(!paused);
  ImGui::SetNextItemWidth(ui.points(48.0F));
  ImGui::DragInt("##run/steps", &steps, 1.0F, 1, 1000000, "%d", ImGuiSliderFlags_AlwaysClamp);
  note(ui, "run/steps");
  ImGui::EndDisabled();
  ImGui::SameLine(0.0F, ui.points(3.0F));
  if (button(ui, "run/step_n", "Steps", paused)) model.run.step(static_cast<unsigned>(std::max(1, steps)));
  tool_tip("so many steps, while paused");
  ImGui::SameLine();
  if (icon_button(ui, "run/reset", Icon::reset,
                  "The whole world back to its start: bodies, time, parameters (Alt+R)")) {
    model.run.reset_world();
  }

  char time[32];
  std::snprintf(time, sizeof time, "%.3f s", frame.sim_time);
  if (ui.strong != nullptr) ImGui::PushFont(ui.strong);
  const float width = ImGui::CalcTextSize(time).x;
  ImGui::SameLine();
  ImGui::SetCursorPosX(std::max(ImGui::GetCursorPosX(), ImGui::GetWindowContentRegionMax().x - width));
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted(time);
  if (ui.strong != nullptr) ImGui::PopFont();
  tool_tip("simulated time");

  draw_rates(scene);
  draw_state(scene);
}

}  // namespace ambf::render
