// One arm: its control, its joints in the scene, its topics. C++17.
#pragma once

#include <atomic>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "adf/crtk_arms.h"
#include "base/log.h"
#include "comm/publish_rate.h"
#include "crtk/arm_commands.h"
#include "crtk/arm_control.h"
#include "crtk/arm_joints.h"
#include "state/abilities/abilities.h"

namespace ambf::crtk {

class ArmTopics;

class ServedArm {
 public:
  ServedArm(adf::CrtkArm arm, const state::Abilities& simulation, base::Log& log);
  ~ServedArm();
  ServedArm(const ServedArm&) = delete;
  ServedArm& operator=(const ServedArm&) = delete;

  // A frame newer than the last one. One thread.
  void update(const state::Frame& frame);
  // Whether its joints have been found, but it has no topics yet. Any thread.
  bool wants_topics() const { return found_ && !open_; }
  // May take long; another thread than update(). Throws when ROS does not take a topic.
  void open(ros_comm::Node& node, const std::string& name_space);
  void close();
  const std::string& name() const { return arm_.name; }

 private:
  void search(const state::Structure& structure);
  void execute(const Act& act);
  void post();
  void announce();

  const adf::CrtkArm arm_;
  const state::Abilities simulation_;
  base::Log& log_;
  std::atomic<bool> found_{false}, open_{false};

  std::mutex mutex_;  // guards all below; held for microseconds, never by the physics thread
  ArmControl control_;
  ArmJoints joints_;
  bool bound_ = false, warned_ = false, commands_ = false;
  std::uint64_t structure_version_ = 0, sequence_ = 0;
  std::unique_ptr<state::CommandPort> port_;
  state::RigidBodyCommand command_;
  comm::PublishRate rate_;
  std::unique_ptr<ArmTopics> topics_;

  std::unique_ptr<ArmCommands> commands_in_;  // the opening thread's
};

}  // namespace ambf::crtk
