// From a soft body's description to its physics and its skin. Loader thread. For use inside model/kinds/soft_body*
// only.
#pragma once

#include <memory>

#include "model/detail/catalogue_impl.h"
#include "physics/soft_body.h"
#include "scene/soft_body.h"
#include "state/soft_bodies.h"

namespace ambf::model {

struct BuiltSoftBody {
  std::unique_ptr<physics::SoftBody> body;  // null: there is nothing to make nodes of, and an error said so
  state::SoftBodyInfo row;                  // less object, parent and place in the column
};

BuiltSoftBody build_soft_body(const scene::KindBlock& block, Catalogue::Impl& all, const LoadedModel& model,
                              const math::Pose& T_world_model, Findings& findings);

}  // namespace ambf::model
