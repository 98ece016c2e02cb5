#include "base/log.h"

#include <cstdio>
#include <cstring>
#include <thread>

namespace ambf::base {

namespace {
constexpr std::int64_t kReportPatienceNs = 200000000;  // how long report() waits for room
}

// A cell may be filled when its turn equals the tail, emptied when it equals the head + 1.
struct Log::Cell {
  std::atomic<std::size_t> turn{0};
  Severity severity = Severity::information;
  std::int64_t steady_ns = 0;
  std::string* long_text = nullptr;  // owned
  std::size_t length = 0;
  char text[kLogTextSize] = {};
};

Log::Log(std::size_t records) {
  std::size_t count = 2;
  while (count < records) count *= 2;
  cells_ = std::make_unique<Cell[]>(count);
  mask_ = count - 1;
  for (std::size_t i = 0; i < count; ++i) cells_[i].turn.store(i, std::memory_order_relaxed);
}

Log::~Log() {
  LogRecord record;
  while (take(record)) {
  }
}

bool Log::push(Severity severity, const char* text, std::size_t length, std::string* long_text) {
  std::size_t tail = tail_.load(std::memory_order_relaxed);
  for (;;) {
    Cell& cell = cells_[tail & mask_];
    const auto lead = static_cast<std::ptrdiff_t>(cell.turn.load(std::memory_order_acquire) - tail);
    if (lead < 0) return false;
    if (lead > 0) {
      tail = tail_.load(std::memory_order_relaxed);
    } else if (tail_.compare_exchange_weak(tail, tail + 1, std::memory_order_relaxed)) {
      cell.severity = severity;
      cell.steady_ns = steady_ns();
      cell.long_text = long_text;
      cell.length = length;
      if (text != nullptr) std::memcpy(cell.text, text, length);
      cell.turn.store(tail + 1, std::memory_order_release);
      event_.notify_all();
      return true;
    }
  }
}

bool Log::take(LogRecord& record) {
  const std::size_t head = head_.load(std::memory_order_relaxed);
  Cell& cell = cells_[head & mask_];
  if (cell.turn.load(std::memory_order_acquire) != head + 1) return false;
  record.severity = cell.severity;
  record.steady_ns = cell.steady_ns;
  record.complete = cell.long_text != nullptr;
  if (cell.long_text != nullptr) {
    record.text = std::move(*cell.long_text);
    delete cell.long_text;
    cell.long_text = nullptr;
  } else {
    record.text.assign(cell.text, cell.length);
  }
  cell.turn.store(head + mask_ + 1, std::memory_order_release);
  head_.store(head + 1, std::memory_order_relaxed);
  return true;
}

void Log::write_list(Severity severity, const char* format, va_list arguments) {
  char text[kLogTextSize];
  const int wanted = std::vsnprintf(text, sizeof text, format, arguments);
  if (wanted < 0) {
    lost_.fetch_add(1, std::memory_order_relaxed);
    return;
  }
  std::size_t length = static_cast<std::size_t>(wanted);
  if (length >= sizeof text) {
    length = sizeof text - 1;
    std::memcpy(text + length - 3, "...", 3);
  }
  if (!push(severity, text, length, nullptr)) lost_.fetch_add(1, std::memory_order_relaxed);
}

void Log::write(Severity severity, const char* format, ...) {
  va_list arguments;
  va_start(arguments, format);
  write_list(severity, format, arguments);
  va_end(arguments);
}

void Log::info(const char* format, ...) {
  va_list arguments;
  va_start(arguments, format);
  write_list(Severity::information, format, arguments);
  va_end(arguments);
}

void Log::warning(const char* format, ...) {
  va_list arguments;
  va_start(arguments, format);
  write_list(Severity::warning, format, arguments);
  va_end(arguments);
}

void Log::error(const char* format, ...) {
  va_list arguments;
  va_start(arguments, format);
  write_list(Severity::error, format, arguments);
  va_end(arguments);
}

void Log::report(const Diagnostic& diagnostic) {
  auto text = std::make_unique<std::string>(to_string(diagnostic));
  const std::int64_t deadline = steady_ns() + kReportPatienceNs;
  while (!push(diagnostic.severity, nullptr, 0, text.get())) {
    if (!drained_.load(std::memory_order_acquire) || steady_ns() > deadline) {
      lost_.fetch_add(1, std::memory_order_relaxed);
      return;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  text.release();  // the ring's now
}

void Log::report(const Diagnostics& diagnostics) {
  for (const Diagnostic& diagnostic : diagnostics) report(diagnostic);
}

}  // namespace ambf::base
