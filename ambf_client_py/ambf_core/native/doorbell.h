// A counter in memory that several processes share: one of them rings, another one waits for it to change. Waiting
// spins for a moment, which is what steps take, and then sleeps in the kernel.
#pragma once

#include <cstdint>

namespace ambf::python {

void ring(std::uint32_t& bell);
// Waits until `bell` is not `seen`; false when the time is over.
bool wait_for_ring(const std::uint32_t& bell, std::uint32_t seen, double timeout_s);

}  // namespace ambf::python
