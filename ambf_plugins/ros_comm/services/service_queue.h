// Where roscpp puts service requests, for the threads that answer them. As ros::CallbackQueue, but who is woken need
// not sleep once more: roscpp's signals its sleeper while it holds a lock that this one needs at once, and a service
// thread, which has a real-time priority, then costs two wake-ups a request, 20 us of a step's 200. Any thread, any
// function. Private to ros_comm. C++17.
#pragma once

#include <ros/callback_queue_interface.h>

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <mutex>
#include <vector>

namespace ambf::ros_comm {

class ServiceQueue final : public ros::CallbackQueueInterface {
 public:
  // max_per_service: requests to one service that run at once; more wait. Clients that wait for steps, or load much,
  // leave a thread to the others.
  explicit ServiceQueue(unsigned max_per_service) : max_per_service_(max_per_service) {}

  void addCallback(const ros::CallbackInterfacePtr& callback, std::uint64_t owner) override;
  // Drops the requests of this owner that have not begun. One that runs may run on: Gate guards its service.
  void removeByID(std::uint64_t owner) override;

  // Runs the oldest that may run, in this thread; waits for one up to the timeout.
  void run_one(std::chrono::milliseconds timeout);
  // Ends all waiting; nothing is taken or run from now on.
  void disable();

 private:
  struct Entry {
    ros::CallbackInterfacePtr callback;
    std::uint64_t owner;
  };

  std::deque<Entry>::iterator next();  // locked

  const unsigned max_per_service_;
  std::mutex mutex_;
  std::condition_variable arrived_;
  std::deque<Entry> entries_;
  std::vector<std::uint64_t> running_;  // owners of what runs now
  bool enabled_ = true;
};

}  // namespace ambf::ros_comm
