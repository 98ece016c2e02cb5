#include "view.h"

#include "base/clock.h"
#include "render/viewer.h"

namespace ambf::simulator {

bool run_view(runtime::Simulation& simulation, Signals& signals, double limit_seconds, base::Log& log) {
  std::string why;
  const std::unique_ptr<render::Viewer> viewer = render::Viewer::open(simulation, log, why);
  if (viewer == nullptr) {
    log.info("no window: %s. Running headless", why.c_str());
    return false;
  }
  const std::int64_t end_ns = limit_seconds < 1e9 ? base::steady_ns() + base::to_ns(limit_seconds) : INT64_MAX;
  while (!signals.stop_requested() && base::steady_ns() < end_ns && viewer->draw()) {
  }
  return true;
}

}  // namespace ambf::simulator
