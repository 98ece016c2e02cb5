// Rims of a sheet: its border and the lips of its cuts; and which of its parts still hang together beside a cut.
// Private to physics/soft/. Physics thread once in a world.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "physics/soft/detail/tissue_cuts.h"

namespace ambf::physics::detail {

class SheetRims {
 public:
  explicit SheetRims(const TissueDefinition& given);  // of solids it is empty

  // After a cut; `places`: of points, as loaded.
  void follow(const TissueGrid& grid, const TissueCuts& cuts, const TissueSolid& solid,
              const std::vector<math::Vec3>& places);

  // The edge of a triangle that is opposite to its corner of that number, 0 to 2.
  bool is_rim(std::size_t triangle, std::size_t opposite) const { return (edges_[triangle] >> opposite & 1U) != 0; }
  // One that runs along the rim, with the tissue on its side: a cut goes zigzag between triangles, and its points go to
  // what was swept.
  bool faces_out(std::size_t triangle, std::size_t opposite) const { return (out_[triangle] >> opposite & 1U) != 0; }
  bool any_faces_out(std::size_t triangle) const { return out_[triangle] != 0; }
  // Nothing of a triangle's area is left to touch: all of its points went to one line.
  bool is_flat(std::size_t triangle) const { return flat_[triangle] != 0; }
  bool has_corner(std::size_t corner) const { return corner_[corner] != 0; }
  // Whether a triangle hangs together with a corner near it, over no more than what was near it as loaded.
  bool joins(const TissueSolid& solid, std::uint32_t triangle, std::uint32_t corner);

 private:
  static constexpr auto kNone = std::numeric_limits<std::uint32_t>::max();

  std::vector<std::uint8_t> border_, edges_;      // of triangles, by bits: as loaded, and with cuts
  std::vector<std::uint8_t> out_, flat_;          // likewise
  std::vector<std::uint8_t> corner_;              // whether it is at a rim
  std::vector<std::uint32_t> first_near_, near_;  // of each triangle those near it as loaded, and the end
  std::vector<std::uint8_t> near_cut_;            // of triangles
  // Of the last call of joins(): by corner and by triangle the round in which it was found.
  std::vector<std::uint64_t> joined_, joined_round_;
  std::uint64_t round_ = 0;
  std::uint32_t joined_of_ = kNone;
};

}  // namespace ambf::physics::detail
