// The world's services: Load, Unload, Remove, Save, List, Step, Snapshot, Restore, Forget, Record, Received, Hold and
// Tune; the topic StepCommands. Each waits for its outcome on a service thread: several can be under way at once.
// Private to ros_comm. C++17.
#pragma once

#include <ambf_msgs/Forget.h>
#include <ambf_msgs/Hold.h>
#include <ambf_msgs/List.h>
#include <ambf_msgs/Load.h>
#include <ambf_msgs/Received.h>
#include <ambf_msgs/Record.h>
#include <ambf_msgs/Remove.h>
#include <ambf_msgs/Restore.h>
#include <ambf_msgs/Save.h>
#include <ambf_msgs/Snapshot.h>
#include <ambf_msgs/Step.h>
#include <ambf_msgs/StepCommands.h>
#include <ambf_msgs/Tune.h>
#include <ambf_msgs/Unload.h>
#include <ros/ros.h>

#include <atomic>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "ros_comm/endpoints/topic_names.h"
#include "ros_comm/endpoints/topics.h"
#include "ros_comm/node.h"
#include "ros_comm/services/gate.h"
#include "ros_comm/services/offered_service.h"
#include "state/abilities/abilities.h"

namespace ambf::ros_comm {

class Services {
 public:
  Services(Node& node, const std::string& world_topic, const TopicNames& topics, const state::Abilities& simulation);
  ~Services();  // those under way are answered at once
  Services(const Services&) = delete;
  Services& operator=(const Services&) = delete;

 private:
  template <class Service>
  void offer(const std::string& name,
             bool (Services::*answer)(typename Service::Request&, typename Service::Response&));

  bool load(ambf_msgs::Load::Request& request, ambf_msgs::Load::Response& response);
  bool unload(ambf_msgs::Unload::Request& request, ambf_msgs::Unload::Response& response);
  bool remove(ambf_msgs::Remove::Request& request, ambf_msgs::Remove::Response& response);
  bool save(ambf_msgs::Save::Request& request, ambf_msgs::Save::Response& response);
  bool list(ambf_msgs::List::Request& request, ambf_msgs::List::Response& response);
  bool step(ambf_msgs::Step::Request& request, ambf_msgs::Step::Response& response);
  bool snapshot(ambf_msgs::Snapshot::Request& request, ambf_msgs::Snapshot::Response& response);
  bool restore(ambf_msgs::Restore::Request& request, ambf_msgs::Restore::Response& response);
  bool forget(ambf_msgs::Forget::Request& request, ambf_msgs::Forget::Response& response);

  bool record(ambf_msgs::Record::Request& request, ambf_msgs::Record::Response& response);
  bool hold(ambf_msgs::Hold::Request& request, ambf_msgs::Hold::Response& response);
  bool tune(ambf_msgs::Tune::Request& request, ambf_msgs::Tune::Response& response);
  bool received(ambf_msgs::Received::Request& request, ambf_msgs::Received::Response& response);

  // For recorders. The request's commands are moved away.
  void publish_commands(ros::Time received, std::uint32_t first_step, std::uint32_t last_step,
                        ambf_msgs::Step::Request& request);
  bool ending() const { return closing_ || node_.stopping(); }
  // Starts something that ends in a completion and waits for that, or for the end of this object.
  template <class Start>
  state::Outcome wait_for(Start start) const;

  Node& node_;
  const std::string world_topic_;
  const TopicNames& topics_;
  const state::Abilities simulation_;
  std::atomic<bool> closing_{false};
  const std::shared_ptr<Gate> gate_ = std::make_shared<Gate>();
  TopicPublisher<ambf_msgs::StepCommands> step_commands_;
  std::vector<std::unique_ptr<Offered>> offered_;
};

}  // namespace ambf::ros_comm
