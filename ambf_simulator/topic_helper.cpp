#include "topic_helper.h"

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include "ambf_cli.h"
#include "base/clock.h"
#include "base/realtime.h"
#include "base/spawn.h"

namespace ambf::simulator {

namespace {

using Stage = render::TopicView::Stage;

constexpr int kLook_ms = 20;

std::shared_ptr<render::TopicView> empty_view() {
  auto view = std::make_shared<render::TopicView>();
  view->list = std::make_shared<const TopicList>();
  return view;
}

std::string end_in_words(int code, const std::vector<std::string>& lines) {
  std::string text = "ambf-cli " + (code > 128 ? "was ended by signal " + std::to_string(code - 128)
                                               : "ended with " + std::to_string(code));
  if (!lines.empty()) text += ": " + lines.back();
  return text;
}

}  // namespace

TopicHelper::TopicHelper(TopicHelperOptions options, base::Log& log)
    : options_(std::move(options)), log_(log), view_(empty_view()) {
  if (options_.unavailable.empty()) thread_ = std::thread([this] { run(); });
}

TopicHelper::~TopicHelper() {
  {
    const std::lock_guard lock(mutex_);
    over_ = true;
  }
  changed_.notify_one();
  if (thread_.joinable()) thread_.join();
}

void TopicHelper::look(bool on) {
  const std::lock_guard lock(mutex_);
  if (on == looked_) return;
  looked_ = on;
  look_changed_ = true;
  changed_.notify_one();
}

void TopicHelper::retry() {
  const std::lock_guard lock(mutex_);
  retry_ = true;
  changed_.notify_one();
}

std::shared_ptr<const render::TopicView> TopicHelper::view() const {
  const std::lock_guard lock(mutex_);
  return view_;
}

void TopicHelper::watch(const std::string& topic) {
  const std::lock_guard lock(mutex_);
  if (topic == watched_) return;
  watched_ = topic;
  watch_changed_ = true;
  auto view = std::make_shared<render::TopicView>(*view_);
  view->message = nullptr;
  view_ = std::move(view);
}

std::uint64_t TopicHelper::ask(std::uint64_t id, std::string request) {
  const std::lock_guard lock(mutex_);
  if (!options_.unavailable.empty()) {
    answers_.push_back({id, false, options_.unavailable, {}});
  } else if (view_->stage == Stage::failed) {
    answers_.push_back({id, false, view_->problem, {}});
  } else {
    requests_.push_back({id, std::move(request)});
    open_.push_back(id);
    changed_.notify_one();
  }
  return id;
}

std::uint64_t TopicHelper::ask_template(const render::TopicInfo& of) {
  const std::uint64_t id = next_id_++;
  return ask(id, template_request(id, of));
}

std::uint64_t TopicHelper::publish(const std::string& topic, const std::string& type, const std::string& text,
                                   double rate_hz) {
  const std::uint64_t id = next_id_++;
  return ask(id, publish_request(id, topic, type, text, rate_hz));
}

std::uint64_t TopicHelper::stop_publishing(const std::string& topic) {
  const std::uint64_t id = next_id_++;
  return ask(id, stop_request(id, topic));
}

std::uint64_t TopicHelper::call(const std::string& service, const std::string& type, const std::string& text) {
  const std::uint64_t id = next_id_++;
  return ask(id, call_request(id, service, type, text));
}

std::vector<render::TopicAnswer> TopicHelper::take_answers() {
  const std::lock_guard lock(mutex_);
  return std::exchange(answers_, {});
}

template <class Change>
void TopicHelper::change_view(Change change) {
  const std::lock_guard lock(mutex_);
  auto view = std::make_shared<render::TopicView>(*view_);
  change(*view);
  view_ = std::move(view);
}

void TopicHelper::show(Stage stage, const std::string& problem) {
  change_view([&](render::TopicView& view) {
    view.stage = stage;
    view.problem = problem;
  });
}

void TopicHelper::give_up_requests(const std::string& why) {
  const std::lock_guard lock(mutex_);
  for (const std::uint64_t id : open_) answers_.push_back({id, false, why, {}});
  open_.clear();
  requests_.clear();
}

void TopicHelper::run() {
  base::set_thread_name("topics");
  std::unique_lock lock(mutex_);
  for (;;) {
    changed_.wait(lock, [this] { return over_ || looked_ || !requests_.empty(); });
    if (over_) return;
    retry_ = false;
    lock.unlock();
    const bool again = serve();
    lock.lock();
    if (again) {
      changed_.wait_for(lock, std::chrono::duration<double>(pause_s_), [this] { return over_ || retry_; });
    } else {
      changed_.wait(lock, [this] { return over_ || retry_; });
    }
  }
}

bool TopicHelper::serve() {
  const auto fail = [&](const std::string& why) {
    log_.error("topics in the panel: %s", why.c_str());
    why_ = why;
    show(Stage::failed, why);
    give_up_requests(why);
    return false;
  };
  const std::string program = base::first_program(options_.places);
  if (program.empty()) return fail(ambf_cli_is_missing(options_.places));
  // What was wrong stays to be read until it is mended.
  show(Stage::starting, why_);
  std::string problem;
  WatchedProgram helper;
  if (!helper.start({program, "serve", "--simulator", std::to_string(getpid())}, problem, WatchedProgram::Talk::yes)) {
    return fail(problem);
  }
  heard_ = senseless_ = false;
  {
    const std::lock_guard lock(mutex_);
    look_changed_ = watch_changed_ = true;
  }
  const std::int64_t began_ns = base::steady_ns();
  std::int64_t over_ns = 0;
  for (;;) {
    const std::optional<int> code = helper.watch(kLook_ms);
    for (const std::string& line : helper.take_words()) take(line);
    if (code) {
      const std::string why = end_in_words(*code, helper.lines());
      if (over_ns != 0) return true;
      if (!heard_) return fail(why);
      mourn(why);
      return true;
    }
    if (deaths_ > 0 && base::to_seconds(base::steady_ns() - began_ns) > options_.well_s) recover();
    send(helper);
    {
      const std::lock_guard lock(mutex_);
      if (over_ && over_ns == 0) {
        over_ns = base::steady_ns();
        helper.hang_up();
      }
    }
    if (over_ns != 0 && base::to_seconds(base::steady_ns() - over_ns) > options_.patience_s) return true;  // kills it
  }
}

void TopicHelper::mourn(const std::string& why) {
  ++deaths_;
  pause_s_ = deaths_ == 1 ? options_.pause_s : std::min(2.0 * pause_s_, options_.longest_pause_s);
  why_ = why;
  if (deaths_ == 1) {
    log_.warning("topics in the panel: %s; it is started again", why.c_str());
  } else if (deaths_ == 2) {
    log_.warning("topics in the panel: %s, again; from now on it is started ever more seldom, at last every %g s",
                 why.c_str(), options_.longest_pause_s);
  }
  change_view([&](render::TopicView& view) {
    // The first time it is back before anybody could do something about it.
    view.stage = deaths_ == 1 ? Stage::starting : Stage::failed;
    view.problem = why + (view.published.empty() ? "" : "; nothing is published at a rate any more");
    if (deaths_ > 1) {
      const auto seconds = std::max(1L, std::lround(pause_s_));
      view.problem += ". It ended " + std::to_string(deaths_) + " times, and is started again after " +
                      std::to_string(seconds) + " s";
    }
    view.published.clear();
  });
  give_up_requests(why);
}

void TopicHelper::recover() {
  if (deaths_ > 1) log_.info("topics in the panel: ambf-cli runs again, having ended %d times", deaths_);
  deaths_ = 0;
}

void TopicHelper::send(WatchedProgram& helper) {
  std::vector<std::string> lines;
  {
    const std::lock_guard lock(mutex_);
    if (std::exchange(look_changed_, false)) lines.push_back(look_request(looked_));
    if (std::exchange(watch_changed_, false)) lines.push_back(watch_request(watched_));
    for (Request& request : requests_) lines.push_back(std::move(request.line));
    requests_.clear();
  }
  for (const std::string& line : lines) helper.say(line);
}

void TopicHelper::take(const std::string& line) {
  std::optional<TopicEvent> event = read_event(line);
  if (!event) {
    if (!std::exchange(senseless_, true)) {
      log_.warning("topics in the panel: ambf-cli says what makes no sense: %s", line.substr(0, 200).c_str());
    }
    return;
  }
  heard_ = true;
  if (const auto* master = std::get_if<MasterEvent>(&*event)) {
    show(Stage::running, master->alive ? "" : "no ROS master answers at " + master->uri);
  } else if (auto* list = std::get_if<TopicList>(&*event)) {
    const auto kept = std::make_shared<const TopicList>(std::move(*list));
    change_view([&](render::TopicView& view) { view.list = kept; });
  } else if (auto* message = std::get_if<render::WatchedMessage>(&*event)) {
    const auto kept = std::make_shared<const render::WatchedMessage>(std::move(*message));
    const std::lock_guard lock(mutex_);
    if (kept->topic != watched_) return;  // it was on its way
    auto view = std::make_shared<render::TopicView>(*view_);
    view->message = kept;
    view_ = std::move(view);
  } else if (auto* published = std::get_if<PublishedEvent>(&*event)) {
    change_view([&](render::TopicView& view) { view.published = std::move(published->topics); });
  } else if (auto* answer = std::get_if<render::TopicAnswer>(&*event)) {
    const std::lock_guard lock(mutex_);
    if (std::erase(open_, answer->id) == 1) answers_.push_back(std::move(*answer));
  }
}

}  // namespace ambf::simulator
