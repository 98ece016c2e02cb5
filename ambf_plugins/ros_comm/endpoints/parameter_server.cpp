#include "ros_comm/endpoints/parameter_server.h"

#include <chrono>
#include <cmath>

#include "base/clock.h"
#include "base/realtime.h"
#include "ros_comm/master.h"

namespace ambf::ros_comm {

namespace {

using namespace std::chrono_literals;

constexpr auto kPause = 250ms;
// What was asked of the simulation shows in frames within this; until then an old value there is no change.
constexpr std::int64_t kOnItsWay_ns = 500'000'000;

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
  std::atomic<bool> gone{false};
  // Polling thread, but for `moving`, which the loader ends.
  Parameters known;  // as on the server when we last looked or wrote
  std::int64_t quiet_until_ns = 0;
  std::shared_ptr<std::atomic<bool>> moving = std::make_shared<std::atomic<bool>>(false);  // a new parent is on its way
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
                                                               const std::string& topic) {
  auto entry = std::make_shared<Entry>();
  entry->object = object;
  entry->topic = topic;
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
    node_.log().warning("ROS: no parameters of cameras and lights: too many readers of frames");
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
  const Parameters live = parameters_of(frame, entry.object.kind, slot);
  XmlRpc::XmlRpcValue tree;
  const Parameters there = master::get_parameter(entry.topic, tree) ? read(tree) : Parameters{};

  // What is known was put there by us, or taken from there: anything else was set by a user.
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
  std::string why;
  if (entry.object.kind == state::ObjectKind::camera) {
    const state::CameraState& now = frame.cameras[slot];
    const state::CameraInfo& info = frame.structure->cameras[slot];
    // An orthographic view without a width shows what the perspective one does where the camera looks.
    const double away_m = math::norm(now.T_parent_camera.position - info.look_at);
    state::Lens lens = now.lens;
    why = change(lens, changed, std::max(1e-3, 2.0 * away_m * std::tan(lens.field_of_view_rad / 2.0)));
    if (why.empty()) tune_.set_lens(entry.object.id, lens);
    if (why.empty() && lens.stereo && !now.lens.stereo && info.image.on && !info.lens.stereo) {
      node_.log().warning(
          "ROS: '%s' shows both eyes in its window now, but publishes no left/ and right/ pictures: their topics are "
          "made for cameras that are loaded with `stereo`",
          entry.object.name.c_str());
    }
  } else {
    state::Beam beam = frame.lights[slot].beam;
    why = change(beam, changed);
    if (why.empty()) tune_.set_beam(entry.object.id, beam);
  }
  entry.quiet_until_ns = base::steady_ns() + kOnItsWay_ns;
  const auto parent = changed.find(kParentName);
  if (why.empty() && parent != changed.end()) {
    const auto* name = std::get_if<std::string>(&parent->second);
    if (name == nullptr) {
      why = std::string(kParentName) + " must be a name";
    } else {
      *entry.moving = true;
      edit_.set_parent(entry.object.id, *name,
                       [moving = entry.moving](const state::Outcome&) {  // refusals are logged by the loader
                         *moving = false;
                       });
    }
  }
  if (!why.empty()) {  // what is in force is put back at the next look
    node_.log().warning("ROS: parameters of '%s' not changed: %s", entry.object.name.c_str(), why.c_str());
    entry.quiet_until_ns = 0;
  }
}

// Only what is ours: users may keep parameters of their own there.
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
