// The mechanics of a sheet: triangles that stretch in their plane, co-rotated, and bend by the angles between them
// (docs/tissue.md#sheets). Its corners are those of the TissueSolid that it is part of, which makes the steps. Private
// to physics/soft/. Physics thread once in a world.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "physics/soft/detail/sheet_lanes.h"
#include "physics/tissue.h"

namespace ambf::physics::detail {

class TissueSheet {
 public:
  // Adds its mass to that of its corners.
  TissueSheet(const TissueDefinition& given, std::vector<double>& mass);

  std::size_t triangle_count() const { return triangles_.size(); }
  double modulus() const { return modulus_; }  // Pa, of a strip that cannot become narrower
  double volume(const std::vector<math::Vec3>& x) const;
  math::Quat rotation_of_first(const std::vector<math::Vec3>& x) const;  // since it was at rest

  // Where everything is turned to, what relaxed in h seconds, and the forces: added to `forces`.
  void begin(const std::vector<math::Vec3>& x, double h, std::vector<math::Vec3>& forces);
  // to -= K u, with the stiffness K as begin() found it; `taut` times what tension adds to it.
  void add_stiffness_force(const std::vector<math::Vec3>& u, std::vector<math::Vec3>& to, double taut = 1.0);

  const std::uint32_t* corners_of(std::size_t triangle) const { return triangles_[triangle].corner; }
  // Of each triangle's corners in turn: use(3 * triangle + 0 to 2, the corner, which it may number anew, its mass).
  template <class Use>
  void each_corner(const Use& use) {
    for (std::size_t i = 0; i < triangles_.size(); ++i)
      for (std::size_t k = 0; k < 3; ++k) use(3 * i + k, triangles_[i].corner[k], triangles_[i].mass / 3.0);
    number_lanes();
  }
  // After corners were numbered anew: where seams are open, nothing bends.
  void part_at(const std::vector<TissueSeam>& seams, const std::vector<std::uint8_t>& open);

  std::size_t state_size() const { return 3 * triangles_.size() + lanes_.hinge_count; }
  void get_state(std::vector<double>& out) const;
  void set_state(const double* from);
  void reset();

 private:
  static constexpr std::uint32_t kNone = ~std::uint32_t{0};

  struct Triangle {
    std::uint32_t corner[3];
    std::uint32_t hinge[3] = {kNone, kNone, kNone};  // of the edge opposite to that corner; kNone: an edge of the sheet
    double area = 0.0, thickness = 0.0, mass = 0.0;
    double moment[6]{};  // as that of SheetLanes, if all of its edges bent
  };
  void add_hinges();
  void set_bending(const TissueDefinition& given);
  void free_edges(std::size_t triangle);
  void number_lanes();
  double& closed(std::size_t hinge) {
    return lanes_.hinges[hinge / SheetLanes::kCount].closed[hinge % SheetLanes::kCount];
  }
  math::Quat frame_of_first(const std::vector<math::Vec3>& x) const;

  std::vector<Triangle> triangles_;
  SheetLanes lanes_;
  math::Quat first_;  // the first triangle's axes, as at rest
  double modulus_ = 0.0, share_ = 1.0, time_ = 1.0;
};

}  // namespace ambf::physics::detail
