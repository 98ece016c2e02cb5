// Sleep on a 32 bit word until another thread of this process changes it. The kernel is entered only to sleep or to
// wake sleepers; no lock is held by either side, so a waker never waits for a sleeper. Any thread; C++17.
#pragma once

#include <atomic>
#include <cstdint>

namespace ambf::base {

inline constexpr std::int64_t kNoDeadline = -1;

// Sleeps while `word` == `expected`, until woken or until the steady clock passes `deadline_ns` (kNoDeadline: for
// ever). May return early: check the word again. Returns false when the deadline has passed.
bool futex_wait(const std::atomic<std::uint32_t>& word, std::uint32_t expected, std::int64_t deadline_ns);

// Wakes everyone who sleeps on `word`.
void futex_wake_all(const std::atomic<std::uint32_t>& word);

}  // namespace ambf::base
