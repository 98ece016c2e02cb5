#include "ros_comm/node.h"

#include <ros/connection_manager.h>
#include <ros/master.h>
#include <ros/network.h>
#include <ros/poll_manager.h>
#include <ros/this_node.h>
#include <ros/xmlrpc_manager.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <iterator>
#include <stdexcept>

#include "base/clock.h"
#include "base/realtime.h"
#include "ros_comm/environment.h"
#include "ros_comm/header_fields.h"
#include "ros_comm/listening.h"
#include "ros_comm/master.h"
#include "ros_comm/node_name.h"
#include "ros_comm/xml_depth.h"

namespace ambf::ros_comm {

namespace {

using namespace std::chrono_literals;

constexpr auto kCheckInterval = 200ms;   // of the master; far below the 2 s in which all must be back
constexpr auto kJoinInterval = 20ms;     // the same before we have joined one
constexpr int kServiceThreads = 3;       // a long Load must not hold up Step,
constexpr unsigned kMaxPerService = 2;   // nor clients that wait for their steps a List
constexpr int kRegisterThreads = 4;      // more do not register faster
constexpr auto kStartPatience = 2000ms;  // with a master that we started, before the next; doubled each time
constexpr int kOriginChecks = 25;        // of a master that answers: who started one marks it soon after
constexpr const char* kStartedBySimulator = "/ambf_simulator/started_this_master";
constexpr double kCallbackWait_s = 0.1;
constexpr auto kServiceWait = 100ms;
constexpr auto kLostCheckInterval = 5s;  // of publishers that are gone
constexpr double kMasterRetry_s = 0.3;   // roscpp would wait for ever; what it could not register is made up for

// Without any address given, and with a local master, nobody outside this machine can reach us.
void stay_on_loopback(base::Log& log) {
  if (std::getenv("ROS_IP") != nullptr || std::getenv("ROS_HOSTNAME") != nullptr) return;
  std::string host;
  std::uint32_t port = 0;
  if (!ros::network::splitURI(std::getenv("ROS_MASTER_URI"), host, port) || !master::is_local(host)) return;
  setenv("ROS_IP", "127.0.0.1", 1);
  log.info(
      "ROS: neither ROS_IP nor ROS_HOSTNAME is set and the master is local: using ROS_IP=127.0.0.1 (this machine "
      "only)");
}

constexpr std::size_t kMaxSenderShown = 128;  // characters

}  // namespace

std::string sender_in(const boost::shared_ptr<ros::M_string>& connection_header) {
  if (!connection_header) return "an unnamed node";
  const auto found = connection_header->find("callerid");
  return found == connection_header->end() ? "an unnamed node" : found->second.substr(0, kMaxSenderShown);
}

Node::Node(base::Log& log, int sending_priority)
    : log_(log), sending_priority_(sending_priority), traffic_(log), services_(kMaxPerService) {
  if (const std::string problem = problem_of_environment(); !problem.empty()) throw std::invalid_argument(problem);
  if (!bound_xml_depth())
    log_.warning("ROS: the depth of XML-RPC requests is not bounded: a hostile one may end this program");
  if (!check_header_fields())
    log_.warning("ROS: the fields of connection headers are not checked: a hostile one may end this program");
  stay_on_loopback(log_);
  // roscpp would make $HOME/.ros/log, and throw where it cannot, for a log file that it never opens.
  const ros::M_string remappings{{"__log", "/dev/null"}};
  ros::init(remappings, node_name(getpid(), base::system_ns() / 1'000'000),
            ros::init_options::NoSigintHandler | ros::init_options::NoRosout);
  ros::master::setRetryTimeout(ros::WallDuration(kMasterRetry_s));
  supervisor_ = std::thread([this] { supervise(); });
}

Node::~Node() {
  stop_ = true;
  commands_.disable();  // wakes its thread
  services_.disable();
  supervisor_.join();
  for (std::thread& thread : threads_) thread.join();
  // The last handle's destruction shuts ROS down and unregisters what is left.
  handle_.reset();
  ros::shutdown();
  child_master_.stop();
}

bool Node::has(const Registration& registration) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return registrations_.count(registration) != 0;
}

std::string Node::master_pid() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return master_pid_;
}

std::size_t Node::topics() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  std::size_t count = 0;
  for (const Registration& r : registrations_) count += r.kind != Registration::Kind::service;
  return count;
}

void Node::supervise() {
  base::set_thread_name("ros master");
  // roscpp sends everything from one thread. Where that has to wait for a processor, states are dropped that the
  // publisher made in time.
  ros::PollManager::instance()->addPollThreadListener([priority = sending_priority_] {
    thread_local bool entered = false;
    if (entered) return;
    entered = true;
    base::enter_real_time("ros sending", priority);
  });
  bool was_there = false, tried_start = false, a_simulators = false;
  int origin_checks = 0;
  auto start_patience = kStartPatience;
  std::chrono::steady_clock::time_point start_due, lost_check_due;
  while (!stop_) {
    const std::string pid = master::pid();
    const bool there = !pid.empty();
    const std::string known_pid = master_pid();
    const bool another = there && (pid != known_pid || !was_there);
    if (there && !handle_) {
      join();
      known_by(pid);
      if (absence_logged_) log_.info("ROS: joined the master at %s", ros::master::getURI().c_str());
    } else if (there && pid != known_pid) {
      log_.info("ROS: a new master answers at %s: registering all topics again", ros::master::getURI().c_str());
      if (register_again()) known_by(pid);
    } else if (!there && was_there) {
      log_.warning(
          "ROS: the master at %s does not answer; connections go on, topics will be registered when it is back",
          ros::master::getURI().c_str());
    }
    if (another) {
      origin_checks = kOriginChecks;
      a_simulators = false;
    }
    if (there && origin_checks > 0) {
      --origin_checks;
      XmlRpc::XmlRpcValue mark;
      if (child_master_.started()) master::set_parameter(kStartedBySimulator, true);
      a_simulators = master::get_parameter(kStartedBySimulator, mark);
      if (a_simulators) origin_checks = 0;
    }
    // Where none is at the start, and where one that a simulator started has ended: with that simulator, or by itself.
    // One of the user's is the user's to start again.
    const bool ended = was_there && (child_master_.started() || a_simulators);
    if (!there && (ended || (!handle_ && !tried_start))) {
      tried_start = true;
      start_patience = kStartPatience;
      start_master();
      start_due = std::chrono::steady_clock::now() + start_patience;
    } else if (!there && child_master_.started() && std::chrono::steady_clock::now() > start_due) {
      // It has ended, most likely because the one before it had not let go of the port yet.
      start_master();
      start_patience *= 2;
      start_due = std::chrono::steady_clock::now() + start_patience;
    }
    connected_ = there && handle_ != nullptr;
    if (connected_ && std::chrono::steady_clock::now() > lost_check_due) {
      forget_lost_publishers();
      lost_check_due = std::chrono::steady_clock::now() + kLostCheckInterval;
    }
    was_there = there;
    const auto pause = handle_ ? kCheckInterval : kJoinInterval;
    for (auto slept = 0ms; slept < pause && !stop_; slept += 10ms) std::this_thread::sleep_for(10ms);
  }
}

void Node::known_by(const std::string& pid) {
  const std::lock_guard<std::mutex> lock(mutex_);
  master_pid_ = pid;
}

void Node::start_master() {
  const std::string& uri = ros::master::getURI();
  child_master_.stop();
  std::string problem;
  if (!master::is_local(ros::master::getHost())) {
    problem = "it is not on this machine";
  } else if (child_master_.start(master::command(ros::master::getPort()), problem)) {
    log_.info("ROS: no master at %s: starting one, for as long as this program runs", uri.c_str());
    return;
  }
  absence_logged_ = true;
  log_.warning(
      "ROS: no master at %s, and none can be started: %s. Going on without topics; they appear when it answers",
      uri.c_str(), problem.c_str());
}

void Node::join() {
  base::set_thread_name("roscpp");  // its threads inherit that
  handle_ = std::make_unique<ros::NodeHandle>();
  base::set_thread_name("ros master");
  let_many_wait(ros::XMLRPCManager::instance()->getServerPort());
  let_many_wait(ros::ConnectionManager::instance()->getTCPPort());
  threads_.emplace_back([this] {
    base::set_thread_name("commands");
    base::request_precise_timers();
    while (!stop_) commands_.callAvailable(ros::WallDuration(kCallbackWait_s));
  });
  for (int i = 0; i < kServiceThreads; ++i) {
    threads_.emplace_back([this] {
      // While one of these writes its answer, roscpp wakes the sending thread, which then spins until the write is
      // over: were it to take the processor from the writer, both would stand still for a time slice (4 ms).
      base::enter_real_time("services", std::max(sending_priority_, 1));
      while (!stop_) services_.run_one(kServiceWait);
    });
  }
}

bool Node::register_again() {
  std::vector<Registration> all;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    all.assign(registrations_.begin(), registrations_.end());
  }
  std::atomic<std::size_t> next{0};
  std::atomic<bool> good{true};
  std::vector<std::thread> helpers;
  for (int i = 0; i < kRegisterThreads; ++i) {
    helpers.emplace_back([&] {
      for (std::size_t at = next++; at < all.size() && good && !stop_; at = next++) {
        if (!register_one(all[at])) good = false;  // gone again: all is tried anew with the next one
      }
    });
  }
  for (std::thread& helper : helpers) helper.join();
  return good;
}

bool Node::register_one(const Registration& registration) {
  XmlRpc::XmlRpcValue request, response, payload;
  request[0] = ros::this_node::getName();
  request[1] = registration.name;
  switch (registration.kind) {
    case Registration::Kind::publisher:
      request[2] = registration.type;
      request[3] = ros::XMLRPCManager::instance()->getServerURI();
      return ros::master::execute("registerPublisher", request, response, payload, false);
    case Registration::Kind::service:
      // The service's own address, as roscpp announces it.
      request[2] = "rosrpc://" + ros::network::getHost() + ":" +
                   std::to_string(ros::ConnectionManager::instance()->getTCPPort());
      request[3] = ros::XMLRPCManager::instance()->getServerURI();
      return ros::master::execute("registerService", request, response, payload, false);
    case Registration::Kind::subscriber: break;
  }
  return subscribe_again(registration, {});
}

// Connects us to all that the master knows, and keeps those we are connected to, known to the master or not; ends the
// connections to `lost`. False: the master did not answer.
bool Node::subscribe_again(const Registration& registration, const std::set<std::string>& lost) {
  XmlRpc::XmlRpcValue request, response, payload;
  request[0] = ros::this_node::getName();
  request[1] = registration.name;
  request[2] = registration.type;
  request[3] = ros::XMLRPCManager::instance()->getServerURI();
  std::set<std::string> announced;
  for (bool first = true;; first = false) {
    {
      // What is closed unregisters under this lock: nothing registers it again after that.
      const std::shared_lock<std::shared_mutex> lock(topic_list_);
      if (!has(registration)) return true;
      if (!ros::master::execute("registerSubscriber", request, response, payload, false)) return false;
    }
    // Who registered before this answer is in it; of who comes later the master informs us. But our own announcement
    // would end the connection to one that came between the answer before it and itself: so it is done until the
    // answer after it has nobody new.
    const int count = payload.getType() == XmlRpc::XmlRpcValue::TypeArray ? payload.size() : 0;
    bool all_known = true;
    for (int i = 0; i < count; ++i) {
      std::string publisher = payload[i];
      if (lost.count(publisher) == 0) all_known &= !announced.insert(std::move(publisher)).second;
    }
    if (all_known && (!first || lost.empty())) return true;
    const std::set<std::string> heard = master::heard_publishers()[registration.name];
    std::set_difference(heard.begin(), heard.end(), lost.begin(), lost.end(),
                        std::inserter(announced, announced.end()));
    master::announce_publishers(registration.name, {announced.begin(), announced.end()});
  }
}

void Node::forget_lost_publishers() {
  const std::map<std::string, std::set<std::string>> heard = master::heard_publishers();
  const std::set<std::string> lost = lost_publishers_.find(heard);
  if (lost.empty()) return;
  std::vector<Registration> concerned;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    for (const Registration& each : registrations_) {
      const auto found = heard.find(each.name);
      const bool has_lost = found != heard.end() && std::any_of(found->second.begin(), found->second.end(),
                                                                [&](const auto& uri) { return lost.count(uri) != 0; });
      if (each.kind == Registration::Kind::subscriber && has_lost) concerned.push_back(each);
    }
  }
  for (const Registration& each : concerned) subscribe_again(each, lost);
}

Registered::Registered(Node& node, Registration registration) : node_(node), registration_(std::move(registration)) {
  const std::lock_guard<std::mutex> lock(node_.mutex_);
  node_.registrations_.insert(registration_);
}

Registered::~Registered() {
  const std::lock_guard<std::mutex> lock(node_.mutex_);
  const auto found = node_.registrations_.find(registration_);
  if (found != node_.registrations_.end()) node_.registrations_.erase(found);
}

}  // namespace ambf::ros_comm
