// Opens and closes endpoints on a few threads of its own, because each waits for the middleware's master; nobody else
// ever does. The world is opened before all others and, when it is handed to close() after them, closed after them:
// a simulator that takes its place finds nothing of ours. What cannot be opened now is tried again. Private to comm.
// Threads: open() and close() from one thread (the publisher), none of which waits. C++17.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <thread>
#include <vector>

#include "comm/detail/instance.h"

namespace ambf::comm {

class Advertiser {
 public:
  Advertiser(Middleware& middleware, int threads);
  ~Advertiser();  // gives up what is not open yet, and returns when all that close() was called for is closed
  Advertiser(const Advertiser&) = delete;
  Advertiser& operator=(const Advertiser&) = delete;

  void open(const InstancePtr& instance);
  // The caller must not use the instance's endpoint any more.
  void close(const InstancePtr& instance);

  std::size_t open_count() const { return open_count_.load(); }

 private:
  using Lock = std::unique_lock<std::mutex>;

  void run();
  bool may_open() const;
  bool may_close() const;
  void open_next(Lock& lock);
  void close_next(Lock& lock);

  Middleware& middleware_;
  std::mutex mutex_;
  std::condition_variable wake_;
  std::deque<InstancePtr> to_open_, to_close_;       // guarded, as are the next four
  std::chrono::steady_clock::time_point try_again_;  // not before this, after a failure
  bool world_open_ = false;
  int busy_ = 0;  // threads that open or close something now
  bool stopping_ = false;
  std::atomic<std::size_t> open_count_{0};
  std::vector<std::thread> threads_;
};

}  // namespace ambf::comm
