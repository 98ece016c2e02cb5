// Publishers that are gone. A node that was killed stays registered, and roscpp would try to reach it for as long as we
// run: each of them costs memory and a connection attempt every 20 s. Private to ros_comm. C++17.
#pragma once

#include <map>
#include <set>
#include <string>

namespace ambf::ros_comm {

class LostPublishers {
 public:
  // Of the publishers of some topics, the addresses that refused a connection in this call and in the one before. One
  // that does not answer at all is not lost: there the network may be down. Waits for up to 0.3 s for each 64.
  std::set<std::string> find(const std::map<std::string, std::set<std::string>>& publishers_by_topic);

 private:
  std::set<std::string> suspects_;  // refused in the last call
};

}  // namespace ambf::ros_comm
