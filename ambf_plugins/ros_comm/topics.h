// A State/Command topic pair: what every endpoint of ros_comm is made of. Counts subscribers by callbacks, since asking roscpp takes
// its global lock and a linear search. Private to ros_comm. C++17.
#pragma once

#include <ros/ros.h>

#include <atomic>
#include <functional>
#include <memory>
#include <string>

#include "ros_comm/node.h"

namespace ambf::ros_comm {

// Characters that ROS does not allow in names become '_'; repeated '/' become one; a leading '/' is added.
std::string topic_name(const std::string& object_name);

// Counts one publisher's subscribers.
class SubscriberCount {
 public:
  SubscriberCount() : count_(std::make_shared<std::atomic<int>>(0)) {}
  int value() const { return count_->load(std::memory_order_relaxed); }
  // The callbacks may outlive this object in the queue: they hold the number itself.
  template <class Options>
  void attach(Options& options) const {
    const auto count = count_;
    options.connect_cb = [count](const ros::SingleSubscriberPublisher&) { count->fetch_add(1); };
    options.disconnect_cb = [count](const ros::SingleSubscriberPublisher&) { count->fetch_sub(1); };
    options.tracked_object = boost::shared_ptr<void>(count.get(), [count](void*) {});
  }

 private:
  std::shared_ptr<std::atomic<int>> count_;
};

constexpr std::uint32_t kQueueSize = 10;

// A publisher that the node registers again with a new master. Move only by pointer.
template <class Message>
class StatePublisher {
 public:
  StatePublisher(Node& node, const std::string& topic, std::uint32_t queue_size = kQueueSize)
      : node_(node),
        registration_{Registration::Kind::publisher, topic, ros::message_traits::DataType<Message>::value()} {
    ros::AdvertiseOptions options;
    options.init<Message>(topic, queue_size);
    options.callback_queue = &node.commands();
    count_.attach(options);
    node_.remember(registration_);
    publisher_ = node_.handle().advertise(options);
  }
  ~StatePublisher() {
    node_.forget(registration_);
    publisher_.shutdown();
  }
  StatePublisher(const StatePublisher&) = delete;
  StatePublisher& operator=(const StatePublisher&) = delete;

  int subscribers() const { return count_.value(); }
  void publish(const Message& message) const { publisher_.publish(message); }

 private:
  Node& node_;
  const Registration registration_;
  SubscriberCount count_;
  ros::Publisher publisher_;
};

// A subscriber whose callbacks run on the command thread until this object is destroyed (destruction waits for the one running).
template <class Message>
class CommandSubscriber {
 public:
  using Callback = std::function<void(const ros::MessageEvent<const Message>&)>;
  CommandSubscriber(Node& node, const std::string& topic, Callback callback, std::uint32_t queue_size = kQueueSize)
      : node_(node),
        registration_{Registration::Kind::subscriber, topic, ros::message_traits::DataType<Message>::value()} {
    ros::SubscribeOptions options;
    options.initByFullCallbackType<const ros::MessageEvent<const Message>&>(topic, queue_size, std::move(callback));
    options.callback_queue = &node.commands();
    options.transport_hints = ros::TransportHints().tcpNoDelay();
    node_.remember(registration_);
    subscriber_ = node_.handle().subscribe(options);
  }
  ~CommandSubscriber() {
    node_.forget(registration_);
    subscriber_.shutdown();
  }
  CommandSubscriber(const CommandSubscriber&) = delete;
  CommandSubscriber& operator=(const CommandSubscriber&) = delete;

 private:
  Node& node_;
  const Registration registration_;
  ros::Subscriber subscriber_;
};

}  // namespace ambf::ros_comm
