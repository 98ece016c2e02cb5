// How much slower than a release build this one may be: the factor for limits of time in tests.
#pragma once

namespace ambf {

#if defined(__has_feature)
#define AMBF_UNDER_SANITIZER (__has_feature(address_sanitizer) || __has_feature(thread_sanitizer))  // clang
#elif defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define AMBF_UNDER_SANITIZER 1  // gcc
#else
#define AMBF_UNDER_SANITIZER 0
#endif

#if AMBF_UNDER_SANITIZER
inline constexpr int kTestSlowness = 20;
#else
inline constexpr int kTestSlowness = 1;
#endif

}  // namespace ambf
