// What ROS communication counts, for the Rates topic. Any thread. C++17.
#pragma once

#include <atomic>
#include <cstdint>
#include <map>
#include <mutex>
#include <string>

#include "base/log.h"
#include "ros_comm/limited_log.h"

namespace ambf::ros_comm {

class Traffic {
 public:
  explicit Traffic(base::Log& log)
      : refusals_(log, base::Severity::warning, "refused commands"),
        expiries_(log, base::Severity::information, "ended commands") {}

  std::atomic<std::uint64_t> states{0};            // messages handed to ROS
  std::atomic<std::uint64_t> accepted{0};          // commands
  std::atomic<int> connections{0};                 // of subscribers to our topics
  std::atomic<std::uint64_t> pictures_dropped{0};  // newer ones came before they could be published

  // A picture handed to ROS; how many of each topic so far.
  void picture_sent(const std::string& topic);
  std::map<std::string, std::uint64_t> pictures() const;

  // A command that is not acted on: counted by object, and said, at a limited rate.
  void refuse(const std::string& object, const std::string& why);
  std::map<std::string, std::uint64_t> refused() const;

  // A command whose sender fell silent.
  void expired(const std::string& object);

 private:
  mutable std::mutex mutex_;
  std::map<std::string, std::uint64_t> refused_, pictures_;  // guarded, as are the logs
  LimitedLog refusals_, expiries_;
};

}  // namespace ambf::ros_comm
