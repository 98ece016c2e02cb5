// ambf_arm_guard TOPIC ...: waits beside a simulator that sends forces to these topics (geometry_msgs/WrenchStamped)
// and sends zero when it is ended, which the simulator's end does in every case (ros_comm/child_program.h).
#include <geometry_msgs/WrenchStamped.h>
#include <ros/ros.h>

#include <csignal>
#include <vector>

int main(int argc, char** argv) {
  constexpr double kMasterRetry_s = 0.3;
  constexpr int kZeros = 10;
  constexpr double kBetween_s = 0.003;
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
  std::vector<ros::Publisher> publishers;
  for (int i = 1; i < argc; ++i) publishers.push_back(node.advertise<geometry_msgs::WrenchStamped>(argv[i], 1));
  int signal = 0;
  sigwait(&ends, &signal);
  for (int i = 0; i < kZeros; ++i) {
    geometry_msgs::WrenchStamped zero;
    zero.header.stamp = ros::Time::now();
    for (const ros::Publisher& publisher : publishers) publisher.publish(zero);
    ros::WallDuration(kBetween_s).sleep();
  }
  return 0;
}
