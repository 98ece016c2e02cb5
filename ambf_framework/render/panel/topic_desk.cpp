#include "render/panel/detail/topic_desk.h"

#include <algorithm>
#include <cstdio>

namespace ambf::render {

namespace {

constexpr std::int64_t kLooks_ns = 2'000'000'000;  // after it was last shown

constexpr double kSilent_s = 2.0;

std::string readable_size(std::size_t bytes) {
  char text[40];
  if (bytes < 10000) {
    std::snprintf(text, sizeof text, "%zu byte%s", bytes, bytes == 1 ? "" : "s");
  } else {
    const double kilobytes = 1e-3 * static_cast<double>(bytes);
    std::snprintf(text, sizeof text, kilobytes < 1000.0 ? "%.0f kB" : "%.1f MB",
                  kilobytes < 1000.0 ? kilobytes : 1e-3 * kilobytes);
  }
  return text;
}

}  // namespace

std::string TopicDesk::unavailable() const {
  return access_ == nullptr ? "nobody here knows any topics" : access_->unavailable();
}

void TopicDesk::show(std::int64_t now_ns) {
  shown_ = true;
  shown_ns_ = now_ns;
}

void TopicDesk::observe(std::int64_t now_ns) {
  now_ns_ = now_ns;
  if (access_ == nullptr) return;
  shown_ = shown_ && now_ns - shown_ns_ < kLooks_ns;
  access_->look(shown_);
  access_->watch(shown_ && info() != nullptr && !info()->service ? chosen_ : std::string());
  view_ = access_->view();
  for (TopicAnswer& answer : access_->take_answers()) {
    for (auto& [name, draft] : drafts_) {
      for (Outcome* outcome : {&draft.filled, &draft.sent}) {
        if (outcome->id != answer.id || outcome->state != Outcome::State::waiting) continue;
        outcome->state = answer.good ? Outcome::State::good : Outcome::State::bad;
        outcome->text = std::move(answer.text);
        outcome->rows = std::move(answer.rows);
        if (outcome == &draft.filled && answer.good && (draft.refill || draft.text.empty())) draft.text = outcome->text;
      }
    }
  }
  // What is chosen first gets its template, as soon as its type is known.
  if (shown_ && info() != nullptr && !info()->type.empty() && draft().filled.state == Outcome::State::none) {
    fill_in();
    draft().refill = false;  // somebody may be writing already
  }
}

void TopicDesk::retry() {
  if (access_ != nullptr) access_->retry();
}

void TopicDesk::choose(const std::string& name) { chosen_ = name; }

const TopicInfo* TopicDesk::info() const {
  if (chosen_.empty() || view_->list == nullptr) return nullptr;
  const auto found = std::find_if(view_->list->begin(), view_->list->end(),
                                  [this](const TopicInfo& each) { return each.name == chosen_; });
  return found == view_->list->end() ? nullptr : &*found;
}

const WatchedMessage* TopicDesk::message() const {
  return view_->message != nullptr && view_->message->topic == chosen_ ? view_->message.get() : nullptr;
}

const PublishedTopic* TopicDesk::published() const {
  const auto found = std::find_if(view_->published.begin(), view_->published.end(),
                                  [this](const PublishedTopic& each) { return each.topic == chosen_; });
  return found == view_->published.end() ? nullptr : &*found;
}

void TopicDesk::ask(Outcome& outcome, std::uint64_t id) {
  outcome = {};
  outcome.state = Outcome::State::waiting;
  outcome.id = id;
  outcome.asked_ns = now_ns_;
}

void TopicDesk::fill_in() {
  if (!can_act()) return;
  ask(draft().filled, access_->ask_template(*info()));
  draft().refill = true;
}

void TopicDesk::publish_once() {
  if (can_act()) ask(draft().sent, access_->publish(chosen_, info()->type, draft().text, 0.0));
}

void TopicDesk::publish_at_rate() {
  if (can_act()) ask(draft().sent, access_->publish(chosen_, info()->type, draft().text, draft().rate_hz));
}

void TopicDesk::stop_publishing(const std::string& topic) {
  if (access_ != nullptr) ask(drafts_[topic].sent, access_->stop_publishing(topic));
}

void TopicDesk::call() {
  if (can_act()) ask(draft().sent, access_->call(chosen_, info()->type, draft().text));
}

std::string in_words(const WatchedMessage& message, double silent_s) {
  char text[80];
  const bool silent = silent_s > kSilent_s;
  std::string line;
  if (!silent && message.rate_hz > 0.0) {
    std::snprintf(text, sizeof text, message.rate_hz < 10.0 ? "%.1f a second, " : "%.0f a second, ", message.rate_hz);
    line = text;
  }
  std::snprintf(text, sizeof text, "%llu so far; the newest: ", static_cast<unsigned long long>(message.count));
  line += text;
  if (silent) {
    std::snprintf(text, sizeof text, "%.0f s ago, ", silent_s);
    line += text;
  }
  return line + readable_size(message.bytes);
}

}  // namespace ambf::render
