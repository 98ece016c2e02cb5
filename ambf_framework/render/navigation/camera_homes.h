// Where cameras were when they were first seen, for the key that brings them back. Main thread.
#pragma once

#include <cstdint>
#include <map>

#include "state/frame.h"

namespace ambf::render {

class CameraHomes {
 public:
  // Notes cameras that are new and forgets those that are gone.
  void take(const state::Frame& frame);
  // T_parent_camera at home; identity for a camera never seen.
  math::Pose home(state::ObjectId camera) const;

 private:
  std::uint64_t structure_version_ = ~std::uint64_t{0};
  std::map<std::uint64_t, math::Pose> homes_;  // by id
};

}  // namespace ambf::render
