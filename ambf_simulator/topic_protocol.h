// The lines of JSON that the simulator and `ambf-cli serve` exchange (ambf_tools/topics/serving.py says what they mean). Pure.
#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "render/window/topic_access.h"

namespace ambf::simulator {

struct MasterEvent {
  bool alive = false;
  std::string uri;
};
struct PublishedEvent {
  std::vector<render::PublishedTopic> topics;
};
using TopicList = std::vector<render::TopicInfo>;
using TopicEvent = std::variant<MasterEvent, TopicList, render::WatchedMessage, PublishedEvent, render::TopicAnswer>;

// Nothing where the line makes no sense.
std::optional<TopicEvent> read_event(const std::string& line);

std::string look_request(bool on);
std::string watch_request(const std::string& topic);  // empty: none
std::string template_request(std::uint64_t id, const render::TopicInfo& of);
std::string publish_request(std::uint64_t id, const std::string& topic, const std::string& type,
                            const std::string& text, double rate_hz);
std::string stop_request(std::uint64_t id, const std::string& topic);
std::string call_request(std::uint64_t id, const std::string& service, const std::string& type,
                         const std::string& text);

}  // namespace ambf::simulator
