// What actuators hold, for kinds that judge it. Physics thread.
#pragma once

#include <array>
#include <cstdint>

#include "base/limits.h"
#include "model/detail/live_impl.h"

namespace ambf::physics {
class Needle;
}

namespace ambf::model {

struct HeldBodies {
  std::uint32_t holder = state::kNone;  // slot of the body that the actuator sits on
  std::array<std::uint32_t, base::kMaxHeldBodies> bodies{};
  std::uint32_t count = 0;
};

// Of the actuator of this slot, by its grasps: a magnet holds nothing.
HeldBodies held_by(const LiveWorld::Impl& live, std::uint32_t actuator);

// Null: the actuator is none. What it went through: physics/needle.h.
const physics::Needle* needle_of(const LiveWorld::Impl& live, std::uint32_t actuator);

}  // namespace ambf::model
