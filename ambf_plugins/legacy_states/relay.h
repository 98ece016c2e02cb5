// Publishes State topics of the simulators on this master a second time, under the same name, as another generation of
// AMBF does, for programs built against its messages: each side takes the publisher whose md5 it knows. A ROS node
// cannot hear one type of a topic and say another, so this takes two nodes: one hears, and says what it heard under a
// name of its own; the other hears that, and says it in the other type. Either subscribes to a topic only while
// somebody listens to what it says. Everything happens on one thread: the one that calls update() must also serve ROS's
// callback queue. C++17.
#pragma once

#include <ros/ros.h>

#include <map>
#include <memory>
#include <string>

#include "legacy_states/other_generations.h"

namespace ambf::legacy_states {

enum class Part { hears, says };

class Relay {
 public:
  Relay(Part part, Generation generation);
  ~Relay();
  // Looks which topics there are and follows. False when the master does not answer.
  bool update(ros::NodeHandle& node);
  void clear();

 private:
  class Topic;
  const Part part_;
  const Generation generation_;
  std::map<std::string, std::unique_ptr<Topic>> topics_;
};

}  // namespace ambf::legacy_states
