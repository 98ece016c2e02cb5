// Keeps the parameters of cameras and lights on ROS's parameter server and the simulation equal: what a user sets there takes effect, what
// changes here shows there. One thread polls, as the parameter server tells nobody of changes. Private to ros_comm. C++17.
#pragma once

#include <atomic>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "ros_comm/endpoints/view_parameters.h"
#include "ros_comm/node.h"
#include "state/control.h"

namespace ambf::ros_comm {

class ParameterServer {
 public:
  explicit ParameterServer(Node& node) : node_(node) {}
  ~ParameterServer();  // takes all of ours off the server
  ParameterServer(const ParameterServer&) = delete;
  ParameterServer& operator=(const ParameterServer&) = delete;

  struct Entry;
  // For as long as this lives, the object's parameters are offered under `topic`.
  class Offer {
   public:
    explicit Offer(std::shared_ptr<Entry> entry) : entry_(std::move(entry)) {}
    ~Offer();
    Offer(const Offer&) = delete;
    Offer& operator=(const Offer&) = delete;

   private:
    const std::shared_ptr<Entry> entry_;
  };
  // Any thread. The same `control` every time.
  std::unique_ptr<Offer> offer(const state::ObjectInfo& object, const std::string& topic, state::Control& control);

 private:
  void run(state::Control& control);
  void poll(state::Control& control, const state::Frame& frame);
  void compare(Entry& entry, state::Control& control, const state::Frame& frame);
  void apply(Entry& entry, const Parameters& changed, state::Control& control, const state::Frame& frame,
             std::uint32_t slot);
  void withdraw(const Entry& entry);

  Node& node_;
  std::mutex mutex_;
  std::condition_variable wake_;
  std::vector<std::shared_ptr<Entry>> entries_;  // guarded
  bool stop_ = false;                            // guarded
  std::thread thread_;                           // started with the first offer
};

}  // namespace ambf::ros_comm
