#include "tests/devices/interposer.h"

#include <dlfcn.h>
#include <linux/futex.h>
#include <pthread.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <time.h>

#include <atomic>
#include <cstdarg>
#include <cstddef>
#include <cstring>

// The C library's allocator by the names that it keeps for those who stand before it.
// NOLINTBEGIN(readability-identifier-naming)
extern "C" void* __libc_malloc(std::size_t size);
extern "C" void* __libc_calloc(std::size_t count, std::size_t size);
extern "C" void* __libc_realloc(void* memory, std::size_t size);
extern "C" void __libc_free(void* memory);
// NOLINTEND(readability-identifier-naming)

namespace ambf::devices::testing {
namespace {

enum class Kind { unknown, device_loop, other };

thread_local Calls own;
thread_local Kind kind = Kind::unknown;
std::atomic<long> loop_memory{0}, loop_locks{0}, loop_waits{0}, loops{0};

void count(long Calls::*what, std::atomic<long>& in_loops) {
  ++(own.*what);
  if (kind == Kind::device_loop) ++in_loops;
}
void count_memory() { count(&Calls::memory, loop_memory); }

void begin_to_sleep() {
  if (kind != Kind::unknown) return;
  char name[16] = {};
  prctl(PR_GET_NAME, name);
  const bool device = std::strncmp(name, "device ", 7) == 0 && name[7] >= '0' && name[7] <= '9';
  kind = device ? Kind::device_loop : Kind::other;
  if (device) ++loops;
}

// Finds the C library's own function. Not in a static of a function, whose guard might lock.
template <class Function>
Function real(std::atomic<Function>& known, const char* name) {
  if (known == nullptr) known = reinterpret_cast<Function>(dlsym(RTLD_NEXT, name));
  return known;
}
std::atomic<int (*)(pthread_mutex_t*)> real_lock{nullptr};
std::atomic<long (*)(long, ...)> real_syscall{nullptr};
std::atomic<int (*)(clockid_t, int, const timespec*, timespec*)> real_sleep{nullptr};

}  // namespace

const Calls& calls_of_this_thread() { return own; }
Calls calls_in_device_loops() { return {loop_memory, loop_locks, loop_waits, loops}; }

}  // namespace ambf::devices::testing

using namespace ambf::devices::testing;

extern "C" void* malloc(std::size_t size) noexcept {
  count_memory();
  return __libc_malloc(size);
}
extern "C" void* calloc(std::size_t count, std::size_t size) noexcept {
  count_memory();
  return __libc_calloc(count, size);
}
extern "C" void* realloc(void* memory, std::size_t size) noexcept {
  count_memory();
  return __libc_realloc(memory, size);
}
extern "C" void free(void* memory) noexcept {
  if (memory != nullptr) count_memory();
  __libc_free(memory);
}
extern "C" int pthread_mutex_lock(pthread_mutex_t* mutex) noexcept {
  count(&Calls::locks, loop_locks);
  return real(real_lock, "pthread_mutex_lock")(mutex);
}
extern "C" long syscall(long number, ...) noexcept {
  long a[6];
  va_list arguments;
  va_start(arguments, number);
  for (long& each : a) each = va_arg(arguments, long);
  va_end(arguments);
  const long operation = a[1] & FUTEX_CMD_MASK;
  if (number == SYS_futex && (operation == FUTEX_WAIT || operation == FUTEX_WAIT_BITSET)) {
    count(&Calls::waits, loop_waits);
  }
  return real(real_syscall, "syscall")(number, a[0], a[1], a[2], a[3], a[4], a[5]);
}
extern "C" int clock_nanosleep(clockid_t clock, int flags, const timespec* time, timespec* left) {
  begin_to_sleep();
  return real(real_sleep, "clock_nanosleep")(clock, flags, time, left);
}
