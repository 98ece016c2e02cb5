#include "view.h"

#include "base/clock.h"

namespace ambf::simulator {

ViewEnd run_view(const state::Abilities& simulation, Signals& signals, std::int64_t end_ns,
                 const render::ViewerOptions& options, base::Log& log) {
  std::string why;
  const std::unique_ptr<render::Viewer> viewer = render::Viewer::open(simulation, log, options, why);
  if (viewer == nullptr) {
    log.info("no window: %s. Running headless", why.c_str());
    return ViewEnd::none;
  }
  while (!signals.stop_requested() && base::steady_ns() < end_ns && viewer->draw()) {
  }
  return viewer->display_lost() ? ViewEnd::display : ViewEnd::over;
}

}  // namespace ambf::simulator
