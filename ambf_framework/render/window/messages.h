// Messages that a window shows for a few seconds, newest last. `add` from any thread (completions of requests); the
// rest on the main thread.
#pragma once

#include <cstdint>
#include <mutex>
#include <string>
#include <vector>

namespace ambf::render {

class Messages {
 public:
  void add(std::string text);
  // The messages to show at `now_ns`.
  std::vector<std::string> shown(std::int64_t now_ns);

 private:
  static constexpr std::int64_t kShown_ns = 6'000'000'000;
  static constexpr std::size_t kMost = 6;

  struct Message {
    std::string text;
    std::int64_t until_ns = 0;  // 0: not shown yet
  };
  std::mutex mutex_;
  std::vector<Message> messages_;
};

}  // namespace ambf::render
