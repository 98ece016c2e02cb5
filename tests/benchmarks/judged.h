// What benchmarks that judge by bars share: a mark beside what misses its bar, and the time of a processor.
#pragma once

#include <ctime>

namespace ambf::benchmarks {

inline bool all_good = true;
inline const char* judged(bool good) {
  all_good &= good;
  return good ? "" : " (!)";
}

inline double thread_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

}  // namespace ambf::benchmarks
