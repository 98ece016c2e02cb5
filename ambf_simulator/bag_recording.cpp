#include "bag_recording.h"

#include <algorithm>
#include <utility>

#include "ambf_cli.h"
#include "base/clock.h"
#include "base/realtime.h"
#include "base/spawn.h"

namespace ambf::simulator {

namespace {

constexpr const char* kBegun = "recording into ";  // what it says when its bag is open
constexpr const char* kDone = " lost; ";           // in the line that sums up
// The program says that it records a moment before it minds being interrupted.
constexpr double kNotBefore_s = 0.5;
constexpr double kLongestEnd_s = 150.0;  // ambf-cli itself gives up on a disk before
constexpr int kLook_ms = 50;

double seconds_since(std::int64_t ns) { return base::to_seconds(base::steady_ns() - ns); }

const std::string* last_with(const std::vector<std::string>& lines, const char* text) {
  const auto found = std::find_if(lines.rbegin(), lines.rend(),
                                  [&](const std::string& line) { return line.find(text) != std::string::npos; });
  return found == lines.rend() ? nullptr : &*found;
}

}  // namespace

BagRecording::BagRecording(BagRecorderOptions options, base::Log& log) : options_(std::move(options)), log_(log) {
  if (options_.unavailable.empty()) thread_ = std::thread([this] { run(); });
}

BagRecording::~BagRecording() {
  {
    const std::lock_guard lock(mutex_);
    over_ = true;
    if (state_ == State::running) state_ = State::ending;
  }
  changed_.notify_one();
  if (thread_.joinable()) thread_.join();
}

void BagRecording::start(const std::string& file) {
  if (!options_.unavailable.empty()) return report(base::Severity::error, "no recording: " + options_.unavailable);
  {
    const std::lock_guard lock(mutex_);
    if (state_ != State::idle) return;
    state_ = State::running;
    file_ = file;
    began_ns_ = base::steady_ns();
  }
  changed_.notify_one();
}

void BagRecording::stop() {
  const std::lock_guard lock(mutex_);
  if (state_ == State::running) state_ = State::ending;  // the thread looks every kLook_ms
}

render::DataRecording::State BagRecording::state() const {
  const std::lock_guard lock(mutex_);
  return state_;
}

double BagRecording::running_s() const { return state() == State::idle ? 0.0 : seconds_since(began_ns_); }

std::vector<std::string> BagRecording::take_messages() {
  const std::lock_guard lock(mutex_);
  return std::exchange(messages_, {});
}

void BagRecording::report(base::Severity severity, const std::string& text) {
  if (severity == base::Severity::error) {
    log_.error("%s", text.c_str());
  } else {
    log_.info("%s", text.c_str());
  }
  const std::lock_guard lock(mutex_);
  messages_.push_back(text);
}

void BagRecording::run() {
  base::set_thread_name("bag recording");
  std::unique_lock lock(mutex_);
  for (;;) {
    changed_.wait(lock, [this] { return over_ || state_ != State::idle; });
    if (state_ == State::idle) return;
    const std::string file = file_;
    lock.unlock();
    record(file);
    lock.lock();
    state_ = State::idle;
  }
}

void BagRecording::record(const std::string& file) {
  const std::string found = base::first_program(options_.places);
  if (found.empty()) return report(base::Severity::error, "no recording: " + ambf_cli_is_missing(options_.places));
  std::string problem;
  WatchedProgram recorder;
  if (!recorder.start({found, "record", "--output=" + file}, problem)) {
    return report(base::Severity::error, "no recording: " + problem);
  }
  const std::optional<int> code = until_it_ends(recorder);
  report(file, code, recorder.lines());
}

std::optional<int> BagRecording::until_it_ends(WatchedProgram& recorder) {
  std::int64_t begun_ns = 0, asked_ns = 0, over_ns = 0, interrupted_ns = 0;  // 0: not yet
  const auto once = [](std::int64_t& at_ns, bool happened) {
    if (at_ns == 0 && happened) at_ns = base::steady_ns();
  };
  for (;;) {
    if (const std::optional<int> code = recorder.watch(kLook_ms)) return code;
    if (begun_ns == 0) {
      if (const std::string* line = last_with(recorder.lines(), kBegun)) {
        once(begun_ns, true);
        report(base::Severity::information, line->substr(0, line->rfind("; Ctrl-C")));
      }
    }
    {
      const std::lock_guard lock(mutex_);
      once(asked_ns, state_ == State::ending);
      once(over_ns, over_);
    }
    if (asked_ns == 0) continue;
    const bool minds =
        begun_ns != 0 ? seconds_since(begun_ns) > kNotBefore_s : seconds_since(asked_ns) > 0.5 * options_.patience_s;
    if (interrupted_ns == 0 && minds) {
      once(interrupted_ns, true);
      recorder.interrupt();
    }
    const bool too_long = (over_ns != 0 && seconds_since(over_ns) > options_.patience_s) ||
                          (interrupted_ns != 0 && seconds_since(interrupted_ns) > kLongestEnd_s);
    if (!too_long) continue;
    recorder.kill();
    while (!recorder.watch(kLook_ms)) {
    }
    return std::nullopt;
  }
}

void BagRecording::report(const std::string& file, std::optional<int> code, const std::vector<std::string>& lines) {
  const std::string* done = last_with(lines, kDone);
  const std::string last = lines.empty() ? "it said nothing" : lines.back();
  if (!code) {
    return report(base::Severity::error, "the recording " + file +
                                             " did not end in time and was killed; its bag, or 'ambf-cli bag repair " +
                                             file + "', has what came until then");
  }
  if (*code == 0) return report(base::Severity::information, "recorded: " + (done != nullptr ? *done : file));
  if (done != nullptr) {  // there is a bag, and something about it
    return report(base::Severity::error, "recorded: " + *done + " (" + last + ")");
  }
  for (const std::string& line : lines) log_.warning("ambf-cli: %s", line.c_str());
  report(base::Severity::error, "no recording: " + last + " (ambf-cli ended with " + std::to_string(*code) + ")");
}

}  // namespace ambf::simulator
