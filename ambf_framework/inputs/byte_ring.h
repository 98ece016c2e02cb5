// Messages from one real-time thread to one that writes files: a ring of bytes of fixed size. Neither side waits or
// allocates; a message that finds no room is refused as a whole.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

namespace ambf::inputs {

class ByteRing {
 public:
  explicit ByteRing(std::size_t capacity) : bytes_(capacity) {}
  ByteRing(const ByteRing&) = delete;
  ByteRing& operator=(const ByteRing&) = delete;

  // The producer.
  bool try_push(const std::uint8_t* data, std::size_t size) {
    const std::uint64_t written = written_.load(std::memory_order_relaxed);
    if (size > bytes_.size() - (written - read_.load(std::memory_order_acquire))) return false;
    const std::size_t at = written % bytes_.size(), first = std::min(size, bytes_.size() - at);
    std::memcpy(bytes_.data() + at, data, first);
    std::memcpy(bytes_.data(), data + first, size - first);
    written_.store(written + size, std::memory_order_release);
    return true;
  }
  // The consumer: appends all that is there; whole messages, since each is published at once.
  void pop_all(std::vector<std::uint8_t>& to) {
    const std::uint64_t read = read_.load(std::memory_order_relaxed);
    const auto size = static_cast<std::size_t>(written_.load(std::memory_order_acquire) - read);
    const std::size_t at = read % bytes_.size(), first = std::min(size, bytes_.size() - at);
    to.insert(to.end(), bytes_.data() + at, bytes_.data() + at + first);
    to.insert(to.end(), bytes_.data(), bytes_.data() + (size - first));
    read_.store(read + size, std::memory_order_release);
  }

 private:
  std::vector<std::uint8_t> bytes_;
  alignas(64) std::atomic<std::uint64_t> written_{0};
  alignas(64) std::atomic<std::uint64_t> read_{0};
};

}  // namespace ambf::inputs
