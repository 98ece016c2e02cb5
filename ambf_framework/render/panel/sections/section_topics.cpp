// Any topic and any service: what comes on it, and what is sent there.
#include <imgui/imgui.h>
#include <imgui/imgui_stdlib.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "base/clock.h"
#include "render/panel/sections/sections.h"

namespace ambf::render {

namespace {

using State = TopicDesk::Outcome::State;

constexpr float kList = 0.34F;  // of the height
constexpr double kMostHz = 1000.0;

void wrapped(const ImVec4& color, const std::string& text) {
  ImGui::PushStyleColor(ImGuiCol_Text, color);
  ImGui::TextWrapped("%s", text.c_str());
  ImGui::PopStyleColor();
}

// What is wrong or under way, above the list. False: there is nothing else to show.
bool draw_state(PanelScene& scene) {
  Ui& ui = scene.ui;
  TopicDesk& desk = scene.model.topics;
  if (const std::string why = desk.unavailable(); !why.empty()) {
    muted_text(ui, ("There are no topics: " + why + ".").c_str());
    return false;
  }
  desk.show(scene.moment.now_ns);
  const TopicView& view = desk.view();
  if (!view.problem.empty()) {
    wrapped(view.stage == TopicView::Stage::failed ? ui.bad : ui.warning, view.problem);
    note(ui, "topics/problem");
  }
  if (view.stage == TopicView::Stage::failed && button(ui, "topics/retry", "Try again")) desk.retry();
  const bool starting = view.stage == TopicView::Stage::off || view.stage == TopicView::Stage::starting;
  if (starting) {
    muted_text(ui, "Starting ambf-cli, which knows all message types...");
    note(ui, "topics/starting");
  }
  return view.list != nullptr && (!starting || !view.list->empty());
}

void draw_rows(PanelScene& scene, const char* id, const std::vector<MessageRow>& rows) {
  Ui& ui = scene.ui;
  constexpr ImGuiTableFlags kFlags = ImGuiTableFlags_SizingStretchProp | ImGuiTableFlags_RowBg;
  if (!ImGui::BeginTable(id, 2, kFlags)) return;
  ImGui::TableSetupColumn("field", ImGuiTableColumnFlags_WidthStretch, 0.42F);
  ImGui::TableSetupColumn("value", ImGuiTableColumnFlags_WidthStretch, 0.58F);
  int open = 0;          // tree nodes above
  int hidden_from = -1;  // depth from which on rows are folded away; -1: none
  for (const MessageRow& row : rows) {
    if (hidden_from >= 0 && row.depth >= hidden_from) continue;
    hidden_from = -1;
    for (; open > row.depth; --open) ImGui::TreePop();
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGuiTreeNodeFlags flags = ImGuiTreeNodeFlags_SpanFullWidth | ImGuiTreeNodeFlags_FramePadding;
    if (!row.opens) flags |= ImGuiTreeNodeFlags_Leaf | ImGuiTreeNodeFlags_NoTreePushOnOpen | ImGuiTreeNodeFlags_Bullet;
    // Arrays say in their line what matters; messages have nothing else to show.
    if (row.opens && row.value.empty()) flags |= ImGuiTreeNodeFlags_DefaultOpen;
    ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {ui.points(3.0F), ui.points(1.0F)});
    const bool unfolded = ImGui::TreeNodeEx(row.name.c_str(), flags);
    if (row.depth == 0) note(ui, std::string(id) + "/" + row.name);
    if (!row.opens && ImGui::IsItemClicked() && scene.host.set_clipboard) {
      scene.host.set_clipboard(row.value);
      scene.model.say(row.name + " copied");
    }
    if (row.opens && unfolded) ++open;
    if (row.opens && !unfolded) hidden_from = row.depth + 1;
    ImGui::TableNextColumn();
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted(row.value.c_str());
    ImGui::PopStyleVar();
    if (ImGui::GetItemRectSize().x > ImGui::GetContentRegionAvail().x) tool_tip(row.value.c_str());
  }
  for (; open > 0; --open) ImGui::TreePop();
  ImGui::EndTable();
}

void draw_message(PanelScene& scene, const TopicInfo& info) {
  Ui& ui = scene.ui;
  const WatchedMessage* message = scene.model.topics.message();
  if (message == nullptr) {
    muted_text(ui, info.publishers == 0 ? "Nobody else publishes here." : "Waiting for the first message...");
    return;
  }
  muted_text(ui, in_words(*message, base::to_seconds(base::steady_ns() - message->came_ns)).c_str());
  note(ui, "topics/message");
  if (!message->problem.empty()) wrapped(ui.bad, message->problem);
  draw_rows(scene, "message", message->rows);
}

void draw_outcome(PanelScene& scene, const TopicDesk::Outcome& outcome, const char* waiting) {
  Ui& ui = scene.ui;
  switch (outcome.state) {
    case State::none: return;
    case State::waiting: {
      char text[80];
      const double seconds = base::to_seconds(scene.moment.now_ns - outcome.asked_ns);
      std::snprintf(text, sizeof text, seconds > 1.0 ? "%s %.0f s" : "%s", waiting, seconds);
      muted_text(ui, text);
      break;
    }
    case State::good:
      if (!outcome.text.empty()) wrapped(ui.good, outcome.text);
      break;
    case State::bad: wrapped(ui.bad, outcome.text); break;
  }
  note(ui, "topics/outcome");
}

void draw_editor(PanelScene& scene, const char* id, bool acts_on_enter, bool& entered) {
  Ui& ui = scene.ui;
  TopicDesk& desk = scene.model.topics;
  TopicDesk::Draft& draft = desk.draft();
  if (draft.filled.state == State::bad) wrapped(ui.bad, draft.filled.text);
  if (draft.filled.state == State::good && draft.filled.text.empty()) {
    muted_text(ui, "Its type has no fields: there is nothing to fill in.");
    note(ui, "topics/no fields");
  }
  const auto lines =
      static_cast<float>(std::clamp<std::ptrdiff_t>(std::count(draft.text.begin(), draft.text.end(), '\n') + 1, 3, 14));
  const float height = lines * ImGui::GetTextLineHeight() + 2.0F * ImGui::GetStyle().FramePadding.y;
  // Ctrl+Enter sends.
  entered = ImGui::InputTextMultiline((std::string("##") + id + desk.chosen()).c_str(), &draft.text, {-1.0F, height},
                                      acts_on_enter ? ImGuiInputTextFlags_EnterReturnsTrue : 0);
  note(ui, "topics/text");
}

void draw_publish(PanelScene& scene) {
  Ui& ui = scene.ui;
  TopicDesk& desk = scene.model.topics;
  bool entered = false;
  draw_editor(scene, "message", true, entered);
  if (button(ui, "topics/publish", "Publish") || entered) desk.publish_once();
  tool_tip("Once. Ctrl+Enter in the text does the same");
  ImGui::SameLine();
  if (const PublishedTopic* published = desk.published()) {
    if (button(ui, "topics/stop", "Stop")) desk.stop_publishing(desk.chosen());
    ImGui::SameLine();
    ImGui::TextColored(ui.good, "at %.4g Hz, %llu sent", published->rate_hz,
                       static_cast<unsigned long long>(published->count));
  } else {
    if (button(ui, "topics/repeat", "Publish at")) desk.publish_at_rate();
    tool_tip("Again and again, until it is stopped");
    ImGui::SameLine();
    number_field(ui, "topics/rate", &desk.draft().rate_hz, 0.1, kMostHz, "%.4g Hz", 80.0F);
  }
  ImGui::SameLine();
  if (button(ui, "topics/template", "Template")) desk.fill_in();
  tool_tip("All fields with their default values");
  draw_outcome(scene, desk.draft().sent, "publishing...");
}

void draw_call(PanelScene& scene) {
  Ui& ui = scene.ui;
  TopicDesk& desk = scene.model.topics;
  bool entered = false;
  draw_editor(scene, "request", true, entered);
  if (button(ui, "topics/call", "Call") || entered) desk.call();
  tool_tip("Ctrl+Enter in the text does the same");
  ImGui::SameLine();
  if (button(ui, "topics/template", "Template")) desk.fill_in();
  tool_tip("All fields with their default values");
  const TopicDesk::Outcome& sent = desk.draft().sent;
  draw_outcome(scene, sent, "waiting for its answer...");
  if (sent.state != State::good) return;
  heading(ui, "Answer");
  if (sent.rows.empty()) muted_text(ui, "Done; it has no fields.");
  draw_rows(scene, "answer", sent.rows);
}

void draw_chosen(PanelScene& scene) {
  Ui& ui = scene.ui;
  TopicDesk& desk = scene.model.topics;
  const TopicInfo* info = desk.info();
  if (desk.chosen().empty()) return muted_text(ui, "Choose a topic to see its messages, or a service to call it.");
  heading(ui, desk.chosen().c_str());
  if (info == nullptr) return muted_text(ui, "It is not there now. When it comes, it is shown.");
  std::string about = info->type.empty() ? "type not known yet" : info->type;
  if (!info->service) {
    const auto count = [](int n, const char* what) {
      return (n == 0 ? "no" : std::to_string(n)) + what + (n == 1 ? "" : "s");
    };
    about += "; " + count(info->publishers, " publisher") + ", " + count(info->listeners, " listener");
  }
  muted_text(ui, about.c_str());
  if (info->service) {
    draw_call(scene);
    return;
  }
  // What nobody else publishes is there to be published; what somebody does is there to be seen. Each kind is folded for itself.
  const bool spoken = info->publishers > 0;
  ImGui::PushID(spoken ? "spoken" : "unspoken");
  if (!spoken && section(ui, "Publish", true)) draw_publish(scene);
  if (section(ui, "Message", true)) draw_message(scene, *info);
  if (spoken && section(ui, "Publish", false)) draw_publish(scene);
  ImGui::PopID();
}

// What goes on behind another choice must not be forgotten, nor what nobody else knows any more: the list lacks it.
void draw_still_published(PanelScene& scene) {
  Ui& ui = scene.ui;
  TopicDesk& desk = scene.model.topics;
  for (const PublishedTopic& each : desk.view().published) {
    if (each.topic == desk.chosen() && desk.info() != nullptr) continue;
    if (button(ui, "topics/stop " + each.topic, "Stop")) desk.stop_publishing(each.topic);
    ImGui::SameLine();
    ImGui::AlignTextToFramePadding();
    ImGui::TextColored(ui.warning, "Still published: %s at %.4g Hz", each.topic.c_str(), each.rate_hz);
  }
}

}  // namespace

void draw_topics(PanelScene& scene) {
  if (!draw_state(scene)) return;
  const float line = ImGui::GetTextLineHeightWithSpacing();  // whole lines
  draw_topic_list(scene, line * std::max(1.0F, std::floor(kList * ImGui::GetContentRegionAvail().y / line)));
  ImGui::Separator();
  ImGui::BeginChild("chosen topic", {0.0F, 0.0F}, false, ImGuiWindowFlags_NoBackground | ImGuiWindowFlags_NavFlattened);
  draw_chosen(scene);
  draw_still_published(scene);
  ImGui::EndChild();
}

}  // namespace ambf::render
