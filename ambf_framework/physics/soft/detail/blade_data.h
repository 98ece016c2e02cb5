// What a Blade is made of. Private to physics/soft/. Physics thread.
#pragma once

#include <vector>

#include "physics/blade.h"
#include "physics/detail/body_data.h"
#include "physics/soft/detail/tissue_data.h"

namespace ambf::physics::detail {

constexpr double kJump = 0.5;  // elements of a sheet: what is that much further in a step, went over to another fold

// A place of the edge.
struct BladeSample {
  math::Vec3 place;     // m, body frame
  math::Vec3 along;     // unit, of the edge, body frame
  double length = 0.0;  // m, of the edge that it stands for
  // The tissue that it is in or beside; null: none is near.
  TissueData* tissue = nullptr;
  math::Vec3 rest;            // m, where that tissue was as loaded
  std::uint32_t element = 0;  // of it
  bool inside = false;
  double felt = 0.0;   // m, of its length in tissue
  bool moved = false;  // in this step, from `from`
  math::Vec3 from;
  bool was_inside = false;
  // Rooms of a step: whether it is near this tissue, was held by it, where it would be, what of that is tissue that is
  // taken along.
  bool followed = false, held = false;
  math::Vec3 wanted, away;
  double stiffness = 0.0;  // N/m
  double limit = 0.0;      // N
};

struct BladeData {
  double sharpness = 0.0;
  std::vector<BladeSample> samples;
  BodyData* holder = nullptr;
  math::Vec3 force_world;
  // Of the tissue that is being stepped: its springs, [first, last).
  std::size_t first_spring = 0, last_spring = 0;

  void forget(const TissueData* tissue);  // null: all
};

// Springs between tissue and the places of the edge; where they go on through it.
void add_blade(TissueData& tissue, BladeData& blade, double h);
void sum_force(const TissueData& tissue, BladeData& blade);
// Opens what the edges crossed in this step; true: something, and its points went to the surface of the cut.
bool cut(TissueData& tissue);

}  // namespace ambf::physics::detail
