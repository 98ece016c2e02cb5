// Reads descriptions of arms that offer the interface of the Collaborative Robotics Toolkit (docs/crtk.md): which
// joints of which model, with which kinematics, how fast. Never throws. Any thread.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/diagnostic.h"
#include "kinematics/arm.h"

namespace ambf::adf {

// A sprung handle without a motor: opening = scale x position of its joint + offset.
struct CrtkGripper {
  std::string joint;  // of the ADF model
  double scale = 1.0, offset = 0.0;
  double closed_below = 0.0;  // rad
};

// A tool's model, which can take the place of the one that an arm's model has (docs/crtk.md).
struct CrtkInstrument {
  std::string tool;                 // of the kinematics
  std::string file;                 // ADF
  std::string carrier;              // the body of the arm's model that it joins: identifier of its block
  std::vector<std::string> bodies;  // its own
  std::vector<std::string> joints;  // of the arm's kinematics: it brings them
};

// Lists are by joint of `kinematics`; m and rad, s.
struct CrtkArm {
  std::string name;  // its namespace on ROS
  std::string file;
  int line = 0, column = 0;            // of its name
  int base_line = 0, base_column = 0;  // of the key `base`
  int kinematics_line = 0, kinematics_column = 0;
  std::string base;                    // body of the scene through which its joints are commanded
  kinematics::Arm kinematics;          // with its tool, and the names of the model's joints
  std::vector<kinematics::Arm> tools;  // the same with each tool that the kinematics know
  std::string frame;                   // frame_id of its poses
  math::Pose T_frame_base;             // of the kinematics' base
  double rate_hz = 100.0;              // of what it publishes, in wall time
  std::string view;  // arm whose tip is the frame of poses instead, where that arm is served too; "": none
  std::vector<double> max_velocity, max_acceleration;
  double jaw_max_velocity = 0.0, jaw_max_acceleration = 0.0;
  bool homing_moves = true;  // homing takes it to the kinematics' home; else it is homed from the start
  bool brakes = false;       // DISABLED it keeps its set-points
  std::optional<CrtkGripper> gripper;
  std::vector<CrtkInstrument> instruments;
  std::string camera;  // of an endoscope: it turns with the endoscope's type; "": none

  bool has_jaw() const { return kinematics.jaw.has_value() && !kinematics.adf_jaw.empty(); }
  bool is_endoscope() const;  // its tools are the directions of endoscopes
  bool is_master() const { return kinematics.solver == kinematics::Solver::gimbal; }
};

struct CrtkArmsResult {
  std::vector<CrtkArm> arms;  // without those that are wrong
  base::Diagnostics diagnostics;
};

CrtkArmsResult load_crtk_arms(const std::string& path);
// `path` is used in messages, and its folder is where relative paths start.
CrtkArmsResult parse_crtk_arms(const std::string& text, const std::string& path);

}  // namespace ambf::adf
