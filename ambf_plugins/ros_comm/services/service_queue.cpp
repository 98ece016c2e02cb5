#include "ros_comm/services/service_queue.h"

#include <algorithm>

namespace ambf::ros_comm {

void ServiceQueue::addCallback(const ros::CallbackInterfacePtr& callback, std::uint64_t owner) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (!enabled_) return;
    entries_.push_back({callback, owner});
  }
  arrived_.notify_one();  // unlocked: who wakes can go on
}

void ServiceQueue::removeByID(std::uint64_t owner) {
  std::deque<Entry> removed;  // destroyed without the lock: their ends are roscpp's business
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    const auto kept = std::stable_partition(entries_.begin(), entries_.end(),
                                            [owner](const Entry& entry) { return entry.owner != owner; });
    std::move(kept, entries_.end(), std::back_inserter(removed));
    entries_.erase(kept, entries_.end());
  }
}

std::deque<ServiceQueue::Entry>::iterator ServiceQueue::next() {
  return std::find_if(entries_.begin(), entries_.end(), [this](const Entry& entry) {
    return std::count(running_.begin(), running_.end(), entry.owner) < max_per_service_;
  });
}

void ServiceQueue::run_one(std::chrono::milliseconds timeout) {
  Entry entry;
  {
    std::unique_lock<std::mutex> lock(mutex_);
    arrived_.wait_for(lock, timeout, [this] { return !enabled_ || next() != entries_.end(); });
    const auto found = next();
    if (!enabled_ || found == entries_.end()) return;
    entry = std::move(*found);
    entries_.erase(found);
    running_.push_back(entry.owner);
  }
  const bool again = entry.callback->call() == ros::CallbackInterface::TryAgain;
  {
    // Who waited for this end to come need not be woken: this thread looks for the next one now.
    const std::lock_guard<std::mutex> lock(mutex_);
    running_.erase(std::find(running_.begin(), running_.end(), entry.owner));
  }
  if (again) addCallback(entry.callback, entry.owner);
}

void ServiceQueue::disable() {
  std::deque<Entry> removed;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    enabled_ = false;
    removed.swap(entries_);
  }
  arrived_.notify_all();
}

}  // namespace ambf::ros_comm
