#include "render/panel/notices.h"

#include <utility>

namespace ambf::render {

Notices::Notices(base::Log& log, std::shared_ptr<Messages> messages)
    : log_(log), messages_(messages != nullptr ? std::move(messages) : std::make_shared<Messages>()) {}

void Notices::warn(const std::string& text) const {
  log_.warning("%s", text.c_str());
  messages_->add(text);
}

state::Completion Notices::outcome(const std::string& done, const std::string& not_done) const {
  return [messages = messages_, &log = log_, done, not_done](const state::Outcome& outcome) {
    if (!outcome.success) {
      log.error("%s: %s", not_done.c_str(), outcome.message.c_str());
      messages->add(not_done + ": " + outcome.message);
    } else if (!done.empty()) {
      log.info("%s", done.c_str());
      messages->add(done);
    }
  };
}

state::Completion Notices::remark(const std::string& about) const {
  return [messages = messages_, about](const state::Outcome& outcome) {
    if (!outcome.message.empty()) messages->add(about + ": " + outcome.message);
  };
}

}  // namespace ambf::render
