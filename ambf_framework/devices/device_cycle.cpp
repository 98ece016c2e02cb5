#include "devices/detail/device_cycle.h"

#include <algorithm>
#include <cstring>

#include "base/clock.h"
#include "math/rotation.h"

namespace ambf::devices {

using state::DeviceFault;

namespace {

constexpr double kLongestCycle_s = 0.1;             // a thread that was stopped does not catch up
constexpr std::int64_t kPercentilesNs = 250000000;  // walking the histograms takes some 10 us

// As inputs::BindingRecord, without a copy.
struct BindingRef {
  static constexpr inputs::Type kType = inputs::Type::binding;
  const EffectorBinding& binding;

  template <class Self, class Archive>
  static void members(Self& r, Archive& a) {
    const EffectorBinding& b = r.binding;
    a(b.port != nullptr ? b.body : state::ObjectId{}), a(b.own_gains), a(b.own_multibody), a(b.jaw_joints);
    a(static_cast<std::uint32_t>(b.cameras.size()));
    for (const EffectorBinding::Camera& camera : b.cameras) a(camera.id);
  }
};

bool releases(DeviceFault fault) {
  return fault == DeviceFault::lost || fault == DeviceFault::not_found || fault == DeviceFault::silent ||
         fault == DeviceFault::not_ready;
}

}  // namespace

DeviceCycle::DeviceCycle(Driver& driver, DeviceInbox& inbox, const DeviceSettings& settings, state::Source source,
                         double period_s, inputs::Channel* record)
    : period_s_(period_s),
      driver_(driver),
      inbox_(inbox),
      samples_(driver, inbox, period_s),
      settings_(settings, driver.traits()),
      view_(source),
      cameras_(source),
      record_(record) {
  cycle_record_.settings.reserve(inbox.settings.capacity());
  cycle_record_.not_ready.reserve(256);
  mapping_.set_mounting(settings.T_base_bo, settings.T_e_to);
  mapping_.set_offsets(settings.T_world_sde_bo, settings.R_sde_to);
}

void DeviceCycle::step(std::int64_t now_ns, const state::Frame* frame) {
  const bool nominal = last_ns_ == 0 || settings_.file().fixed_dt;
  const double dt = nominal ? period_s_ : std::clamp(base::to_seconds(now_ns - last_ns_), 0.0, kLongestCycle_s);
  if (last_ns_ != 0) period_.add(now_ns - last_ns_);
  last_ns_ = now_ns;
  ++status_.cycle;

  take_inbox();
  settings_.advance(dt);
  view_.update(frame, now_ns);
  samples_.read(now_ns, faults_);
  judge_simulation();
  faults_.end_cycle(now_ns);
  map(now_ns, dt);
  post();
  push_hand(now_ns, dt);
  measure(now_ns);
  publish(now_ns);
  if (record_ != nullptr) note_cycle(now_ns);
}

void DeviceCycle::note_cycle(std::int64_t now_ns) {
  using Given = inputs::CycleRecord::Reading;
  const SampleSource::Given& given = samples_.given();
  inputs::CycleRecord& out = cycle_record_;
  out.cycle = status_.cycle;
  out.now_ns = now_ns;
  out.frame = view_.frame() == nullptr ? 0 : view_.frame()->sequence;
  out.cameras_held = cameras_.held();
  out.reading = !given.open                        ? Given::closed
                : given.reading == Reading::sample ? Given::sample
                : given.reading == Reading::lost   ? Given::lost
                                                   : Given::nothing_new;
  out.sample.reset();
  out.not_ready.clear();
  if (out.reading == Given::sample) {
    const Sample& sample = given.sample;
    out.sample = {sample.stamp_ns, sample.T_u_tip, sample.jaw, sample.buttons, sample.has_jaw, sample.ready};
    if (!sample.ready) out.not_ready.append(sample.not_ready, strnlen(sample.not_ready, out.not_ready.capacity()));
  }
  record_->add(out);
  out.settings.clear();
  out.external.reset();
  out.set_point.reset();
}

void DeviceCycle::end() {
  if (binding_ != nullptr && binding_->port != nullptr) binding_->port->let_go();
  cameras_.acquire(binding_.get(), view_, false);
  if (samples_.connected() && driver_.traits().force) driver_.write({});
}

void DeviceCycle::take_inbox() {
  DeviceInbox::Setting setting;
  while (inbox_.settings.try_pop(setting)) {
    settings_.set(setting.parameter, setting.value);
    if (record_ != nullptr) cycle_record_.settings.push_back({setting.parameter, setting.value});
  }
  if (inbox_.external.refresh() && record_ != nullptr) {
    const DeviceInbox::External& external = inbox_.external.value();
    cycle_record_.external = {inbox_.external.time_ns(), external.wrench_world, external.pulls,
                              external.T_world_target};
  }
  take_binding();
}

void DeviceCycle::take_binding() {
  // Not before the hub has freed the one before: from then on nothing but the force delays it.
  if (pending_ == nullptr && inbox_.retired.load(std::memory_order_acquire) == nullptr) {
    pending_.reset(inbox_.incoming.exchange(nullptr, std::memory_order_acq_rel));
    if (pending_ != nullptr && record_ != nullptr) record_->add(BindingRef{*pending_});
  }
  if (pending_ == nullptr) return;
  const bool same_body = binding_ != nullptr && binding_->body == pending_->body;
  const bool felt = norm(status_.wrench_u_written.force) > 0.0 || norm(status_.wrench_u_written.torque) > 0.0;
  if (!same_body && felt) return faults_.raise(DeviceFault::no_effector);  // first the force, then the effector
  cameras_.acquire(binding_.get(), view_, false);
  inbox_.retired.store(binding_.release(), std::memory_order_release);
  binding_ = std::move(pending_);
  view_.bind(binding_.get());
  settings_.bind(*binding_);
  if (same_body) return;
  restart_ = true;
  jaw_.restart();
}

void DeviceCycle::judge_simulation() {
  const state::Frame* frame = view_.frame();
  if (frame == nullptr) return faults_.raise(DeviceFault::no_frame);
  if (!epoch_known_ || frame->epoch != epoch_) {
    if (epoch_known_) faults_.raise(DeviceFault::restarted);
    epoch_ = frame->epoch;
    epoch_known_ = true;
    restart_ = true;
  }
  if (!view_.has_effector()) return faults_.raise(DeviceFault::no_effector);
  if (view_.body().frozen) faults_.raise(DeviceFault::diverged);
  if (frame->run.paused) faults_.raise(DeviceFault::paused);
  if (view_.age_s() > state::kDeviceFrameTimeoutS) faults_.raise(DeviceFault::no_frame);
}

void DeviceCycle::map(std::int64_t now_ns, double dt) {
  const Sample& sample = samples_.sample();
  if (samples_.is_new()) settings_.press(sample.buttons);
  const bool allowed = faults_.fault() == DeviceFault::none && samples_.started(now_ns) && samples_.settled();
  status_.clutched = settings_.clutch(sample.buttons);
  status_.camera_clutched = settings_.camera_clutch(sample.buttons);
  status_.engaged = allowed && !status_.clutched && !status_.camera_clutched;

  if (view_.has_effector()) {
    mapping_.set_effector(view_.T_world_sde());
    const state::EffectorState* own = view_.own();
    if (restart_) {
      mapping_.start_at(view_.body().T_world_body);
      restart_ = false;
    } else if (!posted_engaged_ && own != nullptr && !own->engaged) {
      mapping_.adopt(own->T_world_ref);
    }
  }
  if (!samples_.has_sample()) return;

  cameras_.acquire(binding_.get(), view_, allowed && status_.camera_clutched);
  MappingInput in;
  in.T_u_iid = sample.T_u_tip;
  if (view_.frame() != nullptr && view_.has_camera(0)) in.T_world_cam = view_.camera(0).T_world_camera;
  in.clutch = !status_.engaged && !status_.camera_clutched;
  in.camera_clutch = status_.camera_clutched;
  in.camera_lock = cameras_.holds(0);
  in.workspace_scaling = settings_.workspace_scaling();
  in.camera_scaling = settings_.camera_scaling();
  in.rotation = settings_.rotation();
  in.dt = dt;
  mapping_.tick(in);
  if (view_.frame() != nullptr) {
    cameras_.command(binding_.get(), view_, mapping_.frames(), T_u_iid_previous_, in.camera_scaling, now_ns);
  }
  T_u_iid_previous_ = in.T_u_iid;

  const math::Pose& ref = mapping_.frames().T_world_ref;
  if (!status_.engaged) {
    status_.twist_world_ref = {};
    ref_sample_ns_ = 0;
  } else if (samples_.is_new()) {
    const double seconds = base::to_seconds(sample.stamp_ns - ref_sample_ns_);
    if (ref_sample_ns_ != 0 && seconds > 0.0) {
      const math::Quat turned = ref.orientation * inverse(T_world_ref_sample_.orientation);
      status_.twist_world_ref = {(ref.position - T_world_ref_sample_.position) / seconds, math::log(turned) / seconds};
    }
    T_world_ref_sample_ = ref;
    ref_sample_ns_ = sample.stamp_ns;
  } else if (base::to_seconds(now_ns - samples_.read_ns()) > 2.0 * samples_.period_s()) {
    status_.twist_world_ref = {};
  }
}

void DeviceCycle::post() {
  const bool shared = view_.has_effector() && view_.is_shared();
  JawInput jaw;
  jaw.has_gripper = samples_.has_sample() && samples_.sample().has_jaw;
  jaw.gripper = samples_.sample().jaw;
  jaw.has_button = settings_.file().buttons.gripper >= 0;
  jaw.button = LiveSettings::down(samples_.sample().buttons, settings_.file().buttons.gripper);
  jaw.offset = settings_.jaw_offset();
  jaw.engaged = status_.engaged;
  jaw.tool = view_.has_effector() ? view_.jaw_opening() : 0.5;
  if (view_.has_effector()) jaw_.step(jaw);

  status_.pulls_effector = false;
  posted_engaged_ = false;
  if (!view_.has_effector()) return;
  const DeviceFault fault = faults_.fault();
  const bool let_go = fault == DeviceFault::diverged ||
                      (releases(fault) && settings_.file().on_loss == state::OnLoss::release) ||
                      !(samples_.ever_connected() || binding_->own_multibody);
  state::SetPoint point;
  point.T_world_ref = mapping_.frames().T_world_ref;
  point.gains = settings_.effector_gains();
  point.period_s = samples_.period_s();
  point.epoch = epoch_;
  point.pulls = !let_go;
  point.engaged = status_.engaged;
  // What holds the jaw of a shared tool is a gripper, or a button for it.
  point.moves_jaw =
      settings_.file().joint_control && jaw_.moves() && (jaw.has_gripper || jaw.has_button || !shared) && !let_go;
  // Before they have met, physics sees where the hand is: a button passes the tool's opening within one sample.
  point.jaw = jaw_.moves() ? jaw_.tool() : jaw_.hand();
  point.sample = samples_.number();
  point.sampled_ns = samples_.read_ns();
  binding_->port->post(point);
  if (record_ != nullptr) cycle_record_.set_point = point;
  posted_engaged_ = point.engaged;
  restart_ = let_go;  // others may move it until it is held again
  status_.pulls_effector = point.pulls;
  status_.gains = point.gains;
  status_.follows_partner = !point.engaged && view_.partner_engaged();
}

void DeviceCycle::push_hand(std::int64_t now_ns, double dt) {
  const state::MappingFrames& frames = mapping_.frames();
  const DriverTraits& traits = driver_.traits();
  HandForceInput in;
  in.T_world_ref = in.T_world_sde = frames.T_world_ref;
  if (view_.has_effector()) {
    in.T_world_sde = frames.T_world_sde;
    in.twist_world_ref = status_.twist_world_ref;
    // Physics moves REF over the period of the samples: what the tool has not been asked for yet is not felt.
    const double ahead_s = std::max(0.0, samples_.period_s() - base::to_seconds(now_ns - samples_.read_ns()));
    in.T_world_ref.position -= in.twist_world_ref.linear * ahead_s;
    in.T_world_ref.orientation =
        math::normalized(math::exp(in.twist_world_ref.angular * -ahead_s) * in.T_world_ref.orientation);
    in.twist_world_sde = view_.twist_world_sde();
  }
  in.gains = settings_.hand_gains();
  in.R_world_u = frames.T_world_cam.orientation;
  in.R_world_u_torque =
      settings_.rotation() == state::RotationReference::world ? frames.T_world_sde_bo.orientation : in.R_world_u;
  const bool external_lives =
      inbox_.external.sequence() != 0 && base::to_seconds(now_ns - inbox_.external.time_ns()) < state::kDeviceCommandS;
  if (external_lives) {
    const DeviceInbox::External& external = inbox_.external.value();
    in.external_world = external.wrench_world;
    if (external.pulls) in.T_world_sde = external.T_world_target;
  }
  in.limits = settings_.limits();
  in.torque = traits.torque;
  cycle_record_.forces = inbox_.forces.load(std::memory_order_relaxed);
  in.allowed = status_.engaged && cycle_record_.forces && traits.force;
  in.fault = faults_.fault() != DeviceFault::none;
  in.ramp_s = settings_.file().ramp_s;
  in.dt = dt;
  const HandForceOutput out = hand_force_.step(in);
  if (samples_.connected() && traits.force) driver_.write(out.written_u);
  status_.wrench_u_wanted = out.wanted_u;
  status_.wrench_u_written = out.written_u;
  status_.at_limit = out.at_limit;
  status_.hand_gains = in.gains;
  status_.limits = in.limits;
}

void DeviceCycle::measure(std::int64_t now_ns) {
  if (view_.is_new() && view_.has_effector()) {
    const state::EffectorState* own = view_.own();
    if (own != nullptr && own->sample != applied_sample_ && own->applied_ns != 0) {
      applied_sample_ = own->sample;
      set_point_age_.add(own->applied_ns - own->sampled_ns);
      sample_to_force_.add(now_ns - own->sampled_ns);
    }
  }
  if (now_ns - percentiles_ns_ >= kPercentilesNs) {
    percentiles_ns_ = now_ns;
    status_.period = period_.percentiles();
    status_.set_point_age = set_point_age_.percentiles();
    status_.sample_to_force = sample_to_force_.percentiles();
  }
  const double counted_s = base::to_seconds(now_ns - second_ns_);
  if (counted_s >= 1.0) {
    if (second_ns_ != 0) {
      status_.rate_hz = static_cast<double>(status_.cycle - second_cycle_) / counted_s;
      status_.sample_rate_hz = static_cast<double>(samples_.number() - second_sample_) / counted_s;
    }
    second_ns_ = now_ns;
    second_cycle_ = status_.cycle;
    second_sample_ = samples_.number();
  }
}

void DeviceCycle::publish(std::int64_t now_ns) {
  status_.steady_ns = now_ns;
  status_.sample = samples_.number();
  status_.sampled_ns = samples_.sample().stamp_ns;
  status_.frames = mapping_.frames();
  status_.connected = samples_.connected();
  status_.ready = samples_.has_sample() && samples_.sample().ready;
  status_.not_ready = samples_.sample().not_ready;
  status_.started = samples_.started(now_ns);
  status_.camera_locked = cameras_.holds_any();
  status_.forces_on = inbox_.forces.load(std::memory_order_relaxed);
  status_.fault = faults_.fault();
  status_.fault_since_ns = faults_.since_ns();
  status_.faults = faults_.count();
  status_.refused_samples = samples_.refused();
  status_.mode = settings_.mode();
  status_.rotation = settings_.rotation();
  status_.scheme = settings_.scheme();
  status_.buttons = samples_.sample().buttons;
  status_.jaw_hand = jaw_.hand();
  status_.jaw_tool = jaw_.moves() ? jaw_.tool() : (view_.has_effector() ? view_.jaw_opening() : 0.5);
  status_.jaw_follows = jaw_.follows();
  status_.workspace_scaling = settings_.workspace_scaling();
  status_.camera_scaling = settings_.camera_scaling();
  status_.dominance = settings_.dominance();
  inbox_.status.publish(status_);
}

}  // namespace ambf::devices
