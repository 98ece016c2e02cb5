// How much slower than a release build this one may be: what tests scale bars of time and patience by.
#pragma once

namespace ambf {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr int kTestSlowness = 20;
#else
inline constexpr int kTestSlowness = 1;
#endif

}  // namespace ambf
