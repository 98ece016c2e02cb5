#include "uncaught.h"

#include <sys/resource.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <new>
#include <system_error>

namespace ambf::simulator {

namespace {

constexpr int kExitFailed = 1;

// A thread that does not start lacks room for its stack as often as a thread. No allocation from here on.
[[noreturn]] void end_without_resources() {
  const auto limit_of = [](__rlimit_resource resource) -> long long {
    rlimit limit{};
    return getrlimit(resource, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY ? static_cast<long long>(limit.rlim_cur)
                                                                               : -1;
  };
  std::fprintf(stderr,
               "ambf_simulator: the system gives no more memory or threads; allowed are %lld bytes of address space "
               "(ulimit -v) and %lld threads (ulimit -u), -1 meaning any number\n",
               limit_of(RLIMIT_AS), limit_of(RLIMIT_NPROC));
  _exit(kExitFailed);
}

[[noreturn]] void on_uncaught() {
  try {
    if (const std::exception_ptr error = std::current_exception()) std::rethrow_exception(error);
  } catch (const std::bad_alloc&) {
    end_without_resources();
  } catch (const std::system_error& error) {
    if (error.code() == std::errc::resource_unavailable_try_again) end_without_resources();
    std::fprintf(stderr, "ambf_simulator: uncaught exception: %s\n", error.what());
  } catch (const std::exception& error) {
    std::fprintf(stderr, "ambf_simulator: uncaught exception: %s\n", error.what());
  } catch (...) {
    std::fprintf(stderr, "ambf_simulator: uncaught exception\n");
  }
  std::abort();
}

}  // namespace

void report_uncaught_exceptions() { std::set_terminate(on_uncaught); }

}  // namespace ambf::simulator
