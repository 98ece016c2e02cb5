// Counts what Bullet allocates. The one piece of process-wide state here: Bullet's allocator hook is process-wide
// itself.
#include <atomic>
#include <cstdlib>

#include "physics/detail/bullet.h"
#include "physics/world.h"

namespace ambf::physics {

namespace {

std::atomic<std::uint64_t> allocations{0};

void* counted_malloc(std::size_t size) {
  allocations.fetch_add(1, std::memory_order_relaxed);
  return std::malloc(size);
}

// Installed when the library is loaded, before any shape can have been made with another allocator.
const bool kInstalled = [] {
  btAlignedAllocSetCustom(counted_malloc, std::free);
  return true;
}();

}  // namespace

std::uint64_t bullet_allocation_count() { return kInstalled ? allocations.load(std::memory_order_relaxed) : 0; }

}  // namespace ambf::physics
