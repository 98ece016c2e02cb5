#include "ros_comm/limited_log.h"

#include "base/clock.h"

namespace ambf::ros_comm {

void LimitedLog::warning(const std::string& text, std::int64_t now_ns) {
  if (now_ns - window_started_ns_ >= base::kNanosecondsPerSecond) {
    if (left_out_ > 0) log_.warning("and %llu more %s", static_cast<unsigned long long>(left_out_), what_.c_str());
    window_started_ns_ = now_ns;
    said_ = 0;
    left_out_ = 0;
  }
  if (said_ < limit_) {
    ++said_;
    log_.warning("%s", text.c_str());
  } else {
    ++left_out_;
  }
}

}  // namespace ambf::ros_comm
