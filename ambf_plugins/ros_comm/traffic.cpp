#include "ros_comm/traffic.h"

#include "base/clock.h"

namespace ambf::ros_comm {

namespace {

// Reasons name what was sent, and anybody sends: a control character must neither forge a line of the log nor paint it.
std::string on_one_line(std::string text) {
  for (char& c : text)
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = '?';
  return text;
}

}  // namespace

void Traffic::refuse(const std::string& object, const std::string& why) {
  const std::lock_guard<std::mutex> lock(mutex_);
  ++refused_[object];
  refusals_.add("command to '" + object + "' refused: " + on_one_line(why), base::steady_ns());
}

std::map<std::string, std::uint64_t> Traffic::refused() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return refused_;
}

void Traffic::picture_sent(const std::string& topic) {
  const std::lock_guard<std::mutex> lock(mutex_);
  ++pictures_[topic];
}

std::map<std::string, std::uint64_t> Traffic::pictures() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return pictures_;
}

void Traffic::expired(const std::string& object) {
  const std::lock_guard<std::mutex> lock(mutex_);
  expiries_.add("the command of '" + object + "' has ended (nothing for 0.5 s)", base::steady_ns());
}

}  // namespace ambf::ros_comm
