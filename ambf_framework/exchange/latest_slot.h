// The newest value from one writer to one reader (a triple buffer): neither ever waits, a value is never torn, newer
// ones replace those that were not read. Carries what a watchdog needs: sequence, time of the last sign of life, and
// whether the writer has let go. The writer may allocate inside its T while it fills it; the reader only gets to see a
// const T and never allocates or frees. Threads: post, begin_write, commit, keep_alive, release: one writer at a time.
// refresh and all that follows: the one reader. C++17.
#pragma once

#include <atomic>
#include <cstdint>

namespace ambf::exchange {

template <class T>
class LatestSlot {
 public:
  LatestSlot() = default;
  explicit LatestSlot(const T& initial) : cells_{{initial, 0, 0}, {initial, 0, 0}, {initial, 0, 0}} {}
  LatestSlot(const LatestSlot&) = delete;
  LatestSlot& operator=(const LatestSlot&) = delete;

  // ---- writer ----
  void post(const T& value, std::int64_t now_ns) {
    begin_write() = value;
    commit(now_ns);
  }

  // The value to fill; it holds one of those posted before: overwrite all of it, then commit.
  T& begin_write() { return cells_[back_].value; }
  void commit(std::int64_t now_ns) {
    cells_[back_].sequence = ++written_;
    cells_[back_].time_ns = now_ns;
    back_ = middle_.exchange(static_cast<std::uint32_t>(back_ | kFresh), std::memory_order_acq_rel) & ~kFresh;
  }

  // Renews the time of what was posted last.
  void keep_alive(std::int64_t now_ns) { alive_ns_.store(now_ns, std::memory_order_release); }

  // Marks everything posted until now as ended; a later post is in force again.
  void release() {
    released_.store(written_, std::memory_order_release);
    releases_.fetch_add(1, std::memory_order_release);
  }

  // ---- reader ----
  // Takes over the newest value; returns whether it is another one than before.
  bool refresh() {
    if ((middle_.load(std::memory_order_acquire) & kFresh) == 0) return false;
    front_ = middle_.exchange(front_, std::memory_order_acq_rel) & ~kFresh;
    return true;
  }
  const T& value() const { return cells_[front_].value; }             // as of the last refresh
  std::uint64_t sequence() const { return cells_[front_].sequence; }  // + 1 a post; 0: nothing was posted yet
  bool released() const {                                             // the writer has let go of value()
    return released_.load(std::memory_order_acquire) >= cells_[front_].sequence;
  }
  std::uint64_t releases() const { return releases_.load(std::memory_order_acquire); }  // calls of release() so far
  // Last sign of life: when value() arrived or was kept alive, whichever is later.
  std::int64_t time_ns() const {
    const std::int64_t alive = alive_ns_.load(std::memory_order_acquire);
    return alive > cells_[front_].time_ns ? alive : cells_[front_].time_ns;
  }

 private:
  static constexpr std::uint32_t kFresh = 4;  // set by the writer, cleared by the reader
  struct Cell {
    T value{};
    std::uint64_t sequence = 0;
    std::int64_t time_ns = 0;
  };

  Cell cells_[3];
  std::uint32_t back_ = 0;                // the writer's
  std::uint64_t written_ = 0;             // the writer's
  std::atomic<std::uint32_t> middle_{1};  // handed over
  std::uint32_t front_ = 2;               // the reader's
  std::atomic<std::int64_t> alive_ns_{0};
  std::atomic<std::uint64_t> released_{0};
  std::atomic<std::uint64_t> releases_{0};
};

}  // namespace ambf::exchange
