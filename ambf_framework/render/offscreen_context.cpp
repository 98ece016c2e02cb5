#include "render/offscreen_context.h"

namespace ambf::render {

std::optional<OffscreenBackend> offscreen_backend(const std::string& name) {
  if (name == "auto") return OffscreenBackend::automatic;
  if (name == "osmesa") return OffscreenBackend::osmesa;
  if (name == "egl") return OffscreenBackend::egl;
  return std::nullopt;
}

std::unique_ptr<OffscreenContext> OffscreenContext::open(OffscreenBackend wanted, std::string& why) {
  if (wanted == OffscreenBackend::osmesa) return open_osmesa(why);
  if (wanted == OffscreenBackend::egl) return open_egl(true, why);
  std::string no_card, no_osmesa;
  if (auto card = open_egl(false, no_card)) return card;
  if (auto software = open_osmesa(no_osmesa)) return software;
  if (auto software = open_egl(true, no_card)) return software;
  why = no_osmesa + "; " + no_card;
  return nullptr;
}

}  // namespace ambf::render
