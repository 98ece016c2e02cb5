// How much is spent on a picture, decided from how long pictures take, and how long nothing has moved: where the
// processor draws, pictures cost physics time and everybody's patience. Pure logic, main thread.
#pragma once

#include <cstdint>
#include <optional>

#include "render/shaders/shaders.h"

namespace ambf::render {

struct Quality {
  int samples = 4;                                     // a pixel
  int shadow_side = 2048;                              // texels at most
  unsigned shadow_interval = 1;                        // moments per new shadow map; 0: no shadows
  ShadowFilter shadow_filter = ShadowFilter::contact;  // the softest that lights get which ask for it
  bool occlusion = true;                               // corners darken where little of the surroundings is seen
  bool sharp_textures = true;                          // prints stay readable where they are seen at a slant
  double resolution = 1.0;                             // pixels drawn a pixel shown, each way; only with one sample
  bool operator==(const Quality&) const = default;
};

// Of videos: as screenshots, but where the processor draws without sharpness at a slant, which more than doubles what
// a picture costs: there are thousands of them, and none stands still long enough to be read.
Quality video_quality(bool in_software);
// Of what cameras publish. Where the processor draws, six pictures of this cost as much as one of a video. Steady,
// unlike that of windows: programs look at them.
Quality stream_quality(bool in_software);

// What a picture deserves that a window drawn by the processor has shown unchanged for `still_s`: nothing new for a
// moment, then all pixels, then all samples.
std::optional<Quality> resting_quality(double still_s);

class QualityGovernor {
 public:
  // Without `adaptive` it always stays at the best; with it, it begins a level below: the best costs the processor
  // tens of megabytes too.
  static constexpr int kLevelCount = 4;
  explicit QualityGovernor(bool adaptive) : adaptive_(adaptive), level_(adaptive ? 1 : 0) {}

  static Quality at(int level);  // 0: the best
  Quality quality() const { return at(level_); }
  // `seconds` that the picture at `now_ns` took to draw.
  void picture_done(std::int64_t now_ns, double seconds);
  int level() const { return level_; }

 private:
  bool adaptive_;
  int level_;
  double seconds_ = 0.0;  // smoothed
  std::int64_t changed_ns_ = 0;
  std::int64_t patience_ns_ = 4'000'000'000;  // before trying a better level; doubled each time that was a mistake
};

}  // namespace ambf::render
