#include "runtime/detail/loader.h"

namespace ambf::runtime {

Loader::Loader() : thread_([this] { run(); }) {}

Loader::~Loader() { stop(); }

void Loader::stop() {
  std::deque<Job> dropped;
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
    dropped.swap(jobs_);
  }
  wake_.notify_all();
  if (thread_.joinable()) thread_.join();
  for (const Job& job : dropped) job(false);
}

void Loader::post(Job job) {
  {
    const std::lock_guard lock(mutex_);
    if (!stop_) {
      jobs_.push_back(std::move(job));
      wake_.notify_one();
      return;
    }
  }
  job(false);
}

void Loader::run() {
  std::unique_lock lock(mutex_);
  while (true) {
    wake_.wait(lock, [this] { return stop_ || !jobs_.empty(); });
    if (stop_) return;
    {
      const Job job = std::move(jobs_.front());
      jobs_.pop_front();
      lock.unlock();
      job(true);
    }  // what it held is let go unlocked: that may post another job
    lock.lock();
  }
}

}  // namespace ambf::runtime
