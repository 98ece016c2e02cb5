// ambf_legacy_states: the relay for programs built against AMBF 1.0 (relay.h). Started by `ambf_simulator
// --legacy-states g2`, or by hand beside any simulator. Ends with SIGINT, SIGTERM or SIGHUP.
#include <sys/prctl.h>
#include <unistd.h>

#include <ros/callback_queue.h>
#include <ros/ros.h>

#include <chrono>
#include <csignal>
#include <cstdio>
#include <thread>

#include "legacy_states/relay.h"

namespace {

using namespace std::chrono_literals;
constexpr auto kLookInterval = 500ms;
constexpr double kMasterPatience_s = 0.5, kCallbackWait_s = 0.05;

void wait_for_master() {
  while (ros::ok() && !ros::master::check()) std::this_thread::sleep_for(kLookInterval);
}

}  // namespace

int main(int argc, char** argv) {
  // Two nodes are two processes (relay.h); the second ends with the first.
  const pid_t first = getpid();
  const pid_t forked = fork();
  if (forked < 0) {
    std::perror("ambf_legacy_states: fork");
    return 1;
  }
  const bool second = forked == 0;
  if (second) {
    prctl(PR_SET_PDEATHSIG, SIGTERM);
    if (getppid() != first) return 0;
  }
  ros::init(argc, argv, "ambf_legacy_states", ros::init_options::AnonymousName | ros::init_options::NoRosout);
  if (argc > 1) {
    std::fprintf(stderr, "ambf_legacy_states takes no arguments but ROS's own: it relays every State topic it finds\n");
    return 2;
  }
  // As roscpp does for SIGINT: nothing stays registered.
  std::signal(SIGTERM, [](int) { ros::requestShutdown(); });
  if (std::signal(SIGHUP, [](int) { ros::requestShutdown(); }) == SIG_IGN) std::signal(SIGHUP, SIG_IGN);  // nohup
  ros::master::setRetryTimeout(ros::WallDuration(kMasterPatience_s));
  wait_for_master();
  if (!ros::ok()) return 0;
  ros::NodeHandle node;
  using ambf::legacy_states::Part;
  ambf::legacy_states::Relay relay(second ? Part::hears : Part::says);
  while (ros::ok()) {
    if (!relay.update(node)) {
      // A new master knows nothing of us: begin anew with it.
      relay.clear();
      wait_for_master();
      continue;
    }
    const auto next_look = std::chrono::steady_clock::now() + kLookInterval;
    while (ros::ok() && std::chrono::steady_clock::now() < next_look) {
      ros::getGlobalCallbackQueue()->callAvailable(ros::WallDuration(kCallbackWait_s));
    }
  }
  return 0;
}
