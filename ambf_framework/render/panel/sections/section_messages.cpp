// What was said: the end of the log, by severity and words.
#include <cstdio>

#include "render/panel/sections/sections.h"

namespace ambf::render {

void draw_messages(PanelScene& scene) {
  Ui& ui = scene.ui;
  PanelDrafts& drafts = scene.drafts;
  const base::LogTail* tail = scene.model.tail();
  if (tail == nullptr) {
    ImGui::TextColored(ui.muted, "No messages are kept.");
    return;
  }
  const bool fresh = tail->count() != drafts.lines_taken;
  if (fresh) {
    drafts.lines_taken = tail->count();
    drafts.lines = tail->lines();
  }
  check_box(ui, "messages/errors", "Errors", &drafts.show_errors);
  ImGui::SameLine();
  check_box(ui, "messages/warnings", "Warnings", &drafts.show_warnings);
  ImGui::SameLine();
  check_box(ui, "messages/information", "Information", &drafts.show_information);
  text_field(ui, "messages/search", "Search messages", &drafts.search_messages);
  const std::vector<std::string> words = search_words(drafts.search_messages);

  ImGui::BeginChild("messages", {0.0F, 0.0F}, false);
  const bool at_end = ImGui::GetScrollY() >= ImGui::GetScrollMaxY() - 1.0F;
  int shown = 0;
  const std::int64_t first_ns = drafts.lines.empty() ? 0 : drafts.lines.front().steady_ns;
  ImGui::PushTextWrapPos(0.0F);
  for (const base::LogLine& line : drafts.lines) {
    const bool wanted = line.severity == base::Severity::error     ? drafts.show_errors
                        : line.severity == base::Severity::warning ? drafts.show_warnings
                                                                   : drafts.show_information;
    if (!wanted || !has_words(line.text, words)) continue;
    ++shown;
    ImGui::TextColored(ui.muted, "%8.2f", static_cast<double>(line.steady_ns - first_ns) * 1e-9);
    ImGui::SameLine();
    const ImVec4 color = line.severity == base::Severity::error     ? ui.bad
                         : line.severity == base::Severity::warning ? ui.warning
                                                                    : ImGui::GetStyle().Colors[ImGuiCol_Text];
    ImGui::PushStyleColor(ImGuiCol_Text, color);
    ImGui::TextWrapped("%s", line.text.c_str());
    ImGui::PopStyleColor();
    if (ImGui::IsItemClicked() && scene.host.set_clipboard) {
      scene.host.set_clipboard(line.text);
      scene.model.say("message copied");
    }
  }
  ImGui::PopTextWrapPos();
  ui.places["messages/shown"] = {static_cast<float>(shown), 0.0F, 0.0F, 0.0F};
  if (shown == 0) ImGui::TextColored(ui.muted, "Nothing was said.");
  if (fresh && at_end) ImGui::SetScrollHereY(1.0F);
  ImGui::EndChild();
}

}  // namespace ambf::render
