// Which topics publish every step, or every n-th, because recorders requested it (service Record). A request is a lease
// that ends unless it is repeated, so that a recorder that was killed costs nothing for long. Any thread. Private to
// ros_comm. C++17.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "base/bounds.h"

namespace ambf::ros_comm {

class StepRequests {
 public:
  static constexpr std::int64_t kLease_ns = 5'000'000'000;  // a recorder that is held up for seconds keeps its request
  static constexpr std::size_t kMaxRecorders = base::kMaxStepRecorders;
  static constexpr std::size_t kMaxAhead = 64;  // steps: fewer than roscpp keeps for a slow connection

  // Every how many steps a topic is published; 0: at its rates.
  using Interval = std::shared_ptr<const std::atomic<std::uint32_t>>;
  // For the topic's publisher, as long as it is open.
  Interval interval_of(const std::string& topic);

  // Replaces the request of this recorder; interval 0 ends it. `served` receives those of `topics` that are open.
  // Returns why it is refused; empty: it is not.
  std::string request(const std::string& recorder, const std::vector<std::string>& topics, std::uint32_t interval,
                      std::int64_t now_ns, std::vector<std::string>& served);
  // Waits until the publisher thread acts on all requests made so far. False: it does not within the timeout.
  bool wait_until_in_force(std::chrono::milliseconds timeout);

  // A recorder has received all its states of the steps up to the one with this stamp. False: it has no request.
  bool receipt(const std::string& recorder, std::int64_t stamp_ns);

  // --- Publisher thread.

  // In each of its iterations: whether any request is in force. Ends those that were not repeated.
  bool in_force(std::int64_t now_ns);
  // A step with this stamp was published.
  void published(std::int64_t stamp_ns);
  // Whether recorders that send receipts have all but the newest kMaxAhead steps.
  bool room();

 private:
  struct Request {
    std::vector<std::string> topics;
    std::uint32_t interval = 0;
    std::int64_t ends_ns = 0;
    bool receipts = false;                // it sends them
    std::deque<std::int64_t> unreceived;  // stamps of published steps, if it does
  };
  void renew_intervals();  // locked

  std::mutex mutex_;
  std::map<std::string, Request> requests_;                                  // by recorder; guarded
  std::map<std::string, std::weak_ptr<std::atomic<std::uint32_t>>> topics_;  // of open publishers; guarded
  std::atomic<std::int64_t> next_end_ns_{0};  // when the first request ends unless it is repeated; 0: there is none
  std::atomic<std::uint64_t> changes_{0};     // requests made so far
  std::atomic<bool> receipts_{false};         // some recorder sends them
  std::uint64_t seen_ = 0;                    // publisher thread: changes_ at its last iteration
  std::atomic<std::uint64_t> acted_on_{0};    // changes_ at the iteration before that one
};

}  // namespace ambf::ros_comm
