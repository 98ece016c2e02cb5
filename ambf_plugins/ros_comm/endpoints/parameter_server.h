// Keeps the live parameters of objects equal on ROS's parameter server and in the simulation, both ways. One thread
// polls, because the parameter server does not announce changes. Private to ros_comm. C++17.
#pragma once

#include <atomic>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "ros_comm/endpoints/parameters.h"
#include "ros_comm/node.h"
#include "state/abilities/edit.h"
#include "state/abilities/observe.h"
#include "state/abilities/tune.h"

namespace ambf::ros_comm {

class ParameterServer {
 public:
  ParameterServer(Node& node, state::ObserveAbility& observe, state::TuneAbility& tune, state::EditAbility& edit)
      : node_(node), observe_(observe), tune_(tune), edit_(edit) {}
  ~ParameterServer();  // deletes our parameters from the server
  ParameterServer(const ParameterServer&) = delete;
  ParameterServer& operator=(const ParameterServer&) = delete;

  struct Entry;
  // While this lives, the object's parameters are on the server under `topic`.
  class Offer {
   public:
    explicit Offer(std::shared_ptr<Entry> entry) : entry_(std::move(entry)) {}
    ~Offer();
    Offer(const Offer&) = delete;
    Offer& operator=(const Offer&) = delete;

   private:
    const std::shared_ptr<Entry> entry_;
  };
  // Any thread. `access`, of the object's kind, outlives the offer.
  std::unique_ptr<Offer> offer(const state::ObjectInfo& object, const std::string& topic,
                               const ParameterAccess& access);

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
