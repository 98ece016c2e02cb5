// Vectors of two and four numbers. Lanes never meet and nothing is fused, so that each number gets the bits that plain
// code gives it. Two are what every processor has; functions that use four are marked AMBF_WIDE and run only where
// has_wide_vectors(). What such a function and its twin for two numbers share is inlined in both by force, because a
// function takes the instructions of the one that it is part of. Private to physics/. Any thread.
#pragma once

// Instrumented code of that size takes minutes to compile: sanitizers see plain functions, which compute the same.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define AMBF_PLAIN_LANES
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define AMBF_PLAIN_LANES
#endif
#endif
#if defined(AMBF_PLAIN_LANES)
#define AMBF_WIDE
#define AMBF_INLINED inline
#define AMBF_INLINED_LAMBDA
#else
#if defined(__x86_64__)
#define AMBF_WIDE [[gnu::target("avx2")]]
#else
#define AMBF_WIDE
#endif
#define AMBF_INLINED [[gnu::always_inline]] inline
#define AMBF_INLINED_LAMBDA __attribute__((always_inline))
#endif

namespace ambf::physics {

using Pair __attribute__((vector_size(16), may_alias)) = double;
using Quad __attribute__((vector_size(32), may_alias, aligned(16))) = double;

inline bool has_wide_vectors() {
#if defined(__x86_64__)
  static const bool has = __builtin_cpu_supports("avx2") != 0;
  return has;
#else
  return false;
#endif
}

}  // namespace ambf::physics
