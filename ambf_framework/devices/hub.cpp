#include "devices/hub.h"

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <utility>

#include "base/clock.h"
#include "base/realtime.h"
#include "devices/detail/device.h"

namespace ambf::devices {

namespace {

constexpr std::chrono::milliseconds kWatchPeriod{20};
constexpr unsigned kMaxDevices = base::kMaxSources - static_cast<unsigned>(state::Source::device_0);

state::Source source_of(unsigned device) {
  return static_cast<state::Source>(static_cast<unsigned>(state::Source::device_0) + device);
}

// Of users whose file names none: far apart, in the order of devices.
constexpr math::Vec3 kColors[] = {{0.20, 0.60, 0.95}, {0.95, 0.55, 0.15}, {0.35, 0.75, 0.35},
                                  {0.85, 0.35, 0.65}, {0.60, 0.50, 0.85}, {0.80, 0.75, 0.25}};

math::Vec3 color_of(const std::string& name, const scene::ColorTable& colors, const math::Vec3& fallback) {
  const auto found = colors.find(name);
  return found == colors.end() ? fallback : math::Vec3{found->second.r, found->second.g, found->second.b};
}

// What the people at the devices cannot know by themselves.
bool is_reported(state::DeviceFault fault) {
  using state::DeviceFault;
  return fault == DeviceFault::silent || fault == DeviceFault::bad_sample || fault == DeviceFault::jump ||
         fault == DeviceFault::backward_stamp || fault == DeviceFault::not_ready;
}

inputs::Channel& record_device(inputs::Recorder& recorder, const std::string& name, const Device::Setup& setup) {
  const DriverTraits& traits = setup.driver->traits();
  inputs::DeviceRecord record;
  record.number = static_cast<std::uint16_t>(setup.source) - static_cast<std::uint16_t>(state::Source::device_0);
  record.name = name;
  record.period_s = 1.0 / (traits.rate_hz > 0.0 ? traits.rate_hz : setup.rate_hz);
  record.orientation = traits.orientation;
  record.force = traits.force;
  record.torque = traits.torque;
  record.gripper = traits.gripper;
  record.event_driven = traits.event_driven;
  record.on_demand = traits.on_demand;
  record.buttons = traits.buttons;
  record.rate_hz = traits.rate_hz;
  record.max_force_N = traits.max_force_N;
  record.max_torque_Nm = traits.max_torque_Nm;
  record.max_stiffness_N_m = traits.max_stiffness_N_m;
  record.hold_at_start_s = traits.hold_at_start_s;
  recorder.add(record);
  return recorder.make_channel(static_cast<inputs::Stream>(inputs::kFirstDeviceStream + record.number));
}

}  // namespace

struct Hub::Member {
  scene::InputDevice file;
  state::Source source = state::Source::device_0;
  math::Vec3 color;
  std::string driver_type, problem;  // of its setup
  std::unique_ptr<Device> device;    // null: it cannot work
  Places places;                     // as bound
  bool bound = false, has_port = false;
  std::string logged_binding;
  std::uint64_t reported_faults = 0;
  std::uint32_t problem_changes = 0;
  std::shared_ptr<const state::DeviceInfo> info;  // under the hub's mutex
};

struct Hub::Loads {
  std::mutex mutex;
  std::vector<std::string> models;    // by device; empty: none, or not yet
  std::vector<std::string> problems;  // by device
  std::uint32_t changes = 0;
};

Hub::Hub(std::vector<scene::InputDevice> devices, const std::string& file, HubOptions options, HubAbilities abilities,
         base::Log& log)
    : options_(std::move(options)),
      abilities_(abilities),
      log_(log),
      forces_(options_.forces),
      loads_(std::make_shared<Loads>()) {
  const std::string folder = std::filesystem::path(file).parent_path().string();
  if (devices.size() > kMaxDevices) {
    log_.warning("there is room for %u input devices; the rest is left out", kMaxDevices);
    devices.resize(kMaxDevices);
  }
  loads_->models.resize(devices.size());
  loads_->problems.resize(devices.size());
  for (unsigned i = 0; i < devices.size(); ++i) {
    auto member = std::make_unique<Member>();
    member->file = std::move(devices[i]);
    member->source = source_of(i);
    member->color = color_of(member->file.color, options_.colors, kColors[i % std::size(kColors)]);
    members_.push_back(std::move(member));
    start(*members_.back(), folder);
    if (members_.back()->device != nullptr) load_multibody(i);
    renew_info(*members_.back());
  }
  watcher_ = std::thread([this] { watch(); });
}

Hub::~Hub() {
  stop_ = true;
  stopping_.notify_all();
  watcher_.join();
  for (const auto& member : members_) member->device.reset();
}

void Hub::scene_loaded() {
  if (!options_.log) return;
  scene_loaded_ = true;
  for (const auto& member : members_) {
    if (member->device != nullptr) member->device->log_problems();
  }
}

void Hub::start(Member& member, const std::string& folder) {
  Device::Setup setup;
  setup.name = member.file.name;
  setup.thread_name =
      state::thread_name_of(static_cast<unsigned>(member.source) - static_cast<unsigned>(state::Source::device_0));
  setup.driver = make_driver(request_of(member.file, folder), member.driver_type, member.problem);
  std::unique_ptr<state::FrameReader> reader;
  if (setup.driver != nullptr) reader = abilities_.observe.make_reader();
  if (setup.driver != nullptr && reader == nullptr) member.problem = "there are too many readers of frames";
  if (reader == nullptr) {
    log_.error("device '%s': %s", member.file.name.c_str(), member.problem.c_str());
    return;
  }
  setup.settings = settings_of(member.file);
  setup.settings.fixed_dt = options_.fixed_dt;
  setup.source = member.source;
  setup.rate_hz = options_.rate_hz;
  setup.real_time = options_.real_time;
  setup.forces = options_.forces;
  if (options_.recorder != nullptr) setup.record = &record_device(*options_.recorder, member.file.name, setup);
  member.device = std::make_unique<Device>(std::move(setup), std::move(reader), log_);
}

void Hub::load_multibody(unsigned index) {
  const scene::InputDevice& file = members_[index]->file;
  if (file.multibody_file.empty()) return;
  state::LoadRequest request;
  request.path = file.multibody_file;
  request.of_device = state::DeviceModel{file.name, file.root_link, file.location};
  abilities_.edit.load(std::move(request), [loads = loads_, index](const state::Outcome& outcome) {
    const std::lock_guard lock(loads->mutex);
    (outcome.success ? loads->models : loads->problems)[index] = outcome.success ? outcome.model : outcome.message;
    ++loads->changes;
  });
}

void Hub::watch() {
  base::set_thread_name("devices");
  std::uint64_t version = 0;
  std::uint32_t changes = 0;
  bool first = true;
  while (!stop_) {
    const std::uint32_t seen = stopping_.count();
    const std::shared_ptr<const state::Structure> structure = abilities_.observe.structure();
    std::vector<std::string> models, problems;
    {
      const std::lock_guard lock(loads_->mutex);
      models = loads_->models;
      problems = loads_->problems;
      if (loads_->changes != changes) first = true;
      changes = loads_->changes;
    }
    const bool changed = first || (structure != nullptr && structure->version != version);
    for (std::size_t i = 0; i < members_.size(); ++i) {
      Member& member = *members_[i];
      if (member.device == nullptr) continue;
      delete member.device->inbox().retired.exchange(nullptr, std::memory_order_acq_rel);
      if (changed && structure != nullptr) {
        if (!problems[i].empty()) member.problem = problems[i];
        bind(member, *structure, models[i]);
      }
      if (member.device->problem_changes() != member.problem_changes) {
        member.problem_changes = member.device->problem_changes();
        renew_info(member);
      }
      if (options_.log) log_binding(member);
      report_faults(member);
    }
    if (structure != nullptr) {
      version = structure->version;
      first = false;
    }
    stopping_.wait_beyond(seen, kWatchPeriod);
  }
}

void Hub::bind(Member& member, const state::Structure& structure, const std::string& multibody) {
  Places places = find_places(structure, member.file, multibody);
  const bool same = member.bound && places.body == member.places.body && places.cameras == member.places.cameras &&
                    (member.has_port || !places.body.valid());
  member.bound = true;
  if (same) return;
  auto binding = std::make_unique<EffectorBinding>();
  if (places.body.valid()) {
    binding->port = abilities_.effector.hold(places.body, member.source);
    if (binding->port == nullptr) places.problem = "'" + places.body_name + "' cannot be held";
  }
  member.has_port = binding->port != nullptr;
  binding->body = member.has_port ? places.body : state::ObjectId{};
  binding->own_gains = places.own_gains;
  binding->own_multibody = !member.file.multibody_file.empty();
  binding->jaw_joints = places.jaw_joints;
  for (const state::ObjectId camera : places.cameras) {
    // Devices that move the same camera share its lock.
    std::shared_ptr<CameraLock>& lock = camera_locks_[{camera.index, camera.generation}];
    if (lock == nullptr) lock = std::make_shared<CameraLock>();
    binding->cameras.push_back({camera, abilities_.command.bind(camera, member.source), lock});
  }
  member.places = std::move(places);
  delete member.device->inbox().incoming.exchange(binding.release(), std::memory_order_acq_rel);
  renew_info(member);
}

void Hub::log_binding(Member& member) {
  if (!member.bound || (!member.has_port && !scene_loaded_)) return;
  const std::string& name = member.file.name;
  const Places& places = member.places;
  const std::string line = member.has_port ? "device '" + name + "' moves '" + places.body_name + "'"
                                           : "device '" + name + "': " + places.problem;
  if (line == member.logged_binding) return;
  member.logged_binding = line;
  log_.info("%s", line.c_str());
}

void Hub::renew_info(Member& member) {
  auto info = std::make_shared<state::DeviceInfo>();
  const scene::InputDevice& file = member.file;
  info->name = file.name;
  info->hardware_name = file.hardware_name;
  info->driver = member.driver_type;
  info->source = member.source;
  info->effector = member.has_port ? member.places.body : state::ObjectId{};
  info->effector_name = member.has_port ? member.places.body_name : file.root_link;
  info->multibody = file.multibody_file;
  info->cameras = member.places.cameras;
  info->camera_names = member.places.camera_names;
  info->color = member.color;
  info->limits = {file.deadband_N, file.max_force_N, file.max_torque_Nm, file.max_jerk_N_per_ms};
  info->button_mapping = file.buttons;
  info->joint_control = file.enable_joint_control;
  info->visible = file.visible;
  info->visible_size = file.visible_size;
  info->visible_color = color_of(file.visible_color, options_.colors, member.color);
  info->on_loss = file.on_loss;
  info->message = member.problem;
  if (member.device != nullptr) {
    const DriverTraits& traits = member.device->traits();
    info->orientation = traits.orientation;
    info->force = traits.force;
    info->torque = traits.torque;
    info->gripper = traits.gripper;
    info->buttons = traits.buttons;
    info->on_demand = traits.on_demand;
    info->rate_hz = member.device->rate_hz();
    info->device_max_force_N = traits.max_force_N;
    info->device_max_torque_Nm = traits.max_torque_Nm;
    info->device_max_stiffness_N_m = traits.max_stiffness_N_m;
    const std::string problem = member.device->problem();
    if (!problem.empty()) info->message = problem;
    if (info->message.empty()) info->message = member.places.problem;
  }
  const std::lock_guard lock(mutex_);
  member.info = std::move(info);
}

void Hub::report_faults(Member& member) {
  state::DeviceStatus status;
  if (!member.device->inbox().status.read(status) || status.faults == member.reported_faults) return;
  member.reported_faults = status.faults;
  if (!is_reported(status.fault)) return;
  if (status.fault == state::DeviceFault::not_ready && member.device->traits().on_demand) return;
  const char* why = status.fault == state::DeviceFault::not_ready ? status.not_ready : "";
  log_.warning("device '%s': %s%s%s; it counts as clutched", member.file.name.c_str(), state::name_of(status.fault),
               *why != '\0' ? ": " : "", why);
}

std::shared_ptr<const state::DeviceInfo> Hub::info(unsigned device) const {
  if (device >= members_.size()) return nullptr;
  const std::lock_guard lock(mutex_);
  return members_[device]->info;
}

bool Hub::status(unsigned device, state::DeviceStatus& status) const {
  return device < members_.size() && members_[device]->device != nullptr &&
         members_[device]->device->inbox().status.read(status);
}

std::string Hub::set(unsigned device, state::DeviceParameter parameter, const math::Vec3& value) {
  if (device >= members_.size()) return "there is no such device";
  if (std::string problem = state::check(parameter, value); !problem.empty()) return problem;
  const auto post = [&](Member& member, const math::Vec3& number) {
    return member.device != nullptr && member.device->inbox().settings.try_push({parameter, number});
  };
  const state::ObjectId effector = info(device)->effector;
  std::vector<unsigned> partners;
  for (unsigned i = 0; i < count(); ++i) {
    if (i != device && effector.valid() && info(i)->effector == effector) partners.push_back(i);
  }
  const bool is_scheme = parameter == state::DeviceParameter::scheme;
  if (is_scheme && partners.size() != 1) return "a scheme is for two devices that share a tool";
  const bool later = is_scheme && partners.front() < device;
  if (!post(*members_[device], is_scheme ? math::Vec3{value.x, later ? 1.0 : 0.0, 0.0} : value)) {
    return "the device does not run";
  }
  if (partners.size() != 1) return {};
  Member& partner = *members_[partners.front()];
  if (is_scheme) post(partner, {value.x, later ? 0.0 : 1.0, 0.0});
  // Of a pair, what one gains the other loses.
  if (parameter == state::DeviceParameter::dominance) post(partner, {1.0 - value.x, 0.0, 0.0});
  return {};
}

void Hub::set_forces(bool on) {
  forces_ = on;
  for (const auto& member : members_) {
    if (member->device != nullptr) member->device->inbox().forces = on;
  }
}

void Hub::push(unsigned device, const math::Wrench& wrench_world) { post_external(device, {wrench_world, false, {}}); }

void Hub::pull_to(unsigned device, const math::Pose& T_world_target) {
  post_external(device, {{}, true, T_world_target});
}

void Hub::post_external(unsigned device, const DeviceInbox::External& external) {
  if (device >= members_.size() || members_[device]->device == nullptr) return;
  const std::lock_guard lock(mutex_);
  members_[device]->device->inbox().external.post(external, base::steady_ns());
}

}  // namespace ambf::devices
