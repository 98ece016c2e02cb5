#include "ros_comm/endpoints/topic_names.h"

#include <cctype>

namespace ambf::ros_comm {

std::string topic_name(const std::string& object_name) {
  std::string topic = "/";
  for (const char c : object_name) {
    const auto byte = static_cast<unsigned char>(c);
    const bool allowed = (byte < 0x80 && std::isalnum(byte) != 0) || c == '_' || c == '/';
    if (c == '/' && topic.back() == '/') continue;
    topic += allowed ? c : '_';
  }
  while (topic.size() > 1 && topic.back() == '/') topic.pop_back();
  // ROS wants a letter first in the whole name; later parts may begin with a digit.
  if (topic.size() == 1 || std::isalpha(static_cast<unsigned char>(topic[1])) == 0) topic.insert(1, "n");
  return topic;
}

std::string TopicNames::reserve(const std::string& object_name) {
  const std::string wanted = topic_name(object_name);
  const std::lock_guard<std::mutex> lock(mutex_);
  std::string topic = wanted;
  for (int number = 1; !objects_by_topic_.emplace(topic, object_name).second; ++number) {
    topic = wanted + std::to_string(number);
  }
  return topic;
}

void TopicNames::release(const std::string& topic) {
  const std::lock_guard<std::mutex> lock(mutex_);
  objects_by_topic_.erase(topic);
}

std::string TopicNames::find(const std::string& object_name) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  const auto usual = objects_by_topic_.find(topic_name(object_name));
  if (usual != objects_by_topic_.end() && usual->second == object_name) return usual->first;
  for (const auto& [topic, object] : objects_by_topic_) {
    if (object == object_name) return topic;
  }
  return {};
}

}  // namespace ambf::ros_comm
