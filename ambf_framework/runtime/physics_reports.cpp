// What the physics loop reports of the model: what was cut to what steps can bear, blades and needles that cannot.
#include <algorithm>
#include <cstdio>

#include "base/limits.h"
#include "physics/needle.h"
#include "runtime/detail/physics_loop.h"
#include "state/actuators.h"
#include "state/sensors.h"
#include "state/soft_bodies.h"

namespace ambf::runtime {

const char* PhysicsLoop::name_of_body(std::uint32_t body) const {
  const state::Structure& structure = *world_->structure();
  return structure.objects[structure.bodies[body].object].name.c_str();
}

void PhysicsLoop::report(const model::CutReport& cut) {
  if (cut.of == model::CutReport::Of::gains) {
    log_.warning(
        "body '%s': the gains of its input devices and controllers add up to more than steps of %g ms can bear; all of "
        "them are cut in proportion while that lasts (B h <= m / 2, K h^2 <= m / 4). Lower the gains or the fixed "
        "timestep. Logged once for this body.",
        name_of_body(cut.body), 1e3 * keeper_.step_s());
    return;
  }
  if (cut.of == model::CutReport::Of::touch) return report_touch(cut);
  if (cut.of == model::CutReport::Of::uncuttable || cut.of == model::CutReport::Of::full ||
      cut.of == model::CutReport::Of::touches)
    return report_soft_body(cut);
  if (cut.of != model::CutReport::Of::speed) return report_needle(cut);
  log_.warning(
      "body '%s': the %s asks for more than %g m/s or rad/s, beyond which no command takes a body; it is cut to that. "
      "Logged once for this source of this body, then counted.",
      name_of_body(cut.body), state::name_of(cut.source), base::kMaxCommandedSpeed);
}

void PhysicsLoop::report_soft_body(const model::CutReport& cut) {
  const state::Structure& structure = *world_->structure();
  const char* name = structure.objects[state::soft_bodies(structure)[cut.body].object].name.c_str();
  if (cut.of == model::CutReport::Of::full)
    log_.warning(
        "soft body '%s' is not cut any further: `tissue/max nodes` leaves no room. Logged once for this blade.", name);
  else if (cut.of == model::CutReport::Of::touches)
    log_.warning(
        "soft body '%s' is touched in more places than there is room for (docs/limits.md): further ones do not push. "
        "Larger elements, or `tissue/touches: none`, make them fewer. Logged once for this soft body.",
        name);
  else
    log_.warning(
        "soft body '%s' cannot be cut: solids and sheets of `tissue` with `max nodes` above their number of corners "
        "can (docs/tissue.md). "
        "Logged once for this blade.",
        name);
}

void PhysicsLoop::report_needle(const model::CutReport& cut) {
  const state::Structure& structure = *world_->structure();
  const char* name = structure.objects[state::actuators(structure)[cut.body].object].name.c_str();
  switch (cut.of) {
    case model::CutReport::Of::nothing_to_tie:
      log_.warning(
          "needle '%s' tied nothing: a knot takes two places or more that its thread goes through and that are in no "
          "knot. Logged once for this needle.",
          name);
      break;
    case model::CutReport::Of::knots:
      log_.warning("needle '%s' tied nothing: it has tied %zu knots, and there may be no more. Logged once for it.",
                   name, physics::Needle::kMaxKnots);
      break;
    case model::CutReport::Of::stitches:
      log_.warning(
          "needle '%s': its thread goes through %zu places of tissue, and there may be no more: what its rear passes "
          "now is left. Logged once for this needle.",
          name, physics::Needle::kMaxStitches);
      break;
    default:
      log_.warning(
          "needle '%s': more than %zu places of its thread are held (fixed, attached or grasped): sewn tissue does not "
          "feel the others. Logged once for this needle.",
          name, physics::Needle::kMaxHolders);
  }
}

void PhysicsLoop::report_touch(const model::CutReport& cut) {
  const model::CutReport::Touch& touch = cut.touch;
  char gains[160] = "";
  std::size_t at = 0;
  const auto add = [&](const char* gain, double given, double limit) {
    if (limit <= 0.0 || at >= sizeof gains) return;
    const int added =
        std::snprintf(gains + at, sizeof gains - at, "%s%s %.4g as %.4g", at == 0 ? "" : ", ", gain, given, limit);
    at += added > 0 ? static_cast<std::size_t>(added) : 0;
  };
  add("static", touch.stick, touch.stick_limit);
  add("damping", touch.damping, touch.damping_limit);
  add("dynamic", touch.slide, touch.slide_limit);
  const state::Structure& structure = *world_->structure();
  // What damps only is as the law has it; what sticks bears less than the file says.
  const auto severity = touch.stick_limit > 0.0 ? base::Severity::warning : base::Severity::information;
  log_.write(severity,
             "sensor '%s': of its friction on '%s' counts %s: steps of %g ms cannot bear more with %u elements on so "
             "light a body. Logged once for this sensor.",
             structure.objects[state::sensors(structure)[touch.sensor].object].name.c_str(), name_of_body(cut.body),
             gains, 1e3 * keeper_.step_s(), touch.elements);
}

}  // namespace ambf::runtime
