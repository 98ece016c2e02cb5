#include "base/detail/stream_sink.h"

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>

#include "base/log_drain.h"

namespace ambf::base {

namespace {
constexpr int kPatienceMs = 200;        // for a reader that is slow
constexpr std::size_t kPortion = 4096;  // a pipe that polls writable takes this much without blocking (PIPE_BUF)
}  // namespace

LineWriter::~LineWriter() {
  if (owned_ && descriptor_ >= 0) ::close(descriptor_);
}

LineWriter::Result LineWriter::write_all(const std::string& text) {
  std::size_t done = 0;
  while (done < text.size()) {
    pollfd poll_for{descriptor_, POLLOUT, 0};
    const int ready = ::poll(&poll_for, 1, stuck_ ? 0 : kPatienceMs);
    if (ready < 0 && errno == EINTR) continue;
    if (ready == 0) return Result::stuck;
    const ssize_t n = ::write(descriptor_, text.data() + done, std::min(kPortion, text.size() - done));
    if (n > 0) {
      done += static_cast<std::size_t>(n);
      inside_line_ = true;
    } else if (n < 0 && errno == EINTR) {
      continue;
    } else {
      return n < 0 && (errno == EPIPE || errno == EBADF) ? Result::closed : Result::stuck;
    }
  }
  inside_line_ = false;
  return Result::done;
}

bool LineWriter::write(const std::string& line) {
  if (descriptor_ < 0) {
    ++lost_;
    return false;
  }
  std::string text;
  if (inside_line_) text += '\n';
  if (untold_ > 0) text += "(" + std::to_string(untold_) + " lines could not be written here)\n";
  text += line;
  text += '\n';
  const Result result = write_all(text);
  stuck_ = result == Result::stuck;
  if (result == Result::done) {
    untold_ = 0;
    return true;
  }
  ++lost_;
  ++untold_;
  if (result == Result::closed) {  // nobody will ever read: no further attempts
    if (owned_) ::close(descriptor_);
    descriptor_ = -1;
  }
  return false;
}

LogSink make_stream_sink(const std::string& file, std::string* problem) {
  auto standard_error = std::make_shared<LineWriter>(STDERR_FILENO, false);
  std::shared_ptr<LineWriter> log_file;
  if (!file.empty()) {
    // A pipe that nobody reads would hold the program here, deaf to signals.
    const int descriptor = ::open(file.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC | O_NONBLOCK, 0644);
    if (descriptor >= 0) {
      log_file = std::make_shared<LineWriter>(descriptor, true);
    } else if (problem != nullptr) {
      *problem = "cannot write the log file " + file + ": " + std::strerror(errno);
    }
  }
  return [standard_error, log_file, start = steady_ns()](const LogLine& line) {
    const std::string& text = line.text;
    char time[32];
    std::snprintf(time, sizeof time, "[%9.3f] ", to_seconds(line.steady_ns - start));
    const std::string full =
        line.complete
            ? text
            : time + (line.severity == Severity::information ? "" : to_string(line.severity) + std::string(": ")) +
                  text;
    standard_error->write(full);
    if (log_file) log_file->write(full);
  };
}

}  // namespace ambf::base
