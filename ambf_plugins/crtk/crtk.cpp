#include "crtk/crtk.h"

#include <rosgraph_msgs/Clock.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <thread>

#include "base/clock.h"
#include "base/realtime.h"
#include "comm/publish_rate.h"
#include "crtk/served_arm.h"
#include "crtk/standard_messages.h"
#include "ros_comm/endpoints/conversions.h"
#include "ros_comm/endpoints/topics.h"
#include "ros_comm/master.h"
#include "ros_comm/node.h"

namespace ambf::crtk {

namespace {

using namespace std::chrono_literals;

constexpr auto kFrameWait = 20ms;
constexpr auto kOpenEvery = 50ms;
constexpr double kFramesHz = 50.0;  // of tf, wall time
constexpr const char* kUseSimTime = "/use_sim_time";

// /clock, and the parameter that has clients follow it, for as long as this lives.
class Clock {
 public:
  explicit Clock(ros_comm::Node& node) : topic_(node, "/clock", 100) {
    ros_comm::master::set_parameter(kUseSimTime, XmlRpc::XmlRpcValue(true));
  }
  ~Clock() { ros_comm::master::delete_parameter(kUseSimTime); }
  Clock(const Clock&) = delete;
  Clock& operator=(const Clock&) = delete;

  void publish(std::int64_t now_ns) {
    if (now_ns == last_ns_ && !topic_.newcomers()) return;
    last_ns_ = now_ns;
    rosgraph_msgs::Clock message;
    message.clock.fromNSec(static_cast<std::uint64_t>(now_ns));
    topic_.publish(message);
  }

 private:
  ros_comm::TopicPublisher<rosgraph_msgs::Clock> topic_;
  std::int64_t last_ns_ = -1;
};

// The arms' frames on /tf: NAME_local is an arm's base, NAME its tip.
class FrameTopic {
 public:
  explicit FrameTopic(ros_comm::Node& node) : topic_(node, "/tf", 100), rate_(kFramesHz, kFramesHz) {}

  void publish(const std::vector<std::unique_ptr<ServedArm>>& arms) {
    if (topic_.subscribers() == 0 || !rate_.due(base::steady_ns(), true)) return;
    Transforms message;
    for (const auto& arm : arms) {
      const auto frames = arm->frames();
      if (!frames) continue;
      const auto add = [&](const std::string& child, const math::Pose& pose) {
        geometry_msgs::TransformStamped& made = message.transforms.emplace_back();
        made.header.stamp.fromNSec(static_cast<std::uint64_t>(frames->stamp_ns));
        made.header.frame_id = frames->frame;
        made.child_frame_id = child;
        const geometry_msgs::Pose as_message = ros_comm::to_ros(pose);
        made.transform.translation.x = as_message.position.x;
        made.transform.translation.y = as_message.position.y;
        made.transform.translation.z = as_message.position.z;
        made.transform.rotation = as_message.orientation;
      };
      add(arm->name() + "_local", frames->T_frame_base);
      add(arm->name(), frames->T_frame_tip);
    }
    if (!message.transforms.empty()) topic_.publish(message);
  }

 private:
  ros_comm::TopicPublisher<Transforms> topic_;
  comm::PublishRate rate_;
};

}  // namespace

struct Interface::Impl {
  Impl(const std::vector<adf::CrtkArm>& descriptions, std::string name_space_in, const state::Abilities& simulation,
       ros_comm::Node& node_in, base::Log& log_in, int priority, bool simulated_time)
      : name_space(std::move(name_space_in)), node(node_in), log(log_in), stamps(simulated_time) {
    for (const adf::CrtkArm& arm : descriptions) {
      arms.push_back(std::make_unique<ServedArm>(arm, simulation, stamps, log));
    }
    reader = simulation.observe.make_reader();
    if (reader == nullptr) {
      log.error("CRTK: no arm is served: too many parts read the simulation's frames");
      return;
    }
    mover = std::thread([this, priority] { move(priority); });
    opener = std::thread([this] { open(); });
  }

  ~Impl() {
    {
      const std::lock_guard<std::mutex> lock(mutex);
      stopping = true;
    }
    wake.notify_all();
    if (opener.joinable()) opener.join();
    for (const auto& arm : arms) arm->close();
    if (mover.joinable()) mover.join();
  }

  void move(int priority) {
    base::enter_real_time("crtk", priority);
    std::uint64_t sequence = 0;
    while (!stopping) {
      reader->wait_newer(sequence, kFrameWait);
      const state::Frame* frame = reader->latest();
      if (frame == nullptr || frame->structure == nullptr) {
        std::this_thread::sleep_for(kFrameWait);
        continue;
      }
      sequence = frame->sequence;
      const std::int64_t stamp_ns = stamps.of(*frame);
      {
        const std::lock_guard<std::mutex> lock(common_mutex);
        if (clock) clock->publish(stamp_ns);
      }
      // An arm is in the view of where the other one is now.
      for (const auto& arm : arms) {
        if (arm->view().empty()) arm->update(*frame, stamp_ns, nullptr);
      }
      for (const auto& arm : arms) {
        if (!arm->view().empty()) arm->update(*frame, stamp_ns, find(arm->view()));
      }
      if (std::any_of(arms.begin(), arms.end(), [](const auto& arm) { return arm->has_work(); })) wake.notify_one();
      const std::lock_guard<std::mutex> lock(common_mutex);
      if (frame_topic) frame_topic->publish(arms);
    }
  }

  const ServedArm* find(const std::string& name) const {
    for (const auto& arm : arms) {
      if (arm->name() == name) return arm.get();
    }
    return nullptr;
  }

  // Registering topics takes as long as the master does, a tool's exchange as the loader, and whether a model moves as
  // described is much to compute: the arms move meanwhile.
  void open() {
    base::set_thread_name("crtk topics");
    std::vector<bool> failed(arms.size(), false);
    std::unique_lock<std::mutex> lock(mutex);
    while (!stopping) {
      if (!common_opened && node.connected()) {
        common_opened = true;
        lock.unlock();
        open_common();
        lock.lock();
      }
      for (std::size_t i = 0; i < arms.size() && !stopping; ++i) {
        lock.unlock();
        arms[i]->serve(stopping);
        lock.lock();
      }
      for (std::size_t i = 0; i < arms.size() && node.connected(); ++i) {
        if (stopping || failed[i] || !arms[i]->wants_topics()) continue;
        lock.unlock();
        try {
          arms[i]->open(node, name_space);
        } catch (const std::exception& problem) {
          failed[i] = true;
          log.error("CRTK: arm %s has no topics: %s", arms[i]->name().c_str(), problem.what());
        }
        lock.lock();
      }
      wake.wait_for(lock, kOpenEvery);
    }
  }

  // What all arms share.
  void open_common() {
    try {
      auto opened_clock = stamps.simulated() ? std::make_unique<Clock>(node) : nullptr;
      auto opened_frames = std::make_unique<FrameTopic>(node);
      const std::lock_guard<std::mutex> lock(common_mutex);
      clock = std::move(opened_clock);
      frame_topic = std::move(opened_frames);
    } catch (const std::exception& problem) {
      log.error("CRTK: no clock and no frames are published: %s", problem.what());
    }
  }

  const std::string name_space;
  ros_comm::Node& node;
  base::Log& log;
  Stamps stamps;
  std::mutex common_mutex;
  std::unique_ptr<Clock> clock;  // this and the next: made by the opening thread, used under common_mutex
  std::unique_ptr<FrameTopic> frame_topic;
  bool common_opened = false;  // the opening thread's
  std::vector<std::unique_ptr<ServedArm>> arms;
  std::unique_ptr<state::FrameReader> reader;
  std::mutex mutex;
  std::condition_variable wake;
  std::atomic<bool> stopping{false};
  std::thread mover, opener;
};

Interface::Interface(const std::vector<adf::CrtkArm>& arms, const std::string& name_space,
                     const state::Abilities& simulation, ros_comm::Node& node, base::Log& log, int priority,
                     bool simulated_time)
    : impl_(std::make_unique<Impl>(arms, name_space, simulation, node, log, priority, simulated_time)) {}

Interface::~Interface() = default;

}  // namespace ambf::crtk
