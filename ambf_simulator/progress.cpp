#include "progress.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include "base/clock.h"

namespace ambf::simulator {

namespace {

constexpr std::int64_t kSilent_ns = 2'000'000'000, kLineEvery_ns = 200'000'000, kMessageEvery_ns = 10'000'000'000;
constexpr int kBarWidth = 20;

}  // namespace

std::string progress_text(unsigned done, unsigned total, double elapsed_s) {
  const double share = static_cast<double>(done) / total;
  const int filled = static_cast<int>(kBarWidth * share);
  const auto left_s = static_cast<long>(std::ceil(elapsed_s * (total - done) / done));
  char text[96];
  std::snprintf(text, sizeof text, "[%s%s] %3.0f %%, %ld:%02ld left", std::string(filled, '#').c_str(),
                std::string(kBarWidth - filled, '-').c_str(), 100.0 * share, left_s / 60, left_s % 60);
  return text;
}

Progress::Progress(base::Log& log, std::string what, unsigned total)
    : log_(log),
      what_(std::move(what)),
      total_(total),
      terminal_(isatty(STDERR_FILENO) != 0),
      begun_ns_(base::steady_ns()),
      shown_ns_(begun_ns_ + kSilent_ns - (terminal_ ? kLineEvery_ns : kMessageEvery_ns)) {}

Progress::~Progress() {
  if (shown_length_ > 0) std::fprintf(stderr, "\r%*s\r", static_cast<int>(shown_length_), "");
}

void Progress::done(unsigned count) {
  const std::int64_t now_ns = base::steady_ns();
  if (count == 0 || count > total_ || now_ns - shown_ns_ < (terminal_ ? kLineEvery_ns : kMessageEvery_ns)) return;
  shown_ns_ = now_ns;
  const std::string text = what_ + " " + progress_text(count, total_, base::to_seconds(now_ns - begun_ns_));
  if (!terminal_) {
    log_.info("%s", text.c_str());
    return;
  }
  std::fprintf(stderr, "\r%-*s", static_cast<int>(shown_length_), text.c_str());
  shown_length_ = std::max(shown_length_, text.size());
}

}  // namespace ambf::simulator
