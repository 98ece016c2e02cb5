// Reports to the panel's user: texts over the scene, and outcomes of requests in the log as well. Main thread.
#pragma once

#include <memory>
#include <string>

#include "base/log.h"
#include "render/window/messages.h"
#include "state/abilities/outcome.h"

namespace ambf::render {

class Notices {
 public:
  // `log` outlives all requests; without `messages` nothing is shown.
  Notices(base::Log& log, std::shared_ptr<Messages> messages);

  void show(const std::string& text) const { messages_->add(text); }
  void warn(const std::string& text) const;  // in the log as well
  // For a request: shows `done` (unless empty), or `not_done` with the reason. May be called after the panel is gone,
  // on any thread.
  state::Completion outcome(const std::string& done, const std::string& not_done) const;
  // For a request whose outcome may have a remark either way.
  state::Completion remark(const std::string& about) const;

 private:
  base::Log& log_;
  std::shared_ptr<Messages> messages_;
};

}  // namespace ambf::render
