// Identity of things in the simulation. Plain values, any thread, C++17.
#pragma once

#include <cstdint>

#include "base/limits.h"

namespace ambf::state {

enum class ObjectKind : std::uint8_t { world, rigid_body, joint, camera, light };

// An index is reused after its object is removed; the generation distinguishes a new object from a removed one.
struct ObjectId {
  std::uint32_t index = 0xffffffffu;
  std::uint32_t generation = 0;

  bool valid() const { return index != 0xffffffffu; }
};

inline bool operator==(const ObjectId& a, const ObjectId& b) {
  return a.index == b.index && a.generation == b.generation;
}
inline bool operator!=(const ObjectId& a, const ObjectId& b) { return !(a == b); }

// A loaded model file; never reused within a run.
using ModelId = std::uint32_t;
inline constexpr ModelId kWorldModel = 0;  // cameras and lights of the world file

// No such slot: e.g. the parent of a camera that hangs in the world.
inline constexpr std::uint32_t kNone = 0xffffffffu;

// Who commands or holds an object. Within one source the newest command wins; across sources wrenches add, and pose,
// twist and each joint follow the source that wrote last until its slot expires. Input devices follow device_0; there
// are base::kMaxSources.
enum class Source : std::uint8_t { ros, step_service, pointer, panel, plugin, device_0 };
// Bit s: source s.
using SourceSet = std::uint64_t;
static_assert(base::kMaxSources <= 64);

}  // namespace ambf::state
