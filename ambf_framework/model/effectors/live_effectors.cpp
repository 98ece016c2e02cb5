#include "model/detail/live_effectors.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "base/clock.h"
#include "inputs/physics_records.h"
#include "inputs/recorder.h"

namespace ambf::model {
namespace {

using state::EffectorGains;
using state::SetPoint;

constexpr double kRounding_s = 1e-6;     // as of commands: rounding does not decide in which step one expires
constexpr double kMaxIteration_s = 0.1;  // slower iterations (free runs) say nothing about samples

constexpr double kMaxGap_s = 10.0;  // between samples: longer gaps mean the same

constexpr std::array kAxes{&math::Vec3::x, &math::Vec3::y, &math::Vec3::z};

// One of the four kinds of gains: where it stands for devices, for the controller, and what is left of the latter.
struct GainKind {
  math::Vec3 EffectorGains::*of_device;
  math::Vec3 scene::ChannelGains::*of_controller;
  math::Vec3 GainScale::*scale;
  bool angular, damping;
};
constexpr GainKind kGainKinds[] = {
    {&EffectorGains::linear_stiffness, &scene::ChannelGains::p, &GainScale::linear_stiffness, false, false},
    {&EffectorGains::linear_damping, &scene::ChannelGains::d, &GainScale::linear_damping, false, true},
    {&EffectorGains::angular_stiffness, &scene::ChannelGains::p, &GainScale::angular_stiffness, true, false},
    {&EffectorGains::angular_damping, &scene::ChannelGains::d, &GainScale::angular_damping, true, true}};

const scene::ChannelGains& channel_of(const LiveBody& body, bool angular) {
  return angular ? body.controller.angular() : body.controller.linear();
}

bool driven_by_force(const LiveBody& body, bool angular) {
  return body.mode == state::CartesianCommandType::position &&
         channel_of(body, angular).output == scene::ControllerOutput::force;
}

// Whether a pose or twist command acts along this axis.
bool commanded(const LiveBody& body, bool angular, double math::Vec3::*axis) {
  if (body.mode == state::CartesianCommandType::velocity) return true;
  if (body.mode != state::CartesianCommandType::position) return false;
  const scene::ChannelGains& gains = channel_of(body, angular);
  return gains.output != scene::ControllerOutput::force || gains.p.*axis > 0.0 || gains.i.*axis > 0.0 ||
         gains.d.*axis > 0.0;
}

math::Vec3& stiffness(EffectorGains& gains, bool angular) {
  return angular ? gains.angular_stiffness : gains.linear_stiffness;
}
math::Vec3& damping(EffectorGains& gains, bool angular) {
  return angular ? gains.angular_damping : gains.linear_damping;
}
bool acts_along(EffectorGains gains, bool angular, double math::Vec3::*axis) {
  return stiffness(gains, angular).*axis > 0.0 || damping(gains, angular).*axis > 0.0;
}

std::uint64_t steps_of(double seconds, double h_s) {
  return static_cast<std::uint64_t>(std::max(1.0, std::round(seconds / h_s)));
}

}  // namespace

LiveEffectors::LiveEffectors(LiveTables& tables, double watchdog_s) : tables_(tables), watchdog_s_(watchdog_s) {
  held_.reserve(base::kMaxEffectors);
}

bool LiveEffectors::take(const state::Structure& structure, std::uint64_t epoch, double watchdog_s, std::uint64_t steps,
                         double h_s) {
  watchdog_now_s_ = watchdog_s;
  bool changed = false, fresh = false;
  for (std::size_t number = 0; number < table_.used(); ++number) {
    EffectorSlot& slot = table_[number];
    if (!slot.posted.refresh() || slot.posted.released()) continue;
    const PostedSetPoint& posted = slot.posted.value();
    if (posted.hold <= slot.ended.load(std::memory_order_acquire) || posted.set_point.epoch != epoch) continue;
    if (record_ != nullptr) {
      record_->add(inputs::SetPointRecord{static_cast<std::uint32_t>(number), posted.hold, posted.body, posted.source,
                                          slot.posted.time_ns()});
    }
    LiveEffector* effector = find_or_make(structure, posted);
    if (effector == nullptr) continue;
    const SetPoint& before = effector->is.set_point;
    changed |= before.pulls != posted.set_point.pulls || before.engaged != posted.set_point.engaged;
    effector->slot = static_cast<int>(number);
    effector->hold = posted.hold;
    accept(*effector, posted.set_point, std::min(steps, steps_of(kMaxIteration_s, h_s)), h_s);
    fresh = true;
  }
  if (fresh) each_body([&](std::span<LiveEffector> of_body) { choose_leader(structure, of_body); });
  return changed;
}

// Null when the body is gone or frozen, or there is no room (a snapshot brought some that no port holds).
LiveEffector* LiveEffectors::find_or_make(const state::Structure& structure, const PostedSetPoint& posted) {
  const std::uint32_t object = state::find(structure, posted.body);
  if (object == state::kNone) return nullptr;
  LiveBody& body = tables_.bodies()[structure.objects[object].slot];
  if (body.body->frozen()) return nullptr;
  const auto key = [](const LiveBody& of, state::Source source) { return std::tuple(of.body->user_index(), source); };
  const auto at = std::find_if(held_.begin(), held_.end(), [&](const LiveEffector& each) {
    return key(*each.body, each.is.source) >= key(body, posted.source);
  });
  if (at != held_.end() && at->body == &body && at->is.source == posted.source) return &*at;
  if (held_.size() == base::kMaxEffectors) return nullptr;
  LiveEffector made;
  made.body = &body;
  made.is.source = posted.source;
  made.is.jaw_in_force = made.is.jaw_seen = made.is.jaw_mark = std::clamp(posted.set_point.jaw, 0.0, 1.0);
  return &*held_.insert(at, made);
}

// A clutched device's reference goes on to where it was going, and stays there.
void LiveEffectors::accept(LiveEffector& effector, const SetPoint& set_point, std::uint64_t steps, double h_s) {
  SavedEffector& is = effector.is;
  const std::uint64_t way_steps = std::max(steps, steps_of(set_point.period_s, h_s));
  const std::uint64_t samples = set_point.sample > is.set_point.sample ? set_point.sample - is.set_point.sample : 0;
  const double sampled_s = std::min(static_cast<double>(samples) * set_point.period_s, kMaxGap_s);
  if (set_point.pulls && !is.set_point.pulls) {
    effector.law.start(set_point.T_world_ref);
  } else if (set_point.pulls && set_point.engaged) {
    effector.law.move_to(set_point.T_world_ref, way_steps, steps_of(sampled_s, h_s), h_s, !is.set_point.engaged);
  }
  // A slow device's sample comes again and again.
  const double jaw = std::clamp(set_point.jaw, 0.0, 1.0);
  if (jaw != is.set_point.jaw) is.jaw_steps_left = way_steps;
  effector.waiting |= set_point.sample != is.set_point.sample || effector.first_step == 0;
  is.set_point = set_point;
  is.set_point.jaw = jaw;
  effector.since_s = watchdog_now_s_;
}

template <class Ends>
bool LiveEffectors::end_if(Ends&& ends) {
  const auto ended = std::remove_if(held_.begin(), held_.end(), [&](const LiveEffector& effector) {
    if (!ends(effector)) return false;
    effector.body->gain_scale = {};
    return true;
  });
  const bool any = ended != held_.end();
  held_.erase(ended, held_.end());
  return any;
}

bool LiveEffectors::end_silent(double watchdog_s) {
  watchdog_now_s_ = watchdog_s;
  return end_if([&](const LiveEffector& effector) {
    if (watchdog_now_s_ - effector.since_s > watchdog_s_ + kRounding_s) return true;
    if (effector.slot < 0) return false;
    const EffectorSlot& slot = table_[static_cast<std::size_t>(effector.slot)];
    const bool over = slot.ended.load(std::memory_order_acquire) >= effector.hold;
    if (!over && !slot.posted.released()) return false;
    if (record_ != nullptr)
      record_->add(inputs::EffectorEndedRecord{static_cast<std::uint32_t>(effector.slot), effector.hold, !over});
    return true;
  });
}

void LiveEffectors::end_of(const LiveBody& body) {
  end_if([&](const LiveEffector& effector) { return effector.body == &body; });
  for (LiveJoint& joint : tables_.joints())
    if (joint.order.jaw == &body) joint.order.jaw = nullptr;
}

void LiveEffectors::end_all() {
  end_if([](const LiveEffector&) { return true; });
}

void LiveEffectors::advance(std::span<LiveEffector> of_body) {
  for (LiveEffector& effector : of_body) {
    SavedEffector& is = effector.is;
    effector.law.advance(is.set_point.engaged);
    if (is.jaw_steps_left == 0) continue;
    is.jaw_in_force += (is.set_point.jaw - is.jaw_in_force) / static_cast<double>(is.jaw_steps_left);
    if (--is.jaw_steps_left == 0) is.jaw_in_force = is.set_point.jaw;
  }
}

// Along an axis on which a partner is engaged, a clutched device exerts nothing, and its reference follows the body.
void LiveEffectors::share_axes(std::span<LiveEffector> of_body) {
  const LiveBody& body = *of_body.front().body;
  for (LiveEffector& effector : of_body) {
    const SetPoint& own = effector.is.set_point;
    EffectorGains gains = own.pulls ? own.gains : EffectorGains{};
    if (own.pulls && !own.engaged) {
      EffectorLaw::AxisFlags given_up[2]{};  // linear, angular
      bool any = false;
      for (const bool angular : {false, true}) {
        for (std::size_t i = 0; i < kAxes.size(); ++i) {
          const auto has_partner = [&](const LiveEffector& other) {
            const SetPoint& set_point = other.is.set_point;
            return set_point.pulls && set_point.engaged && acts_along(set_point.gains, angular, kAxes[i]);
          };
          if (!commanded(body, angular, kAxes[i]) && std::none_of(of_body.begin(), of_body.end(), has_partner))
            continue;
          stiffness(gains, angular).*kAxes[i] = damping(gains, angular).*kAxes[i] = 0.0;
          given_up[angular][i] = any = true;
        }
      }
      if (any) effector.law.follow(*body.body, given_up[0], given_up[1]);
    }
    effector.law.set_gains(gains);
  }
}

bool LiveEffectors::bound_gains(std::span<LiveEffector> of_body, double h_s) {
  LiveBody& body = *of_body.front().body;
  const EffectiveMass mass = effective_mass(*body.body);
  body.gain_scale = {};
  bool any_cut = false;
  for (LiveEffector& effector : of_body) effector.is.bounded = false;
  for (const GainKind& kind : kGainKinds) {
    for (const auto axis : kAxes) {
      const double of_axis = kind.angular ? mass.angular.*axis : mass.linear;
      const double limit = kind.damping ? max_damping(of_axis, h_s) : max_stiffness(of_axis, h_s);
      double of_devices = 0.0;
      for (const LiveEffector& effector : of_body) of_devices += (effector.law.state().gains.*kind.of_device).*axis;
      const double of_controller =
          driven_by_force(body, kind.angular) ? (channel_of(body, kind.angular).*kind.of_controller).*axis : 0.0;
      if (of_devices == 0.0 || of_devices + of_controller <= limit) continue;
      const double left = limit / (of_devices + of_controller);
      (body.gain_scale.*kind.scale).*axis = left;
      any_cut = true;
      for (LiveEffector& effector : of_body) {
        EffectorGains gains = effector.law.state().gains;
        double& gain = (gains.*kind.of_device).*axis;
        effector.is.bounded |= gain > 0.0;
        gain *= left;
        effector.law.set_gains(gains);
      }
    }
  }
  return any_cut;
}

void LiveEffectors::obey_waiting(std::uint32_t step) {
  for (LiveEffector& effector : held_) {
    if (!effector.waiting) continue;
    effector.waiting = false;
    effector.applied_ns = base::steady_ns();
    effector.first_step = step;
  }
}

void LiveEffectors::fill(std::vector<state::EffectorState>& rows) const {
  rows.clear();
  for (const LiveEffector& effector : held_) {
    const SavedEffector& is = effector.is;
    const EffectorLaw::State& law = effector.law.state();
    state::EffectorState row;
    row.body = effector.body->body->user_index();
    row.source = is.source;
    row.pulls = is.set_point.pulls;
    row.engaged = is.set_point.engaged;
    row.leads_jaw = is.leads_jaw;
    row.bounded = is.bounded;
    row.T_world_ref = law.T_world_ref;
    row.twist_ref_world = law.twist_ref_world;
    row.gains = law.gains;
    row.jaw = is.jaw_in_force;
    row.sample = is.set_point.sample;
    row.sampled_ns = is.set_point.sampled_ns;
    row.applied_ns = effector.waiting ? 0 : effector.applied_ns;
    row.first_step = effector.first_step;
    rows.push_back(row);
  }
}

std::vector<SavedEffector> LiveEffectors::save() const {
  std::vector<SavedEffector> saved;
  for (const LiveEffector& effector : held_) {
    SavedEffector& to = saved.emplace_back(effector.is);
    to.body = effector.body->body->user_index();
    to.age_s = std::max(0.0, watchdog_now_s_ - effector.since_s);
    to.law = effector.law.state();
  }
  return saved;
}

void LiveEffectors::restore(const std::vector<SavedEffector>& saved, const state::Structure& structure) {
  for (const SavedEffector& from : saved) {
    LiveEffector& effector = held_.emplace_back();
    effector.body = &tables_.bodies()[from.body];
    effector.is = from;
    effector.law.set_state(from.law);
    effector.since_s = watchdog_now_s_ - from.age_s;
    if (!from.leads_jaw) continue;
    each_jaw_joint(structure, *effector.body, [&](LiveJoint& joint) { joint.order.jaw = effector.body; });
  }
}

}  // namespace ambf::model
