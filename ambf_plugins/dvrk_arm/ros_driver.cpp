#include "dvrk_arm/ros_driver.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <mutex>
#include <shared_mutex>
#include <utility>

#include "base/clock.h"
#include "base/realtime.h"

namespace ambf::dvrk_arm {

namespace {

using namespace std::chrono_literals;
using devices::Reading;
using devices::Sample;

constexpr auto kFirstSample = 2000ms;     // to connect and to get one
constexpr unsigned kManyUnstamped = 100;  // the arm is there, and has no pose
constexpr auto kMeasured = 300ms;         // over which the rate is measured
constexpr auto kPause = 10ms;
constexpr double kQueueWait_s = 0.1;
constexpr std::int64_t kLost_ns = 500'000'000;
constexpr std::int64_t kTwistLife_ns = 200'000'000;  // senders of twists that stop end the motion
constexpr double kWantedRate = 500.0;                // Hz
constexpr double kUnitTolerance = 1e-3;
constexpr unsigned kSwitchQueue = 1;
constexpr bool kLatched = true;

}  // namespace

RosDriver::RosDriver(RosHost& host, base::Log& log, RosTopics topics)
    : host_(host), log_(log), topics_(std::move(topics)), hand_(topics_.rates) {
  host_.add(*this);
}

RosDriver::~RosDriver() {
  host_.remove(*this);
  close();
}

std::string RosDriver::open() {
  if (!topics_.problem.empty()) return topics_.problem;
  const RosHost::Lease lease(host_);
  end_session();
  if (lease.node() == nullptr) return "ROS is not running (yet, or --no-ros)";
  if (!lease.node()->connected()) return "no ROS master answers at " + ros::master::getURI() + " yet";
  std::string problem;
  try {
    problem = open_topics(*lease.node());
  } catch (const std::exception& e) {
    problem = std::string("ROS: ") + e.what();
  }
  if (problem.empty() && !topics_.pose.empty()) problem = wait_for_poses();
  if (!problem.empty()) end_session();
  return problem;
}

std::string RosDriver::open_topics(ros_comm::Node& node) {
  node_ = &node;
  start_afresh();
  const std::string& moves = !topics_.pose.empty()    ? topics_.pose
                             : !topics_.twist.empty() ? topics_.twist
                                                      : topics_.joy;
  subscribe(moves, [this](const Message& message) {
    if (!topics_.pose.empty()) return on_pose(message);
    topics_.twist.empty() ? on_joy(message) : on_twist(message);
  });
  if (!topics_.joy.empty() && topics_.joy != moves) {
    subscribe(topics_.joy, [this](const Message& message) { on_joy(message); });
  }
  if (!topics_.jaw.empty()) {
    subscribe(topics_.jaw, [this](const Message& message) {
      double angle = 0.0;
      const std::string problem = read_angle(message, angle);
      if (problem.empty() && std::isfinite(angle)) {
        const double opening = (angle - topics_.jaw_closed_rad) / (topics_.jaw_open_rad - topics_.jaw_closed_rad);
        input_.jaw = std::clamp(opening, 0.0, 1.0);
        input_.has_jaw = true;
      }
      post(problem, message);
    });
  }
  if (!topics_.state.empty()) {
    subscribe(topics_.state, [this](const Message& message) { post(read_state(message, input_.not_ready), message); });
  }
  if (!topics_.joints.empty()) {
    subscribe(topics_.joints, [this](const Message& message) {
      const std::string problem = read_joints(message, input_.joints, input_.joint_velocities);
      input_.has_joints |= problem.empty();
      post(problem, message);
    });
  }
  for (unsigned i = 0; i < topics_.buttons.size(); ++i) {
    if (topics_.buttons[i].empty()) continue;
    subscribe(topics_.buttons[i], [this, i](const Message& message) { on_button(i, message); });
  }
  for (const std::string& topic : topics_.operator_present) {
    subscribe(topic, [this](const Message& message) {
      const std::string problem = read_switch(message, input_.present);
      input_.presence_known |= problem.empty();
      post(problem, message);
    });
    presence_.push_back(std::move(subscribers_.back()));
    subscribers_.pop_back();
  }
  start_thread();
  const auto set = [this](const std::string& topic, bool value) {
    if (topic.empty()) return;
    switches_.push_back(std::make_unique<Publisher>(*node_, topic, kSwitchQueue, kLatched));
    std_msgs::Bool message;
    message.data = value;
    switches_.back()->publish(message);
  };
  set(topics_.gravity_compensation, true);
  set(topics_.absolute_orientation, topics_.wrench_absolute);
  return open_forces();
}

std::string RosDriver::open_forces() {
  if (!(topics_.traits.force || topics_.traits.torque)) return {};
  const bool by_efforts = !topics_.efforts.empty();
  const std::string& topic = by_efforts ? topics_.efforts : topics_.wrench;
  std::string problem;
  sender_ = std::make_unique<ForceSender>(
      *node_, topic, by_efforts ? ForceSender::Kind::efforts : ForceSender::Kind::wrench, forces_, problem);
  if (problem.empty()) return {};
  return "nothing would end the forces of " + topic + " if this program were killed: " + problem;
}

void RosDriver::subscribe(const std::string& topic, AnySubscriber::Callback callback) {
  const std::shared_lock<std::shared_mutex> lock(node_->topic_list());
  subscribers_.push_back(std::make_unique<AnySubscriber>(*node_, queue_, topic, std::move(callback)));
}

void RosDriver::start_afresh() {
  stop_ = gone_ = false;
  unstamped_ = refused_ = 0;
  arrived_ = 0;
  input_ = {};
  newest_stamp_ns_ = 0;
  seen_ = 0;
  ready_ = false;
  hand_.pause();
  slot_.post(input_, base::steady_ns());
  // Before anything can arrive: a subscription that fills up while its queue is disabled never calls again.
  queue_.enable();
}

void RosDriver::start_thread() {
  thread_ = std::thread([this] {
    base::set_thread_name("arm topics");
    base::request_precise_timers();
    bool was_there = false;
    while (!stop_) {
      queue_.callAvailable(ros::WallDuration(kQueueWait_s));
      const bool there = source_has_publisher();
      gone_ = was_there && !there;
      was_there |= there;
    }
  });
}

std::string RosDriver::wait_for_poses() {
  const auto end = std::chrono::steady_clock::now() + kFirstSample;
  while (arrived_ == 0 && unstamped_ < kManyUnstamped && std::chrono::steady_clock::now() < end && !host_.ending())
    std::this_thread::sleep_for(kPause);
  if (arrived_ == 0) {
    if (unstamped_ > 0) return topics_.pose + " has no valid pose (stamp 0): power and home the arm";
    if (refused_ > 0) return "the messages of " + topics_.pose + " cannot be read";
    return "nothing arrives on " + topics_.pose +
           ": start the arm's ROS program, or set 'driver: {namespace: " + "/ARM}' or its topics";
  }
  mention_rate();
  console_ = std::any_of(presence_.begin(), presence_.end(), [](const auto& s) { return s->publishers() > 0; });
  return {};
}

void RosDriver::mention_rate() {
  const std::uint64_t before = arrived_;
  const std::int64_t begin_ns = base::steady_ns();
  std::this_thread::sleep_for(kMeasured);
  const double rate_hz = static_cast<double>(arrived_ - before) / base::to_seconds(base::steady_ns() - begin_ns);
  topics_.traits.rate_hz = std::max(1.0, std::round(rate_hz));
  if (rate_hz >= kWantedRate) return;
  log_.warning(
      "%s: %.0f samples a second arrive on %s: motion and forces are softer than they could be. For a da Vinci, start "
      "its ROS program with -p 0.001 (its period of publishing; 0.01 is its default)",
      topics_.request.device.c_str(), rate_hz, topics_.pose.c_str());
}

void RosDriver::close() {
  const RosHost::Lease lease(host_);
  end_session();
}

void RosDriver::end_session() {
  if (node_ == nullptr) return;
  sender_.reset();  // zero goes first
  stop_ = true;
  queue_.disable();
  if (thread_.joinable()) thread_.join();
  gone_ = true;
  {
    const std::unique_lock<std::shared_mutex> lock(node_->topic_list());
    subscribers_.clear();
    presence_.clear();
  }
  switches_.clear();
  queue_.clear();
  node_ = nullptr;
}

// --- the reading thread ----------------------------------------------------------------------------------------------

void RosDriver::post(const std::string& problem, const Message& message) {
  if (problem.empty()) return slot_.post(input_, base::steady_ns());
  if (refused_++ == 0) {
    log_.warning("%s: a message is refused: %s (%s)", topics_.request.device.c_str(), problem.c_str(),
                 message.type.c_str());
  }
}

void RosDriver::on_pose(const Message& message) {
  StampedPose pose;
  const std::string problem = read_pose(message, pose);
  if (!problem.empty()) return post(problem, message);
  if (pose.stamped && pose.stamp_ns == 0) {
    ++unstamped_;
    return;
  }
  // The same sample again, or an older one, is no sample.
  if (pose.stamped && pose.stamp_ns <= newest_stamp_ns_) return;
  newest_stamp_ns_ = pose.stamp_ns;
  input_.T_base_tip = pose.pose;
  input_.pose_ns = base::steady_ns();
  ++input_.poses;
  ++arrived_;
  post({}, message);
}

void RosDriver::on_twist(const Message& message) {
  math::Twist twist;
  const std::string problem = read_twist(message, twist);
  if (problem.empty() && math::is_finite(twist)) {
    const double speed = std::max(topics_.rates.speed_m_s, 1e-9), turn = std::max(topics_.rates.turn_rad_s, 1e-9);
    input_.deflections = {twist.linear.x / speed, twist.linear.y / speed, twist.linear.z / speed,
                          twist.angular.x / turn, twist.angular.y / turn, twist.angular.z / turn};
    input_.twist_ns = base::steady_ns();
  }
  post(problem, message);
}

void RosDriver::on_joy(const Message& message) {
  JoyValues joy;
  const std::string problem = read_joy(message, joy);
  if (problem.empty()) {
    input_.buttons = joy.buttons;
    if (topics_.pose.empty() && topics_.twist.empty()) {
      input_.deflections = topics_.axes.deflections([&](unsigned number) {
        return number < joy.axes.size() && std::isfinite(joy.axes[number]) ? joy.axes[number] : 0.0;
      });
    }
  }
  post(problem, message);
}

void RosDriver::on_button(unsigned number, const Message& message) {
  bool down = false;
  const std::string problem = read_switch(message, down);
  const std::uint64_t bit = std::uint64_t{1} << number;
  if (problem.empty()) input_.buttons = down ? input_.buttons | bit : input_.buttons & ~bit;
  post(problem, message);
}

bool RosDriver::source_has_publisher() const { return !subscribers_.empty() && subscribers_.front()->publishers() > 0; }

// --- the device's thread ---------------------------------------------------------------------------------------------

void RosDriver::fill_ready(const Input& input, Sample& sample) const {
  sample.not_ready = input.not_ready;
  // Without a console nobody can say that the operator is absent.
  const bool absent = input.presence_known ? !input.present : console_;
  if (absent && *sample.not_ready == 0) sample.not_ready = "the operator is absent";
  sample.ready = *sample.not_ready == 0;
}

Reading RosDriver::read(Sample& sample, double /*max_wait_s*/) {
  slot_.refresh();
  const Input& input = slot_.value();
  const std::int64_t now_ns = base::steady_ns();
  if (gone_.load(std::memory_order_relaxed)) return Reading::lost;
  sample = {};
  if (topics_.pose.empty()) {
    const bool stale = !topics_.twist.empty() && now_ns - input.twist_ns > kTwistLife_ns;
    sample.stamp_ns = now_ns;
    sample.T_u_tip = hand_.advance(stale ? devices::Deflections{} : input.deflections, now_ns);
  } else {
    if (now_ns - input.pose_ns > kLost_ns) return Reading::lost;
    if (input.poses == seen_) return Reading::nothing_new;
    seen_ = input.poses;
    sample.stamp_ns = input.pose_ns;
    sample.T_u_tip = devices::to_user_frame(topics_.request, input.T_base_tip);
    R_base_tip_ = input.T_base_tip.orientation;
    // What is no rotation must not pass as one.
    if (std::abs(math::norm(R_base_tip_) - 1.0) > kUnitTolerance)
      sample.T_u_tip.orientation.w = std::numeric_limits<double>::quiet_NaN();
  }
  sample.jaw = input.jaw;
  sample.has_jaw = input.has_jaw;
  sample.buttons = input.buttons;
  fill_ready(input, sample);
  ready_ = sample.ready;
  return Reading::sample;
}

MtmJoints RosDriver::efforts_of(const math::Wrench& wrench_base) const {
  const Input& input = slot_.value();
  if (!input.has_joints) return {};
  MtmJoints efforts = mtm_efforts(mtm_frames(input.joints), wrench_base);
  // Where nobody holds the arm, its wrist stays as it is.
  if (ready_) efforts[3] += mtm_platform_effort(input.joints, input.joint_velocities);
  return mtm_bounded(efforts);
}

void RosDriver::write(const math::Wrench& wrench_u) {
  if (!topics_.traits.force && !topics_.traits.torque) return;
  const math::Wrench wrench_base = devices::to_base_axes(topics_.request, wrench_u);
  Force force;
  force.wrench = wrench_base;
  if (!topics_.efforts.empty()) {
    force.efforts = efforts_of(wrench_base);
  } else if (!topics_.wrench_absolute) {
    const math::Quat R_tip_base = math::inverse(R_base_tip_);
    force.wrench = {math::rotate(R_tip_base, wrench_base.force), math::rotate(R_tip_base, wrench_base.torque)};
  }
  forces_.post(force, base::steady_ns());
}

}  // namespace ambf::dvrk_arm
