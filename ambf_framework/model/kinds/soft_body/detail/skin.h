// Binds drawn vertices to nodes (EQUATIONS 16). Loader thread. For use inside model/kinds/soft_body* only.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "mesh/appearance.h"
#include "state/soft_bodies.h"

namespace ambf::model {

// Each vertex to the node at its place, else to the triangle that is nearest, so that it is drawn where it is as long
// as nodes are at `nodes`; to the nearest node where there are no triangles. All in the body frame, m.
std::vector<state::SkinVertex> make_skin(const mesh::Appearance& appearance, const std::vector<math::Vec3>& nodes,
                                         const std::vector<std::array<std::uint32_t, 3>>& triangles);

}  // namespace ambf::model
