// One cycle of a device: sample -> mapping -> set-point, frame -> force on the hand, and all that can go wrong. The
// device's thread calls it once a period; tests and replays call it with times and frames of their own. Nothing in here
// waits (only the driver may), locks, allocates or logs.
#pragma once

#include <cstdint>
#include <memory>

#include "devices/detail/camera_control.h"
#include "devices/detail/fault_tracker.h"
#include "devices/detail/frame_view.h"
#include "devices/detail/live_settings.h"
#include "devices/detail/run_histogram.h"
#include "devices/detail/sample_source.h"
#include "devices/device_inbox.h"
#include "devices/driver.h"
#include "devices/hand_force.h"
#include "devices/jaw.h"
#include "devices/mapping.h"
#include "inputs/device_records.h"
#include "inputs/recorder.h"
#include "state/frame.h"

namespace ambf::devices {

class DeviceCycle {
 public:
  DeviceCycle(Driver& driver, DeviceInbox& inbox, const DeviceSettings& settings, state::Source source, double period_s,
              inputs::Channel* record = nullptr);

  // `frame`: the newest one; null: there is none yet.
  void step(std::int64_t now_ns, const state::Frame* frame);
  // After the last cycle: no force, and the effector is let go.
  void end();

  const state::DeviceStatus& status() const { return status_; }
  void count_slip() { ++status_.slips; }
  void set_fifo(bool fifo) { status_.fifo = fifo; }

 private:
  void take_inbox();
  void take_binding();
  void judge_simulation();
  void map(std::int64_t now_ns, double dt);
  void post();
  void push_hand(std::int64_t now_ns, double dt);
  void measure(std::int64_t now_ns);
  void publish(std::int64_t now_ns);
  void note_cycle(std::int64_t now_ns);

  const double period_s_;
  Driver& driver_;
  DeviceInbox& inbox_;
  SampleSource samples_;
  FaultTracker faults_;
  LiveSettings settings_;
  FrameView view_;
  CameraControl cameras_;
  Mapping mapping_;
  HandForce hand_force_;
  Jaw jaw_;
  std::unique_ptr<EffectorBinding> binding_, pending_;

  std::int64_t last_ns_ = 0;
  std::uint64_t epoch_ = 0;
  bool epoch_known_ = false;
  bool restart_ = true;  // REF begins at the body
  bool posted_engaged_ = false;
  math::Pose T_u_iid_previous_;    // of the cycle before
  math::Pose T_world_ref_sample_;  // REF at the sample before
  std::int64_t ref_sample_ns_ = 0;

  state::DeviceStatus status_;
  RunHistogram period_, set_point_age_, sample_to_force_;
  std::uint64_t applied_sample_ = 0;
  std::int64_t second_ns_ = 0;  // start of the second that rates are counted in
  std::uint64_t second_cycle_ = 0, second_sample_ = 0;
  std::int64_t percentiles_ns_ = 0;

  inputs::Channel* const record_;
  inputs::CycleRecord cycle_record_;  // of this cycle; filled while there is a recording
};

}  // namespace ambf::devices
