#include "ros_comm/limited_log.h"

#include "base/clock.h"

namespace ambf::ros_comm {

void LimitedLog::add(const std::string& text, std::int64_t now_ns) {
  if (now_ns - window_started_ns_ >= base::kNanosecondsPerSecond) {
    if (left_out_ > 0) write("and " + std::to_string(left_out_) + " more " + what_);
    window_started_ns_ = now_ns;
    said_ = 0;
    left_out_ = 0;
  }
  if (said_ < limit_) {
    ++said_;
    write(text);
  } else {
    ++left_out_;
  }
}

void LimitedLog::write(const std::string& text) {
  severity_ == base::Severity::information ? log_.info("%s", text.c_str()) : log_.warning("%s", text.c_str());
}

}  // namespace ambf::ros_comm
