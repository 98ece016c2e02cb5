// Pictures without a display: the same painter on a context of its own, made only when this is opened. Says what a
// camera sees, how far away that is and whose. One thread at a time, the one that opened it.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "base/diagnostic.h"
#include "render/camera/camera.h"
#include "render/gl/offscreen_backend.h"
#include "render/images/image_file.h"
#include "render/scene/quality.h"
#include "state/frame.h"

namespace ambf::render {

struct Extras;  // extras.h

// What is wanted of one camera, and what came of it. Rows go from top to bottom.
struct Shot {
  Camera camera;
  int width = 0, height = 0;  // px
  bool color = false;
  bool measured = false;
  bool multipass = false;            // transparent surfaces exact in their order
  state::ShaderFiles shaders;        // instead of all bodies' own, for the colours, before black
  state::ShaderFiles depth_shaders;  // compute points from the depth buffer, beside what is measured
  const Extras* extras = nullptr;    // for tests and documentation: what is published has none

  std::vector<std::uint8_t> rgb;      // 8 bits a channel
  std::vector<float> depth_m;         // along the view axis; 0 where nothing is
  std::vector<std::uint32_t> bodies;  // slots, soft bodies behind bodies; kNone where nothing is
  std::vector<float> points_m;        // of depth_shaders that work: x, y, z, optical axes; NaN where nothing is
  std::string failure;                // empty: all is well
};

Image image_of(const std::vector<std::uint8_t>& rgb, int width, int height);

class Offscreen {
 public:
  ~Offscreen();
  // Null when there can be none (a library is missing or too old), with the reason in `why`. Else `why` is what users
  // should know (a graphics card that fails), mostly empty. `overlap_reading`: as on a graphics card, for tests; a
  // card has it anyhow.
  static std::unique_ptr<Offscreen> open(std::string& why, OffscreenBackend wanted = OffscreenBackend::automatic,
                                         bool overlap_reading = false);

  const std::string& renderer() const;  // as the driver calls it
  bool in_software() const;

  // All of one frame: what one is read back, the next is drawn. Findings (unreadable textures) are added to
  // `diagnostics`.
  void shoot(const state::Frame& frame, std::vector<Shot>& shots, base::Diagnostics& diagnostics,
             const Quality& quality = {});

  // What `camera` sees of `frame`. False with the reason in `why`.
  bool picture(const state::Frame& frame, const Camera& camera, int width, int height, Image& image,
               base::Diagnostics& diagnostics, std::string& why, const Quality& quality = {},
               const Extras* extras = nullptr);
  // The camera in `slot` of the frame.
  static Camera camera_of(const state::Frame& frame, std::size_t slot);

  struct Counts {
    std::size_t meshes = 0, textures = 0, batches = 0;  // held on the card; draws a picture needs if all is seen
    std::size_t instances_drawn = 0;                    // in the last picture
    std::size_t sizes = 0;                              // of pictures that memory is held for
    std::uint64_t shadow_maps = 0;                      // drawn since it was opened
    unsigned gl_errors = 0;                             // since the last call
  };
  Counts counts();

 private:
  struct Impl;
  explicit Offscreen(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace ambf::render
