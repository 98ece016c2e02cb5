// Topics and services by words and kind, ours first; one is chosen.
#include <algorithm>
#include <memory>

#include "render/panel/sections/sections.h"

namespace ambf::render {

namespace {

enum Heading { ours = -1, others = -2, services_ours = -3, services_others = -4 };

const char* text_of(int heading) {
  switch (heading) {
    case ours: return "Topics of this simulation";
    case others: return "Topics of other programs";
    case services_ours: return "Services of this simulation";
    default: return "Services of other programs";
  }
}

int heading_of(const TopicInfo& info) {
  if (info.service) return info.ours ? services_ours : services_others;
  return info.ours ? ours : others;
}

// Only when the list or what is asked for has changed: there may be thousands.
void filter(PanelDrafts& drafts, const std::shared_ptr<const std::vector<TopicInfo>>& of) {
  const std::vector<TopicInfo>& list = *of;
  std::string by = drafts.search_topics;
  for (const bool on : {drafts.show_topics, drafts.show_services, drafts.show_others}) by += on ? '1' : '0';
  if (drafts.listed_topics == of && drafts.topics_filtered_by == by) return;
  drafts.listed_topics = of;
  drafts.topics_filtered_by = by;
  drafts.topics_shown.clear();
  const std::vector<std::string> words = search_words(drafts.search_topics);
  // Ours in front: what a simulation is worked with, then what is around it.
  for (const int heading : {ours, services_ours, others, services_others}) {
    bool headed = false;
    for (std::size_t i = 0; i < list.size(); ++i) {
      const TopicInfo& info = list[i];
      if (heading_of(info) != heading || !(info.service ? drafts.show_services : drafts.show_topics)) continue;
      if ((!info.ours && !drafts.show_others) || !has_words(info.name + " " + info.type, words)) continue;
      if (!headed) drafts.topics_shown.push_back(heading);
      headed = true;
      drafts.topics_shown.push_back(static_cast<int>(i));
    }
  }
}

void draw_line(PanelScene& scene, const TopicInfo& info) {
  Ui& ui = scene.ui;
  TopicDesk& desk = scene.model.topics;
  const float width = ImGui::GetContentRegionAvail().x;
  if (ImGui::Selectable(("##" + info.name).c_str(), info.name == desk.chosen())) {
    desk.choose(info.name);
    scene.model.settings.topic = info.name;
  }
  note(ui, "topics/" + info.name);
  tool_tip((info.name + "\n" + (info.type.empty() ? "type not known yet" : info.type)).c_str());
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const ImVec2 a = ImGui::GetItemRectMin(), b = ImGui::GetItemRectMax();
  const std::string type = info.type.substr(info.type.find('/') + 1);
  const float type_width = ImGui::CalcTextSize(type.c_str()).x, gap = ui.points(10.0F);
  const float left = a.x + ui.points(6.0F), y = a.y + 0.5F * (b.y - a.y - ImGui::GetTextLineHeight());
  // The end of a name tells more than its beginning.
  std::string name = info.name;
  float name_width = ImGui::CalcTextSize(name.c_str()).x;
  const float most = std::max(0.5F * width, width - type_width - gap - ui.points(6.0F));
  const float dots = ImGui::CalcTextSize("...").x;
  std::size_t cut = 0;
  while (name_width + (cut > 0 ? dots : 0.0F) > most && cut + 4 < info.name.size()) {
    ++cut;
    name_width = ImGui::CalcTextSize(info.name.c_str() + cut).x;
  }
  if (cut > 0) name = "..." + info.name.substr(cut);
  const bool idle = !info.service && info.publishers == 0;
  draw.AddText({left, y}, ImGui::GetColorU32(idle ? ImGuiCol_TextDisabled : ImGuiCol_Text), name.c_str());
  const float right = left + std::min(most, ImGui::CalcTextSize(name.c_str()).x) + gap;
  draw.PushClipRect({right, a.y}, {b.x, b.y}, true);
  draw.AddText({std::max(right, b.x - type_width - ui.points(4.0F)), y}, ImGui::ColorConvertFloat4ToU32(ui.muted),
               type.c_str());
  draw.PopClipRect();
}

}  // namespace

void draw_topic_list(PanelScene& scene, float height) {
  Ui& ui = scene.ui;
  PanelDrafts& drafts = scene.drafts;
  const std::vector<TopicInfo>& list = *scene.model.topics.view().list;
  check_box(ui, "topics/topics", "Topics", &drafts.show_topics);
  ImGui::SameLine();
  check_box(ui, "topics/services", "Services", &drafts.show_services);
  ImGui::SameLine();
  check_box(ui, "topics/others", "Of other programs", &drafts.show_others);
  text_field(ui, "topics/search", "Search topics, services and types", &drafts.search_topics);
  filter(drafts, scene.model.topics.view().list);

  ImGui::BeginChild("topic list", {0.0F, height}, false, ImGuiWindowFlags_NavFlattened);
  if (drafts.topics_shown.empty()) {
    ImGui::TextColored(ui.muted, list.empty() ? "Nothing is listed yet." : "Nothing fits.");
  }
  ImGuiListClipper clipper;
  clipper.Begin(static_cast<int>(drafts.topics_shown.size()));
  while (clipper.Step()) {
    for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i) {
      const int shown = drafts.topics_shown[static_cast<std::size_t>(i)];
      if (shown < 0) {
        ImGui::TextColored(ui.accent, "%s", text_of(shown));
      } else {
        draw_line(scene, list[static_cast<std::size_t>(shown)]);
      }
    }
  }
  ImGui::EndChild();
}

}  // namespace ambf::render
