#include "ros_comm/ros_middleware.h"

#include <chrono>
#include <random>
#include <thread>

#include "base/clock.h"
#include "ros_comm/endpoints/endpoint_kinds.h"
#include "ros_comm/endpoints/parameter_server.h"
#include "ros_comm/endpoints/topic_names.h"
#include "ros_comm/endpoints/world_endpoint.h"
#include "ros_comm/images/image_desk.h"
#include "ros_comm/master.h"
#include "ros_comm/node.h"

namespace ambf::ros_comm {

namespace {

constexpr double kAnswerTimeout_s = 0.5;  // a node that does not answer within is dead
constexpr int kMaxRenamedLogged = 100;    // a file of thousands of objects may lack its namespace
constexpr int kMaxRetryDelay_ms = 200;    // before the next check, beside the advertiser's own pause

class Endpoints final : public RosMiddleware {
 public:
  Endpoints(const state::Abilities& simulation, base::Log& log, int sending_priority, JpegEncoder encode)
      : simulation_(simulation), node_(log, sending_priority), desk_(node_, std::move(encode)) {}

  state::PictureSink& pictures() override { return desk_; }
  Node& node() override { return node_; }

  bool available() const override { return node_.connected(); }
  bool room_for_step() override { return node_.step_requests().room(); }
  void step_published(const state::Frame& step) override { node_.step_requests().published(step.system_ns); }
  bool steps_wanted() override { return node_.step_requests().in_force(base::steady_ns()); }

  bool serves(const state::ObjectInfo& object) const override {
    const EndpointKind* kind = endpoint_kind(object.kind);
    return kind != nullptr && kind->open != nullptr;
  }

  std::string reserve(const std::string& name) override {
    std::string topic = topics_.reserve(name);
    if (topic != name && renamed_ < kMaxRenamedLogged) {
      const char* more = ++renamed_ == kMaxRenamedLogged ? "; and so on: ambf-cli list names all" : "";
      node_.log().info("ROS: the topics of '%s' are called %s/...%s", name.c_str(), topic.c_str(), more);
    }
    return topic;
  }
  void release(const std::string& topic) override { topics_.release(topic); }

  std::unique_ptr<comm::Endpoint> open(const state::ObjectInfo& object, const std::string& topic) override {
    return without_exceptions(object.name, [&] {
      return endpoint_kind(object.kind)->open({node_, desk_, parameters_, simulation_}, object, topic);
    });
  }

  std::unique_ptr<comm::Endpoint> open_world(const std::string& topic) override {
    return without_exceptions(topic, [&] { return open_free_world(topic); });
  }

 private:
  // ROS throws for names and types that it does not accept; no exception leaves this plugin.
  template <class Open>
  std::unique_ptr<comm::Endpoint> without_exceptions(const std::string& name, Open open) {
    const std::string known = node_.master_pid();
    try {
      return open();
    } catch (const std::exception& e) {
      // Where the master has ended, the node itself has logged that, and these topics are tried again. Another may be
      // there by now.
      if (const std::string now = master::pid(); !now.empty() && now == known)
        node_.log().error("ROS: no topics for '%s' now: %s", name.c_str(), e.what());
    }
    return nullptr;
  }

  // The world's topics belong to one simulator. Checking before and after opening them ensures that of two simulators
  // starting at the same time at least one sees the other, and gives way for a random time.
  std::unique_ptr<comm::Endpoint> open_free_world(const std::string& topic) {
    std::unique_ptr<comm::Endpoint> endpoint;
    if (free(topic)) endpoint = std::make_unique<WorldEndpoint>(node_, topic, topics_, simulation_);
    if (endpoint != nullptr && free(topic)) {
      if (taken_logged_) node_.log().info("ROS: %s is free now: offering topics", topic.c_str());
      return endpoint;
    }
    endpoint.reset();
    std::this_thread::sleep_for(
        std::chrono::milliseconds(std::uniform_int_distribution<int>(0, kMaxRetryDelay_ms)(random_)));
    return nullptr;
  }

  // Whether no other running simulator offers this world; clears registrations that ended ones left behind.
  bool free(const std::string& topic) {
    for (const std::string& other : master::other_publishers(topic + "/State")) {
      if (other.rfind("/ambf_legacy_states", 0) == 0) continue;  // republishes our states
      if (!master::alive(other, kAnswerTimeout_s)) {
        node_.log().info("ROS: clearing away the topics that %s left behind", other.c_str());
        master::unregister_node(other);
        continue;
      }
      if (!taken_logged_) {
        node_.log().warning(
            "ROS: %s already serves %s on this master. This simulator offers no topics until that one has ended; to "
            "run "
            "both, start one of them with --ns NAME, or with a ROS_MASTER_URI of its own",
            other.c_str(), topic.c_str());
      }
      taken_logged_ = true;
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
  bool taken_logged_ = false;
  int renamed_ = 0;  // topics that are not called as their objects; the thread that reserves
};

}  // namespace

std::unique_ptr<RosMiddleware> RosMiddleware::start(const state::Abilities& simulation, base::Log& log,
                                                    int sending_priority, JpegEncoder encode) {
  return std::make_unique<Endpoints>(simulation, log, sending_priority, std::move(encode));
}

}  // namespace ambf::ros_comm
