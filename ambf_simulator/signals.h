// SIGINT, SIGTERM and SIGHUP as a value to poll: a thread of its own receives them, so that they end the program
// cleanly in every state, also while it loads or waits. A second signal (except SIGHUP) ends it at once.
#pragma once

#include <atomic>
#include <functional>
#include <thread>

namespace ambf::simulator {

class Signals {
 public:
  // Blocks these signals in this thread and in threads that it starts later: construct it first. `on_stop` is called
  // once, on the receiving thread, at the first signal.
  explicit Signals(std::function<void()> on_stop = {});
  ~Signals();
  Signals(const Signals&) = delete;
  Signals& operator=(const Signals&) = delete;

  bool stop_requested() const { return signal_ != 0 || stop_asked_; }
  int signal() const { return signal_; }  // 0, SIGINT, SIGTERM or SIGHUP
  // Requests a stop from within the program, as a signal would.
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
