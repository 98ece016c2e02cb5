// The mechanics of tissue: co-rotated linear tetrahedra, or a sheet, in implicit Euler steps (docs/tissue.md). The
// equations of a step are solved by a fixed number of conjugate gradients, preconditioned by mass, which keep momentum.
// Knows neither bodies nor worlds. Private to physics/soft/. Physics thread once in a world.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "physics/soft/detail/tissue_sheet.h"
#include "physics/tissue.h"

namespace ambf::physics::detail {

// What pulls at a point: a spring of which the solver knows the stiffness. With v the point's velocity after the step,
// the force is pull - h (normal_stiffness n n^T + side_stiffness (1 - n n^T)) v.
struct TissueSpring {
  TissuePoint at;
  math::Vec3 normal;
  math::Vec3 pull;                                      // N
  double normal_stiffness = 0.0, side_stiffness = 0.0;  // N/m
  bool pushes = false;  // only along the normal: where the step would make it pull, the step undoes it

  // The force against a velocity, by the step: N/s.
  math::Vec3 holding_back(const math::Vec3& v) const {
    return v * side_stiffness + normal * ((normal_stiffness - side_stiffness) * math::dot(normal, v));
  }
};

// What pulls two points together: a spring between them. With v the velocity of the first from the second after the
// step, the force on the first, and the opposite of that on the second, is as that of a TissueSpring.
struct TissueLink {
  TissuePoint first, second;
  math::Vec3 normal;
  math::Vec3 pull;                                      // N, on the first
  double normal_stiffness = 0.0, side_stiffness = 0.0;  // N/m

  math::Vec3 holding_back(const math::Vec3& v) const {
    return v * side_stiffness + normal * ((normal_stiffness - side_stiffness) * math::dot(normal, v));
  }
};

// A point of a surface that touches a face of one: a spring between them. With v the velocity of the point from the
// face after the step, the force on the point, and the opposite of that on the face, is as that of a TissueSpring.
struct TissueTouch {
  static constexpr std::size_t kMaxCorners = 16;

  // The place of the point from that on the face: the sum of these corners, each by its weight. Where one of the two is
  // of another tissue, it is not in here, and `pull` knows how it moves.
  std::array<std::uint32_t, kMaxCorners> corner{};
  std::array<double, kMaxCorners> weight{};
  std::size_t corners = 0;
  bool within = true;                                   // both are of this tissue
  math::Vec3 place;                                     // m, world, where they touch
  math::Vec3 normal;                                    // out of the face
  math::Vec3 pull;                                      // N, on the point
  double normal_stiffness = 0.0, side_stiffness = 0.0;  // N/m
  double push = 0.0;                                    // N, as the step begins
  double friction = 0.0;                                // of what presses, that it bears at most

  void add(const TissuePoint& point, double share) {
    for (std::size_t k = 0; k < 4; ++k)
      if (point.weight[k] != 0.0) corner[corners] = point.corner[k], weight[corners++] = share * point.weight[k];
  }
  math::Vec3 holding_back(const math::Vec3& v) const {
    return v * side_stiffness + normal * ((normal_stiffness - side_stiffness) * math::dot(normal, v));
  }
};

// What acts in a step besides forces; all of it ends with the step.
struct TissuePulls {
  std::span<TissueSpring> springs;  // those that would pull where they only push let go
  std::span<const TissueLink> links;
  std::span<TissueTouch> touches;
};

// The rotation that fits a deformation best (its columns are where the axes go), found from a guess: it exists for flat
// and inverted elements, too.
math::Quat fit_rotation(math::Quat guess, const math::Vec3 (&columns)[3], int sweeps);

class TissueSolid {
 public:
  explicit TissueSolid(const TissueDefinition& given);

  // One step of h seconds: the forces that were added, which end with it, gravity, and what pulls. Velocities of fixed
  // corners are as set_velocity() left them.
  void step(double h, const math::Vec3& gravity, const TissuePulls& pulls);
  math::Vec3 force_of(const TissueSpring& spring, double h) const;  // after step()
  math::Vec3 force_of(const TissueLink& link, double h) const;      // likewise, on its first point
  math::Vec3 force_of(const TissueTouch& touch, double h) const;    // likewise, on the point

  std::size_t corner_count() const { return x_.size(); }
  const std::vector<math::Vec3>& positions() const { return x_; }
  const std::vector<math::Vec3>& velocities() const { return v_; }
  const std::vector<double>& masses() const { return mass_; }
  math::Vec3 at(const TissuePoint& point) const { return sum(x_, point); }
  math::Vec3 velocity(const TissuePoint& point) const { return sum(v_, point); }
  bool fixed(std::size_t corner) const { return fixed_[corner] != 0; }
  void set_velocity(std::size_t corner, const math::Vec3& v) { v_[corner] = v; }
  void add_force(std::size_t corner, const math::Vec3& force) {
    force_[corner] += force;
    pushed_ = true;
  }
  bool pushed() const { return pushed_; }              // forces act on corners in the next step
  void stop();                                         // no corner moves
  void put(const std::vector<math::Vec3>& positions);  // at rest, turned as they fit

  // Each element's corners are those of `corner_of`, four an element, `count` in all; elements that go on sharing one
  // go on moving as one. Mass, momentum and volume stay. Not between forces and their step.
  void renumber(const std::vector<std::uint32_t>& corner_of, std::size_t count);
  void make_room(std::size_t corners);
  void part_at(const std::vector<TissueSeam>& seams, const std::vector<std::uint8_t>& open) {
    sheet_.part_at(seams, open);
  }
  // Four of an element, three of a triangle.
  const std::uint32_t* corners_of(std::size_t element) const {
    return hot_.empty() ? sheet_.corners_of(element) : hot_[element].corner;
  }

  double volume() const;
  math::Quat rotation_of_first() const { return cold_.empty() ? sheet_.rotation_of_first(x_) : cold_.front().rotation; }
  std::size_t element_count() const { return hot_.size(); }
  std::size_t triangle_count() const { return sheet_.triangle_count(); }
  int iterations() const { return iterations_; }
  int wanted_iterations() const { return wanted_iterations_; }
  // Pa, of a slab, or of a strip in its plane, that cannot give way sideways.
  double modulus() const { return hot_.empty() ? sheet_.modulus() : lambda_ + 2.0 * mu_; }

  std::size_t state_size() const;
  void get_state(std::vector<double>& out) const;
  void set_state(std::span<const double> state);
  void reset(const math::Pose& T_world_body);

 private:
  struct Symmetric {
    double xx = 0.0, yy = 0.0, zz = 0.0, yz = 0.0, zx = 0.0, xy = 0.0;
  };
  // What the solver reads of an element in each iteration.
  struct Hot {
    std::uint32_t corner[4];
    math::Vec3 gradient[3];  // of corners 1 to 3, 1/m, turned with the element
    double shear, pressure;  // N m: 2 mu V and lambda V
  };
  struct Cold {
    math::Vec3 gradient[3];  // as at rest
    double volume;           // m^3, of tissue
    double stiffness;
    double share, mass;
    math::Quat rotation;  // of the element since it was at rest
    Symmetric relaxed;    // strain that no longer bears its stress, in the element's axes
  };

  static math::Vec3 sum(const std::vector<math::Vec3>& of, const TissuePoint& point);
  static Symmetric strain(const Hot& element, const math::Vec3& d1, const math::Vec3& d2, const math::Vec3& d3);
  static void add_stress(const Hot& element, const Symmetric& strain, std::vector<math::Vec3>& forces);
  void begin(double h);
  // to = -K u, with `taut` times what tension adds to K.
  void add_stiffness_force(const std::vector<math::Vec3>& u, std::vector<math::Vec3>& to, double taut = 1.0);
  static math::Vec3 sum(const std::vector<math::Vec3>& of, const TissueTouch& touch);  // of the point from the face
  double multiply(const std::vector<math::Vec3>& u, std::vector<math::Vec3>& to, double h,
                  const TissuePulls& pulls);  // to = A u; returns u . A u
  void converge(double h, const TissuePulls& pulls, int iterations);
  bool undo_pulling(double h, std::span<TissueSpring> springs);
  bool undo_touches(double h, std::span<TissueTouch> touches);
  void find_lightness(double h, const TissuePulls& pulls);
  math::Vec3 moved(std::size_t corner, const math::Vec3& by) const;  // the preconditioner
  void remove_net(double h, const TissuePulls& pulls, bool rotates);
  void add_masses(const math::Vec3& centre, std::array<std::array<double, 6>, 6>& inertia) const;
  void choose_iterations(double h);

  std::vector<math::Vec3> rest_;
  std::vector<Hot> hot_;
  std::vector<Cold> cold_;
  std::vector<double> mass_;
  TissueSheet sheet_;
  std::vector<Symmetric> lightness_;  // of a sheet's corners, 1/kg: of their mass and of the springs at them
  std::vector<std::uint8_t> fixed_, next_fixed_;
  bool any_fixed_ = false;
  double mu_, lambda_, share_, time_;
  int iterations_ = 6, wanted_iterations_ = 6;
  std::vector<math::Vec3> x_, v_, force_;
  bool pushed_ = false;
  std::vector<math::Vec3> change_, residual_, direction_, product_;  // rooms of a step
};

}  // namespace ambf::physics::detail
