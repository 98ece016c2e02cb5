#include "devices/drivers/keyboard_mouse.h"

#include <algorithm>
#include <memory>

#include "base/clock.h"
#include "devices/drivers/options.h"
#include "devices/drivers/rate_pose.h"

namespace ambf::devices {

namespace {

using state::HandKey;

constexpr double kSlow = 0.1;       // left Shift
constexpr double kJawTime_s = 0.5;  // from open to closed
constexpr double kMaxGap_s = 0.1;   // as RatePose
// A window that draws nothing for so long cannot see keys go up either: nothing moves until it draws again.
constexpr std::int64_t kFrozen_ns = 500'000'000;
constexpr double kRateHz = 250.0;  // pictures are slower: more would read the same events again
constexpr double kMinSpread_s = 0.01, kMaxSpread_s = 0.2;

// Moves that came at once, given out evenly until the next ones are due.
class SpreadMotion {
 public:
  void add(const math::Vec3& motion, double over_s) {
    left_ += motion;
    time_s_ = std::clamp(over_s, kMinSpread_s, kMaxSpread_s);
  }
  math::Vec3 take(double dt_s) {
    const math::Vec3 part = left_ * (time_s_ > dt_s ? dt_s / time_s_ : 1.0);
    left_ -= part;
    time_s_ = std::max(0.0, time_s_ - dt_s);
    return part;
  }
  void clear() { left_ = {}; }

 private:
  math::Vec3 left_;
  double time_s_ = 0.0;
};

class KeyboardMouse final : public Driver {
 public:
  KeyboardMouse(const DriverRequest& request, const exchange::Broadcast<state::WindowInput>& windows)
      : windows_(windows), request_(request) {
    Options options(request_);
    constexpr double kMaxPointer_m = 0.1, kMaxWheel_m = 1.0;
    hand_ = RatePose(read_rate_settings(options, {0.05, 1.0, 0.0}));
    pointer_m_ = options.number("pointer speed", pointer_m_, 0.0, kMaxPointer_m);
    wheel_m_ = options.number("wheel step", wheel_m_, 0.0, kMaxWheel_m);
    problem_ = options.problems();
    traits_.gripper = true;
    traits_.buttons = 3;
    traits_.rate_hz = kRateHz;
    traits_.event_driven = true;
    traits_.on_demand = true;
    traits_.hold_at_start_s = 0.0;  // velocities: it rests where it starts
  }

  const DriverTraits& traits() const override { return traits_; }

  std::string open() override {
    if (!problem_.empty()) return problem_;
    if (!windows_.read(seen_) || !seen_.open) {
      return "no keyboard and mouse: this simulation has no window (-g false, or no display)";
    }
    hand_.pause();
    spread_.clear();
    last_ns_ = 0;
    return {};
  }

  Reading read(Sample& sample, double /*max_wait_s*/) override {
    state::WindowInput now;
    const bool open = windows_.read(now) && now.open;
    if (!open) now = {};  // no fault: windows come and go, and nothing moves without one
    sample = {};
    sample.stamp_ns = base::steady_ns();
    const double dt_s = last_ns_ == 0 ? 0.0 : std::min(base::to_seconds(sample.stamp_ns - last_ns_), kMaxGap_s);
    last_ns_ = sample.stamp_ns;
    const bool moves = now.controls && sample.stamp_ns - now.stamp_ns < kFrozen_ns;
    const double pace = is_held(now, HandKey::slow) ? kSlow : 1.0;
    hand_.shift(pointer_motion(now, moves, pace, dt_s));
    const math::Pose& T_base_tip = hand_.advance(moves ? deflections(now, pace) : Deflections{}, sample.stamp_ns);
    sample.T_u_tip = to_user_frame(request_, T_base_tip);
    if (moves) jaw_ = std::clamp(jaw_ + (now.jaw_closed ? -dt_s : dt_s) / kJawTime_s, 0.0, 1.0);
    sample.jaw = jaw_;
    sample.has_jaw = true;
    sample.buttons = std::uint64_t{now.jaw_closed};
    if (moves) sample.buttons |= is_held(now, HandKey::clutch) * 2U | is_held(now, HandKey::camera_clutch) * 4U;
    sample.ready = now.controls;
    if (!sample.ready)
      sample.not_ready = open ? "press G in a window to move it by keyboard and mouse" : "no window is open";
    seen_ = now;
    return Reading::sample;
  }

  void write(const math::Wrench&) override {}
  void close() override {}

 private:
  static Deflections deflections(const state::WindowInput& now, double pace) {
    const auto between = [&](HandKey plus, HandKey minus) {
      return pace * (static_cast<double>(is_held(now, plus)) - static_cast<double>(is_held(now, minus)));
    };
    return {between(HandKey::towards, HandKey::away),
            between(HandKey::right, HandKey::left),
            between(HandKey::up, HandKey::down),
            between(HandKey::roll_left, HandKey::roll_right),
            between(HandKey::pitch_up, HandKey::pitch_down),
            between(HandKey::yaw_left, HandKey::yaw_right)};
  }

  math::Vec3 pointer_motion(const state::WindowInput& now, bool moves, double pace, double dt_s) {
    if (!moves || !seen_.controls) {
      spread_.clear();
      return {};
    }
    const math::Vec3 motion{-wheel_m_ * (now.wheel_away_notches - seen_.wheel_away_notches),
                            pointer_m_ * (now.pointer_right_px - seen_.pointer_right_px),
                            pointer_m_ * (now.pointer_up_px - seen_.pointer_up_px)};
    if (motion != math::Vec3{}) spread_.add(pace * motion, base::to_seconds(now.stamp_ns - seen_.stamp_ns));
    return spread_.take(dt_s);
  }

  const exchange::Broadcast<state::WindowInput>& windows_;
  const DriverRequest request_;
  std::string problem_;
  double pointer_m_ = 2e-4, wheel_m_ = 5e-3;
  RatePose hand_;
  SpreadMotion spread_;
  state::WindowInput seen_;  // as of the read before
  std::int64_t last_ns_ = 0;
  double jaw_ = 1.0;
  DriverTraits traits_;
};

}  // namespace

DriverKind keyboard_mouse_kind(const exchange::Broadcast<state::WindowInput>& windows) {
  return {kKeyboardMouse,
          {"Keyboard", "Keyboard and mouse", "keyboard_mouse"},
          [&windows](const DriverRequest& request) { return std::make_unique<KeyboardMouse>(request, windows); }};
}

}  // namespace ambf::devices
