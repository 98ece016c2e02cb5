// Hands whole, immutable values ("frames") from one writer to several readers. The writer fills a slot that nobody
// reads and publishes it; a reader pins the newest slot and the one it saw before. The writer never waits, retries or
// fails (wait-free); a reader retries only while the writer publishes (lock-free). Never allocates or frees after
// construction, never blocks. Threads: begin_write, publish, exchange_write_slot, try_exchange_slot, newest: the one
// writer. make_reader: any thread. A Reader: one thread at a time; it must not outlive the pool. C++17.
//
// Why no slot is ever written while it is read: a reader announces its pin first and then checks that the slot is still
// the newest; the writer looks at the pins only after it has published something newer. All of these are sequentially
// consistent, so one of the two sees the other. With R readers at most 2R slots are pinned, one is the newest, so one
// of 2R + 2 is always free.
#pragma once

#include <atomic>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <utility>

#include "base/limits.h"

namespace ambf::exchange {

template <class T>
class FramePool {
 public:
  class Reader;

  // make() -> std::unique_ptr<T>, never null; called once a slot, here and now. At most `readers` at a time, up to
  // base::kMaxReaders: each takes two slots.
  template <class Make>
  explicit FramePool(Make&& make, int readers = base::kMaxReaders)
      : readers_(readers), slot_count_(static_cast<int>(base::frames_for(readers))) {
    assert(readers >= 0 && readers <= base::kMaxReaders);
    for (int slot = 0; slot < slot_count_; ++slot) {
      slots_[slot] = make();
      assert(slots_[slot] != nullptr);
    }
  }
  FramePool(const FramePool&) = delete;
  FramePool& operator=(const FramePool&) = delete;

  // The slot to fill: neither pinned nor newest. The same one until it is published. It holds an old value: overwrite
  // all of it.
  T& begin_write() { return *slots_[write_slot()]; }

  // Makes what begin_write gave the newest value.
  void publish() {
    newest_.store(write_slot(), std::memory_order_seq_cst);
    writing_ = kNoSlot;
  }

  int slots() const { return slot_count_; }

  // Puts another payload in the slot that begin_write gives (or would give) and returns the old one, for somebody else
  // to free.
  std::unique_ptr<T> exchange_write_slot(std::unique_ptr<T> payload) {
    assert(payload != nullptr);
    std::swap(slots_[write_slot()], payload);
    return payload;
  }

  // The same for any slot, 0 .. slots() - 1, when the structure of payloads changes: swaps and returns true unless the
  // slot is pinned or the newest; then the writer asks again after a later publish. Replace all slots: those that are
  // never needed keep old payloads otherwise.
  bool try_exchange_slot(int slot, std::unique_ptr<T>& payload) {
    assert(payload != nullptr && slot >= 0 && slot < slot_count_);
    if ((busy_slots() >> slot) & 1) return false;
    std::swap(slots_[slot], payload);
    return true;
  }

  // What was published last, for the writer itself; null before the first publish.
  const T* newest() const {
    const std::uint32_t slot = newest_.load(std::memory_order_relaxed);
    return slot == kNoSlot ? nullptr : slots_[slot].get();
  }

  // Registers a reader; empty when as many are registered as the pool is for.
  std::optional<Reader> make_reader() {
    for (int reader = 0; reader < readers_; ++reader) {
      Pins& pins = pins_[reader];
      bool expected = false;
      if (pins.claimed.compare_exchange_strong(expected, true, std::memory_order_acq_rel)) return Reader(this, &pins);
    }
    return std::nullopt;
  }

 private:
  static constexpr std::uint32_t kNoSlot = 0xffffffffu;
  static constexpr int kMaxSlots = static_cast<int>(base::kFramesPerPool);
  static_assert(kMaxSlots <= 64, "the writer keeps its slots in one 64 bit mask");

  struct alignas(64) Pins {  // a cache line each: readers do not disturb one another
    std::atomic<std::uint32_t> slot[2] = {{kNoSlot}, {kNoSlot}};
    std::atomic<bool> claimed{false};
  };

  // One bit a slot: newest or pinned.
  std::uint64_t busy_slots() const {
    std::uint64_t busy = 0;
    const std::uint32_t newest = newest_.load(std::memory_order_relaxed);
    if (newest != kNoSlot) busy |= std::uint64_t{1} << newest;
    for (const Pins& pins : pins_) {
      for (const auto& pin : pins.slot) {
        const std::uint32_t slot = pin.load(std::memory_order_seq_cst);
        if (slot != kNoSlot) busy |= std::uint64_t{1} << slot;
      }
    }
    return busy;
  }

  std::uint32_t write_slot() {
    if (writing_ == kNoSlot) {
      const std::uint64_t busy = busy_slots();
      writing_ = 0;
      while ((busy >> writing_) & 1) ++writing_;
      assert(writing_ < static_cast<std::uint32_t>(slot_count_));
    }
    return writing_;
  }

  const int readers_, slot_count_;
  std::unique_ptr<T> slots_[kMaxSlots];
  Pins pins_[base::kMaxReaders];
  alignas(64) std::atomic<std::uint32_t> newest_{kNoSlot};
  std::uint32_t writing_ = kNoSlot;  // the writer's own
};

// A registered reader; gives its pins back when destroyed.
template <class T>
class FramePool<T>::Reader {
 public:
  Reader(Reader&& other) noexcept
      : pool_(std::exchange(other.pool_, nullptr)),
        pins_(std::exchange(other.pins_, nullptr)),
        current_(std::exchange(other.current_, kNoSlot)),
        previous_(std::exchange(other.previous_, kNoSlot)),
        current_pin_(other.current_pin_) {}
  Reader& operator=(Reader&&) = delete;
  ~Reader() {
    if (pins_ == nullptr) return;
    for (auto& pin : pins_->slot) pin.store(kNoSlot, std::memory_order_release);
    pins_->claimed.store(false, std::memory_order_release);
  }

  // The newest value; null before the first one is published. When it is newer than what the call before returned, that
  // one becomes previous() and the older one is let go: a pointer returned here stays valid through one more newer
  // value.
  const T* latest() noexcept {
    const std::uint32_t newest = pool_->newest_.load(std::memory_order_seq_cst);
    if (newest == current_) return get(current_);  // nothing newer (or nothing at all)
    auto& pin = pins_->slot[1 - current_pin_];     // guards `previous_`, which is let go by being overwritten
    std::uint32_t candidate = newest;
    for (;;) {
      pin.store(candidate, std::memory_order_seq_cst);
      const std::uint32_t check = pool_->newest_.load(std::memory_order_seq_cst);
      if (check == candidate) break;
      candidate = check;
    }
    previous_ = current_;
    current_ = candidate;
    current_pin_ = 1 - current_pin_;
    return get(current_);
  }

  // The newest value before the one that latest() returned last; null when this reader has not seen two.
  const T* previous() const noexcept { return get(previous_); }

 private:
  friend class FramePool;
  Reader(FramePool* pool, Pins* pins) : pool_(pool), pins_(pins) {}
  const T* get(std::uint32_t slot) const noexcept { return slot == kNoSlot ? nullptr : pool_->slots_[slot].get(); }

  FramePool* pool_;
  Pins* pins_;
  std::uint32_t current_ = kNoSlot, previous_ = kNoSlot;
  int current_pin_ = 0;  // which pin guards current_
};

}  // namespace ambf::exchange
