#include "ros_comm/listening.h"

#include <arpa/inet.h>
#include <dirent.h>
#include <sys/socket.h>

#include <cstdlib>
#include <memory>

namespace ambf::ros_comm {

namespace {

bool listens_at(int socket, std::uint32_t port) {
  int listening = 0;
  socklen_t size = sizeof(listening);
  if (getsockopt(socket, SOL_SOCKET, SO_ACCEPTCONN, &listening, &size) != 0 || listening == 0) return false;
  sockaddr_storage address{};
  size = sizeof(address);
  if (getsockname(socket, reinterpret_cast<sockaddr*>(&address), &size) != 0) return false;
  if (address.ss_family == AF_INET) return ntohs(reinterpret_cast<const sockaddr_in&>(address).sin_port) == port;
  if (address.ss_family == AF_INET6) return ntohs(reinterpret_cast<const sockaddr_in6&>(address).sin6_port) == port;
  return false;
}

}  // namespace

bool let_many_wait(std::uint32_t port) {
  // roscpp keeps its sockets to itself. To listen at one again changes only how many may wait.
  const std::unique_ptr<DIR, int (*)(DIR*)> descriptors(opendir("/proc/self/fd"), closedir);
  if (!descriptors) return false;
  bool found = false;
  while (const dirent* entry = readdir(descriptors.get())) {
    char* end = nullptr;
    const long descriptor = std::strtol(entry->d_name, &end, 10);
    if (end == entry->d_name || *end != '\0' || !listens_at(static_cast<int>(descriptor), port)) continue;
    found = listen(static_cast<int>(descriptor), SOMAXCONN) == 0 || found;
  }
  return found;
}

}  // namespace ambf::ros_comm
