// Where the surface of a cut is: on what the blade swept, not along the ragged seams that it opened. Points of the
// surface at open seams go to the planes that the sweep had there; elements carry them, within or a little beyond
// (points of virtual elements). Elements, their mass and their stiffness stay as they are. All of it follows from the
// open seams and their planes, in whatever order they were opened. Private to physics/soft/. Physics thread.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "physics/soft/detail/tissue_solid.h"

namespace ambf::physics::detail {

class CutSurface {
 public:
  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

  // `loaded`: corners by slot, those of the first element, and so on. Rooms for `max_corners`.
  CutSurface(const TissueGrid& grid, const std::vector<std::uint32_t>& loaded, std::size_t max_corners);

  // The slot of the corner that a point is at; kNone: it is at none.
  std::uint32_t home(std::size_t point) const { return home_[point]; }
  bool is_away(std::size_t point) const { return place_[point] != kNone && places_[place_[point]].away; }
  // Writes the corners and weights of all points. `swept`: of each open seam, the way from the middle of its first
  // element, as loaded, to the plane that opened it, across that. `corner_of`: corners now, by slot, which the grid and
  // the solid have already.
  void follow(const std::vector<std::uint8_t>& open, const std::vector<math::Vec3>& swept,
              const std::vector<std::uint32_t>& corner_of, const TissueSolid& solid, TissueGrid& grid);
  void look_at_all();  // in the next follow(), also where the same seams are open

 private:
  // Of points that are at one place as loaded: they go to one place.
  struct Place {
    math::Vec3 loaded, moved;                 // m, body frame
    math::Vec3 free[3] = {};                  // rows of the projection on where it may go: along the outer surface
    std::uint32_t first_seam = 0, seams = 0;  // of `seams_`
    bool away = false;                        // one of these is open
  };

  void find_places(const TissueGrid& grid);
  void find_seams(const TissueGrid& grid);
  void find_free(const TissueGrid& grid);
  void move(Place& place, const std::vector<std::uint8_t>& open, const std::vector<math::Vec3>& swept) const;

  const std::vector<std::uint32_t>& loaded_;
  std::size_t sides_;                          // corners of an element
  double size_;                                // m, of an element
  std::vector<std::array<double, 4>> weight_;  // of each point, as loaded
  std::vector<std::uint32_t> home_, place_;    // of each point
  std::vector<Place> places_;                  // of the corners as loaded, then further ones
  std::vector<std::uint32_t> seams_;
  std::vector<math::Vec3> middle_;   // of the first element of each seam
  std::vector<std::uint8_t> known_;  // of each seam, whether it was open in the last follow(); 2: look again
  std::vector<std::uint32_t> best_;  // of each corner that is away, the element that has its place the most within
  std::vector<double> min_weight_;   // its smallest weight there
};

// Symmetric: the sum of what add() got, by its axes.
class Principal {
 public:
  void add(const math::Vec3& v);  // v v^T
  // Eigenvalues, and the axes they are of.
  void solve(double (&values)[3], math::Vec3 (&axes)[3]) const;

 private:
  double xx_ = 0.0, yy_ = 0.0, zz_ = 0.0, yz_ = 0.0, zx_ = 0.0, xy_ = 0.0;
};

}  // namespace ambf::physics::detail
