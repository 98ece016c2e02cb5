// Who draws pictures without a display. Plain values, any thread.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace ambf::render {

enum class OffscreenBackend : std::uint8_t {
  automatic,  // egl where it offers a graphics card, else osmesa
  osmesa,     // the processor, by Mesa's off-screen library
  egl         // a graphics card without a display server; Mesa's software renderer where there is none; else osmesa
};

// "auto", "osmesa" or "egl".
std::optional<OffscreenBackend> offscreen_backend(const std::string& name);

}  // namespace ambf::render
