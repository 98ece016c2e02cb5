// Who may still be inside an object when it goes: callbacks enter, close() turns newcomers away and waits for those
// inside. roscpp promises as much when a subscriber or service is shut down, but AddressSanitizer caught a service
// handler running afterwards. Shared between the object and its callbacks, so that it outlives both. Any thread.
// Private to ros_comm. C++17.
#pragma once

#include <condition_variable>
#include <mutex>

namespace ambf::ros_comm {

class Gate {
 public:
  class Pass {
   public:
    explicit Pass(Gate& gate) : gate_(gate), granted_(gate.enter()) {}
    ~Pass() {
      if (granted_) gate_.leave();
    }
    Pass(const Pass&) = delete;
    Pass& operator=(const Pass&) = delete;
    explicit operator bool() const { return granted_; }

   private:
    Gate& gate_;
    const bool granted_;
  };

  void close() {
    std::unique_lock<std::mutex> lock(mutex_);
    closed_ = true;
    empty_.wait(lock, [this] { return inside_ == 0; });
  }

 private:
  bool enter() {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (closed_) return false;
    ++inside_;
    return true;
  }
  void leave() {
    // Told while locked: close() may end, and this with it, as soon as the lock is free.
    const std::lock_guard<std::mutex> lock(mutex_);
    if (--inside_ == 0) empty_.notify_all();
  }

  std::mutex mutex_;
  std::condition_variable empty_;
  int inside_ = 0;
  bool closed_ = false;
};

}  // namespace ambf::ros_comm
