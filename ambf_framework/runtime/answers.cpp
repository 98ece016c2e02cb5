#include "runtime/answers.h"

#include <chrono>

namespace ambf::runtime {

Answers::Answers() : thread_([this] { run(); }) {}

Answers::~Answers() {
  stop_ = true;
  signal_.notify_all();
  thread_.join();
}

bool Answers::reserve() {
  if (in_flight_.fetch_add(1) < kMaxRequests) return true;
  in_flight_.fetch_sub(1);
  return false;
}

void Answers::push(RequestPtr request, bool ran) {
  queue_.try_push(Item{std::move(request), ran});
  signal_.notify_all();
}

void Answers::run() {
  while (true) {
    const auto count = signal_.count();
    Item item;
    while (queue_.try_pop(item)) {
      item.request->answer(item.ran);
      item.request.reset();
      in_flight_.fetch_sub(1);
    }
    if (stop_) return;
    signal_.wait_beyond(count, std::chrono::seconds(1));
  }
}

}  // namespace ambf::runtime
