#include "dvrk_arm/any_subscriber.h"

#include <stdexcept>
#include <typeinfo>
#include <utility>

namespace ambf::dvrk_arm {

namespace {

constexpr const char* kAny = "*";         // roscpp: every type and checksum fits
constexpr std::uint32_t kQueueSize = 10;  // at 1 kHz 10 ms; of a thread that is late, the oldest are dropped

class Helper final : public ros::SubscriptionCallbackHelper {
 public:
  Helper(std::shared_ptr<ros_comm::Gate> gate, AnySubscriber::Callback callback)
      : gate_(std::move(gate)), callback_(std::move(callback)) {}

  // On the queue's thread. Nothing is called for the null that it returns.
  ros::VoidConstPtr deserialize(const ros::SubscriptionCallbackHelperDeserializeParams& params) override {
    const ros_comm::Gate::Pass pass(*gate_);
    if (!pass || !params.connection_header) return {};
    const auto type = params.connection_header->find("type");
    if (type != params.connection_header->end()) callback_({type->second, params.buffer, params.length});
    return {};
  }
  void call(ros::SubscriptionCallbackHelperCallParams&) override {}
  const std::type_info& getTypeInfo() override { return typeid(void); }
  bool isConst() override { return true; }
  bool hasHeader() override { return false; }

 private:
  const std::shared_ptr<ros_comm::Gate> gate_;
  const AnySubscriber::Callback callback_;
};

}  // namespace

AnySubscriber::AnySubscriber(ros_comm::Node& node, ros::CallbackQueue& queue, const std::string& topic,
                             Callback callback)
    : registered_(node, {ros_comm::Registration::Kind::subscriber, topic, kAny}) {
  ros::SubscribeOptions options(topic, kQueueSize, kAny, kAny);
  options.helper = boost::make_shared<Helper>(gate_, std::move(callback));
  options.callback_queue = &queue;
  options.transport_hints = ros::TransportHints().tcpNoDelay();
  subscriber_ = node.handle().subscribe(options);
  if (!subscriber_) throw std::runtime_error("ROS does not take the topic " + topic);
}

AnySubscriber::~AnySubscriber() {
  gate_->close();
  subscriber_.shutdown();
}

}  // namespace ambf::dvrk_arm
