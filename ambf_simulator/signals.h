// SIGINT, SIGTERM and SIGHUP as a value to look at: a thread of its own takes them, so that they end the program cleanly in every state,
// also while it loads or waits. A second signal (but SIGHUP) ends it at once.
#pragma once

#include <atomic>
#include <functional>
#include <thread>

namespace ambf::simulator {

class Signals {
 public:
  // Blocks these signals in this thread and all that it starts afterwards: make it first. `on_stop` is called once, on the
  // watching thread, when the first one arrives.
  explicit Signals(std::function<void()> on_stop = {});
  ~Signals();
  Signals(const Signals&) = delete;
  Signals& operator=(const Signals&) = delete;

  bool stop_requested() const { return signal_ != 0 || stop_asked_; }
  int signal() const { return signal_; }  // 0, SIGINT, SIGTERM or SIGHUP
  // As a signal would, from within the program.
  void request_stop();
  // Sleeps until a stop is requested or the time is over; returns stop_requested().
  bool wait(double seconds);

 private:
  void watch();

  std::function<void()> on_stop_;
  std::atomic<int> signal_{0};
  std::atomic<bool> ending_{false}, stop_asked_{false};
  std::thread thread_;
};

}  // namespace ambf::simulator
