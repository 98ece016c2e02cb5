#include "render/gl/offscreen_context.h"

namespace ambf::render {

std::optional<OffscreenBackend> offscreen_backend(const std::string& name) {
  if (name == "auto") return OffscreenBackend::automatic;
  if (name == "osmesa") return OffscreenBackend::osmesa;
  if (name == "egl") return OffscreenBackend::egl;
  return std::nullopt;
}

std::unique_ptr<OffscreenContext> OffscreenContext::open(OffscreenBackend wanted, std::string& why) {
  why.clear();
  if (wanted == OffscreenBackend::osmesa) return open_osmesa(why);
  EglAnswer egl = open_egl(wanted == OffscreenBackend::egl);
  if (egl.context != nullptr) {
    if (egl.card_fails) why = egl.why + "; the processor draws";
    return std::move(egl.context);
  }
  std::string no_osmesa;
  if (auto software = open_osmesa(no_osmesa)) {
    // Where nobody asked for a card and there is none, all is well.
    if (wanted == OffscreenBackend::egl || egl.card_fails) why = egl.why + "; the processor draws by OSMesa instead";
    return software;
  }
  if (wanted == OffscreenBackend::automatic) {
    EglAnswer software = open_egl(true);
    if (software.context != nullptr) return std::move(software.context);
  }
  why = egl.why + "; " + no_osmesa;
  return nullptr;
}

}  // namespace ambf::render
