#include "dvrk_arm/ros_topics.h"

#include <cmath>

#include "devices/drivers/options.h"
#include "math/rotation.h"

namespace ambf::dvrk_arm {

namespace {

using devices::DriverRequest;
using devices::Options;

constexpr double kMaxForce = 100.0, kMaxTorque = 10.0, kMaxStiffness = 1000.0;  // N, N m, N/m

// "none" switches a topic off; a leading slash makes it absolute.
std::string topic(Options& options, const std::string& name, const std::string& prefix, const std::string& usual) {
  const std::string text = options.text(name, usual);
  if (text.empty() || text == "none") return {};
  return text.front() == '/' || prefix.empty() ? text : prefix + "/" + text;
}

// How the masters of the da Vinci stand before their operator, where the device file does not say so.
void set_usual_mounting(DriverRequest& request) {
  const bool right = request.hardware_name == "MTMR", left = request.hardware_name == "MTML";
  if (!(right || left)) return;
  if (request.T_base_offset == math::Pose{}) {
    request.T_base_offset = {{right ? -0.181 : 0.181, -0.0163, -0.262}, math::from_rpy(0.0, 0.0, -M_PI / 2)};
  }
  if (request.T_tip_offset == math::Pose{}) request.T_tip_offset = {{}, math::from_rpy(0.0, M_PI / 2, 0.0)};
}

void read_force(Options& options, RosTopics& topics, double usual_force_N, double usual_torque_Nm) {
  devices::DriverTraits& traits = topics.traits;
  traits.max_force_N = options.number("max force", usual_force_N, 0.0, kMaxForce);
  traits.max_torque_Nm = options.number("max torque", usual_torque_Nm, 0.0, kMaxTorque);
  traits.max_stiffness_N_m = kMaxStiffness;
  traits.force = !topics.wrench.empty() && traits.max_force_N > 0.0;
  traits.torque = !topics.wrench.empty() && traits.max_torque_Nm > 0.0;
}

}  // namespace

RosTopics arm_topics(const DriverRequest& request) {
  constexpr double kUsualForce_N = 5.0, kUsualTorque_Nm = 0.2;
  RosTopics topics;
  topics.request = request;
  set_usual_mounting(topics.request);
  Options options(request);
  const std::string arm = options.text("namespace", "/" + request.hardware_name);
  // measured_cp is in the frame of the surgeon's display; the offsets fit the arm's own base.
  topics.pose = topic(options, "pose", arm, "local/measured_cp");
  topics.jaw = topic(options, "jaw", arm, "gripper/measured_js");
  topics.state = topic(options, "state", arm, "operating_state");
  const std::string present = options.text("operator present");
  if (present.empty()) {
    topics.operator_present = {"/console/operator_present", "/footpedals/operatorpresent"};
  } else if (present != "none") {
    topics.operator_present = {present};
  }
  const char* const usual[] = {"gripper/closed",       "/footpedals/clutch",    "/footpedals/camera",
                               "/footpedals/cam_plus", "/footpedals/cam_minus", "/footpedals/coag"};
  for (const char* name : usual) {
    topics.buttons.push_back(topic(options, "button " + std::to_string(topics.buttons.size()), arm, name));
  }
  topics.wrench = topic(options, "wrench", arm, "body/servo_cf");
  topics.gravity_compensation = topic(options, "gravity compensation", arm, "use_gravity_compensation");
  topics.absolute_orientation = topic(options, "absolute orientation", arm, "body/set_cf_orientation_absolute");
  topics.wrench_absolute = options.choice("absolute wrench", {"false", "true"}) == 1;
  const std::string joints = topic(options, "joints", arm, "measured_js");
  const std::string efforts = topic(options, "efforts", arm, "servo_jf");
  if (options.choice("null space", {"false", "true"}) == 1) {
    topics.joints = joints;
    topics.efforts = efforts;
  }
  topics.jaw_closed_rad = options.number("gripper closed", -M_PI / 3, -M_PI, M_PI);
  topics.jaw_open_rad = options.number("gripper open", M_PI / 3, -M_PI, M_PI);
  topics.traits.gripper = !topics.jaw.empty();
  topics.traits.buttons = static_cast<unsigned>(topics.buttons.size());
  read_force(options, topics, kUsualForce_N, kUsualTorque_Nm);
  topics.problem = options.problems();
  if (arm == "/") topics.problem = "a ros_arm needs a 'hardware name' or 'driver: {namespace: /ARM}'";
  if (topics.joints.empty() != topics.efforts.empty())
    topics.problem = "'null space: true' needs the topics 'joints' and 'efforts'";
  if (topics.jaw_closed_rad == topics.jaw_open_rad) topics.problem = "'gripper closed' equals 'gripper open'";
  return topics;
}

RosTopics generic_topics(const DriverRequest& request) {
  constexpr unsigned kMaxAxes = 32, kMaxButtons = 64;
  RosTopics topics;
  topics.request = request;
  Options options(request);
  topics.pose = topic(options, "pose", "", "");
  topics.twist = topic(options, "twist", "", "");
  topics.joy = topic(options, "joy", "", "");
  topics.jaw = topic(options, "jaw", "", "");
  topics.wrench = topic(options, "wrench", "", "");
  topics.wrench_absolute = true;
  topics.jaw_closed_rad = options.number("closed", 0.0, -1e3, 1e3);
  topics.jaw_open_rad = options.number("open", 1.0, -1e3, 1e3);
  std::vector<std::string> numbers;
  for (unsigned i = 0; i < kMaxAxes; ++i) numbers.push_back(std::to_string(i));
  topics.axes = devices::RateAxes::read(options, {"none", "none", "none", "none", "none", "none"}, numbers);
  // A twist is followed up to these speeds; a Joy at full deflection has them.
  topics.rates = devices::read_rate_settings(options, topics.joy.empty() ? devices::RatePose::Settings{1.0, 3.0, 0.0}
                                                                         : devices::RatePose::Settings{0.1, 1.0, 0.1});
  topics.traits.gripper = !topics.jaw.empty();
  topics.traits.buttons = topics.joy.empty() ? 0 : kMaxButtons;
  if (topics.pose.empty()) {
    topics.traits.event_driven = true;
    topics.traits.hold_at_start_s = 0.0;  // velocities: it rests where it starts
  }
  read_force(options, topics, 0.0, 0.0);
  topics.problem = options.problems();
  if (topics.problem.empty() && topics.pose.empty() && topics.twist.empty() &&
      (topics.joy.empty() || topics.traits.buttons == 0)) {
    topics.problem = "a ros_generic device needs 'driver: {pose: TOPIC}', 'twist: TOPIC' or 'joy: TOPIC'";
  }
  if (topics.jaw_closed_rad == topics.jaw_open_rad) topics.problem = "'closed' equals 'open'";
  return topics;
}

}  // namespace ambf::dvrk_arm
