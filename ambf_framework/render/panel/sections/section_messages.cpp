// The end of the log, filtered by severity and words.
#include <cstdio>

#include "render/panel/sections/sections.h"

namespace ambf::render {

namespace {

class LogTab final : public PanelTab {
 public:
  const char* name() const override { return "Log"; }
  void draw(PanelScene& scene) override;

 private:
  std::string search_;
  bool errors_ = true, warnings_ = true, information_ = true;  // are shown
  std::vector<base::LogLine> lines_;
  std::uint64_t lines_taken_ = 0;
};

void LogTab::draw(PanelScene& scene) {
  Ui& ui = scene.ui;
  const base::LogTail* tail = scene.model.tail();
  if (tail == nullptr) {
    ImGui::TextColored(ui.muted, "No messages are kept.");
    return;
  }
  const bool fresh = tail->count() != lines_taken_;
  if (fresh) {
    lines_taken_ = tail->count();
    lines_ = tail->lines();
  }
  check_box(ui, "messages/errors", "Errors", &errors_);
  ImGui::SameLine();
  check_box(ui, "messages/warnings", "Warnings", &warnings_);
  ImGui::SameLine();
  check_box(ui, "messages/information", "Information", &information_);
  text_field(ui, "messages/search", "Search messages", &search_);
  const std::vector<std::string> words = search_words(search_);

  ImGui::BeginChild("messages", {0.0F, 0.0F}, false);
  const bool at_end = ImGui::GetScrollY() >= ImGui::GetScrollMaxY() - 1.0F;
  int shown = 0;
  const std::int64_t first_ns = lines_.empty() ? 0 : lines_.front().steady_ns;
  ImGui::PushTextWrapPos(0.0F);
  for (const base::LogLine& line : lines_) {
    const bool wanted = line.severity == base::Severity::error     ? errors_
                        : line.severity == base::Severity::warning ? warnings_
                                                                   : information_;
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

}  // namespace

std::unique_ptr<PanelTab> make_log_tab() { return std::make_unique<LogTab>(); }

}  // namespace ambf::render
