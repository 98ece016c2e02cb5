#include "ros_comm/endpoints/parameter_server.h"

#include <chrono>

#include "base/clock.h"
#include "base/realtime.h"
#include "ros_comm/master.h"

namespace ambf::ros_comm {

namespace {

using namespace std::chrono_literals;

constexpr auto kPause = 250ms;
// A requested change shows in frames within this time; until then the old value there is not a change.
constexpr std::int64_t kChangeDelay_ns = 500'000'000;

Parameters read(const XmlRpc::XmlRpcValue& tree) {
  Parameters out;
  if (tree.getType() != XmlRpc::XmlRpcValue::TypeStruct) return out;
  for (auto entry = tree.begin(); entry != tree.end(); ++entry) {
    XmlRpc::XmlRpcValue value = entry->second;
    switch (value.getType()) {
      case XmlRpc::XmlRpcValue::TypeDouble: out[entry->first] = static_cast<double>(value); break;
      case XmlRpc::XmlRpcValue::TypeInt: out[entry->first] = static_cast<double>(static_cast<int>(value)); break;
      case XmlRpc::XmlRpcValue::TypeString: out[entry->first] = static_cast<std::string>(value); break;
      case XmlRpc::XmlRpcValue::TypeBoolean:
        out[entry->first] = std::string(static_cast<bool>(value) ? "true" : "false");
        break;
      default: out[entry->first] = std::string("a list or a map");
    }
  }
  return out;
}

}  // namespace

struct ParameterServer::Entry {
  state::ObjectInfo object;
  std::string topic;
  const ParameterAccess* access = nullptr;
  std::atomic<bool> gone{false};
  // Polling thread, except `moving`, which the loader clears.
  Parameters known;  // as on the server when last read or written
  std::int64_t quiet_until_ns = 0;
  std::shared_ptr<std::atomic<bool>> moving = std::make_shared<std::atomic<bool>>(false);  // a new parent is requested
};

ParameterServer::Offer::~Offer() { entry_->gone = true; }

ParameterServer::~ParameterServer() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    stop_ = true;
  }
  wake_.notify_all();
  if (thread_.joinable()) thread_.join();
  for (const auto& entry : entries_) withdraw(*entry);
}

std::unique_ptr<ParameterServer::Offer> ParameterServer::offer(const state::ObjectInfo& object,
                                                               const std::string& topic,
                                                               const ParameterAccess& access) {
  auto entry = std::make_shared<Entry>();
  entry->object = object;
  entry->topic = topic;
  entry->access = &access;
  const std::lock_guard<std::mutex> lock(mutex_);
  entries_.push_back(entry);
  if (!thread_.joinable()) thread_ = std::thread([this] { run(); });
  return std::make_unique<Offer>(entry);
}

void ParameterServer::run() {
  base::set_thread_name("parameters");
  base::lower_priority(5);
  const std::unique_ptr<state::FrameReader> reader = observe_.make_reader();
  if (reader == nullptr) {
    node_.log().warning("ROS: no parameters of cameras and lights on the parameter server: too many readers of frames");
    return;
  }
  std::unique_lock<std::mutex> lock(mutex_);
  while (!stop_) {
    lock.unlock();
    const state::Frame* frame = node_.connected() ? reader->latest() : nullptr;
    try {
      if (frame != nullptr) poll(*frame);
    } catch (const std::exception& e) {  // ROS throws for names it does not accept
      node_.log().error("ROS: parameters: %s", e.what());
    }
    lock.lock();
    wake_.wait_for(lock, kPause, [this] { return stop_; });
  }
}

void ParameterServer::poll(const state::Frame& frame) {
  std::vector<std::shared_ptr<Entry>> entries;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    entries = entries_;
  }
  for (const auto& entry : entries) {
    if (!node_.connected()) return;
    if (!entry->gone) {
      compare(*entry, frame);
      continue;
    }
    withdraw(*entry);
    const std::lock_guard<std::mutex> lock(mutex_);
    for (auto at = entries_.begin(); at != entries_.end(); ++at) {
      if (*at != entry) continue;
      entries_.erase(at);
      break;
    }
  }
}

void ParameterServer::compare(Entry& entry, const state::Frame& frame) {
  const std::uint32_t object = state::find(*frame.structure, entry.object.id);
  if (object == state::kNone) return;
  const std::uint32_t slot = frame.structure->objects[object].slot;
  const Parameters live = entry.access->values(frame, slot);
  XmlRpc::XmlRpcValue tree;
  const Parameters there = master::get_parameter(entry.topic, tree) ? read(tree) : Parameters{};

  // Known values were written or read by us before: anything else was set by a user.
  Parameters changed;
  for (const auto& [name, value] : there) {
    const auto before = entry.known.find(name);
    if (before != entry.known.end() && !same(before->second, value)) changed[name] = value;
  }
  if (!changed.empty()) {
    for (const auto& [name, value] : changed) entry.known[name] = value;
    apply(entry, changed, frame, slot);
    return;
  }
  if (base::steady_ns() < entry.quiet_until_ns || *entry.moving) return;
  for (const auto& [name, value] : live) {
    const auto before = entry.known.find(name);
    const bool lost = there.find(name) == there.end();  // a new master, or a new object
    if (!lost && before != entry.known.end() && same(before->second, value)) continue;
    const auto* number = std::get_if<double>(&value);
    const XmlRpc::XmlRpcValue shown =
        number != nullptr ? XmlRpc::XmlRpcValue(*number) : XmlRpc::XmlRpcValue(std::get<std::string>(value));
    if (!master::set_parameter(entry.topic + "/" + name, shown)) return;
    entry.known[name] = value;
  }
}

void ParameterServer::apply(Entry& entry, const Parameters& changed, const state::Frame& frame, std::uint32_t slot) {
  std::string problem = entry.access->apply({entry.object, changed, frame, slot, tune_, node_.log()});
  entry.quiet_until_ns = base::steady_ns() + kChangeDelay_ns;
  const auto parent = changed.find(kParentName);
  if (problem.empty() && parent != changed.end()) {
    const auto* name = std::get_if<std::string>(&parent->second);
    if (name == nullptr) {
      problem = std::string(kParentName) + " must be a name";
    } else {
      *entry.moving = true;
      edit_.set_parent(entry.object.id, *name,
                       [moving = entry.moving](const state::Outcome&) {  // refusals are logged by the loader
                         *moving = false;
                       });
    }
  }
  if (!problem.empty()) {  // the next poll writes the values in force back
    node_.log().warning("ROS: parameters of '%s' not changed: %s", entry.object.name.c_str(), problem.c_str());
    entry.quiet_until_ns = 0;
  }
}

// Only our own: users may keep parameters of theirs there.
void ParameterServer::withdraw(const Entry& entry) {
  try {
    for (const auto& [name, value] : entry.known) {
      if (!node_.connected()) return;  // each call would wait for the master
      master::delete_parameter(entry.topic + "/" + name);
    }
  } catch (const std::exception& e) {
    node_.log().error("ROS: parameters: %s", e.what());
  }
}

}  // namespace ambf::ros_comm
