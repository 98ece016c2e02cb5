#include "runtime/detail/loader.h"

#include <chrono>

#include "base/realtime.h"

namespace ambf::runtime {

namespace {

constexpr std::chrono::milliseconds kQuiet{500};

}  // namespace

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
  const auto wanted = [this] { return stop_ || !jobs_.empty(); };
  bool tidy = true;
  while (true) {
    // Texts, meshes and frames that were replaced leave holes in the heaps. Not between jobs: the next needs them.
    // (By the system's clock: ThreadSanitizer does not know how waiting by the steady one is done.)
    if (!tidy && !wake_.wait_until(lock, std::chrono::system_clock::now() + kQuiet, wanted)) {
      lock.unlock();
      base::give_back_memory();
      lock.lock();
      tidy = true;
    }
    wake_.wait(lock, wanted);
    if (stop_) return;
    {
      const Job job = std::move(jobs_.front());
      jobs_.pop_front();
      lock.unlock();
      job(true);
    }  // what it held is let go unlocked: that may post another job
    tidy = false;
    lock.lock();
  }
}

}  // namespace ambf::runtime
