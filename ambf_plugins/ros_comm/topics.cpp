#include "ros_comm/topics.h"

#include <cctype>

namespace ambf::ros_comm {

std::string topic_name(const std::string& object_name) {
  std::string topic = "/";
  for (const char c : object_name) {
    const bool allowed = std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '/';
    if (c == '/' && topic.back() == '/') continue;
    topic += allowed ? c : '_';
  }
  // ROS wants a letter first in the whole name; later parts may begin with a digit.
  if (topic.size() > 1 && std::isalpha(static_cast<unsigned char>(topic[1])) == 0) topic.insert(1, "n");
  while (topic.size() > 1 && topic.back() == '/') topic.pop_back();
  return topic;
}

}  // namespace ambf::ros_comm
