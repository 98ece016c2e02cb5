// Edges of tissue that meet edges of other tissue between their nodes (edge_touch.cpp): rims of sheets and where these
// are bent, and ridges of solids. Private to physics/soft/. Physics thread once in a world.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "physics/tissue.h"

namespace ambf::physics::detail {

struct TissueData;

struct TouchEdges {
  explicit TouchEdges(const TissueDefinition& given);
  void begin_step();
  void let_go(const TissueData* tissue);         // null: all
  void forget_friction(const TissueData* with);  // null: all

  static constexpr auto kNone = std::numeric_limits<std::uint32_t>::max();
  static constexpr std::size_t kSlots = 1024;     // a power of 2
  static constexpr std::size_t kMaxFew = 2048;    // rims or ridges of one tissue near another
  static constexpr std::size_t kMaxPairs = 4096;  // edges of it that are near those of others

  // Of a solid its ridges as loaded, the outer surface's; of a sheet each edge of each triangle.
  struct Edge {
    std::array<std::uint32_t, 2> point{}, place{};  // of the surface; those at one place as loaded have one number
    std::uint32_t face = 0, mate = kNone;           // `mate`: on its other side
    std::uint8_t opposite = 0, mate_opposite = 0;   // of the face's corners
    bool second = false;                            // the mate's edge stands for both while they hang together
  };
  std::vector<Edge> edges;
  double longest = 0.0;  // m, as loaded

  // An edge of this tissue near one of another.
  struct Pair {
    const TissueData* other = nullptr;
    std::uint32_t own = 0, others = 0;
    bool own_is_few = false;
    bool above = false;     // of sheets: own edge x other's points from the other's edge to its own
    bool touching = false;  // in this step
    bool held = false;
    // Where they touched first, by the length of each edge: friction pulls them back there (EQUATIONS 17).
    double own_place = 0.0, others_place = 0.0;

    std::uint64_t key() const {
      const std::uint64_t of_few = own_is_few ? own : others, of_many = own_is_few ? others : own;
      return (own_is_few ? 0 : std::uint64_t{1} << 63U) | of_many << 31U | of_few;
    }
  };
  std::vector<Pair> pairs, last;  // of this step and of the one before, those with one other tissue sorted by key

  // Rooms of a search: edges by the cells that what is near them may be in.
  std::vector<std::uint32_t> few, first, in_cell;
};

// Springs of `tissue` where edges of both cross each other; of a sheet with what `other` feels.
void add_edge_touches(TissueData& tissue, TissueData& other, double h);

}  // namespace ambf::physics::detail
