// Topics and services for the panel, by `ambf-cli serve` as a program beside this one: Python knows every message type. A thread of its own
// starts it, talks with it and starts it again when it dies, so that neither drawing nor physics waits for it. What dies again and again is
// started ever more seldom. All calls from one thread.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "base/log.h"
#include "render/window/topic_access.h"
#include "topic_protocol.h"
#include "watched_program.h"

namespace ambf::simulator {

struct TopicHelperOptions {
  std::string unavailable;          // why there are no topics; empty: there are
  std::vector<std::string> places;  // where ambf-cli may be: the first that can be run is taken
  double pause_s = 1.0;             // before it is started again; twice as long each time
  double patience_s = 2.0;          // how long it may take to end with this object
  double longest_pause_s = 60.0;    // of these pauses
  double well_s = 30.0;             // what runs so long is well: the pauses begin anew
};

class TopicHelper final : public render::TopicAccess {
 public:
  // Make it before the thread lowers its priority: programs inherit that from here.
  TopicHelper(TopicHelperOptions options, base::Log& log);
  ~TopicHelper() override;  // ends the program, within bounds

  std::string unavailable() const override { return options_.unavailable; }
  void look(bool on) override;
  void retry() override;
  std::shared_ptr<const render::TopicView> view() const override;
  void watch(const std::string& topic) override;
  std::uint64_t ask_template(const render::TopicInfo& of) override;
  std::uint64_t publish(const std::string& topic, const std::string& type, const std::string& text,
                        double rate_hz) override;
  std::uint64_t stop_publishing(const std::string& topic) override;
  std::uint64_t call(const std::string& service, const std::string& type, const std::string& text) override;
  std::vector<render::TopicAnswer> take_answers() override;

 private:
  std::uint64_t ask(std::uint64_t id, std::string request);

  // On the thread.
  void run();
  bool serve();  // until it ends; false: it never said a word, so that starting it again makes no sense
  void send(WatchedProgram& helper);
  void take(const std::string& line);
  void show(render::TopicView::Stage stage, const std::string& problem);
  void give_up_requests(const std::string& why);
  void mourn(const std::string& why);  // it died, and will be started again
  void recover();
  template <class Change>
  void change_view(Change change);

  const TopicHelperOptions options_;
  base::Log& log_;
  std::uint64_t next_id_ = 1;

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  bool over_ = false, looked_ = false, retry_ = false;
  bool look_changed_ = false, watch_changed_ = false;
  std::string watched_;
  struct Request {
    std::uint64_t id;
    std::string line;
  };
  std::vector<Request> requests_;
  std::vector<std::uint64_t> open_;  // asked, not answered
  std::vector<render::TopicAnswer> answers_;
  std::shared_ptr<const render::TopicView> view_;

  // On the thread.
  bool heard_ = false, senseless_ = false;  // of the program that runs
  int deaths_ = 0;                          // since it last was well
  double pause_s_ = 0.0;                    // before it is started again
  std::string why_;                         // it died

  std::thread thread_;  // last: it uses the rest
};

}  // namespace ambf::simulator
