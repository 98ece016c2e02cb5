// ambf_arm_guard TOPIC, or ambf_arm_guard --efforts TOPIC: waits beside a simulator that sends forces to this topic
// (geometry_msgs/WrenchStamped, or sensor_msgs/JointState) and sends zero when it is ended, which the simulator's end
// does in every case (ros_comm/child_program.h).
#include <geometry_msgs/WrenchStamped.h>
#include <ros/ros.h>
#include <sensor_msgs/JointState.h>

#include <csignal>
#include <cstdio>
#include <string>

#include "dvrk_arm/mtm.h"

int main(int argc, char** argv) {
  constexpr double kMasterRetry_s = 0.3;
  constexpr int kZeros = 10;
  constexpr double kBetween_s = 0.003;
  const std::string option = argc > 2 ? argv[1] : "";
  if (argc < 2 || argc > 3 || (argc == 3 && option != "--efforts")) {
    std::fprintf(stderr, "usage: ambf_arm_guard [--efforts] TOPIC\n");
    return 2;
  }
  const char* const topic = argv[argc - 1];
  sigset_t ends;
  sigemptyset(&ends);
  sigaddset(&ends, SIGTERM);
  sigaddset(&ends, SIGINT);
  sigaddset(&ends, SIGHUP);
  pthread_sigmask(SIG_BLOCK, &ends, nullptr);  // before ROS's threads start
  const ros::M_string remappings{{"__log", "/dev/null"}};
  ros::init(remappings, "ambf_arm_guard",
            ros::init_options::NoSigintHandler | ros::init_options::NoRosout | ros::init_options::AnonymousName);
  ros::master::setRetryTimeout(ros::WallDuration(kMasterRetry_s));
  ros::NodeHandle node;
  const bool efforts = !option.empty();
  const ros::Publisher publisher = efforts ? node.advertise<sensor_msgs::JointState>(topic, 1)
                                           : node.advertise<geometry_msgs::WrenchStamped>(topic, 1);
  int signal = 0;
  sigwait(&ends, &signal);
  for (int i = 0; i < kZeros; ++i) {
    if (efforts) {
      sensor_msgs::JointState zero;
      zero.header.stamp = ros::Time::now();
      zero.effort.assign(ambf::dvrk_arm::kMtmJoints, 0.0);
      publisher.publish(zero);
    } else {
      geometry_msgs::WrenchStamped zero;
      zero.header.stamp = ros::Time::now();
      publisher.publish(zero);
    }
    ros::WallDuration(kBetween_s).sleep();
  }
  return 0;
}
