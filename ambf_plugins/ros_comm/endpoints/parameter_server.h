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
#include "state/abilities/edit.h"
#include "state/abilities/observe.h"
#include "state/abilities/tune.h"

namespace ambf::ros_comm {

class ParameterServer {
 public:
  ParameterServer(Node& node, state::ObserveAbility& observe, state::TuneAbility& tune, state::EditAbility& edit)
      : node_(node), observe_(observe), tune_(tune), edit_(edit) {}
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
  // Any thread.
  std::unique_ptr<Offer> offer(const state::ObjectInfo& object, const std::string& topic);

 private:
  void run();
  void poll(const state::Frame& frame);
  void compare(Entry& entry, const state::Frame& frame);
  void apply(Entry& entry, const Parameters& changed, const state::Frame& frame, std::uint32_t slot);
  void withdraw(const Entry& entry);

  Node& node_;
  state::ObserveAbility& observe_;
  state::TuneAbility& tune_;
  state::EditAbility& edit_;
  std::mutex mutex_;
  std::condition_variable wake_;
  std::vector<std::shared_ptr<Entry>> entries_;  // guarded
  bool stop_ = false;                            // guarded
  std::thread thread_;                           // started with the first offer
};

}  // namespace ambf::ros_comm
