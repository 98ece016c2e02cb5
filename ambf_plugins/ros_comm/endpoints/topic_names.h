// From object names to topic names: every object has one of its own that ROS accepts, whatever the files call things.
// Any thread. C++17.
#pragma once

#include <map>
#include <mutex>
#include <string>

namespace ambf::ros_comm {

// Characters that ROS does not allow in names become '_'; repeated '/' become one; a leading '/' is added, and a letter
// where a name begins with something else.
std::string topic_name(const std::string& object_name);

class TopicNames {
 public:
  // The topic for an object; with a number at its end where another object has that topic already.
  std::string reserve(const std::string& object_name);
  void release(const std::string& topic);
  // Empty when the object has none.
  std::string find(const std::string& object_name) const;

 private:
  mutable std::mutex mutex_;
  std::map<std::string, std::string> objects_by_topic_;
};

}  // namespace ambf::ros_comm
