// All input devices of a run: made from the device file, bound to what is loaded, seen and set by others through
// state::DeviceAbility. They live outside the simulated world: what physics sees of each are set-points of its source.
#pragma once

#include <atomic>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "base/event_count.h"
#include "base/log.h"
#include "devices/binding.h"
#include "devices/device_inbox.h"
#include "devices/driver.h"
#include "inputs/recorder.h"
#include "scene/colors.h"
#include "scene/description.h"
#include "state/abilities/command.h"
#include "state/abilities/devices.h"
#include "state/abilities/edit.h"
#include "state/abilities/effector.h"
#include "state/abilities/observe.h"

namespace ambf::devices {

class Device;

struct HubAbilities {
  state::ObserveAbility& observe;
  state::EditAbility& edit;
  state::CommandAbility& command;
  state::EffectorAbility& effector;
};

struct HubOptions {
  double rate_hz = 1000.0;  // of devices whose driver has none of its own
  bool forces = false;
  bool fixed_dt = false;  // DeviceSettings::fixed_dt
  bool real_time = true;  // threads above physics, where the system permits
  bool log = true;        // what they move and lack; false where nobody asked for these devices
  scene::ColorTable colors;
  inputs::Recorder* recorder = nullptr;  // of all inputs; null: none
};

class Hub final : public state::DeviceAbility {
 public:
  // Starts all devices, in the order of the list; those that cannot work are reported, the rest runs. `log` and what
  // the abilities belong to must outlive it.
  Hub(std::vector<scene::InputDevice> devices, const std::string& file, HubOptions options, HubAbilities abilities,
      base::Log& log);
  ~Hub() override;  // zero forces first; all effectors are let go

  // What the program starts with is loaded: from now on the log reports what devices lack. Before, bodies, windows and
  // ROS are expected to come.
  void scene_loaded();

  unsigned count() const override { return static_cast<unsigned>(members_.size()); }
  std::shared_ptr<const state::DeviceInfo> info(unsigned device) const override;
  bool status(unsigned device, state::DeviceStatus& status) const override;
  std::string set(unsigned device, state::DeviceParameter parameter, const math::Vec3& value) override;
  bool forces() const override { return forces_.load(); }
  void set_forces(bool on) override;
  void push(unsigned device, const math::Wrench& wrench_world) override;
  void pull_to(unsigned device, const math::Pose& T_world_target) override;

 private:
  struct Member;
  // Loading of multibodies ends on other threads, perhaps after this object.
  struct Loads;

  void start(Member& member, const std::string& folder);
  void load_multibody(unsigned index);
  void watch();  // on its thread: binds, frees, reports
  void bind(Member& member, const state::Structure& structure, const std::string& multibody);
  void log_binding(Member& member);
  void renew_info(Member& member);
  void report_faults(Member& member);
  void post_external(unsigned device, const DeviceInbox::External& external);

  HubOptions options_;
  HubAbilities abilities_;
  base::Log& log_;
  std::atomic<bool> forces_{false}, stop_{false}, scene_loaded_{false};
  mutable std::mutex mutex_;  // infos, writers of external commands
  std::vector<std::unique_ptr<Member>> members_;
  std::shared_ptr<Loads> loads_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::shared_ptr<CameraLock>> camera_locks_;  // watch thread's
  base::EventCount stopping_;
  std::thread watcher_;  // last: it uses the rest
};

// Of one block; null driver: none answers to it, `problem` says what was looked for.
DeviceSettings settings_of(const scene::InputDevice& device);
DriverRequest request_of(const scene::InputDevice& device, const std::string& folder);
std::unique_ptr<Driver> make_driver(const DriverRequest& request, std::string& type, std::string& problem);

}  // namespace ambf::devices
