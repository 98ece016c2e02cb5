// Blocks of the kinds that scene::Model keeps in `blocks`, as keys and flow values. Pure functions, any thread.
#pragma once

#include <string>
#include <vector>

#include "adf/detail/write_looks.h"
#include "scene/description.h"

namespace ambf::adf {

// Of a kind that this library does not know: what its rows say. `bodies` of the same model.
WrittenKeys block_keys(const scene::KindBlock& block, const std::vector<scene::Body>& bodies, const Lost& lost);

// The body whose `resistive surface` a sensor is; null for every other block.
const scene::Body* body_of_surface(const scene::KindBlock& block, const std::vector<scene::Body>& bodies);
// The value of that key.
std::string surface_keys(const scene::KindBlock& block);
// Of a vehicle: identifiers of the bodies that its wheels' meshes became.
std::vector<std::string> drawn_wheels(const scene::KindBlock& block);

}  // namespace ambf::adf
