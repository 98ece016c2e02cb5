#include "devices/replayed_device.h"

#include <deque>
#include <optional>
#include <utility>
#include <variant>
#include <vector>

#include "devices/detail/device_cycle.h"
#include "devices/device_inbox.h"
#include "inputs/bytes.h"

namespace ambf::devices {

namespace {

// Who else may hold a camera.
constexpr state::Source kOther = state::Source::ros;

class ReplayDriver final : public Driver {
 public:
  explicit ReplayDriver(const DriverTraits& traits) : traits_(traits) {}

  const DriverTraits& traits() const override { return traits_; }
  std::string open() override { return {}; }
  Reading read(Sample& sample, double) override {
    if (reading == Reading::sample) sample = next;
    return reading;
  }
  void write(const math::Wrench&) override {}
  void close() override {}

  Reading reading = Reading::nothing_new;
  Sample next;

 private:
  const DriverTraits traits_;
};

// What was posted, and in the cycle of which time. Physics obeys the newest of a time, a cycle or two later.
template <class Value>
class Posted {
 public:
  void add(std::int64_t now_ns, const Value& value) {
    if (values_.size() == kKept) values_.pop_front();
    values_.emplace_back(now_ns, value);
  }
  const Value* newest(std::int64_t until_ns) const {
    for (auto each = values_.rbegin(); each != values_.rend(); ++each)
      if (each->first <= until_ns) return &each->second;
    return nullptr;
  }

 private:
  static constexpr std::size_t kKept = 4096;
  std::deque<std::pair<std::int64_t, Value>> values_;
};

class ReplayPort final : public state::EffectorPort {
 public:
  explicit ReplayPort(std::optional<state::SetPoint>& posted) : posted_(posted) {}
  void post(const state::SetPoint& set_point) override { posted_ = set_point; }
  void let_go() override {}  // the recording says when physics saw it

 private:
  std::optional<state::SetPoint>& posted_;
};

class ReplayCameraPort final : public state::CommandPort {
 public:
  explicit ReplayCameraPort(Posted<math::Pose>& posted) : posted_(posted) {}
  void post(const state::Command&) override {}
  void post(const state::Command& command, std::int64_t now_ns) override {
    posted_.add(now_ns, std::get<state::PoseCommand>(command).T_parent_object);
  }
  void keep_alive() override {}
  void hold() override {}
  void release() override {}

 private:
  Posted<math::Pose>& posted_;
};

bool same(const std::optional<state::SetPoint>& recorded, const std::optional<state::SetPoint>& now) {
  inputs::Bytes bytes[2];
  inputs::Writer(bytes[0], true)(recorded);
  inputs::Writer(bytes[1], true)(now);
  return bytes[0] == bytes[1];
}

}  // namespace

struct ReplayedDevice::Impl {
  explicit Impl(Setup setup_in)
      : setup(std::move(setup_in)),
        source(static_cast<state::Source>(static_cast<unsigned>(state::Source::device_0) + setup.number)),
        driver(setup.traits),
        cycle(driver, inbox, setup.settings, source, setup.period_s) {}

  const Setup setup;
  const state::Source source;
  ReplayDriver driver;
  DeviceInbox inbox;
  DeviceCycle cycle;
  std::optional<state::SetPoint> posted;  // in the newest cycle
  Posted<state::SetPoint> set_points;
  struct Camera {
    state::ObjectId id;
    std::shared_ptr<CameraLock> lock;
    Posted<math::Pose> poses;
  };
  std::deque<Camera> cameras;    // of all bindings so far: cycles may hold the one before for a while
  std::size_t first_camera = 0;  // of the newest binding
};

ReplayedDevice::ReplayedDevice(Setup setup) : impl_(std::make_unique<Impl>(std::move(setup))) {}
ReplayedDevice::~ReplayedDevice() = default;

const std::string& ReplayedDevice::name() const { return impl_->setup.name; }

void ReplayedDevice::bind(const inputs::BindingRecord& record) {
  auto binding = std::make_unique<EffectorBinding>();
  binding->body = record.body;
  if (record.body.valid()) binding->port = std::make_unique<ReplayPort>(impl_->posted);
  binding->own_gains = record.own_gains;
  binding->own_multibody = record.own_multibody;
  binding->jaw_joints = record.jaw_joints;
  impl_->first_camera = impl_->cameras.size();
  for (const state::ObjectId id : record.cameras) {
    Impl::Camera& camera = impl_->cameras.emplace_back();
    camera.id = id;
    camera.lock = std::make_shared<CameraLock>();
    binding->cameras.push_back({id, std::make_unique<ReplayCameraPort>(camera.poses), camera.lock});
  }
  delete impl_->inbox.incoming.exchange(binding.release());
}

bool ReplayedDevice::run(const inputs::CycleRecord& record, const state::Frame* frame) {
  using Given = inputs::CycleRecord::Reading;
  DeviceInbox& inbox = impl_->inbox;
  delete inbox.retired.exchange(nullptr);
  for (const inputs::DeviceSetting& setting : record.settings) {
    if (!state::check(setting.parameter, setting.value).empty()) return false;  // a damaged file
    inbox.settings.try_push({setting.parameter, setting.value});
  }
  if (record.external) {
    const inputs::DeviceExternal& external = *record.external;
    inbox.external.post({external.wrench_world, external.pulls, external.T_world_target}, external.posted_ns);
  }
  inbox.forces = record.forces;
  inbox.driver = record.reading == Given::closed ? DriverState::closed : DriverState::open;
  impl_->driver.reading = record.reading == Given::sample ? Reading::sample
                          : record.reading == Given::lost ? Reading::lost
                                                          : Reading::nothing_new;
  if (record.sample) {
    const inputs::RawSample& sample = *record.sample;
    impl_->driver.next = {sample.stamp_ns, sample.T_u_tip, sample.jaw, sample.has_jaw,
                          sample.buttons,  sample.ready,   ""};
  }
  // Whether others held a camera is known only by what the device got.
  for (std::size_t i = impl_->first_camera; i < impl_->cameras.size(); ++i) {
    CameraLock& lock = *impl_->cameras[i].lock;
    const std::size_t number = i - impl_->first_camera;
    const bool got = number < 16 && ((record.cameras_held >> number) & 1) != 0;
    lock.release(got ? kOther : impl_->source);
    if (!got) lock.acquire(kOther);
  }
  impl_->posted.reset();
  impl_->cycle.step(record.now_ns, frame);
  if (impl_->posted) impl_->set_points.add(record.now_ns, *impl_->posted);
  return same(record.set_point, impl_->posted);
}

const state::SetPoint* ReplayedDevice::set_point(std::int64_t until_ns) const {
  return impl_->set_points.newest(until_ns);
}

const math::Pose* ReplayedDevice::camera_pose(state::ObjectId camera, std::int64_t until_ns) const {
  // Physics may obey what was posted through the binding before.
  for (auto each = impl_->cameras.rbegin(); each != impl_->cameras.rend(); ++each) {
    const math::Pose* posted = each->id == camera ? each->poses.newest(until_ns) : nullptr;
    if (posted != nullptr) return posted;
  }
  return nullptr;
}

}  // namespace ambf::devices
