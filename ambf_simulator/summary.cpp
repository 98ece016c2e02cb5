#include "summary.h"

#include <sys/resource.h>

#include <cstdio>

#include "base/clock.h"

namespace ambf::simulator {

namespace {

constexpr const char* kPhaseNames[state::kPhaseCount] = {"commands", "controllers", "collision",
                                                         "solver",   "integration", "publish"};

void line(std::string& out, const char* name, double value, const char* unit) {
  char buffer[128];
  std::snprintf(buffer, sizeof buffer, "%s: %.6g%s%s\n", name, value, *unit ? " " : "", unit);
  out += buffer;
}

}  // namespace

Summary::Summary(state::ObserveAbility& observe) : reader_(observe.make_reader()) {
  started_ns_ = base::steady_ns();
  started_cpu_ns_ = base::process_cpu_ns();
  if (const state::Frame* frame = reader_->latest()) {
    first_step_ = frame->sim_step;
    first_time_s_ = frame->sim_time;
  }
}

std::string Summary::text() const {
  std::string out;
  const state::Frame* frame = reader_->latest();
  if (frame == nullptr) return "no frame was published\n";
  const double wall_s = base::to_seconds(base::steady_ns() - started_ns_);
  line(out, "wall time", wall_s, "s");
  line(out, "simulated time", frame->sim_time - first_time_s_, "s");
  line(out, "steps per second", (frame->sim_step - first_step_) / wall_s, "");
  line(out, "real-time factor", (frame->sim_time - first_time_s_) / wall_s, "");
  line(out, "steps given up", static_cast<double>(frame->run.steps_given_up), "");
  line(out, "process CPU", base::to_seconds(base::process_cpu_ns() - started_cpu_ns_) / wall_s * 100.0, "% of a core");
  line(out, "physics thread CPU", frame->run.physics_cpu_share * 100.0, "% of a core");
  line(out, "lateness p50", frame->run.lateness_p50 * 1e6, "us");
  line(out, "lateness p99", frame->run.lateness_p99 * 1e6, "us");
  line(out, "lateness p99.9", frame->run.lateness_p999 * 1e6, "us");
  line(out, "lateness max", frame->run.lateness_max * 1e6, "us");
  for (int i = 0; i < state::kPhaseCount; ++i) {
    line(out, (std::string("phase ") + kPhaseNames[i]).c_str(), frame->run.seconds_per_phase[i] * 1e6, "us a step");
  }
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  line(out, "peak memory", static_cast<double>(usage.ru_maxrss) / 1024.0, "MB");
  return out;
}

}  // namespace ambf::simulator
