// What a thread asks of the operating system to be on time, and what it got. Everything here is a wish: without the
// permission it returns false and changes nothing else. Never used to raise the whole process; threads started by a
// raised thread are not raised. Any thread, about itself; C++17.
#pragma once

#include <cstdint>
#include <string>

namespace ambf::base {

// Shown by debuggers and top; at most 15 characters count.
void set_thread_name(const char* name);

// Wake from sleeps within microseconds instead of 50 us late (timer slack 1 ns).
bool request_precise_timers();

// SCHED_FIFO of priority 1..99. Reset on fork: threads and programs that this thread starts are ordinary ones.
bool request_fifo(int priority);
bool leave_fifo();

// For graphics and other work that must not disturb: nice +10 or so, for this thread only.
bool lower_priority(int nice);

// Brings all threads of the process back up to this thread's nice value, where the system lets it (root, or
// RLIMIT_NICE): what is awaited at the end of the program shall not starve beside other programs.
void end_lower_priorities();

// Keeps the pages that the process has touched in memory, all threads', and those touched later where no limit is set
// on them. Pages are locked when touched (MCL_ONFAULT), so thread stacks do not count in full.
bool lock_memory();

// Gives pages of the heap that nothing uses back to the system, those that are locked, too. Takes some milliseconds, in
// which other threads that allocate may wait: for a thread of no hurry, after work that has left much behind.
void give_back_memory();

// What one real-time thread obtained, for the log: "SCHED_FIFO 60, timer slack 1 ns".
struct RealTimeGrant {
  bool fifo = false;
  int priority = 0;
  bool precise_timers = false;
};
RealTimeGrant enter_real_time(const char* thread_name, int fifo_priority);  // priority 0: no SCHED_FIFO wanted
std::string to_string(const RealTimeGrant& grant);

// Sleeps until the steady clock shows `deadline_ns`; never returns early; returns how late it is. With spin_ns (at most
// 50 us count) the last bit is waited for awake. Never pass spin_ns under SCHED_FIFO: it would keep everyone else off
// the core.
std::int64_t sleep_until(std::int64_t deadline_ns, std::int64_t spin_ns = 0);
inline constexpr std::int64_t kMaxSpinNs = 50000;

}  // namespace ambf::base
