#include "runtime/answers.h"

#include <chrono>

namespace ambf::runtime {

namespace {

constexpr unsigned kDisposeTogether = 64;  // far below the places for steps

}  // namespace

Answers::Answers() : thread_([this] { run(); }) {}

Answers::~Answers() {
  stop_ = true;
  signal_.notify_all();
  thread_.join();
}

bool Answers::reserve(std::size_t limit) {
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

void Answers::dispose(RequestPtr request) {
  queue_.try_push(Item{std::move(request), true});
  if (++disposed_ % kDisposeTogether == 0) signal_.notify_all();
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
    if (last) return;
    signal_.wait_beyond(count, std::chrono::seconds(1));
  }
}

}  // namespace ambf::runtime
