// Writes lines to a file descriptor that may be closed, full or stopped: what cannot be written within a moment is
// counted as lost, and said as soon as writing works again. Never blocks for long, never raises SIGPIPE's default (its
// thread has that signal blocked), never throws. One thread at a time.
#pragma once

#include <cstdint>
#include <string>

namespace ambf::base {

class LineWriter {
 public:
  // Owned descriptors are closed at the end. -1: writes nothing.
  LineWriter(int descriptor, bool owned) : descriptor_(descriptor), owned_(owned) {}
  ~LineWriter();
  LineWriter(const LineWriter&) = delete;
  LineWriter& operator=(const LineWriter&) = delete;

  // Writes `line` and a line feed; false when it was lost.
  bool write(const std::string& line);
  std::uint64_t lost() const { return lost_; }

 private:
  enum class Result { done, stuck, closed };
  Result write_all(const std::string& text);

  int descriptor_;
  bool owned_;
  bool stuck_ = false;        // the last attempt failed: do not wait again
  bool inside_line_ = false;  // a line was written in part
  std::uint64_t lost_ = 0;    // in all
  std::uint64_t untold_ = 0;  // of these not yet said
};

}  // namespace ambf::base
