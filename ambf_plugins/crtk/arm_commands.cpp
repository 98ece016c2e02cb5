#include "crtk/arm_commands.h"

#include <crtk_msgs/CartesianImpedance.h>
#include <crtk_msgs/QueryForwardKinematics.h>
#include <crtk_msgs/QueryInverseKinematics.h>
#include <crtk_msgs/StringStamped.h>
#include <geometry_msgs/PoseStamped.h>
#include <geometry_msgs/Quaternion.h>
#include <geometry_msgs/TwistStamped.h>
#include <geometry_msgs/WrenchStamped.h>
#include <sensor_msgs/JointState.h>
#include <std_msgs/Bool.h>
#include <std_msgs/Empty.h>
#include <std_msgs/Float64.h>
#include <std_msgs/String.h>

#include <algorithm>
#include <cmath>

#include "crtk/standard_messages.h"
#include "math/rotation.h"
#include "ros_comm/endpoints/conversions.h"
#include "ros_comm/endpoints/topics.h"

namespace ambf::crtk {

namespace {

using sensor_msgs::JointState;

constexpr const char* kCrtkVersion = "1.1.0";  // of the names of topics and of the states

// The values in the arm's order; else why the message is refused. Without names, or with "0", "1" .., they are in it.
std::string in_order(const JointState& message, const std::vector<double>& values,
                     const std::vector<std::string>& names, Joints& out) {
  for (const auto* list : {&message.position, &message.velocity, &message.effort}) {
    if (!list->empty() && list->size() != values.size()) return "its lists have different lengths";
  }
  out = values;
  if (message.name.empty() || values.size() != names.size()) return {};
  if (message.name.size() != values.size()) return "it has another number of names than of values";
  bool numbered = true;
  for (std::size_t i = 0; i < names.size(); ++i) numbered &= message.name[i] == std::to_string(i);
  if (numbered) return {};
  std::vector<bool> given(names.size(), false);
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto found = std::find(names.begin(), names.end(), message.name[i]);
    const auto at = static_cast<std::size_t>(found - names.begin());
    if (found == names.end() || given[at]) {
      std::string known;
      for (const std::string& name : names) known += (known.empty() ? "" : ", ") + name;
      return "it names '" + message.name[i].substr(0, 60) + "'; the joints are " + known;
    }
    given[at] = true;
    out[at] = values[i];
  }
  return {};
}

math::Quat turned(const geometry_msgs::Quaternion& q) { return {q.x, q.y, q.z, q.w}; }

kinematics::Chain first_joints(const kinematics::Chain& chain, std::size_t count) {
  if (count >= chain.size()) return chain;
  kinematics::Chain part = chain;
  part.steps.clear();
  for (const kinematics::Step& step : chain.steps) {
    if (step.joint < static_cast<int>(count)) part.steps.push_back(step);
  }
  part.tip = {};
  return part;
}

}  // namespace

ArmCommands::ArmCommands(ros_comm::Node& node, const std::string& prefix, const adf::CrtkArm& arm, Execute execute)
    : node_(node), prefix_(prefix), arm_(arm), execute_(std::move(execute)) {
  take_joints();
  take_poses();
  take_wrenches();
  if (arm_.has_jaw()) take_jaw();
  if (arm_.is_master()) take_master();
  take_others();
  offer_services();
}

ArmCommands::~ArmCommands() {
  gate_->close();
  taken_.clear();
}

template <class Message>
void ArmCommands::take(const std::string& name, Does<Message> does) {
  struct Subscriber final : Taken {
    Subscriber(ros_comm::Node& node, const std::string& topic,
               typename ros_comm::CommandSubscriber<Message>::Callback callback,
               typename ros_comm::CommandSubscriber<Message>::Refused refused)
        : subscriber(node, topic, std::move(callback), std::move(refused)) {}
    ros_comm::CommandSubscriber<Message> subscriber;
  };
  ros_comm::Traffic& traffic = node_.traffic();
  const std::string topic = prefix_ + "/" + name;
  const auto refused = [&traffic, topic](const std::string& why) { traffic.refuse(topic, why); };
  const auto callback = [this, &traffic, refused,
                         does = std::move(does)](const ros::MessageEvent<const Message>& event) {
    std::string why;
    execute_([&](ArmControl& control) { return why = does(control, *event.getConstMessage()); });
    why.empty() ? static_cast<void>(++traffic.accepted) : refused(why);
  };
  taken_.push_back(std::make_unique<Subscriber>(node_, topic, callback, refused));
}

void ArmCommands::take_joints() {
  const std::vector<std::string>& names = arm_.kinematics.names;
  using Method = std::string (ArmControl::*)(const Joints&);
  const auto joints = [&](const char* name, std::vector<double> JointState::*field, Method method, bool move) {
    take<JointState>(name, [names, name, field, method, move](ArmControl& control, const JointState& message) {
      Joints values;
      const std::string why = in_order(message, message.*field, names, values);
      return why.empty() ? (control.*method)(values) : control.refuse(name, why, move);
    });
  };
  joints("servo_jp", &JointState::position, &ArmControl::servo_jp, false);
  joints("servo_jr", &JointState::position, &ArmControl::servo_jr, false);
  joints("servo_jf", &JointState::effort, &ArmControl::servo_jf, false);
  joints("move_jp", &JointState::position, &ArmControl::move_jp, true);
  joints("move_jr", &JointState::position, &ArmControl::move_jr, true);
}

void ArmCommands::take_poses() {
  using geometry_msgs::PoseStamped;
  using Method = std::string (ArmControl::*)(const math::Pose&);
  const auto pose = [&](const char* name, Method method) {
    take<PoseStamped>(name, [method](ArmControl& control, const PoseStamped& message) {
      return (control.*method)(ros_comm::from_ros(message.pose));
    });
  };
  pose("servo_cp", &ArmControl::servo_cp);
  pose("servo_cr", &ArmControl::servo_cr);
  pose("move_cp", &ArmControl::move_cp);
  pose("move_cr", &ArmControl::move_cr);
  pose("set_base_frame", &ArmControl::set_base_frame);
}

void ArmCommands::take_wrenches() {
  using geometry_msgs::WrenchStamped;
  const auto wrench = [&](const char* name, WrenchFrame frame) {
    take<WrenchStamped>(name, [frame](ArmControl& control, const WrenchStamped& message) {
      return control.servo_cf(frame,
                              {ros_comm::from_ros(message.wrench.force), ros_comm::from_ros(message.wrench.torque)});
    });
  };
  wrench("body/servo_cf", WrenchFrame::body);
  wrench("spatial/servo_cf", WrenchFrame::spatial);
  take<geometry_msgs::TwistStamped>("servo_cv", [](ArmControl& control, const geometry_msgs::TwistStamped& message) {
    return control.servo_cv({ros_comm::from_ros(message.twist.linear), ros_comm::from_ros(message.twist.angular)});
  });
  take<std_msgs::Bool>("body/set_cf_orientation_absolute", [](ArmControl& control, const std_msgs::Bool& message) {
    control.set_wrench_axes_absolute(message.data != 0);
    return std::string();
  });
}

void ArmCommands::take_jaw() {
  using Method = std::string (ArmControl::*)(double);
  const auto jaw = [&](const char* name, std::vector<double> JointState::*field, Method method, bool move) {
    take<JointState>(name, [name, field, method, move](ArmControl& control, const JointState& message) {
      const std::vector<double>& values = message.*field;
      if (values.size() != 1) {
        return control.refuse(name, "it has " + std::to_string(values.size()) + " values; expected 1", move);
      }
      return (control.*method)(values[0]);
    });
  };
  jaw("jaw/servo_jp", &JointState::position, &ArmControl::jaw_servo_jp, false);
  jaw("jaw/servo_jf", &JointState::effort, &ArmControl::jaw_servo_jf, false);
  jaw("jaw/move_jp", &JointState::position, &ArmControl::jaw_move_jp, true);
}

void ArmCommands::take_master() {
  using crtk_msgs::CartesianImpedance;
  using ros_comm::from_ros;
  take<CartesianImpedance>("servo_ci", [](ArmControl& control, const CartesianImpedance& message) {
    const auto side = [](const crtk_msgs::CartesianImpedanceHalfPlaneGains& gains) {
      return Impedance::Side{from_ros(gains.p), from_ros(gains.d), from_ros(gains.bias), from_ros(gains.deadband)};
    };
    return control.servo_ci({turned(message.force_orientation), from_ros(message.force_position),
                             turned(message.torque_orientation), side(message.position_positive),
                             side(message.position_negative), side(message.orientation_positive),
                             side(message.orientation_negative)});
  });
  take<geometry_msgs::Quaternion>("lock_orientation",
                                  [](ArmControl& control, const geometry_msgs::Quaternion& message) {
                                    return control.lock_orientation(turned(message));
                                  });
  take<std_msgs::Empty>("unlock_orientation",
                        [](ArmControl& control, const std_msgs::Empty&) { return control.unlock_orientation(); });
}

void ArmCommands::take_others() {
  take<crtk_msgs::StringStamped>("state_command", [](ArmControl& control, const crtk_msgs::StringStamped& message) {
    return control.state_command(message.string);
  });
  take<std_msgs::Empty>("hold", [](ArmControl& control, const std_msgs::Empty&) { return control.hold(); });
  take<std_msgs::Empty>("free", [](ArmControl& control, const std_msgs::Empty&) { return control.free(); });
  const auto without_effect = [&](const char* name, const char* why) {
    take<std_msgs::Bool>(name, [name, why](ArmControl& control, const std_msgs::Bool&) {
      control.say(std::string(name) + " has no effect: " + why);
      return std::string();
    });
  };
  without_effect("use_gravity_compensation", "what gravity acts on an arm is said in its model's file");
  if (arm_.has_jaw()) {
    without_effect("emulate_tool_present", "the tool is part of the model");
    without_effect("emulate_adapter_present", "the tool is part of the model");
  }
  const auto named = [&](const char* name, std::string (ArmControl::*method)(const std::string&)) {
    take<std_msgs::String>(name, [method](ArmControl& control, const std_msgs::String& message) {
      return (control.*method)(message.data);
    });
  };
  if (arm_.is_endoscope()) {
    named("set_endoscope_type", &ArmControl::set_endoscope_type);
  } else if (!arm_.kinematics.tool.empty()) {
    named("set_tool_type", &ArmControl::set_tool_type);
  }
  const auto ratio = [&](const char* name, bool velocity, bool acceleration) {
    take<std_msgs::Float64>(name, [=](ArmControl& control, const std_msgs::Float64& message) {
      return control.set_ratio(velocity, acceleration, message.data);
    });
  };
  ratio("trajectory_j/set_ratio", true, true);
  ratio("trajectory_j/set_ratio_v", true, false);
  ratio("trajectory_j/set_ratio_a", false, true);
}

void ArmCommands::offer_services() {
  using Forward = crtk_msgs::QueryForwardKinematics;
  using Inverse = crtk_msgs::QueryInverseKinematics;
  // The arm with its present tool, and its base.
  struct Now {
    kinematics::Arm arm;
    math::Pose base;
    bool base_known = true;
  };
  const auto present = [this] {
    Now now;
    execute_([&](ArmControl& control) {
      now = {control.description().kinematics, control.base_frame(), control.knows_base_frame()};
      return std::string();
    });
    return now;
  };
  const auto forward = [](const Now& now, Forward::Request& request, Forward::Response& response) {
    const bool finite = std::all_of(request.jp.begin(), request.jp.end(), [](double v) { return std::isfinite(v); });
    const bool fits = request.jp.size() <= now.arm.size();
    response.result = finite && fits && now.base_known ? 1 : 0;
    response.cp.orientation.w = 1.0;
    if (response.result != 0) {
      const kinematics::Chain part = first_joints(now.arm, request.jp.size());
      response.cp = ros_comm::to_ros(now.base * kinematics::forward(part, request.jp));
    } else if (!now.base_known) {
      response.message = kNoView;
    } else {
      response.message = fits ? "a value is not finite"
                              : "jp has " + std::to_string(request.jp.size()) + " values; expected at most " +
                                    std::to_string(now.arm.size());
    }
    return true;
  };
  services_.push_back(std::make_unique<ros_comm::OfferedService<Trigger>>(
      node_, prefix_ + "/crtk_version", gate_, [](TriggerRequest&, TriggerResponse& response) {
        response.success = 1;
        response.message = kCrtkVersion;
        return true;
      }));
  services_.push_back(std::make_unique<ros_comm::OfferedService<Forward>>(
      node_, prefix_ + "/forward_kinematics", gate_,
      [=](Forward::Request& request, Forward::Response& response) { return forward(present(), request, response); }));
  services_.push_back(std::make_unique<ros_comm::OfferedService<Forward>>(
      node_, prefix_ + "/local/forward_kinematics", gate_, [=](Forward::Request& request, Forward::Response& response) {
        Now now = present();
        now.base = {};
        now.base_known = true;
        return forward(now, request, response);
      }));
  services_.push_back(std::make_unique<ros_comm::OfferedService<Inverse>>(
      node_, prefix_ + "/inverse_kinematics", gate_, [=](Inverse::Request& request, Inverse::Response& response) {
        const Now now = present();
        if (!now.base_known) {
          response.result = 0;
          response.jp = request.jp;
          response.message = kNoView;
          return true;
        }
        math::Pose pose = ros_comm::from_ros(request.cp);
        const double norm = math::norm(pose.orientation);
        if (std::abs(norm - 1.0) < 0.1) pose.orientation = math::normalized(pose.orientation);
        const kinematics::Answer answer = kinematics::inverse(now.arm, math::inverse(now.base) * pose, request.jp);
        response.result = answer.reached() ? 1 : 0;
        response.jp = answer.joints;
        response.message = kinematics::to_string(answer.status);
        if (answer.status == kinematics::Status::out_of_limits && answer.joint >= 0) {
          response.message += ": " + now.arm.names[static_cast<std::size_t>(answer.joint)];
        } else if (answer.status == kinematics::Status::unreachable) {
          response.message += ": jp leads to within " + std::to_string(answer.distance) + " m";
        }
        return true;
      }));
}

}  // namespace ambf::crtk
