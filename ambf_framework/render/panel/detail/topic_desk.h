// What the panel knows of topics and services and what it does with them: which one is chosen and watched, what is being written for it, what came
// of that. No drawing: section_topics.cpp shows it. Nothing is asked of anybody while nobody looks. Main thread. Private to render/panel/.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "render/window/topic_access.h"

namespace ambf::render {

// How often messages come, how many came since they are watched, and how large the newest is, which came so long ago.
std::string in_words(const WatchedMessage& message, double silent_s);

class TopicDesk {
 public:
  // What came of something that was asked.
  struct Outcome {
    enum class State { none, waiting, good, bad };
    State state = State::none;
    std::uint64_t id = 0;
    std::int64_t asked_ns = 0;
    std::string text;
    std::vector<MessageRow> rows;
  };
  // What is written for a topic or a service; kept when another one is chosen.
  struct Draft {
    std::string text;
    double rate_hz = 10.0;
    Outcome filled;       // the template
    bool refill = false;  // it takes the place of what is written
    Outcome sent;         // published or called
  };

  explicit TopicDesk(TopicAccess* access) : access_(access) {}

  std::string unavailable() const;    // why there is nothing to show; empty: there is
  void show(std::int64_t now_ns);     // somebody looks, in this picture
  void observe(std::int64_t now_ns);  // once a picture, shown or not
  const TopicView& view() const { return *view_; }
  void retry();

  // A topic is watched while it is chosen and somebody looks.
  void choose(const std::string& name);  // empty: nothing
  const std::string& chosen() const { return chosen_; }
  const TopicInfo* info() const;            // of what is chosen; null: nothing, or it is not there
  const WatchedMessage* message() const;    // null: none yet
  const PublishedTopic* published() const;  // what is chosen, at a rate; null: it is not

  Draft& draft() { return drafts_[chosen_]; }
  void fill_in();  // the draft by the template; an empty one is filled by itself when it is chosen first
  void publish_once();
  void publish_at_rate();
  void stop_publishing(const std::string& topic);  // also of one that nobody else knows any more
  void call();

 private:
  bool can_act() const { return info() != nullptr; }
  void ask(Outcome& outcome, std::uint64_t id);

  TopicAccess* access_;
  std::shared_ptr<const TopicView> view_ = std::make_shared<const TopicView>();
  std::string chosen_;
  std::map<std::string, Draft> drafts_;
  std::int64_t now_ns_ = 0, shown_ns_ = 0;
  bool shown_ = false;
};

}  // namespace ambf::render
