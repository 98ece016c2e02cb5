#include "ros_comm/node.h"

#include <ros/connection_manager.h>
#include <ros/master.h>
#include <ros/network.h>
#include <ros/this_node.h>
#include <ros/xmlrpc_manager.h>

#include <unistd.h>

#include <chrono>
#include <cstdlib>

#include "base/realtime.h"

namespace ambf::ros_comm {

namespace {

using namespace std::chrono_literals;

constexpr auto kCheckInterval = 200ms;  // of the master; far below the 2 s in which all must be back
constexpr int kServiceThreads = 3;      // a long Load must not hold up Step
constexpr double kCallbackWait_s = 0.1;
constexpr const char* kDefaultMaster = "http://localhost:11311";

bool is_local(const std::string& host) {
  if (host == "localhost" || host == "127.0.0.1" || host == "::1") return true;
  char name[256] = {};
  return gethostname(name, sizeof name - 1) == 0 && host == name;
}

// Without any address given, and with a local master, nobody outside this machine can reach us.
void stay_on_loopback(base::Log& log) {
  if (std::getenv("ROS_IP") != nullptr || std::getenv("ROS_HOSTNAME") != nullptr) return;
  const char* uri = std::getenv("ROS_MASTER_URI");
  std::string host;
  uint32_t port = 0;
  if (!ros::network::splitURI(uri != nullptr ? uri : kDefaultMaster, host, port) || !is_local(host)) return;
  setenv("ROS_IP", "127.0.0.1", 1);
  log.info(
      "ROS: neither ROS_IP nor ROS_HOSTNAME is set and the master is local: using ROS_IP=127.0.0.1 (this machine "
      "only)");
}

}  // namespace

Node::Node(base::Log& log) : log_(log) {
  if (std::getenv("ROS_MASTER_URI") == nullptr) setenv("ROS_MASTER_URI", kDefaultMaster, 1);
  stay_on_loopback(log_);
  ros::M_string no_remappings;
  ros::init(no_remappings, "ambf_comm_node",
            ros::init_options::AnonymousName | ros::init_options::NoSigintHandler | ros::init_options::NoRosout);
  supervisor_ = std::thread([this] { supervise(); });
}

Node::~Node() {
  stop_ = true;
  supervisor_.join();
  for (std::thread& thread : threads_) thread.join();
  // The last handle's destruction shuts ROS down and unregisters what is left.
  handle_.reset();
  ros::shutdown();
  child_master_.stop();
}

void Node::remember(const Registration& registration) {
  const std::lock_guard<std::mutex> lock(mutex_);
  registrations_.insert(registration);
}

void Node::forget(const Registration& registration) {
  const std::lock_guard<std::mutex> lock(mutex_);
  const auto found = registrations_.find(registration);
  if (found != registrations_.end()) registrations_.erase(found);
}

bool Node::master_answers(std::string& master_pid) {
  XmlRpc::XmlRpcValue request, response, payload;
  request[0] = ros::this_node::getName();
  if (!ros::master::execute("getPid", request, response, payload, false)) return false;
  master_pid = payload.getType() == XmlRpc::XmlRpcValue::TypeInt ? std::to_string(static_cast<int>(payload)) : "";
  return true;
}

void Node::supervise() {
  base::set_thread_name("ros master");
  std::string known_pid, pid;
  bool told_absent = false, was_there = false, tried_child = false;
  while (!stop_) {
    const bool there = master_answers(pid);
    if (there && !handle_) {
      join();
      known_pid = pid;
      if (told_absent) log_.info("ROS: joined the master at %s", ros::master::getURI().c_str());
    } else if (there && (!was_there || pid != known_pid)) {
      log_.info("ROS: the master at %s is back: registering all topics again", ros::master::getURI().c_str());
      register_again();
      known_pid = pid;
    } else if (!there && was_there) {
      log_.warning(
          "ROS: the master at %s does not answer; connections go on, topics will be registered when it is back",
          ros::master::getURI().c_str());
    }
    if (!there && !handle_ && !tried_child) {
      tried_child = true;
      if (is_local(ros::master::getHost())) {
        std::string problem;
        if (child_master_.start(ros::master::getPort(), problem)) {
          log_.info("ROS: no master at %s: starting one, for as long as this program runs",
                    ros::master::getURI().c_str());
        } else {
          log_.warning("ROS: no master at %s, and %s. Going on without topics; they appear when a master does",
                       ros::master::getURI().c_str(), problem.c_str());
          told_absent = true;
        }
      } else {
        log_.warning("ROS: no master at %s. Going on without topics; they appear when it answers",
                     ros::master::getURI().c_str());
        told_absent = true;
      }
    }
    was_there = there;
    const auto pause = handle_ ? kCheckInterval : 20ms;
    for (auto slept = 0ms; slept < pause && !stop_; slept += 10ms) std::this_thread::sleep_for(10ms);
  }
}

void Node::join() {
  handle_ = std::make_unique<ros::NodeHandle>();
  threads_.emplace_back([this] {
    base::set_thread_name("commands");
    base::request_precise_timers();
    while (!stop_) commands_.callAvailable(ros::WallDuration(kCallbackWait_s));
  });
  for (int i = 0; i < kServiceThreads; ++i) {
    threads_.emplace_back([this] {
      base::set_thread_name("services");
      while (!stop_) services_.callOne(ros::WallDuration(kCallbackWait_s));
    });
  }
  connected_ = true;
}

void Node::register_again() {
  std::multiset<Registration> registrations;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    registrations = registrations_;
  }
  const std::string uri = ros::XMLRPCManager::instance()->getServerURI();
  for (const Registration& r : registrations) {
    XmlRpc::XmlRpcValue request, response, payload;
    request[0] = ros::this_node::getName();
    request[1] = r.name;
    const char* method = "registerPublisher";
    if (r.kind == Registration::Kind::service) {
      // The service's own address, as roscpp announces it.
      request[2] = "rosrpc://" + ros::network::getHost() + ":" +
                   std::to_string(ros::ConnectionManager::instance()->getTCPPort());
      request[3] = uri;
      method = "registerService";
    } else {
      request[2] = r.type;
      request[3] = uri;
      if (r.kind == Registration::Kind::subscriber) method = "registerSubscriber";
    }
    // Masters come and go: what fails now is tried again when the next one appears.
    if (!ros::master::execute(method, request, response, payload, false)) return;
  }
}

}  // namespace ambf::ros_comm
