// What a Needle is made of. Private to physics/soft/. Physics thread.
#pragma once

#include <vector>

#include "physics/detail/body_data.h"
#include "physics/needle.h"
#include "physics/soft/detail/tissue_data.h"

namespace ambf::physics::detail {

// A place of tissue, which keeps its meaning when the tissue is cut.
struct TissuePlace {
  TissueData* tissue = nullptr;  // null: none
  std::uint32_t element = 0;
  math::Vec3 rest;  // m, where it was as loaded
};

enum class PunctureKind : std::uint8_t { entry, inner, exit };

struct Puncture {
  TissuePlace at;
  PunctureKind kind = PunctureKind::inner;
  double stuck = 0.0;    // m, along the needle from its tip: where friction holds it
  double now = 0.0;      // m, likewise, where it is
  std::size_t node = 0;  // the nearest
  // Of a step.
  std::size_t spring = 0;
  bool has_spring = false;
  math::Vec3 needle, force_world;
};

// unknown: until it has been outside of all tissue, a tip that may be anywhere punctures nothing.
enum class TipState : std::uint8_t { unknown, outside, touching, inside };

struct NeedleData {
  NeedleOptions options;
  // The arc as a polyline, body frame: where its corners are, how far along, and its direction there, to the rear.
  std::vector<math::Vec3> corner, direction;
  std::vector<double> along;
  double length = 0.0;

  BodyData* holder = nullptr;
  std::vector<Puncture> punctures;  // the oldest first: the nearest to the rear
  TipState tip = TipState::unknown;
  TissuePlace tip_at;  // what it presses on or is in
  bool seen_inside = false;
  math::Vec3 force_world;
  std::size_t first_spring = 0, last_spring = 0;  // of the tissue that is being stepped
  std::vector<SurfacePuncture> on_surfaces;

  // Before the tip and behind the rear it goes straight on.
  math::Vec3 place(double s) const;
  math::Vec3 tangent(double s) const;  // unit, to the rear
  // Of the places that are no further than `reach` from s along the needle, the nearest to a point in the body frame.
  double nearest(const math::Vec3& point, double s, double reach) const;
  void forget(const TissueData* tissue);  // null: all
  void forget_tip();
};

bool is_near_needle(const TissueData& tissue, const NeedleData& needle);
// Moves punctures along, makes and ends them; springs between them and the needle.
void add_needle(TissueData& tissue, NeedleData& needle, double h);
void sum_force(const TissueData& tissue, NeedleData& needle);
std::size_t nearest_node(const TissueData& tissue, const math::Vec3& rest);

}  // namespace ambf::physics::detail
