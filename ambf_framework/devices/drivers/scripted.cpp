#include "devices/drivers/scripted.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <sstream>
#include <vector>

#include "base/clock.h"
#include "devices/drivers/options.h"
#include "math/rotation.h"

namespace ambf::devices {

namespace {

enum class Motion { none, circle, ellipse, line, path };

// Where the hand is at a time, about its start.
struct PathPoint {
  double seconds = 0.0;
  math::Vec3 position, rpy;
  double jaw = 0.0;
};

struct Script {
  Motion motion = Motion::none;
  double size_m = 0.0, rate_rad_s = 0.0, turn_rad = 0.0;
  unsigned axis = 0;  // x, y, z
  double jaw = 0.5, jaw_swing = 0.0;
  double rate_hz = 0.0, noise_m = 0.0, delay_s = 0.0;
  double dropout_every_s = 0.0, dropout_s = 0.0;
  double hold_s = 0.0, max_force_N = 0.0;
  unsigned seed = 1;
  std::vector<PathPoint> path;
  double repeat_s = 0.0;
};

math::Vec3 along(unsigned axis, double value) {
  return {axis == 0 ? value : 0.0, axis == 1 ? value : 0.0, axis == 2 ? value : 0.0};
}

// Between two points: slow at both ends, so that nothing jerks.
PathPoint path_at(const Script& script, double t) {
  if (script.repeat_s > 0.0) t = std::fmod(t, script.repeat_s);
  const auto next =
      std::find_if(script.path.begin(), script.path.end(), [t](const PathPoint& point) { return point.seconds > t; });
  if (next == script.path.begin()) return *next;
  const PathPoint& from = *(next - 1);
  if (next == script.path.end()) return from;
  const double u = (t - from.seconds) / (next->seconds - from.seconds), share = u * u * (3.0 - 2.0 * u);
  const auto between = [share](const auto& a, const auto& b) { return a + share * (b - a); };
  return {t, between(from.position, next->position), between(from.rpy, next->rpy), between(from.jaw, next->jaw)};
}

// Starts at the origin, without a jump.
math::Pose pose_at(const Script& script, double t) {
  const double angle = script.rate_rad_s * t, s = std::sin(angle), c = std::cos(angle) - 1.0;
  const unsigned next = (script.axis + 1) % 3, last = (script.axis + 2) % 3;
  math::Pose pose;
  switch (script.motion) {
    case Motion::none: break;
    case Motion::circle: pose.position = along(next, script.size_m * c) + along(last, script.size_m * s); break;
    // Eq. 3.10 of the dissertation: a = b = 1, c = 2, from P_0.
    case Motion::ellipse: pose.position = script.size_m * math::Vec3{s, c, 2.0 * s}; break;
    case Motion::line: pose.position = along(script.axis, script.size_m * s); break;
    case Motion::path: {
      const PathPoint point = path_at(script, t);
      return {point.position, math::from_rpy(point.rpy.x, point.rpy.y, point.rpy.z)};
    }
  }
  pose.orientation = math::exp(along(script.axis, script.turn_rad * s));
  return pose;
}

class ScriptedDriver final : public Driver {
 public:
  ScriptedDriver(const DriverRequest& request, const Script& script, std::string problem)
      : request_(request), script_(script), problem_(std::move(problem)), random_(script.seed) {
    traits_.gripper = true;
    traits_.rate_hz = script.rate_hz;
    traits_.hold_at_start_s = script.hold_s;
    traits_.force = traits_.torque = script.max_force_N > 0.0;
    traits_.max_force_N = script.max_force_N;
    traits_.max_torque_Nm = script.max_force_N;
  }

  const DriverTraits& traits() const override { return traits_; }
  std::string open() override {
    if (problem_.empty()) start_ns_ = base::steady_ns();
    return problem_;
  }
  void write(const math::Wrench&) override {}
  void close() override {}

  Reading read(Sample& sample, double) override {
    const std::int64_t now_ns = base::steady_ns();
    const double t = base::to_seconds(now_ns - start_ns_);
    if (script_.dropout_every_s > 0.0 && t > script_.dropout_every_s &&
        std::fmod(t, script_.dropout_every_s) < script_.dropout_s) {
      return Reading::nothing_new;
    }
    if (now_ns < next_ns_) return Reading::nothing_new;
    // A late sample shows where the hand was when it should have come.
    const double period_s = script_.rate_hz > 0.0 ? 1.0 / script_.rate_hz : 0.0;
    sample.stamp_ns = now_ns;
    const double moved_s = std::max(0.0, t - script_.hold_s - delay_s_);
    sample.T_u_tip = to_user_frame(request_, pose_at(script_, moved_s));
    sample.T_u_tip.position += math::Vec3{noise(), noise(), noise()};
    sample.has_jaw = true;
    sample.jaw = script_.motion == Motion::path ? path_at(script_, moved_s).jaw
                                                : script_.jaw + script_.jaw_swing * std::sin(script_.rate_rad_s * t);
    delay_s_ = script_.delay_s * uniform();
    next_ns_ = script_.delay_s > 0.0 ? now_ns + base::to_ns(0.5 * period_s + delay_s_) : 0;
    return Reading::sample;
  }

 private:
  // A linear congruential generator: the standard library's distributions may allocate.
  double uniform() {
    random_ = random_ * 6364136223846793005u + 1442695040888963407u;
    return static_cast<double>(random_ >> 11) * 0x1p-53;
  }
  double noise() { return script_.noise_m * (2.0 * uniform() - 1.0); }

  const DriverRequest request_;
  const Script script_;
  const std::string problem_;
  DriverTraits traits_;
  std::uint64_t random_;
  std::int64_t start_ns_ = 0, next_ns_ = 0;
  double delay_s_ = 0.0;
};

// Empty: `text` is none.
std::vector<PathPoint> read_path(const std::string& text) {
  std::vector<PathPoint> path;
  std::istringstream points(text);
  for (std::string each; std::getline(points, each, ';');) {
    if (each.find_first_not_of(" \t\n") == std::string::npos) continue;
    std::istringstream numbers(each);
    PathPoint p;
    numbers >> p.seconds >> p.position.x >> p.position.y >> p.position.z >> p.rpy.x >> p.rpy.y >> p.rpy.z >> p.jaw;
    std::string rest;
    const bool later = path.empty() ? p.seconds == 0.0 : p.seconds > path.back().seconds;
    if (!numbers || numbers >> rest || !later || p.jaw < 0.0 || p.jaw > 1.0) return {};
    path.push_back(p);
  }
  return path;
}

std::unique_ptr<Driver> make_scripted(const DriverRequest& request) {
  Options options(request);
  Script script;
  script.motion = static_cast<Motion>(options.choice("motion", {"none", "circle", "ellipse", "line", "path"}));
  script.size_m = options.number("size", 0.02, 0.0, 1.0);
  script.rate_rad_s = options.number("rate", 1.0, 0.0, 100.0);
  script.axis = static_cast<unsigned>(options.choice("axis", {"x", "y", "z"}));
  script.turn_rad = options.number("turn", 0.0, 0.0, 3.0);
  script.jaw = options.number("jaw", 0.5, 0.0, 1.0);
  script.jaw_swing = options.number("jaw swing", 0.0, 0.0, 0.5);
  script.rate_hz = options.number("hertz", 0.0, 0.0, 4000.0);
  script.noise_m = options.number("noise", 0.0, 0.0, 0.01);
  script.delay_s = options.number("delay", 0.0, 0.0, 1.0);
  script.dropout_every_s = options.number("dropout every", 0.0, 0.0, 1e6);
  script.dropout_s = options.number("dropout", 0.0, 0.0, 1e6);
  script.hold_s = options.number("hold", 0.0, 0.0, 60.0);
  script.max_force_N = options.number("force", 0.0, 0.0, 100.0);
  script.seed = options.count("seed", 1, 1u << 30);
  script.path = read_path(options.text("path"));
  script.repeat_s = options.number("repeat", 0.0, 0.0, 1e6);
  std::string problem = options.problems();
  if (script.motion == Motion::path && script.path.empty()) {
    problem +=
        "'path' is not a list of points \"seconds x y z roll pitch yaw jaw; ...\", the first at 0, the jaw 0 .. 1";
  }
  return std::make_unique<ScriptedDriver>(request, script, problem);
}

}  // namespace

DriverKind scripted_kind() { return {"scripted", {"Scripted"}, make_scripted}; }

}  // namespace ambf::devices
