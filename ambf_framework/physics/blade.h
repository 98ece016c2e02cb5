// The edge of a blade, which cuts tissue (docs/tissue.md, Cutting). Each place of the edge takes along the tissue that
// it is in; where that would need more than the sharpness, it moves on through the tissue, and what its way crosses is
// cut. The body feels what holds the edge back. Made off the physics thread; once in a world only the physics thread
// may call anything here. SI units, world axes.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "math/types.h"
#include "physics/body.h"

namespace ambf::physics {

class World;

namespace detail {
struct BladeData;
}

struct BladeOptions {
  std::vector<math::Vec3> edge;  // m, body frame: at least two, of a polyline
  double sharpness = 0.0;        // N for each m of edge in tissue, >= 0
};

class Blade {
 public:
  static constexpr std::size_t kMaxSamples = 96;  // places of the edge that are followed
  static constexpr std::size_t kMaxState = 6 * kMaxSamples;

  explicit Blade(const BladeOptions& options);
  ~Blade();  // has left its world
  Blade(const Blade&) = delete;
  Blade& operator=(const Blade&) = delete;

  // In the coming steps it cuts, by this body of its world; null: it does not, and forgets where it was.
  void use(Body* holder);
  Body* holder() const;
  math::Vec3 force_world() const;   // N, on the tissue in the last step
  double length_in_tissue() const;  // m

  // Where its edge is in tissue: what its next steps depend on, besides its holder.
  void get_state(std::vector<double>& out) const;
  void set_state(World& world, std::span<const double> state);  // of another size or of other tissue: as if not in any

  detail::BladeData& data() const { return *data_; }

 private:
  std::unique_ptr<detail::BladeData> data_;
};

void add(World& world, Blade& blade);
void remove(World& world, Blade& blade);

}  // namespace ambf::physics
