// The newest value of one writer for any number of readers, none of which registers: a ring of sequence-locked cells.
// The writer never waits; a reader copies the newest whole value and begins again only when the writer published
// kCells - 1 values meanwhile. A writer that is stopped in the middle holds up nobody: readers get the value before.
// Nothing allocates. All memory is atomic words, so that ThreadSanitizer sees no race. C++17.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>

namespace ambf::exchange {

template <class T>
class Broadcast {
  static_assert(std::is_trivially_copyable_v<T>, "values are copied word by word");

 public:
  Broadcast() = default;
  Broadcast(const Broadcast&) = delete;
  Broadcast& operator=(const Broadcast&) = delete;

  // The one writer.
  void publish(const T& value) {
    std::array<std::uint64_t, kWords> words{};
    std::memcpy(words.data(), &value, sizeof(T));
    const std::uint64_t number = newest_.load(std::memory_order_relaxed) + 1;
    Cell& cell = cells_[number % kCells];
    cell.number.store(kBeingWritten, std::memory_order_relaxed);
    // Each word is released after the mark and acquired before the number is compared: no fence is needed.
    for (std::size_t i = 0; i < kWords; ++i) cell.words[i].store(words[i], std::memory_order_release);
    cell.number.store(number, std::memory_order_release);
    newest_.store(number, std::memory_order_release);
  }

  // Any thread. False while nothing was published; `value` is then left alone.
  bool read(T& value) const {
    std::array<std::uint64_t, kWords> words;
    for (;;) {
      const std::uint64_t number = newest_.load(std::memory_order_acquire);
      if (number == 0) return false;
      const Cell& cell = cells_[number % kCells];
      if (cell.number.load(std::memory_order_acquire) != number) continue;
      for (std::size_t i = 0; i < kWords; ++i) words[i] = cell.words[i].load(std::memory_order_acquire);
      if (cell.number.load(std::memory_order_relaxed) == number) break;
    }
    std::memcpy(static_cast<void*>(&value), words.data(), sizeof(T));
    return true;
  }

  // + 1 a publication; 0: none yet.
  std::uint64_t number() const { return newest_.load(std::memory_order_acquire); }

 private:
  static constexpr std::size_t kCells = 4;
  static constexpr std::size_t kWords = (sizeof(T) + sizeof(std::uint64_t) - 1) / sizeof(std::uint64_t);
  static constexpr std::uint64_t kBeingWritten = ~std::uint64_t{0};
  struct Cell {
    std::atomic<std::uint64_t> number{0};
    std::array<std::atomic<std::uint64_t>, kWords> words{};
  };

  std::array<Cell, kCells> cells_{};
  std::atomic<std::uint64_t> newest_{0};
};

}  // namespace ambf::exchange
