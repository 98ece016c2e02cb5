#include "ros_comm/lost_publishers.h"

#include <netdb.h>
#include <poll.h>
#include <ros/network.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdint>
#include <iterator>
#include <utility>
#include <vector>

namespace ambf::ros_comm {

namespace {

using std::chrono::steady_clock;

constexpr std::chrono::milliseconds kPatience{300};
constexpr std::size_t kAtOnce = 64;

enum class Attempt { under_way, refused, answered_or_silent };

// Starts to connect; the socket stays open while that is under way.
Attempt begin(const std::string& uri, int& socket_out) {
  std::string host;
  std::uint32_t port = 0;
  if (!ros::network::splitURI(uri, host, port)) return Attempt::answered_or_silent;
  addrinfo hints{}, *found = nullptr;
  hints.ai_socktype = SOCK_STREAM;
  if (getaddrinfo(host.c_str(), std::to_string(port).c_str(), &hints, &found) != 0) return Attempt::answered_or_silent;
  const int s = socket(found->ai_family, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
  const int result = s < 0 ? -1 : connect(s, found->ai_addr, found->ai_addrlen);
  const int error = errno;
  freeaddrinfo(found);
  if (s >= 0 && result != 0 && error == EINPROGRESS) {
    socket_out = s;
    return Attempt::under_way;
  }
  if (s >= 0) close(s);
  return s >= 0 && result != 0 && error == ECONNREFUSED ? Attempt::refused : Attempt::answered_or_silent;
}

bool was_refused(int s) {
  int error = 0;
  socklen_t size = sizeof error;
  return getsockopt(s, SOL_SOCKET, SO_ERROR, &error, &size) == 0 && error == ECONNREFUSED;
}

using Uri = std::set<std::string>::const_iterator;

// Adds those of [first, last) that refuse connections.
void add_refusing(Uri first, Uri last, std::set<std::string>& refused) {
  std::vector<std::pair<pollfd, std::string>> open;
  for (Uri uri = first; uri != last; ++uri) {
    int s = -1;
    const Attempt attempt = begin(*uri, s);
    if (attempt == Attempt::refused) refused.insert(*uri);
    if (attempt == Attempt::under_way) open.push_back({{s, POLLOUT, 0}, *uri});
  }
  const auto deadline = steady_clock::now() + kPatience;
  while (!open.empty()) {
    std::vector<pollfd> waited;
    for (const auto& attempt : open) waited.push_back(attempt.first);
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(deadline - steady_clock::now());
    const int ready = poll(waited.data(), waited.size(), static_cast<int>(std::max<std::int64_t>(0, left.count())));
    if (ready <= 0) break;
    for (std::size_t i = open.size(); i-- > 0;) {
      if (waited[i].revents == 0) continue;
      if (was_refused(open[i].first.fd)) refused.insert(open[i].second);
      close(open[i].first.fd);
      open.erase(open.begin() + static_cast<std::ptrdiff_t>(i));
    }
  }
  for (const auto& attempt : open) close(attempt.first.fd);
}

}  // namespace

std::set<std::string> LostPublishers::find(const std::map<std::string, std::set<std::string>>& publishers_by_topic) {
  std::set<std::string> all;
  for (const auto& [topic, uris] : publishers_by_topic) all.insert(uris.begin(), uris.end());
  std::set<std::string> refused;
  for (Uri first = all.begin(); first != all.end();) {
    Uri last = first;
    for (std::size_t i = 0; i < kAtOnce && last != all.end(); ++i) ++last;
    add_refusing(first, last, refused);
    first = last;
  }
  std::set<std::string> lost;
  std::set_intersection(refused.begin(), refused.end(), suspects_.begin(), suspects_.end(),
                        std::inserter(lost, lost.end()));
  suspects_ = std::move(refused);
  return lost;
}

}  // namespace ambf::ros_comm
