#include "render/camera/stereo.h"

#include <cmath>

#include "render/camera/intrinsics.h"

namespace ambf::render {

std::vector<EyeView> eyes_of(const Camera& middle, const state::Lens& lens, double window_width) {
  if (!lens.stereo) return {{middle, 0.0, window_width}};
  const double half = std::floor(window_width / 2.0);
  return {{eye_of(middle, lens, state::Eye::left), 0.0, half},
          {eye_of(middle, lens, state::Eye::right), window_width - half, half}};
}

const EyeView& eye_at(const std::vector<EyeView>& eyes, double x) {
  return eyes.size() > 1 && x >= eyes[1].left ? eyes[1] : eyes[0];
}

}  // namespace ambf::render
