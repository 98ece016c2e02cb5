#include "ros_comm/traffic.h"

#include "base/clock.h"

namespace ambf::ros_comm {

void Traffic::refuse(const std::string& object, const std::string& why) {
  const std::lock_guard<std::mutex> lock(mutex_);
  ++refused_[object];
  refusals_.add("command to '" + object + "' refused: " + why, base::steady_ns());
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
