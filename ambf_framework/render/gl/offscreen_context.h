// An OpenGL 3.3 context without a display, for pictures that no window shows. Two backends, both loaded only when
// asked for: Mesa's OSMesa, where the processor draws, and EGL, which reaches graphics cards without a display
// server. One thread at a time: the one that made it current last. Private to render/ (offscreen.h is its face).
#pragma once

#include <memory>
#include <string>

#include "render/gl/offscreen_backend.h"

namespace ambf::render {

class OffscreenContext {
 public:
  OffscreenContext() = default;
  virtual ~OffscreenContext() = default;
  OffscreenContext(const OffscreenContext&) = delete;
  OffscreenContext& operator=(const OffscreenContext&) = delete;

  // Current afterwards. Null with the reason in `why`; else `why` says what is not as it was asked for, or should be,
  // and is empty if nothing is.
  static std::unique_ptr<OffscreenContext> open(OffscreenBackend wanted, std::string& why);

  virtual bool make_current() = 0;
  virtual void* address_of(const char* function) = 0;
};

std::unique_ptr<OffscreenContext> open_osmesa(std::string& why);

struct EglAnswer {
  std::unique_ptr<OffscreenContext> context;  // null: see `why`
  std::string why;                            // no card draws
  bool card_fails = false;                    // there is one, however
};
// On a graphics card; `software` says whether Mesa's own renderer will do where there is none.
EglAnswer open_egl(bool software);

}  // namespace ambf::render
