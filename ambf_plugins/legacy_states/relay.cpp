#include "legacy_states/relay.h"

#include "legacy_states/raw_message.h"

namespace ambf::legacy_states {

namespace {

constexpr std::uint32_t kQueueSize = 10;  // as the simulator's
constexpr const char* kNodeNames = "/ambf_legacy_states";

// Between the two nodes: a type that no program looks for.
constexpr const char* kBytesType = "ambf_legacy_states/Bytes";
constexpr const char* kBytesMd5 = "b1e5b1e5b1e5b1e5b1e5b1e5b1e5b1e5";

bool is_ours(const std::string& node) { return node.rfind(kNodeNames, 0) == 0; }

struct Line {
  std::string name, type, md5, definition;
};

}  // namespace

class Relay::Topic {
 public:
  Topic(ros::NodeHandle& node, Part part, Generation generation, const std::string& name, const OtherType& type)
      : node_(node), part_(part), type_(type) {
    const char* below = generation == Generation::second ? "/g2" : "/g4";  // both relays may run
    const Line bytes = {kNodeNames + (below + name), kBytesType, kBytesMd5, "# a State message, as its bytes\n"};
    from_ = part == Part::hears ? Line{name, type.name, type.own_md5, ""} : bytes;
    const Line to = part == Part::hears ? bytes : Line{name, type.name, type.other_md5, type.other_definition()};
    ros::AdvertiseOptions options;
    options.topic = to.name;
    options.queue_size = kQueueSize;
    options.md5sum = to.md5;
    options.datatype = to.type;
    options.message_definition = to.definition;
    options.connect_cb = [this](const ros::SingleSubscriberPublisher&) { listener_came(); };
    options.disconnect_cb = [this](const ros::SingleSubscriberPublisher&) { listener_went(); };
    publisher_ = ros::NodeHandle(node_).advertise(options);  // a handle remembers all it ever opened
  }
  Topic(const Topic&) = delete;
  Topic& operator=(const Topic&) = delete;
  ~Topic() {
    publisher_.shutdown();
    subscriber_.shutdown();
  }

 private:
  void listener_came() {
    if (++listeners_ > 1) return;
    ros::SubscribeOptions options;
    options.topic = from_.name;
    options.queue_size = kQueueSize;
    options.md5sum = from_.md5;
    options.datatype = from_.type;
    options.helper = boost::make_shared<ros::SubscriptionCallbackHelperT<const boost::shared_ptr<const RawMessage>&>>(
        [this](const boost::shared_ptr<const RawMessage>& message) { pass_on(*message); });
    options.transport_hints = ros::TransportHints().tcpNoDelay();
    subscriber_ = ros::NodeHandle(node_).subscribe(options);
  }
  void listener_went() {
    if (--listeners_ == 0) subscriber_.shutdown();
  }
  void pass_on(const RawMessage& message) {
    if (part_ == Part::hears) {
      publisher_.publish(message);
    } else if (convert(type_, message.bytes, other_.bytes)) {
      publisher_.publish(other_);
    }
  }

  ros::NodeHandle& node_;
  const Part part_;
  const OtherType& type_;
  Line from_;
  int listeners_ = 0;
  ros::Publisher publisher_;
  ros::Subscriber subscriber_;
  RawMessage other_;
};

Relay::Relay(Part part, Generation generation) : part_(part), generation_(generation) {}
Relay::~Relay() = default;

void Relay::clear() { topics_.clear(); }

bool Relay::update(ros::NodeHandle& node) {
  XmlRpc::XmlRpcValue question, answer, state, types;
  question[0] = ros::this_node::getName();
  if (!ros::master::execute("getSystemState", question, answer, state, false)) return false;
  if (!ros::master::execute("getTopicTypes", question, answer, types, false)) return false;
  std::map<std::string, const OtherType*> known;
  for (int i = 0; i < types.size(); ++i) {
    if (const OtherType* type = find_other_type(generation_, types[i][1])) known[types[i][0]] = type;
  }
  // Of these, the ones that a simulator publishes.
  std::map<std::string, const OtherType*> there;
  XmlRpc::XmlRpcValue& published = state[0];
  for (int i = 0; i < published.size(); ++i) {
    const auto topic = known.find(published[i][0]);
    if (topic == known.end()) continue;
    for (int k = 0; k < published[i][1].size(); ++k) {
      if (!is_ours(published[i][1][k])) there.insert(*topic);
    }
  }
  for (auto topic = topics_.begin(); topic != topics_.end();) {
    topic = there.count(topic->first) == 0 ? topics_.erase(topic) : std::next(topic);
  }
  for (const auto& [name, type] : there) {
    if (topics_.count(name) == 0) topics_[name] = std::make_unique<Topic>(node, part_, generation_, name, *type);
  }
  return true;
}

}  // namespace ambf::legacy_states
