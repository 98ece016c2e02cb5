// A queue of fixed capacity for several producers and several consumers: requests to the physics thread, completions
// and garbage out of it. Nobody ever waits: try_push refuses when full, try_pop when empty. A producer that the
// scheduler stops between taking its place and filling it hides what was pushed after it until it runs again (try_pop
// then says "empty"); nobody is blocked by that. What is accepted is delivered once, and in order for each producer.
// Nothing is allocated after construction (T's own moves aside). Any thread, any function; C++17. (Each cell carries
// the turn in which it may be filled or emptied, after D. Vyukov's bounded queue.)
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace ambf::exchange {

template <class T>
class BoundedQueue {
 public:
  // The capacity is rounded up to a power of two, at least 2.
  explicit BoundedQueue(std::size_t capacity) : cells_(round_up(capacity)), mask_(cells_.size() - 1) {
    for (std::size_t i = 0; i < cells_.size(); ++i) cells_[i].turn.store(i, std::memory_order_relaxed);
  }
  BoundedQueue(const BoundedQueue&) = delete;
  BoundedQueue& operator=(const BoundedQueue&) = delete;

  std::size_t capacity() const { return cells_.size(); }

  // False when full; `value` is then untouched and remains the caller's.
  bool try_push(T&& value) {
    std::size_t tail = tail_.load(std::memory_order_relaxed);
    for (;;) {
      Cell& cell = cells_[tail & mask_];
      const auto lead = static_cast<std::ptrdiff_t>(cell.turn.load(std::memory_order_acquire) - tail);
      if (lead < 0) return false;
      if (lead > 0) {
        tail = tail_.load(std::memory_order_relaxed);
      } else if (tail_.compare_exchange_weak(tail, tail + 1, std::memory_order_relaxed)) {
        cell.value = std::move(value);
        cell.turn.store(tail + 1, std::memory_order_release);
        return true;
      }
    }
  }
  bool try_push(const T& value) {
    T copy(value);
    return try_push(std::move(copy));
  }

  // False when empty; `value` is then untouched.
  bool try_pop(T& value) {
    std::size_t head = head_.load(std::memory_order_relaxed);
    for (;;) {
      Cell& cell = cells_[head & mask_];
      const auto lead = static_cast<std::ptrdiff_t>(cell.turn.load(std::memory_order_acquire) - (head + 1));
      if (lead < 0) return false;
      if (lead > 0) {
        head = head_.load(std::memory_order_relaxed);
      } else if (head_.compare_exchange_weak(head, head + 1, std::memory_order_relaxed)) {
        value = std::move(cell.value);
        cell.turn.store(head + mask_ + 1, std::memory_order_release);
        return true;
      }
    }
  }

  // Whether try_pop would find something: the check before sleeping on a signal that producers notify after their push.
  // A place that a stopped producer has taken but not filled does not count: waiting for that one would be spinning.
  bool ready() const {
    const std::size_t head = head_.load(std::memory_order_relaxed);
    return cells_[head & mask_].turn.load(std::memory_order_acquire) == head + 1;
  }

 private:
  struct Cell {
    std::atomic<std::size_t> turn{0};
    T value{};
  };
  static std::size_t round_up(std::size_t n) {
    std::size_t power = 2;
    while (power < n) power *= 2;
    return power;
  }

  std::vector<Cell> cells_;
  const std::size_t mask_;
  alignas(64) std::atomic<std::size_t> tail_{0};
  alignas(64) std::atomic<std::size_t> head_{0};
};

}  // namespace ambf::exchange
