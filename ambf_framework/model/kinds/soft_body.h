// The kind of soft bodies (model/kinds/soft_body.cpp).
#pragma once

#include <cstdint>
#include <memory>

#include "model/detail/live_impl.h"

namespace ambf::physics {
class SoftBody;  // physics/soft_body.h
}

namespace ambf::model {

class Kind;  // model/kinds/kind.h

std::unique_ptr<Kind> make_soft_body_kind();

// For other kinds, on the physics thread.
physics::SoftBody& soft_body_at(const LiveWorld::Impl& live, std::uint32_t slot);
// state::kNone: there is no such soft body.
std::uint32_t soft_body_slot(const LiveWorld::Impl& live, state::ObjectId id);

}  // namespace ambf::model
