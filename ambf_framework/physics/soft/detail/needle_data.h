// What a Needle is made of. Private to physics/soft/. Physics thread.
#pragma once

#include <vector>

#include "physics/detail/body_data.h"
#include "physics/needle.h"
#include "physics/soft/detail/thread_data.h"
#include "physics/soft/detail/tissue_data.h"
#include "physics/soft_grip.h"

namespace ambf::physics::detail {

// A place of tissue, which keeps its meaning when the tissue is cut.
struct TissuePlace {
  TissueData* tissue = nullptr;  // null: none
  std::uint32_t element = 0;
  math::Vec3 rest;  // m, where it was as loaded
};

constexpr double kPassed = 1e-5;  // m, beyond an end of the needle: a puncture has left it

// Of a solid, where the needle went in and came out, and between; `through`: of a sheet, both in one.
enum class PunctureKind : std::uint8_t { entry, inner, exit, through };

inline bool goes_in(PunctureKind kind) { return kind == PunctureKind::entry || kind == PunctureKind::through; }
inline bool comes_out(PunctureKind kind) { return kind == PunctureKind::exit || kind == PunctureKind::through; }

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

// A puncture that the needle's rear has passed: the thread slides through it.
struct Stitch {
  TissuePlace at;
  PunctureKind kind = PunctureKind::inner;
  double s = 0.0;          // m, of the thread from its first node to here
  std::uint32_t knot = 0;  // 0: it is in none
  std::size_t node = 0;    // the nearest
  math::Vec3 force_world;  // N, on the tissue in the last step
  // Of a step, as it begins.
  TissuePoint point;
  math::Vec3 world, velocity;
  double friction = 0.0;  // N
  double before = 0.0;    // m, s, while it is tried how far the thread would slide
  bool lost = false;      // at its end
};

struct Knot {
  std::uint32_t number = 0;
  double length = 0.0;  // m, of the loop between its first and its last stitch
};

// What holds a place of the thread in a step: the needle's rear, grips, bodies that it hangs on.
struct ThreadHolder {
  double s = 0.0;  // m
  math::Vec3 world, velocity;
  BodyData* body = nullptr;  // null: the world
  double softness = 0.0;     // m/N
  double max_force = 0.0;    // N
  HeldNode* held = nullptr;
};

// Thread between two places, of which one or both are stitches.
struct ThreadSpan {
  Stitch *front = nullptr, *back = nullptr;  // null: the holder
  const ThreadHolder* holder = nullptr;
  double free = -1.0;                                       // m, of a knot's loop; below 0: as far as the two are apart
  math::Vec3 normal;                                        // from front to back
  double distance = 0.0, predicted = 0.0, stiffness = 0.0;  // m, as the step begins and, maybe, ends; N/m
  double before = 0.0, after = 0.0;  // m, of thread in it, before and after it slides in the step
  // What the step's spring is to be: along and across the normal.
  double pull = 0.0, along = 0.0, across = 0.0;  // N, N/m
  // Of the tissue that is being stepped: what it became there; npos: nothing.
  std::size_t link = 0, front_spring = 0, back_spring = 0;
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

  ThreadData* thread = nullptr;  // that hangs on its rear
  std::vector<Stitch> stitches;  // the newest first, as they come along the thread
  std::vector<Knot> knots;
  // Of a step.
  std::vector<ThreadHolder> holders;
  std::vector<ThreadSpan> spans;
  bool holder_left_out = false, stitch_left_out = false;

  // Before the tip and behind the rear it goes straight on.
  math::Vec3 place(double s) const;
  math::Vec3 tangent(double s) const;  // unit, to the rear
  // Of the places that are no further than `reach` from s along the needle, the nearest to a point in the body frame.
  double nearest(const math::Vec3& point, double s, double reach) const;
  void forget(const TissueData* tissue);  // null: all
  void forget_tip();
  void hang_thread() const;       // on this one, if another needle had it, too
  void take_free_thread() const;  // which hangs on nothing
  bool has_thread() const { return thread != nullptr && thread->needle == this; }
  void leave_thread();  // its stitches are forgotten
  bool has_knot(std::uint32_t number) const;
  void lose_stitches();  // those marked so, and knots around none; a knot that loses an end is as long as it is now
};

bool is_near_needle(const TissueData& tissue, const NeedleData& needle);
// Moves punctures along, makes and ends them; springs between them and the needle.
void add_needle(TissueData& tissue, NeedleData& needle, double h);
void sum_force(const TissueData& tissue, NeedleData& needle);

// Stitches (stitches.cpp). As a step begins: where they are, what holds the thread, and how far it slides through them.
void begin_stitches(NeedleData& needle, double h);
// Whether stitches bear what pulls at that node.
bool is_beside_stitches(const NeedleData& needle, const HeldNode& held);
void add_stitches(TissueData& tissue, NeedleData& needle, double h);
void sum_stitches(TissueData& tissue, NeedleData& needle, double h);
// As it ends: what tears out, and what the needle's rear has passed.
void end_stitches(NeedleData& needle);

TissuePoint point_of(const TissuePlace& at);
math::Vec3 now(const TissuePlace& at);
std::size_t nearest_node(const TissueData& tissue, const math::Vec3& rest);

}  // namespace ambf::physics::detail
