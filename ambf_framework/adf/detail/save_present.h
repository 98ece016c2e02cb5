// How a simulation is now, as changes of the text that it was read from. Pure functions, any thread.
#pragma once

#include <string>
#include <vector>

#include "adf/detail/text_edit.h"
#include "adf/save.h"
#include "math/types.h"

namespace ambf::adf {

double angle_between(const math::Pose& a, const math::Pose& b);
bool is_near(const math::Pose& a, const math::Pose& b, double tolerance);
// Whether a header list of the text names a block.
bool lists(const Value& root, const std::string& list, const std::string& block);
// The numbers of a map that differ; all of them where there is no such map.
void set_numbers(const std::optional<Value>& map, const math::Vec3& wanted, const char* const (&names)[3],
                 Change& change);

// Poses and parents of cameras and lights; as described: `cameras`, `lights`.
void set_views(const Value& root, const std::vector<scene::Camera>& cameras, const std::vector<scene::Light>& lights,
               const Present& present, Change& change);

// Blocks for cameras and lights that a text does not describe, as they are described otherwise, where they have moved.
std::string text_of_moved_defaults(const std::string& text, const scene::Model& views, const Present& present);

// One object's values that differ from what was loaded, and what they must read back as.
struct TunedBlock {
  std::string block;
  Change change;
};
// Of bodies, joints, cameras and lights that the text describes.
std::vector<TunedBlock> tuned_blocks(const Value& root, const Present& present);
// Whether a model (or a world, as a model of cameras and lights) reads as the order wants it.
bool reads_as_tuned(const scene::Model& after, const Present& present, const std::string& block);

}  // namespace ambf::adf
