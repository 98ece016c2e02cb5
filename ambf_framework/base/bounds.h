// How large what comes from outside may be: every bound once, with its reason. How many of each there may be at one
// time is in limits.h. C++17.
#pragma once

#include <cstddef>

namespace ambf::base {

// Memory that a received message may take beyond its own size, in bytes: lists of short texts take several times what
// came. With this a Step request may name kMaxObjects objects.
inline constexpr std::size_t kMaxMessageExpansion = std::size_t{4} << 20;

}  // namespace ambf::base
