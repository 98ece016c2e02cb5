// A ring of fixed, preallocated places for one producer and one consumer that must see *every* value (recorder, step service). Values are
// filled and read in place, so that a frame whose arrays have their size already is copied without an allocation. Neither side waits.
// Threads: begin_push, push: the producer. front, pop: the consumer. lost: any. C++17.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace ambf::exchange {

template <class T>
class SpscRing {
 public:
  explicit SpscRing(std::size_t capacity) : cells_(capacity < 1 ? 1 : capacity) {}
  SpscRing(std::size_t capacity, const T& initial) : cells_(capacity < 1 ? 1 : capacity, initial) {}
  SpscRing(const SpscRing&) = delete;
  SpscRing& operator=(const SpscRing&) = delete;

  std::size_t capacity() const { return cells_.size(); }

  // The place to fill before push(); null when the ring is full, which is counted.
  T* begin_push() {
    const std::uint64_t tail = tail_.load(std::memory_order_relaxed);
    if (tail - head_.load(std::memory_order_acquire) == cells_.size()) {
      lost_.fetch_add(1, std::memory_order_relaxed);
      return nullptr;
    }
    return &cells_[tail % cells_.size()];
  }
  void push() { tail_.store(tail_.load(std::memory_order_relaxed) + 1, std::memory_order_release); }

  // The oldest value, valid until pop(); null when empty.
  T* front() {
    const std::uint64_t head = head_.load(std::memory_order_relaxed);
    return head == tail_.load(std::memory_order_acquire) ? nullptr : &cells_[head % cells_.size()];
  }
  void pop() { head_.store(head_.load(std::memory_order_relaxed) + 1, std::memory_order_release); }

  // How often a value did not fit.
  std::uint64_t lost() const { return lost_.load(std::memory_order_relaxed); }

 private:
  std::vector<T> cells_;
  alignas(64) std::atomic<std::uint64_t> tail_{0};
  alignas(64) std::atomic<std::uint64_t> head_{0};
  std::atomic<std::uint64_t> lost_{0};
};

}  // namespace ambf::exchange
