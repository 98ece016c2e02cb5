// Where tissue is cut: which seams between its elements are open, and so which elements share corners, and where the
// surface of the cut is. All of it follows from the open seams and what opened them, in whatever order that was.
// Private to physics/soft/. Physics thread.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "physics/soft/detail/cut_surface.h"

namespace ambf::physics::detail {

class TissueCuts {
 public:
  // `max_corners`: room that is taken at once; too little for what there is as loaded: it cannot be cut.
  TissueCuts(TissueGrid& grid, TissueSolid& solid, std::size_t max_corners);

  bool possible() const { return !open_.empty(); }
  std::size_t max_corners() const { return max_corners_; }
  bool open(std::size_t seam) const { return open_[seam] != 0; }
  std::size_t open_count() const;
  std::size_t pieces() const;
  bool full() const { return full_; }
  // Of a point or a face of the grid: whether it is seen. Of a sheet's points at one corner, the first stands for all.
  bool shows_point(std::size_t point) const { return shown_.empty() || shown_[point] != 0; }
  bool shows_face(std::size_t face) const {
    return open_.empty() || face < grid_.first_inner_face || open((face - grid_.first_inner_face) / 2);
  }
  // The corner as loaded of which this one is a copy.
  std::uint32_t origin(std::size_t corner) const { return origin_[corner]; }

  // The corner that a point is at; CutSurface::kNone: at none.
  std::uint32_t corner_at(std::size_t point) const {
    const std::uint32_t slot = surface_->home(point);
    return slot == CutSurface::kNone ? slot : corner_of_[slot];
  }
  // Whether it is of the surface of a cut.
  bool is_on_cut(std::size_t point) const;

  // To be opened by apply(), by what was swept in this plane, as loaded; once more has no effect.
  void mark(std::size_t seam, const math::Vec3& at, const math::Vec3& normal);
  // False: nothing was marked, or there is no room for it, and nothing changes.
  bool apply();
  // Three numbers of each seam: the way from the middle of its first element to the plane that opened it, m; 0, 0, 0:
  // it is not open.
  std::size_t state_size() const { return 3 * open_.size(); }
  void get_state(std::vector<double>& out) const;
  bool put(const double* state);  // as saved; false: there is no room, or it cannot be
  void close();

 private:
  bool connect(const std::vector<std::uint8_t>& open);
  std::uint32_t root(std::uint32_t slot);
  void unite(std::uint32_t a, std::uint32_t b);
  void use();
  math::Vec3 middle(std::size_t element) const;  // as loaded

  TissueGrid& grid_;
  TissueSolid& solid_;
  std::size_t max_corners_ = 0, count_ = 0;
  std::size_t sides_ = 4, shared_ = 3;  // corners of an element, and of a seam
  bool full_ = false;
  std::vector<std::uint8_t> open_, wanted_, shown_;
  std::vector<math::Vec3> swept_, wanted_swept_;  // of seams
  std::optional<CutSurface> surface_;
  std::vector<std::uint32_t> loaded_;              // corners, by slot
  std::vector<math::Vec3> rest_;                   // of corners as loaded
  std::vector<std::uint32_t> parent_;              // of the slots: corners of the first element, and so on
  std::vector<std::uint32_t> number_, corner_of_;  // by slot
  std::vector<std::uint32_t> origin_;              // by corner
  std::vector<std::uint8_t> used_;                 // by corner as loaded
};

}  // namespace ambf::physics::detail
