// A needle, which sews tissue (docs/tissue.md, Sewing). Its tip takes the face that it presses on along; above its
// puncture force it goes through, and on through what lies behind. Where it went, punctures hold its arc: points of the
// tissue that slide along it with friction. What its rear passes is handed to the thread that it draws: stitches, which
// the thread slides through with friction, and which it pulls together (soft/stitches.cpp). The bodies feel all of that
// in the same step. Made off the physics thread; once in a world only the physics thread may call anything here. SI
// units, world axes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "math/types.h"
#include "physics/body.h"
#include "physics/soft_body.h"

namespace ambf::physics {

class Thread;
class World;

namespace detail {
struct NeedleData;
}

struct NeedleOptions {
  // m, body frame, from the tip to the rear. Two places: straight; three: the arc of a circle through them; more: a
  // polyline.
  std::vector<math::Vec3> arc;
  double puncture_force = 0.2;  // N, >= 0
  double friction = 10.0;       // N for each m of needle or thread in tissue, >= 0
  double strength = 5.0;        // N, across the needle, or of the thread's pull: a puncture tears out beyond it
};

// One on a surface, where the needle or its thread goes in or comes out.
struct SurfacePuncture {
  const SoftBody* body = nullptr;
  std::size_t node = 0;    // of it, the nearest
  math::Vec3 needle;       // m, where the needle or the thread goes through it
  math::Vec3 force_world;  // N, on the tissue in the last step
  double thread = -1.0;    // m, of the thread from the needle's rear to here; below 0: it is on the needle
  bool out = false;        // the tip came out there; else it went in
  math::Vec3 rest;         // m, where that is in the tissue as loaded, in the soft body's frame
};

class Needle {
 public:
  static constexpr std::size_t kMaxPunctures = 48;  // at once, those within the tissue included
  static constexpr std::size_t kMaxStitches = 96;   // likewise; what more the rear passes is left
  static constexpr std::size_t kMaxKnots = 16;
  static constexpr std::size_t kMaxHolders = 64;  // places where a thread with stitches is held
  static constexpr std::size_t kMaxState = 6 + 8 * (kMaxPunctures + kMaxStitches + kMaxKnots);
  static constexpr std::size_t kMaxInOneBody = 8;  // needles

  explicit Needle(const NeedleOptions& options);
  ~Needle();  // has left its world
  Needle(const Needle&) = delete;
  Needle& operator=(const Needle&) = delete;

  // In the coming steps it sews, on this body of its world; null: it does not, and all punctures are forgotten.
  void use(Body* holder);
  Body* holder() const;
  // The first node of this thread of the same world hangs on the needle's rear, from the next step on; null: none does.
  // Another one than before: stitches are forgotten. Ends when the thread leaves the world. Of several needles that
  // draw one thread it hangs on the one that asked last; where that lets go, on the first of the others. What passes
  // the rear of one without the thread becomes no stitch.
  void draw(Thread* thread);
  math::Vec3 force_world() const;  // N, on the tissue in the last step, by the needle and the thread at its rear
  double length() const;           // m, from the tip to the rear
  std::size_t punctures() const;   // those within the tissue included
  bool tip_inside() const;         // in tissue
  std::size_t stitches() const;    // punctures that the thread goes through, those within the tissue included
  // A knot around all stitches that are in none yet: the thread slides through them no more, and the first and the last
  // come no further apart than they are. False: there are fewer than two, or kMaxKnots.
  bool tie();
  void untie();               // all knots
  std::size_t tied() const;   // stitches that are in knots
  std::size_t bites() const;  // ways of the thread from where it goes in to where it comes out
  // Of the last step: more held the thread than are felt; more passed the rear than there may be stitches.
  bool too_many_holders() const;
  bool too_many_stitches() const;
  // Those of the needle, then those of the thread; the oldest of each first. The next call and the next step end it.
  std::span<const SurfacePuncture> on_surfaces() const;

  // What its next steps depend on, besides its holder.
  void get_state(std::vector<double>& out) const;
  void set_state(World& world, std::span<const double> state);  // what cannot be is left out

  detail::NeedleData& data() const { return *data_; }

 private:
  std::unique_ptr<detail::NeedleData> data_;
};

void add(World& world, Needle& needle);
void remove(World& world, Needle& needle);

}  // namespace ambf::physics
