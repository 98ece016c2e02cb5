#include "limits.h"

#include <sched.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <new>

#include "base/worker.h"

namespace ambf::file_reader {

namespace {

// At the soft one a signal comes that names the resource. Whoever started the simulator may have set less.
void limit(decltype(RLIMIT_CORE) resource, rlim_t soft, rlim_t hard) {
  rlimit now{};
  if (::getrlimit(resource, &now) != 0) std::_Exit(1);
  const rlimit lower{std::min(soft, now.rlim_max), std::min(hard, now.rlim_max)};
  if (::setrlimit(resource, &lower) != 0) std::_Exit(1);
}
void limit(decltype(RLIMIT_CORE) resource, rlim_t value) { limit(resource, value, value); }

// Sanitizers reserve terabytes of address space that they do not use, and probe memory through a pipe.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kInstrumented = true;
#elif defined(__has_feature)
constexpr bool kInstrumented = __has_feature(address_sanitizer) || __has_feature(thread_sanitizer);
#else
constexpr bool kInstrumented = false;
#endif

}  // namespace

void limit_this_process(pid_t parent) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) std::_Exit(1);  // it died before the line above
  ::close_range(STDERR_FILENO + 1, ~0U, 0);
  const sched_param ordinary{};
  ::sched_setscheduler(0, SCHED_OTHER, &ordinary);
  std::set_new_handler([] { std::_Exit(base::kWorkerOutOfMemory); });
  if (!kInstrumented) limit(RLIMIT_AS, rlim_t{1} << 30);
  limit(RLIMIT_CPU, 20, 21);
  limit(RLIMIT_FSIZE, 0);
  limit(RLIMIT_NOFILE, STDERR_FILENO + 1 + (kInstrumented ? 2 : 0));
  limit(RLIMIT_CORE, 0);
  ::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0);
}

}  // namespace ambf::file_reader
