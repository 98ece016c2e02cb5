#include "render/scene/quality.h"

#include <algorithm>

namespace ambf::render {

namespace {

constexpr Quality kPlain = {1, 1024, 1, ShadowFilter::hard, false, false};
constexpr Quality kLevels[QualityGovernor::kLevelCount] = {{},
                                                           kPlain,
                                                           {1, 1024, 3, ShadowFilter::hard, false, false, 0.75},
                                                           {1, 512, 6, ShadowFilter::hard, false, false, 0.5}};
constexpr double kPlainAfter_s = 0.25, kBestAfter_s = 1.5;  // of rest
constexpr int kLast = QualityGovernor::kLevelCount - 1;
constexpr double kTooSlow = 0.030, kFast = 0.009;  // s a picture
constexpr double kSmoothing = 0.1;
constexpr std::int64_t kSettle_ns = 800'000'000;  // before judging a level
constexpr std::int64_t kMaxPatience_ns = 120'000'000'000;

}  // namespace

Quality video_quality(bool in_software) {
  Quality quality;
  quality.sharp_textures = !in_software;
  return quality;
}

Quality stream_quality(bool in_software) { return in_software ? kPlain : Quality{}; }

std::optional<Quality> resting_quality(double still_s) {
  if (still_s < kPlainAfter_s) return std::nullopt;
  return still_s < kBestAfter_s ? kPlain : video_quality(true);
}

Quality QualityGovernor::at(int level) { return kLevels[level]; }

void QualityGovernor::picture_done(std::int64_t now_ns, double seconds) {
  if (!adaptive_) return;
  if (changed_ns_ == 0) changed_ns_ = now_ns;
  seconds_ += kSmoothing * (seconds - seconds_);
  const std::int64_t since = now_ns - changed_ns_;
  if (seconds_ > kTooSlow && level_ < kLast && since > kSettle_ns) {
    ++level_;
    patience_ns_ = std::min(2 * patience_ns_, kMaxPatience_ns);
    changed_ns_ = now_ns;
  } else if (seconds_ < kFast && level_ > 0 && since > patience_ns_) {
    --level_;
    changed_ns_ = now_ns;
  }
}

}  // namespace ambf::render
