// A set of small numbers that any thread adds to and one thread empties: "look at these command slots". A mark made
// after data was posted makes that data visible to the reader that drains the mark. Fixed capacity; after construction
// nothing allocates, waits or retries. Threads: mark: any. drain: one. C++17.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace ambf::exchange {

class DirtySet {
 public:
  explicit DirtySet(std::size_t capacity)
      : capacity_(capacity), words_((capacity + 63) / 64), summary_((words_.size() + 63) / 64) {}

  std::size_t capacity() const { return capacity_; }

  // Returns false (and does nothing) when i is beyond the capacity. Both words are always written, set already or not:
  // the write is what orders the caller's data before the drain.
  bool mark(std::size_t i) {
    if (i >= capacity_) return false;
    words_[i / 64].fetch_or(bit(i % 64), std::memory_order_acq_rel);
    summary_[i / 4096].fetch_or(bit(i / 64 % 64), std::memory_order_acq_rel);
    return true;
  }

  // Calls visit(i) for each number marked, in increasing order, and takes it out. What is marked meanwhile is visited
  // now or next time.
  template <class Visit>
  void drain(Visit&& visit) {
    for (std::size_t s = 0; s < summary_.size(); ++s) {
      if (summary_[s].load(std::memory_order_relaxed) == 0) continue;
      std::uint64_t words = summary_[s].exchange(0, std::memory_order_acq_rel);
      while (words != 0) {
        const std::size_t w = s * 64 + take_lowest(words);
        std::uint64_t bits = words_[w].exchange(0, std::memory_order_acq_rel);
        while (bits != 0) visit(w * 64 + take_lowest(bits));
      }
    }
  }

 private:
  static std::uint64_t bit(std::size_t i) { return std::uint64_t{1} << i; }
  static std::size_t take_lowest(std::uint64_t& bits) {
    const int i = __builtin_ctzll(bits);
    bits &= bits - 1;
    return static_cast<std::size_t>(i);
  }

  std::size_t capacity_;
  std::vector<std::atomic<std::uint64_t>> words_;
  std::vector<std::atomic<std::uint64_t>> summary_;  // bit w: words_[w] may hold something
};

}  // namespace ambf::exchange
