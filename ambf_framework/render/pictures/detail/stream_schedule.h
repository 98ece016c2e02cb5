// Which pictures are due at a scene update: what is wanted, every n-th time as the cameras' files say. Nothing that
// nobody wants is drawn. No OpenGL. One thread.
#pragma once

#include <cstdint>
#include <vector>

#include "state/frame.h"
#include "state/picture.h"

namespace ambf::render {

// What is due of one camera's eye in one size.
struct StreamOrder {
  std::uint32_t camera = 0;  // slot
  state::Eye eye = state::Eye::middle;
  unsigned width = 0, height = 0;  // px
  bool color = false;              // a picture; without: at most its geometry
  bool color_geometry = false;
  bool depth = false, depth_color = false, depth_geometry = false;
  bool mask = false;

  bool draws() const { return color || depth_color || measures(); }
  bool measures() const { return depth || mask; }
};

class StreamSchedule {
 public:
  // Once a scene update. `all`: whatever is wanted, at whichever interval.
  std::vector<StreamOrder> due(const state::Frame& frame, const state::PictureSink& sink, bool all);

 private:
  std::uint64_t updates_ = 0;
};

// Whether any picture of this world is wanted.
bool anything_wanted(const state::Structure& structure, const state::PictureSink& sink);

}  // namespace ambf::render
