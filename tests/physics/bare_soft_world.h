// Bullet's own world of soft bodies with one in it, made as AMBF 2.0 makes it: what ours are compared with.
#pragma once

#include <memory>

#include "physics/soft_body.h"

namespace ambf::physics::testing {

class BareSoftWorld {
 public:
  explicit BareSoftWorld(const SoftDefinition& definition);
  ~BareSoftWorld();
  void add_box(const math::Vec3& half_extents);  // static, at the origin; once
  void step();                                   // 1 ms
  math::Vec3 position(std::size_t node) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ambf::physics::testing
