// A State/Command topic pair: what every endpoint of ros_comm is made of. Counts subscribers by callbacks, since asking
// roscpp takes its global lock and a linear search. Private to ros_comm. C++17.
#pragma once

#include <ros/ros.h>

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <string>

#include "ros_comm/message_lengths.h"
#include "ros_comm/node.h"
#include "ros_comm/services/gate.h"

namespace ambf::ros_comm {

constexpr std::uint32_t kQueueSize = 10;  // of commands, as the original
// Of slow listeners the oldest states are dropped. The original keeps 10, which at 1 kHz are lost whenever roscpp's
// sending thread waits 10 ms for a processor; recorders want every one. A listener too slow for its topic sees states
// 0.1 s older.
constexpr std::uint32_t kStateQueueSize = 100;
constexpr std::uint32_t kWorldCommandQueue = 1000;  // each toggle of the step clock counts: none may be dropped

// A publisher that the node registers again with a new master. Throws when ROS does not accept it. `latch`: who comes
// later gets the last message.
template <class Message>
class TopicPublisher {
 public:
  TopicPublisher(Node& node, const std::string& topic, std::uint32_t queue_size, bool latch = false)
      : node_(node),
        registered_(node, {Registration::Kind::publisher, topic, ros::message_traits::DataType<Message>::value()}),
        count_(std::make_shared<std::atomic<int>>(0)),
        newcomers_(std::make_shared<std::atomic<bool>>(false)) {
    ros::AdvertiseOptions options;
    options.init<Message>(topic, queue_size);
    options.latch = latch;
    options.callback_queue = &node.commands();
    // The callbacks may outlive this object in the queue: they hold the number itself.
    const auto count = count_;
    const auto newcomers = newcomers_;
    Traffic& traffic = node.traffic();
    options.connect_cb = [count, newcomers, &traffic](const ros::SingleSubscriberPublisher&) {
      ++*count, ++traffic.connections;
      *newcomers = true;
    };
    options.disconnect_cb = [count, &traffic](const ros::SingleSubscriberPublisher&) {
      --*count, --traffic.connections;
    };
    const std::shared_lock<std::shared_mutex> lock(node_.topic_list());
    publisher_ = node_.handle().advertise(options);
    if (!publisher_) throw std::runtime_error("ROS does not take the topic " + topic);
  }
  ~TopicPublisher() {
    const std::unique_lock<std::shared_mutex> lock(node_.topic_list());
    publisher_.shutdown();
    node_.traffic().connections -= *count_;  // roscpp calls nothing for connections that end with the topic
  }
  TopicPublisher(const TopicPublisher&) = delete;
  TopicPublisher& operator=(const TopicPublisher&) = delete;

  int subscribers() const { return count_->load(std::memory_order_relaxed); }
  // Whether someone subscribed since the last publish().
  bool newcomers() const { return newcomers_->load(std::memory_order_relaxed); }
  void publish(const Message& message) const {
    newcomers_->store(false, std::memory_order_relaxed);
    publisher_.publish(message);
  }
  const std::string& name() const { return registered_.name(); }

 private:
  Node& node_;
  const Registered registered_;
  std::shared_ptr<std::atomic<int>> count_;
  std::shared_ptr<std::atomic<bool>> newcomers_;
  ros::Publisher publisher_;
};

// Of states: they are counted, and recorders can request every step of them.
template <class Message>
class StatePublisher {
 public:
  StatePublisher(Node& node, const std::string& topic)
      : traffic_(node.traffic()),
        interval_(node.step_requests().interval_of(topic)),
        publisher_(node, topic, kStateQueueSize) {}

  int subscribers() const { return publisher_.subscribers(); }
  bool newcomers() const { return publisher_.newcomers(); }
  // Every how many steps a recorder requested it; 0: none did.
  std::uint32_t step_interval() const { return interval_->load(std::memory_order_relaxed); }
  void publish(const Message& message) const {
    publisher_.publish(message);
    traffic_.states.fetch_add(1, std::memory_order_relaxed);
  }

 private:
  Traffic& traffic_;
  const StepRequests::Interval interval_;
  TopicPublisher<Message> publisher_;
};

// A subscriber whose callbacks run on the command thread until this object is destroyed (destruction waits for the one
// running). `refused` gets the reason, with the sender, for each message that cannot be deserialized.
template <class Message>
class CommandSubscriber {
 public:
  using Event = ros::MessageEvent<const Message>;
  using Callback = std::function<void(const Event&)>;
  using Refused = std::function<void(const std::string& why)>;
  CommandSubscriber(Node& node, const std::string& topic, Callback callback, Refused refused,
                    std::uint32_t queue_size = kQueueSize)
      : node_(node) {
    registered_.emplace(
        node, Registration{Registration::Kind::subscriber, topic, ros::message_traits::DataType<Message>::value()});
    ros::SubscribeOptions options(topic, queue_size, ros::message_traits::md5sum<Message>(),
                                  ros::message_traits::datatype<Message>());
    options.helper = boost::make_shared<Helper>(gate_, std::move(callback), std::move(refused));
    options.callback_queue = &node.commands();
    options.transport_hints = ros::TransportHints().tcpNoDelay();
    subscriber_ = node.handle().subscribe(options);
    if (!subscriber_) throw std::runtime_error("ROS does not take the topic " + topic);
  }
  ~CommandSubscriber() {
    gate_->close();
    const std::unique_lock<std::shared_mutex> lock(node_.topic_list());
    subscriber_.shutdown();
    registered_.reset();
  }
  CommandSubscriber(const CommandSubscriber&) = delete;
  CommandSubscriber& operator=(const CommandSubscriber&) = delete;

 private:
  // Deserializes only what has the bytes that it claims.
  class Helper final : public ros::SubscriptionCallbackHelperT<const Event&> {
   public:
    Helper(std::shared_ptr<Gate> gate, Callback callback, Refused refused)
        : ros::SubscriptionCallbackHelperT<const Event&>([gate, callback = std::move(callback)](const Event& event) {
            const Gate::Pass pass(*gate);
            if (pass) callback(event);
          }),
          gate_(std::move(gate)),
          refused_(std::move(refused)) {}

    // Nothing is called for the null that it returns.
    ros::VoidConstPtr deserialize(const ros::SubscriptionCallbackHelperDeserializeParams& params) override {
      const std::string problem = problem_of_lengths<Message>(params.buffer, params.length);
      if (problem.empty()) return ros::SubscriptionCallbackHelperT<const Event&>::deserialize(params);
      const Gate::Pass pass(*gate_);
      if (pass) refused_("malformed message from " + sender_in(params.connection_header) + ": " + problem);
      return {};
    }

   private:
    const std::shared_ptr<Gate> gate_;
    const Refused refused_;
  };

  Node& node_;
  const std::shared_ptr<Gate> gate_ = std::make_shared<Gate>();
  std::optional<Registered> registered_;
  ros::Subscriber subscriber_;
};

}  // namespace ambf::ros_comm
