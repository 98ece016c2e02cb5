// Pictures without a display: the same painter on Mesa's off-screen library, which is loaded only when this is opened. One thread at a
// time, the one that opened it.
#pragma once

#include <memory>
#include <string>

#include "base/diagnostic.h"
#include "render/camera.h"
#include "render/image_file.h"
#include "render/quality.h"
#include "state/frame.h"

namespace ambf::render {

class Offscreen {
 public:
  ~Offscreen();
  // Null when the library is missing or too old, with the reason in `why`.
  static std::unique_ptr<Offscreen> open(std::string& why);

  // What `camera` sees of `frame`. Findings (unreadable textures) are added to `diagnostics`.
  bool picture(const state::Frame& frame, const Camera& camera, int width, int height, Image& image,
               base::Diagnostics& diagnostics, std::string& why, const Quality& quality = {});
  // The camera in `slot` of the frame.
  static Camera camera_of(const state::Frame& frame, std::size_t slot);

  struct Counts {
    std::size_t meshes = 0, textures = 0, batches = 0;  // held on the card; draws a picture needs if all is seen
    std::size_t instances_drawn = 0;                    // in the last picture
    unsigned gl_errors = 0;                             // since the last call
  };
  Counts counts();

 private:
  struct Impl;
  explicit Offscreen(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace ambf::render
