#include "devices/drivers/gamepad.h"

#include <glob.h>

#include <memory>

#include "base/clock.h"
#include "devices/drivers/detail/gamepad_node.h"
#include "devices/drivers/options.h"
#include "devices/drivers/rate_pose.h"

namespace ambf::devices {

namespace {

constexpr unsigned kMaxAxes = 32, kMaxButtons = 64;
constexpr double kMaxRange = 1e6;

std::vector<std::string> paths_like(const char* pattern) {
  glob_t found{};
  std::vector<std::string> paths;
  if (glob(pattern, 0, nullptr, &found) == 0) paths.assign(found.gl_pathv, found.gl_pathv + found.gl_pathc);
  globfree(&found);
  return paths;
}

std::vector<std::string> numbers_below(unsigned count) {
  std::vector<std::string> names;
  for (unsigned i = 0; i < count; ++i) names.push_back(std::to_string(i));
  return names;
}

class Gamepad final : public Driver {
 public:
  explicit Gamepad(const DriverRequest& request) : request_(request) {
    Options options(request_);
    path_ = options.path("path");
    format_ = static_cast<GamepadNode::Format>(options.choice("format", {"by name", "evdev", "joydev"}));
    const RatePose::Settings usual{0.1, 1.0, 0.15};
    hand_ = RatePose(read_rate_settings(options, usual));
    assumed_.axes = options.count("axis count", assumed_.axes, kMaxAxes);
    assumed_.buttons = options.count("button count", assumed_.buttons, kMaxButtons);
    assumed_.stick_range = options.number("stick range", assumed_.stick_range, 1.0, kMaxRange);
    assumed_.trigger_range = options.number("trigger range", assumed_.trigger_range, 1.0, kMaxRange);
    const std::vector<std::string> names = numbers_below(kMaxAxes);
    // Left stick: the plane of the table; right stick: up, yaw; the cross: roll, pitch; right trigger: the jaw.
    axes_ = RateAxes::read(options, {"1", "0", "-4", "-6", "-7", "-3"}, names);
    jaw_ = options.axis("axes/jaw", "5", names);
    problem_ = options.problems();
    traits_.event_driven = true;
    traits_.hold_at_start_s = 0.0;  // velocities: it rests where it starts
  }
  ~Gamepad() override { node_.close(); }

  const DriverTraits& traits() const override { return traits_; }

  std::string open() override {
    if (!problem_.empty()) return problem_;
    if (path_.empty()) {
      if (std::string nothing = search(); !nothing.empty()) return nothing;
    } else if (const std::string refused = node_.open(path_, format_, assumed_, false); !refused.empty()) {
      return "no gamepad at " + path_ + ": " + refused + " (plug it in, or correct 'path'; its node is readable for " +
             "members of the group 'input')";
    }
    hand_.pause();
    traits_.buttons = node_.buttons();
    traits_.gripper = jaw_.number >= 0 && static_cast<unsigned>(jaw_.number) < node_.axes();
    return {};
  }

  Reading read(Sample& sample, double /*max_wait_s*/) override {
    if (!node_.is_open() || !node_.update()) return Reading::lost;
    sample = {};
    sample.stamp_ns = base::steady_ns();
    const Deflections deflections = axes_.deflections([this](unsigned number) { return node_.axis(number); });
    sample.T_u_tip = to_user_frame(request_, hand_.advance(deflections, sample.stamp_ns));
    sample.buttons = node_.held();
    sample.has_jaw = traits_.gripper;
    if (sample.has_jaw) {
      const double pressed = node_.pressed(static_cast<unsigned>(jaw_.number));
      sample.jaw = jaw_.sign > 0.0 ? 1.0 - pressed : pressed;
    }
    return Reading::sample;
  }

  void write(const math::Wrench&) override {}
  void close() override { node_.close(); }

 private:
  // The first gamepad that no other driver has open.
  std::string search() {
    unsigned nodes = 0, unreadable = 0, taken = 0;
    for (const char* pattern : {"/dev/input/event*", "/dev/input/js*"}) {
      for (const std::string& path : paths_like(pattern)) {
        ++nodes;
        const std::string refused = node_.open(path, GamepadNode::Format::by_name, assumed_, true);
        if (refused.empty() && node_.looks_like_gamepad()) return {};
        taken += refused == GamepadNode::kInUse;
        unreadable += !refused.empty() && refused != GamepadNode::kInUse;
        node_.close();
      }
    }
    return "no gamepad: of " + std::to_string(nodes) + " nodes /dev/input/event* and js*, " +
           std::to_string(unreadable) + " may not be read (members of the group 'input' may) and " +
           std::to_string(taken) + " are in use; plug one in, or set 'driver: {type: gamepad, path: ...}'";
  }

  const DriverRequest request_;
  std::string problem_, path_;
  GamepadNode::Format format_ = GamepadNode::Format::by_name;
  GamepadNode::Assumed assumed_;
  GamepadNode node_;
  RateAxes axes_;
  SourceAxis jaw_;
  RatePose hand_;
  DriverTraits traits_;
};

}  // namespace

DriverKind gamepad_kind() {
  return {"gamepad", {"Gamepad", "gamepad", "Joystick", "joystick"}, [](const DriverRequest& request) {
            return std::make_unique<Gamepad>(request);
          }};
}

}  // namespace ambf::devices
