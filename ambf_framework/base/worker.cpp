#include "base/worker.h"

#include <dlfcn.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <utility>

#include "base/spawn.h"

namespace ambf::base {

namespace {

using Clock = std::chrono::steady_clock;

std::string after_seconds(double seconds) {
  std::string text = std::to_string(seconds);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text + " s";
}

std::string cause_of_death(int status) {
  if (WIFSIGNALED(status)) {
    const int signal = WTERMSIG(status);
    if (signal == SIGXCPU) return "it used more processor time than it may";
    return "it crashed (" + std::string(::strsignal(signal)) + ")";
  }
  if (WEXITSTATUS(status) == kWorkerOutOfMemory) return "it needed more memory than it may have";
  return "it ended without an answer (exit status " + std::to_string(WEXITSTATUS(status)) + ")";
}

class Conversation {
 public:
  explicit Conversation(const WorkerCall& call) : call_(call) {}
  ~Conversation() {
    if (socket_ >= 0) ::close(socket_);
    end_process();
  }
  Conversation(const Conversation&) = delete;
  Conversation& operator=(const Conversation&) = delete;

  WorkerAnswer hold(std::string_view question) {
    WorkerAnswer answer;
    if (!start(answer.problem)) return answer;
    send(WorkerMessageKind::question, question);
    const auto started = Clock::now();
    heard_ = started;
    while (!answered_ && answer.problem.empty()) {
      const auto now = Clock::now();
      const std::chrono::duration<double> silent = now - heard_, whole = now - started;
      const double left = std::min(call_.limits.silence_s - silent.count(), call_.limits.total_s - whole.count());
      if (left <= 0.0) {
        const bool all = whole.count() >= call_.limits.total_s;
        answer.problem = "it did not " + std::string(all ? "end" : "answer") + " within " +
                         after_seconds(all ? call_.limits.total_s : call_.limits.silence_s);
        break;
      }
      exchange(static_cast<int>(1000.0 * left) + 1, answer.problem);
    }
    answer.ok = answered_ && answer.problem.empty();
    if (answer.ok) answer.bytes = std::move(answer_);
    return answer;
  }

 private:
  bool start(std::string& problem) {
    int ends[2];
    if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0) {
      problem = std::string("no socket could be made for it: ") + std::strerror(errno);
      return false;
    }
    socket_ = ends[0];
    Streams streams;
    streams.input = ends[1];
    streams.output = ends[1];
    process_ = spawn({call_.program, std::to_string(::getpid())}, streams, problem);
    ::close(ends[1]);
    return process_ > 0;
  }

  void send(WorkerMessageKind kind, std::string_view bytes) {
    const WorkerMessage head{kind, bytes.size()};
    outgoing_.assign(reinterpret_cast<const char*>(&head), sizeof head);
    outgoing_.append(bytes);
    sent_ = 0;
  }

  void exchange(int wait_ms, std::string& problem) {
    const bool sending = sent_ < outgoing_.size();
    pollfd wanted{socket_, static_cast<short>(sending ? POLLIN | POLLOUT : POLLIN), 0};
    if (::poll(&wanted, 1, wait_ms) <= 0) return;
    if ((wanted.revents & POLLIN) != 0 || (wanted.revents & (POLLHUP | POLLERR)) != 0) {
      receive(problem);
    } else if ((wanted.revents & POLLOUT) != 0) {
      const ssize_t put =
          ::send(socket_, outgoing_.data() + sent_, outgoing_.size() - sent_, MSG_NOSIGNAL | MSG_DONTWAIT);
      if (put <= 0) return;  // gone: receive() finds out why
      sent_ += static_cast<std::size_t>(put);
      heard_ = Clock::now();
    }
  }

  void receive(std::string& problem) {
    char buffer[65536];
    const ssize_t got = ::recv(socket_, buffer, sizeof buffer, MSG_DONTWAIT);
    if (got < 0 && (errno == EAGAIN || errno == EINTR)) return;
    if (got <= 0) {
      problem = end_process(true);
      return;
    }
    heard_ = Clock::now();
    incoming_.append(buffer, static_cast<std::size_t>(got));
    WorkerMessage head;
    if (incoming_.size() < sizeof head) return;
    std::memcpy(&head, incoming_.data(), sizeof head);
    const bool wants = head.kind == WorkerMessageKind::file_wanted;
    const std::size_t max_name = 4096;
    if ((!wants && head.kind != WorkerMessageKind::answer) ||
        head.size > (wants ? max_name : call_.limits.max_answer_bytes)) {
      problem = "its answer is malformed";
      return;
    }
    if (incoming_.size() - sizeof head < head.size) return;
    if (incoming_.size() - sizeof head > head.size) {
      problem = "its answer is malformed";
      return;
    }
    incoming_.erase(0, sizeof head);
    if (wants) {
      serve(std::exchange(incoming_, {}), problem);
    } else {
      answer_ = std::move(incoming_);
      answered_ = true;
    }
  }

  void serve(const std::string& name, std::string& problem) {
    if (++files_ > call_.limits.max_files) {
      problem = "it asked for more than " + std::to_string(call_.limits.max_files) + " files";
      return;
    }
    const std::optional<std::string> bytes = call_.file ? call_.file(name) : std::nullopt;
    heard_ = Clock::now();
    send(bytes ? WorkerMessageKind::file_found : WorkerMessageKind::file_missing,
         bytes ? std::string_view(*bytes) : std::string_view());
  }

  // `by_itself`: its socket is closed, so it is ending or pretends to; returns why.
  std::string end_process(bool by_itself = false) {
    if (process_ < 0) return {};
    int status = 0;
    constexpr int kTries = 100;  // of 2 ms
    for (int i = 0; by_itself && i < kTries && process_ > 0; ++i) {
      if (::waitpid(process_, &status, WNOHANG) != 0) process_ = -1;
      if (process_ > 0) ::usleep(2000);
    }
    if (process_ < 0) return cause_of_death(status);
    ::kill(process_, SIGKILL);
    while (::waitpid(process_, &status, 0) < 0 && errno == EINTR) {
    }
    process_ = -1;
    return "it closed its connection without an answer";
  }

  const WorkerCall& call_;
  pid_t process_ = -1;
  int socket_ = -1;
  std::string outgoing_, incoming_, answer_;
  std::size_t sent_ = 0, files_ = 0;
  bool answered_ = false;
  Clock::time_point heard_;
};

}  // namespace

WorkerAnswer ask_worker(const WorkerCall& call, std::string_view question) { return Conversation(call).hold(question); }

std::string program_beside_library(const std::string& name) {
  Dl_info info{};
  if (::dladdr(reinterpret_cast<const void*>(&ask_worker), &info) == 0 || info.dli_fname == nullptr) return {};
  std::error_code error;
  const std::filesystem::path library = std::filesystem::canonical(info.dli_fname, error);
  return (library.parent_path() / "ambf" / name).string();
}

}  // namespace ambf::base
