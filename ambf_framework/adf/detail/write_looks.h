// What is drawn and what collides, as keys and flow values. Pure functions, any thread.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "adf/detail/write_rows.h"
#include "scene/description.h"

namespace ambf::adf {

// Called with what no key says, and what to do about it.
using Lost = std::function<void(const std::string& what, const std::string& hint)>;

std::string flow(const scene::Shaders& shaders);  // empty where none are given
std::string flow(const std::vector<int>& numbers);
// A list in one line, of values that are flow values already.
std::string flow_list(const std::vector<std::string>& values);

// Keys in the order of the table. `collides`: something stands below the collision keys, so that a mesh that is drawn
// does not collide, too.
WrittenKeys visual_keys(const scene::Visual& visual, bool collides, const Lost& lost);
WrittenKeys collision_keys(const scene::Collision& collision);
WrittenKeys material_keys(const scene::Material& material, const Lost& lost);
bool collides(const scene::Collision& collision);

}  // namespace ambf::adf
