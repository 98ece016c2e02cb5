// The mechanics of a sheet: triangles that stretch in their plane, co-rotated, and bend by the angles between them
// (docs/tissue.md#sheets). Its corners are those of the TissueSolid that it is part of, which makes the steps. Private
// to physics/soft/. Physics thread once in a world.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

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
      for (std::size_t k = 0; k < 3; ++k) use(3 * i + k, triangles_[i].corner[k], rests_[i].mass / 3.0);
  }
  // After corners were numbered anew: where seams are open, nothing bends.
  void part_at(const std::vector<TissueSeam>& seams, const std::vector<std::uint8_t>& open);

  std::size_t state_size() const { return 3 * rests_.size() + hinges_.size(); }
  void get_state(std::vector<double>& out) const;
  void set_state(const double* from);
  void reset();

 private:
  static constexpr std::uint32_t kNone = ~std::uint32_t{0};

  struct Plane {  // symmetric, in the plane of a triangle
    double xx = 0.0, yy = 0.0, xy = 0.0;
  };
  // What the solver reads of a triangle in each iteration.
  struct Triangle {
    std::uint32_t corner[3];
    math::Vec3 along, across, normal;  // the axes of its plane, turned with it; unit
    double ax, ay, by;                 // 1/m: gradients of corner 1, and of corner 2, which has none along
    double shear, even;                // N m: stress by strain, and by the sum of strains, times volume
    double taut[3];                    // N/m: by what it is stretched, corners resist to leave its plane: 11, 12, 22
  };
  // Likewise, how it bends.
  struct Bending {
    std::uint32_t hinge[3];  // of the edge opposite to that corner; kNone: an edge of the sheet
    double moment[6];        // N m: of the hinges by their angles: 00, 11, 22, 01, 12, 20
  };
  struct Rest {
    double area = 0.0, thickness = 0.0, mass = 0.0;
    double moment[6]{};                // as of Bending, if all of its edges bent
    double side[3] = {1.0, 1.0, 1.0};  // -1: it sees that hinge bend from behind
    Plane relaxed;                     // strain that no longer bears its stress
  };
  struct Hinge {
    std::uint32_t corner[4];  // the edge, then the corner opposite to it of either triangle
    math::Vec3 gradient[4];   // of the angle, 1/m
    double angle = 0.0;       // rad, as at rest
    double relaxed = 0.0;     // of its bend
    std::uint32_t slot[4];    // where `corner` is from: 3 * triangle + 0 to 2
    bool open = false;        // cut
  };

  void add_hinges(const TissueDefinition& given);
  void set_bending(const TissueDefinition& given);
  void free_edges(std::size_t triangle);
  void measure(const std::vector<math::Vec3>& x, Hinge& hinge, double& angle) const;
  math::Quat frame_of_first(const std::vector<math::Vec3>& x) const;
  void pull_hinges(std::vector<math::Vec3>& to);  // by `bends_`
  static void add_stress(const Triangle& triangle, const Plane& strain, std::vector<math::Vec3>& to);

  std::vector<Triangle> triangles_;
  std::vector<Bending> bending_;
  std::vector<Rest> rests_;
  std::vector<Hinge> hinges_;
  std::vector<double> bends_, moments_;  // rooms of a pass, by hinge: what bears a moment, N m
  math::Quat first_;                     // the first triangle's axes, as at rest
  double modulus_ = 0.0, share_ = 1.0, time_ = 1.0;
};

}  // namespace ambf::physics::detail
