// Finishes requests: a thread of its own runs their answer() and destroys them, so that the physics thread never calls
// out, never waits and never frees.
#pragma once

#include <atomic>
#include <thread>

#include "base/bounds.h"
#include "exchange/bounded_queue.h"
#include "exchange/signal.h"
#include "runtime/detail/request.h"

namespace ambf::runtime {

// Requests in flight (base/bounds.h). The last places belong to the loader, whose catalogue has already moved on and
// must never be refused.
using base::kMaxRequests;
inline constexpr std::size_t kPlacesForSteps = base::kMaxStepRequests;
inline constexpr std::size_t kPlacesForOthers = kMaxRequests - 8;

class Answers {
 public:
  Answers();
  ~Answers();  // answers what is left, then returns
  Answers(const Answers&) = delete;
  Answers& operator=(const Answers&) = delete;

  // A place for one more request, to be given back by its answer; false when `limit` (at most kMaxRequests) are in
  // flight. Any thread.
  bool reserve(std::size_t limit = kMaxRequests);
  // Takes a request whose place was reserved; therefore never fails and never blocks. Physics thread, or the thread
  // that could not submit.
  void push(RequestPtr request, bool ran);
  // The same for one that has no waiting caller any more: the thread that reserves the next places destroys it, or this
  // one does within a second. Were it this thread's work alone, a client that steps in a loop on a busy machine would
  // fill all places before it is served.
  void dispose(RequestPtr request);

 private:
  struct Item {
    RequestPtr request;
    bool ran = false;
  };
  void run();
  bool destroy_one();

  exchange::BoundedQueue<Item> queue_{kMaxRequests};
  exchange::BoundedQueue<RequestPtr> disposed_{kMaxRequests};
  exchange::Signal signal_;
  std::atomic<std::size_t> in_flight_{0};
  std::atomic<bool> stop_{false};
  std::thread thread_;
};

}  // namespace ambf::runtime
