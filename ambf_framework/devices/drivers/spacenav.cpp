// spacenavd's protocol, version 0: a stream of packets of eight 32-bit integers in the machine's order. Packet[0] is 0
// for motion (then x, y, z, rx, ry, rz and the milliseconds since the last), 1 for a button pressed, 2 for one released
// (then its number). x is to the right, y up, z away from the user; rx, ry, rz turn right-handed about them. Why not
// libspnav: docs/decisions/0030-drivers.md.
#include "devices/drivers/spacenav.h"

#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <memory>

#include "base/clock.h"
#include "devices/drivers/options.h"
#include "devices/drivers/rate_pose.h"

namespace ambf::devices {

namespace {

constexpr unsigned kButtons = 64;

// One connection to the daemon.
class Puck {
 public:
  ~Puck() { close(); }

  // Empty, or why there is no connection.
  std::string open(const std::string& path) {
    close();
    deflections_ = {};
    held_ = 0;
    filled_ = 0;
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    if (path.size() >= sizeof(address.sun_path)) return "the path is too long for a socket";
    std::memcpy(address.sun_path, path.c_str(), path.size());
    fd_ = socket(AF_UNIX, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
    if (fd_ >= 0 && connect(fd_, reinterpret_cast<const sockaddr*>(&address), sizeof(address)) == 0) return {};
    const std::string why = std::strerror(errno);
    close();
    return why;
  }
  void close() {
    if (fd_ >= 0) ::close(fd_);
    fd_ = -1;
  }

  // Obeys all that has arrived. False: the daemon is gone.
  bool update() {
    if (fd_ < 0) return false;
    for (;;) {
      char* const bytes = reinterpret_cast<char*>(packet_.data());
      const ssize_t got = recv(fd_, bytes + filled_, sizeof(packet_) - filled_, 0);
      if (got < 0) return errno == EAGAIN || errno == EINTR;
      if (got == 0) return false;
      filled_ += static_cast<std::size_t>(got);
      if (filled_ < sizeof(packet_)) continue;
      filled_ = 0;
      obey();
    }
  }
  double axis(unsigned number) const { return deflections_[number]; }
  std::uint64_t held() const { return held_; }

 private:
  void obey() {
    if (packet_[0] == 0) {
      for (std::size_t i = 0; i < kRateAxes; ++i) deflections_[i] = packet_[i + 1];
    } else if ((packet_[0] == 1 || packet_[0] == 2) && packet_[1] >= 0 &&
               packet_[1] < static_cast<std::int32_t>(kButtons)) {
      const std::uint64_t bit = std::uint64_t{1} << packet_[1];
      held_ = packet_[0] == 1 ? held_ | bit : held_ & ~bit;
    }
  }

  int fd_ = -1;
  std::array<std::int32_t, 8> packet_{};
  std::size_t filled_ = 0;
  Deflections deflections_{};  // as sent
  std::uint64_t held_ = 0;
};

class Spacenav final : public Driver {
 public:
  explicit Spacenav(const DriverRequest& request) : request_(request) {
    Options options(request_);
    path_ = options.path("path");
    constexpr double kUsual = 350.0, kMax = 1e6;  // what common pucks send at their stops
    full_ = options.number("full", kUsual, 1.0, kMax);
    hand_ = RatePose(read_rate_settings(options, {0.1, 1.0, 0.05}));
    axes_ = RateAxes::read(options, {"-z", "x", "y", "-rz", "rx", "ry"}, {"x", "y", "z", "rx", "ry", "rz"});
    problem_ = options.problems();
    traits_.buttons = kButtons;
    traits_.event_driven = true;
    traits_.hold_at_start_s = 0.0;  // velocities: it rests where it starts
  }

  const DriverTraits& traits() const override { return traits_; }

  std::string open() override {
    if (!problem_.empty()) return problem_;
    const char* const named = std::getenv("SPNAV_SOCKET");
    const std::string path = !path_.empty() ? path_ : named != nullptr ? named : "/run/spnav.sock";
    hand_.pause();
    const std::string why = puck_.open(path);
    if (why.empty()) return {};
    return "no space mouse: nothing answers at the socket " + path + " (" + why +
           "); start spacenavd, or set SPNAV_SOCKET or 'driver: {type: spacenav, path: ...}'";
  }

  Reading read(Sample& sample, double /*max_wait_s*/) override {
    if (!puck_.update()) return Reading::lost;
    sample = {};
    sample.stamp_ns = base::steady_ns();
    const Deflections deflections = axes_.deflections([this](unsigned number) { return puck_.axis(number) / full_; });
    sample.T_u_tip = to_user_frame(request_, hand_.advance(deflections, sample.stamp_ns));
    sample.buttons = puck_.held();
    return Reading::sample;
  }

  void write(const math::Wrench&) override {}
  void close() override { puck_.close(); }

 private:
  const DriverRequest request_;
  std::string problem_, path_;
  double full_ = 1.0;
  RateAxes axes_;
  RatePose hand_;
  Puck puck_;
  DriverTraits traits_;
};

}  // namespace

DriverKind spacenav_kind() {
  return {"spacenav", {"SpaceNavigator", "SpaceMouse", "SpaceNav", "spacenav"}, [](const DriverRequest& request) {
            return std::make_unique<Spacenav>(request);
          }};
}

}  // namespace ambf::devices
