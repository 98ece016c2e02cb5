#include "runtime/detail/answers.h"

#include <chrono>

namespace ambf::runtime {

Answers::Answers() : thread_([this] { run(); }) {}

Answers::~Answers() {
  stop_ = true;
  signal_.notify_all();
  thread_.join();
}

bool Answers::reserve(std::size_t limit) {
  // More than one comes: what gathered meanwhile becomes less.
  for (int i = 0; i < 2 && destroy_one(); ++i) {
  }
  std::size_t in_flight = in_flight_.load();
  while (in_flight < limit) {
    if (in_flight_.compare_exchange_weak(in_flight, in_flight + 1)) return true;
  }
  return false;
}

void Answers::push(RequestPtr request, bool ran) {
  queue_.try_push(Item{std::move(request), ran});
  signal_.notify_all();
}

void Answers::dispose(RequestPtr request) { disposed_.try_push(std::move(request)); }

bool Answers::destroy_one() {
  RequestPtr request;
  if (!disposed_.try_pop(request)) return false;
  request.reset();
  in_flight_.fetch_sub(1);
  return true;
}

void Answers::run() {
  while (true) {
    const auto count = signal_.count();
    const bool last = stop_;  // looked at first: what was pushed before the end is answered below
    Item item;
    while (queue_.try_pop(item)) {
      item.request->answer(item.ran);
      item.request.reset();
      in_flight_.fetch_sub(1);
    }
    while (destroy_one()) {
    }
    if (last) return;
    signal_.wait_beyond(count, std::chrono::seconds(1));
  }
}

}  // namespace ambf::runtime
