#include "topic_protocol.h"

#include <nlohmann/json.hpp>

#include "base/clock.h"

namespace ambf::simulator {

namespace {

using Json = nlohmann::json;

constexpr int kDeepest = 20;

// Throws Json::exception where they are none; read_event() catches it.
void read_rows(const Json& from, int depth, std::vector<render::MessageRow>& to) {
  for (const Json& row : from) {
    const bool opens = row.size() > 2 && !row.at(2).empty() && depth < kDeepest;
    to.push_back({depth, opens, row.at(0).get<std::string>(), row.at(1).get<std::string>()});
    if (opens) read_rows(row.at(2), depth + 1, to);
  }
}

TopicList read_list(const Json& event) {
  TopicList list;
  const auto add = [&](bool service, const Json& each) {
    render::TopicInfo info;
    info.service = service;
    each.at(0).get_to(info.name);
    each.at(1).get_to(info.type);
    if (!service) {
      each.at(2).get_to(info.publishers);
      each.at(3).get_to(info.listeners);
    }
    each.back().get_to(info.ours);
    list.push_back(std::move(info));
  };
  for (const Json& each : event.at("topics")) add(false, each);
  for (const Json& each : event.at("services")) add(true, each);
  return list;
}

render::WatchedMessage read_message(const Json& event) {
  render::WatchedMessage message;
  event.at("topic").get_to(message.topic);
  event.at("type").get_to(message.type);
  event.at("count").get_to(message.count);
  event.at("rate").get_to(message.rate_hz);
  event.at("bytes").get_to(message.bytes);
  message.problem = event.value("error", "");
  message.came_ns = base::steady_ns();
  read_rows(event.at("rows"), 0, message.rows);
  return message;
}

render::TopicAnswer read_answer(const Json& event) {
  render::TopicAnswer answer;
  answer.id = event.at("id").is_null() ? 0 : event.at("id").get<std::uint64_t>();
  answer.good = !event.contains("error");
  answer.text = answer.good ? event.value("text", "") : event.at("error").get<std::string>();
  if (event.contains("rows")) read_rows(event.at("rows"), 0, answer.rows);
  return answer;
}

// Texts come from users and from files: what is no UTF-8 is replaced.
std::string line_of(const Json& json) { return json.dump(-1, ' ', true, Json::error_handler_t::replace); }

}  // namespace

std::optional<TopicEvent> read_event(const std::string& line) try {
  const Json event = Json::parse(line);
  const std::string kind = event.at("event");
  if (kind == "master") return MasterEvent{event.at("alive"), event.at("uri")};
  if (kind == "list") return read_list(event);
  if (kind == "message") return read_message(event);
  if (kind == "answer") return read_answer(event);
  if (kind != "publishing") return std::nullopt;
  PublishedEvent published;
  for (const Json& each : event.at("topics")) {
    published.topics.push_back({each.at("topic"), each.at("rate"), each.at("count")});
  }
  return published;
} catch (const Json::exception&) {
  return std::nullopt;
}

std::string look_request(bool on) { return line_of({{"do", "look"}, {"on", on}}); }

std::string watch_request(const std::string& topic) {
  Json topics = Json::array();
  if (!topic.empty()) topics.push_back(topic);
  return line_of({{"do", "watch"}, {"topics", topics}});
}

std::string template_request(std::uint64_t id, const render::TopicInfo& of) {
  return line_of({{"do", "template"}, {"id", id}, {"name", of.name}, {"type", of.type}, {"service", of.service}});
}

std::string publish_request(std::uint64_t id, const std::string& topic, const std::string& type,
                            const std::string& text, double rate_hz) {
  return line_of({{"do", "publish"}, {"id", id}, {"topic", topic}, {"type", type}, {"text", text}, {"rate", rate_hz}});
}

std::string stop_request(std::uint64_t id, const std::string& topic) {
  return line_of({{"do", "stop"}, {"id", id}, {"topic", topic}});
}

std::string call_request(std::uint64_t id, const std::string& service, const std::string& type,
                         const std::string& text) {
  return line_of({{"do", "call"}, {"id", id}, {"service", service}, {"type", type}, {"text", text}});
}

}  // namespace ambf::simulator
