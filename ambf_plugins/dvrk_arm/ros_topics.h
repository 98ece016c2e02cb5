// What a device behind ROS topics consists of, as the device file describes it: arms of the da Vinci research kit and
// other CRTK masters (type ros_arm), and any device with a pose, a twist or a Joy (type ros_generic). C++17.
#pragma once

#include <string>
#include <vector>

#include "devices/driver.h"
#include "devices/drivers/rate_pose.h"

namespace ambf::dvrk_arm {

struct RosTopics {
  // One of these moves the hand.
  std::string pose, twist, joy;
  std::string jaw;                                         // an angle
  std::string state;                                       // whether the arm can be used
  std::vector<std::string> operator_present;               // any of them
  std::vector<std::string> buttons;                        // pedals and switches by their numbers; empty: none
  std::string wrench;                                      // out; empty: no forces
  std::string joints, efforts;                             // of an MTM: forces go out as efforts; empty: as a wrench
  std::string gravity_compensation, absolute_orientation;  // out, Bool

  bool wrench_absolute = false;  // in the axes of the pose's frame, else in those of the tip
  double jaw_closed_rad = 0.0, jaw_open_rad = 1.0;
  devices::RateAxes axes;  // of the Joy
  devices::RatePose::Settings rates;

  devices::DriverRequest request;  // with the offsets in force
  devices::DriverTraits traits;
  std::string problem;  // what is wrong with the options; empty: nothing
};

// Names of CRTK and dVRK 2, all of them options: namespace, pose, jaw, state, operator present, button 0 .. button 5,
// wrench, absolute wrench, null space, joints, efforts, gravity compensation, gripper closed, gripper open,
// max force, max torque.
RosTopics arm_topics(const devices::DriverRequest& request);

// Options pose, twist, joy, axes/x .. axes/yaw, speed, turn speed, dead zone, jaw, closed, open, wrench, max force,
// max torque.
RosTopics generic_topics(const devices::DriverRequest& request);

}  // namespace ambf::dvrk_arm
