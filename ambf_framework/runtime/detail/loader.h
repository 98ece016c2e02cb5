// The loader thread: everything that changes the structure happens here, one job after the other, so that names are
// resolved before the physics thread hears of it. Jobs may take long; nobody waits for them but who asked.
#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>

namespace ambf::runtime {

class Loader {
 public:
  Loader();
  ~Loader();
  Loader(const Loader&) = delete;
  Loader& operator=(const Loader&) = delete;

  // `job(run)`: run is true on the loader thread, in order, false (on any thread) when the loader is stopping.
  using Job = std::function<void(bool run)>;
  void post(Job job);
  // Ends after the job at hand; what is queued is called with run = false.
  void stop();

 private:
  void run();

  std::mutex mutex_;
  std::condition_variable wake_;
  std::deque<Job> jobs_;
  bool stop_ = false;
  std::thread thread_;
};

}  // namespace ambf::runtime
