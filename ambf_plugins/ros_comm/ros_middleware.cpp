#include "ros_comm/ros_middleware.h"

#include <chrono>
#include <random>
#include <thread>

#include "ros_comm/endpoints/body_endpoint.h"
#include "ros_comm/endpoints/camera_endpoint.h"
#include "ros_comm/endpoints/pose_endpoint.h"
#include "ros_comm/endpoints/topic_names.h"
#include "ros_comm/endpoints/world_endpoint.h"
#include "ros_comm/images/image_desk.h"
#include "ros_comm/master.h"
#include "ros_comm/node.h"

namespace ambf::ros_comm {

namespace {

constexpr double kAnswerTimeout_s = 0.5;  // a node that does not answer within is dead
constexpr int kLongestWait_ms = 200;      // before looking again, beside the advertiser's own pause

class Endpoints final : public RosMiddleware {
 public:
  Endpoints(const state::Abilities& simulation, base::Log& log, int sending_priority, JpegEncoder encode)
      : simulation_(simulation), node_(log, sending_priority), desk_(node_, std::move(encode)) {}

  state::PictureSink& pictures() override { return desk_; }

  bool available() const override { return node_.connected(); }

  std::string reserve(const state::ObjectInfo& object) override {
    std::string topic = topics_.reserve(object.name);
    if (topic != object.name) {
      node_.log().info("ROS: the topics of '%s' are called %s/...", object.name.c_str(), topic.c_str());
    }
    return topic;
  }
  void release(const std::string& topic) override { topics_.release(topic); }

  std::unique_ptr<comm::Endpoint> open(const state::ObjectInfo& object, const std::string& topic) override {
    // ROS throws for names and types it does not accept; no exception leaves this plugin.
    try {
      switch (object.kind) {
        case state::ObjectKind::world: return open_world(topic);
        case state::ObjectKind::rigid_body:
          return std::make_unique<BodyEndpoint>(node_, object, topic, simulation_.command);
        case state::ObjectKind::camera:
          return std::make_unique<CameraEndpoint>(node_, desk_, object, topic, simulation_.command, simulation_.observe,
                                                  parameters_);
        case state::ObjectKind::light:
          return std::make_unique<LightEndpoint>(node_, object, topic, simulation_.command, parameters_);
        case state::ObjectKind::joint: break;
      }
    } catch (const std::exception& e) {
      if (master::pid().empty()) return nullptr;  // it has just gone; the node says so
      node_.log().error("ROS: no topics for '%s' now: %s", object.name.c_str(), e.what());
    }
    return nullptr;
  }

 private:
  // The world's topics belong to one simulator. Looking before and after opening them means that of two that start at the same time at
  // least one sees the other, and gives way for a random time.
  std::unique_ptr<comm::Endpoint> open_world(const std::string& topic) {
    std::unique_ptr<comm::Endpoint> endpoint;
    if (free(topic)) endpoint = std::make_unique<WorldEndpoint>(node_, topic, topics_, simulation_);
    if (endpoint != nullptr && free(topic)) {
      if (said_taken_) node_.log().info("ROS: %s is free now: offering topics", topic.c_str());
      return endpoint;
    }
    endpoint.reset();
    std::this_thread::sleep_for(
        std::chrono::milliseconds(std::uniform_int_distribution<int>(0, kLongestWait_ms)(random_)));
    return nullptr;
  }

  // Whether no other living simulator offers this world; what dead ones left behind is cleared away.
  bool free(const std::string& topic) {
    for (const std::string& other : master::other_publishers(topic + "/State")) {
      if (other.rfind("/ambf_legacy_states", 0) == 0) continue;  // says again what we say
      if (!master::alive(other, kAnswerTimeout_s)) {
        node_.log().info("ROS: clearing away the topics that %s left behind", other.c_str());
        master::bury(other);
        continue;
      }
      if (!said_taken_) {
        node_.log().warning(
            "ROS: %s already serves %s on this master. This simulator offers no topics until that one has ended; to "
            "run "
            "both, start one of them with --ns NAME, or with a ROS_MASTER_URI of its own",
            other.c_str(), topic.c_str());
      }
      said_taken_ = true;
      return false;
    }
    return true;
  }

  const state::Abilities simulation_;
  TopicNames topics_;
  Node node_;
  ImageDesk desk_;
  ParameterServer parameters_{node_, simulation_.observe, simulation_.tune, simulation_.edit};
  // The world is opened by one thread at a time.
  std::mt19937 random_{std::random_device{}()};
  bool said_taken_ = false;
};

}  // namespace

std::unique_ptr<RosMiddleware> RosMiddleware::start(const state::Abilities& simulation, base::Log& log,
                                                    int sending_priority, JpegEncoder encode) {
  return std::make_unique<Endpoints>(simulation, log, sending_priority, std::move(encode));
}

}  // namespace ambf::ros_comm
