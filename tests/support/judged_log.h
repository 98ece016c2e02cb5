// A log that fails the running test when it holds a warning or an error that the test did not expect, or lacks one that
// it did. A test that removes messages itself (take) judges those itself. Threads: as base::Log; expect_warning, allow
// and the destructor: the test's own.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "base/log.h"

namespace ambf {

class JudgedLog : public base::Log {
 public:
  ~JudgedLog() {
    std::set<std::string> judged;  // each text once
    for (base::LogRecord record; take(record);) {
      if (record.severity == base::Severity::information || !judged.insert(record.text).second) continue;
      const auto named = std::find_if(messages_.begin(), messages_.end(), [&](const Message& message) {
        return record.text.find(message.part) != std::string::npos;
      });
      if (named == messages_.end()) {
        ADD_FAILURE() << "unexpected in the log: " << record.text;
      } else {
        named->missing = false;
      }
    }
    for (const Message& message : messages_) EXPECT_FALSE(message.missing) << "expected in the log: " << message.part;
  }

  // At least one warning or error that contains `part` is logged.
  void expect_warning(std::string part) { messages_.push_back({std::move(part), true}); }
  // Warnings and errors that contain `part` may be logged.
  void allow(std::string part) { messages_.push_back({std::move(part), false}); }

 private:
  struct Message {
    std::string part;
    bool missing;
  };
  std::vector<Message> messages_;
};

}  // namespace ambf
