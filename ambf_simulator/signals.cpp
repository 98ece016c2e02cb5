#include "signals.h"

#include <pthread.h>
#include <unistd.h>
#include <csignal>
#include <ctime>

#include <chrono>

#include "base/realtime.h"

namespace ambf::simulator {

namespace {

constexpr int kExitOnSecondSignal = 130;

sigset_t stop_signals() {
  sigset_t set;
  sigemptyset(&set);
  sigaddset(&set, SIGINT);
  sigaddset(&set, SIGTERM);
  // Who started us with SIGHUP ignored (nohup) wants us to outlive the terminal.
  struct sigaction hang_up {};
  sigaction(SIGHUP, nullptr, &hang_up);
  if (hang_up.sa_handler != SIG_IGN) sigaddset(&set, SIGHUP);
  sigaddset(&set, SIGUSR2);  // wakes the watching thread when the program asks for its end, and at the end
  return set;
}

}  // namespace

Signals::Signals(std::function<void()> on_stop) : on_stop_(std::move(on_stop)) {
  const sigset_t set = stop_signals();
  pthread_sigmask(SIG_BLOCK, &set, nullptr);
  // A parent shell may have made a background child ignore SIGINT: an ignored signal never arrives, a blocked one does.
  for (const int signal : {SIGINT, SIGTERM}) std::signal(signal, SIG_DFL);
  // Writing to a closed pipe or socket is an error of that write, not the end of the program.
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);  // so is one beyond the largest file that is allowed (ulimit -f)
  thread_ = std::thread([this] { watch(); });
}

Signals::~Signals() {
  ending_ = true;
  pthread_kill(thread_.native_handle(), SIGUSR2);
  thread_.join();
}

void Signals::request_stop() {
  stop_asked_ = true;
  pthread_kill(thread_.native_handle(), SIGUSR2);
}

bool Signals::wait(double seconds) {
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
  while (!stop_requested() && std::chrono::steady_clock::now() < deadline) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return stop_requested();
}

void Signals::watch() {
  const sigset_t set = stop_signals();
  while (!ending_) {
    int signal = 0;
    if (sigwait(&set, &signal) != 0) continue;
    // Windows yield to all else, but who ends the program waits for them.
    base::end_lower_priorities();
    if (signal == SIGUSR2) continue;
    if (signal == SIGHUP && signal_ != 0)
      continue;  // a terminal that closes may say so twice: the shell, and the kernel
    if (signal_ != 0) _exit(kExitOnSecondSignal);
    signal_ = signal;
    if (on_stop_) on_stop_();
  }
}

}  // namespace ambf::simulator
