// ambf_legacy_states [g2|g4]: the relay for programs built against AMBF 1.0 (g2, the default) or AMBF 3.0 (g4); see
// relay.h. Started by `ambf_simulator --legacy-states`, or by hand beside any simulator. Ends with SIGINT, SIGTERM or
// SIGHUP.
#include <sys/prctl.h>
#include <unistd.h>

#include <ros/callback_queue.h>
#include <ros/network.h>
#include <ros/ros.h>

#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <thread>
#include <vector>

#include "legacy_states/relay.h"

namespace {

using namespace std::chrono_literals;
constexpr auto kLookInterval = 500ms;
constexpr double kMasterPatience_s = 0.5, kCallbackWait_s = 0.05;

// roscpp aborts where its environment makes no sense, and throws where it cannot make $HOME/.ros/log, for a log file
// that it never opens.
bool start_node(int& argc, char** argv) {
  std::string host;
  std::uint32_t port = 0;
  setenv("ROS_MASTER_URI", "http://localhost:11311", 0);
  if (!ros::network::splitURI(std::getenv("ROS_MASTER_URI"), host, port)) {
    std::fprintf(stderr, "ambf_legacy_states: ROS_MASTER_URI is not of the form http://HOST:PORT\n");
    return false;
  }
  static char no_log[] = "__log:=/dev/null";
  std::vector<char*> arguments(argv, argv + argc);
  arguments.push_back(no_log);
  arguments.push_back(nullptr);
  argc = static_cast<int>(arguments.size()) - 1;
  try {
    ros::init(argc, arguments.data(), "ambf_legacy_states",
              ros::init_options::AnonymousName | ros::init_options::NoRosout);
  } catch (const std::exception& e) {
    std::fprintf(stderr, "ambf_legacy_states: %s\n", e.what());
    return false;
  }
  return true;
}

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
  if (!start_node(argc, argv)) return 2;
  using namespace ambf::legacy_states;
  Generation generation = Generation::second;
  if (argc > 2 || (argc == 2 && !parse(argv[1], generation))) {
    std::fprintf(stderr,
                 "ambf_legacy_states takes g2 (AMBF 1.0, the default) or g4 (AMBF 3.0): it relays every State "
                 "topic that differs there\n");
    return 2;
  }
  // As roscpp does for SIGINT: nothing stays registered.
  std::signal(SIGTERM, [](int) { ros::requestShutdown(); });
  if (std::signal(SIGHUP, [](int) { ros::requestShutdown(); }) == SIG_IGN) std::signal(SIGHUP, SIG_IGN);  // nohup
  ros::master::setRetryTimeout(ros::WallDuration(kMasterPatience_s));
  wait_for_master();
  if (!ros::ok()) return 0;
  ros::NodeHandle node;
  Relay relay(second ? Part::hears : Part::says, generation);
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
