// Many may wait to be let in by roscpp, however few it asked for.
#include "ros_comm/listening.h"

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <vector>

namespace ambf::ros_comm {
namespace {

class Socket {
 public:
  explicit Socket(int kind = 0) : descriptor_(socket(AF_INET, SOCK_STREAM | kind, 0)) {}
  Socket(const Socket&) = delete;
  Socket& operator=(const Socket&) = delete;
  Socket(Socket&& other) noexcept : descriptor_(other.descriptor_) { other.descriptor_ = -1; }
  ~Socket() {
    if (descriptor_ >= 0) close(descriptor_);
  }
  operator int() const { return descriptor_; }

 private:
  int descriptor_;
};

class ListeningTest : public ::testing::Test {
 protected:
  ListeningTest() {
    at_.sin_family = AF_INET;
    at_.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof(at_);
    EXPECT_EQ(bind(server_, reinterpret_cast<const sockaddr*>(&at_), size), 0);
    EXPECT_EQ(getsockname(server_, reinterpret_cast<sockaddr*>(&at_), &size), 0);
  }
  std::uint16_t port() const { return ntohs(at_.sin_port); }

  // Of so many who come at once, while nobody is let in, those whom the kernel makes wait.
  int waiting(int count) const {
    std::vector<Socket> clients;
    int connected = 0;
    for (int i = 0; i < count; ++i) {
      clients.emplace_back(SOCK_NONBLOCK);
      connect(clients.back(), reinterpret_cast<const sockaddr*>(&at_), sizeof(at_));
      pollfd ready{clients.back(), POLLOUT, 0};
      connected += poll(&ready, 1, 100);  // well below the second after which the kernel tries again
      if (connected <= i) break;
    }
    return connected;
  }

  Socket server_;
  sockaddr_in at_{};
};

TEST_F(ListeningTest, ManyMayWaitWhereFiveWould) {
  ASSERT_EQ(listen(server_, 5), 0);
  EXPECT_TRUE(let_many_wait(port()));
  EXPECT_EQ(waiting(40), 40);
}

TEST_F(ListeningTest, SocketsThatDoNotListenAreLeftAlone) {
  EXPECT_FALSE(let_many_wait(port()));
  int listening = 1;
  socklen_t size = sizeof(listening);
  ASSERT_EQ(getsockopt(server_, SOL_SOCKET, SO_ACCEPTCONN, &listening, &size), 0);
  EXPECT_EQ(listening, 0);
}

}  // namespace
}  // namespace ambf::ros_comm
