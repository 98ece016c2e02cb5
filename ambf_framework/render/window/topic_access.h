// Topics and services of any type, as the windows show and use them: by whoever made this, in whatever way. render/ knows neither middleware
// nor programs. Nothing here waits: what is asked for is answered later, under its number. Main thread.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace ambf::render {

struct TopicInfo {
  std::string name, type;  // type empty: nobody has told it yet
  bool service = false;
  bool ours = false;                  // of this simulation
  int publishers = 0, listeners = 0;  // of a topic
};

// A message is a row after the other; those below another have a greater depth.
struct MessageRow {
  int depth = 0;
  bool opens = false;  // rows below it follow
  std::string name, value;
};

struct WatchedMessage {
  std::string topic, type;
  std::string problem;  // why it cannot be read; empty: it can
  std::uint64_t count = 0;
  double rate_hz = 0.0;  // of arrival, 0: not known yet; shown are fewer
  std::size_t bytes = 0;
  std::int64_t came_ns = 0;  // steady clock
  std::vector<MessageRow> rows;
};

struct PublishedTopic {
  std::string topic;
  double rate_hz = 0.0;
  std::uint64_t count = 0;
};

// All that is known at one moment; never changes.
struct TopicView {
  enum class Stage { off, starting, running, failed };  // failed: until retry()
  Stage stage = Stage::off;
  std::string problem;                                 // what is wrong, in words; empty: nothing
  std::shared_ptr<const std::vector<TopicInfo>> list;  // ours first, then by name; never null
  std::shared_ptr<const WatchedMessage> message;       // the newest of what is watched; null: none yet
  std::vector<PublishedTopic> published;               // at a rate
};

struct TopicAnswer {
  std::uint64_t id = 0;
  bool good = false;
  std::string text;              // a template, what was done, or what is wrong
  std::vector<MessageRow> rows;  // of a service's answer
};

class TopicAccess {
 public:
  virtual ~TopicAccess() = default;
  virtual std::string unavailable() const = 0;                // why there can be none, in words; empty: there can
  virtual void look(bool on) = 0;                             // somebody looks, or no longer; starts what is needed
  virtual void retry() = 0;                                   // after it failed
  virtual std::shared_ptr<const TopicView> view() const = 0;  // never null

  virtual void watch(const std::string& topic) = 0;  // this one; empty: none
  // Numbers of the answers to come.
  virtual std::uint64_t ask_template(const TopicInfo& of) = 0;
  virtual std::uint64_t publish(const std::string& topic, const std::string& type, const std::string& text,
                                double rate_hz) = 0;  // 0: once
  virtual std::uint64_t stop_publishing(const std::string& topic) = 0;
  virtual std::uint64_t call(const std::string& service, const std::string& type, const std::string& text) = 0;
  virtual std::vector<TopicAnswer> take_answers() = 0;  // since the last call
};

}  // namespace ambf::render
