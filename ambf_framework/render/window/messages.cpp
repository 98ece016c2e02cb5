#include "render/window/messages.h"

#include <utility>

namespace ambf::render {

void Messages::add(std::string text) {
  const std::lock_guard lock(mutex_);
  messages_.push_back({std::move(text), 0});
  if (messages_.size() > kMost) messages_.erase(messages_.begin());
}

std::vector<std::string> Messages::shown(std::int64_t now_ns) {
  const std::lock_guard lock(mutex_);
  std::vector<std::string> texts;
  for (Message& message : messages_) {
    if (message.until_ns == 0) message.until_ns = now_ns + kShown_ns;
    if (message.until_ns > now_ns) texts.push_back(message.text);
  }
  std::erase_if(messages_, [now_ns](const Message& m) { return m.until_ns <= now_ns; });
  return texts;
}

}  // namespace ambf::render
