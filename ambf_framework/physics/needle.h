// A needle, which sews tissue (docs/tissue.md, Sewing). Its tip takes the face that it presses on along; above its
// puncture force it goes through, and on through what lies behind. Where it went, punctures hold its arc: points of the
// tissue that slide along it with friction. The body feels all of that in the same step. Made off the physics thread;
// once in a world only the physics thread may call anything here. SI units, world axes.
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

class World;

namespace detail {
struct NeedleData;
}

struct NeedleOptions {
  // m, body frame, from the tip to the rear. Two places: straight; three: the arc of a circle through them; more: a
  // polyline.
  std::vector<math::Vec3> arc;
  double puncture_force = 0.2;  // N, >= 0
  double friction = 10.0;       // N for each m of needle in tissue, >= 0
  double strength = 5.0;        // N, across the needle: a puncture tears out beyond it
};

// One on a surface, where the needle went in or came out.
struct SurfacePuncture {
  const SoftBody* body = nullptr;
  std::size_t node = 0;    // of it, the nearest
  math::Vec3 needle;       // m, where the needle goes through it
  math::Vec3 force_world;  // N, on the tissue in the last step
};

class Needle {
 public:
  static constexpr std::size_t kMaxPunctures = 48;  // at once, those within the tissue included
  static constexpr std::size_t kMaxState = 6 + 8 * kMaxPunctures;

  explicit Needle(const NeedleOptions& options);
  ~Needle();  // has left its world
  Needle(const Needle&) = delete;
  Needle& operator=(const Needle&) = delete;

  // In the coming steps it sews, on this body of its world; null: it does not, and all punctures are forgotten.
  void use(Body* holder);
  Body* holder() const;
  math::Vec3 force_world() const;  // N, on the tissue in the last step
  double length() const;           // m, from the tip to the rear
  std::size_t punctures() const;   // those within the tissue included
  bool tip_inside() const;         // in tissue
  // The oldest first; the next call and the next step end it.
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
