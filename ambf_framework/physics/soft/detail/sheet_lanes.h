// The triangles of a sheet as its solver reads them: four beside each other, one number of each a lane (lanes.h), and
// what they do to corners. Private to physics/soft/. Physics thread once in a world.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "math/types.h"
#include "physics/detail/lanes.h"

namespace ambf::physics::detail {

struct SheetLanes {
  static constexpr std::size_t kCount = 4;  // of triangles beside each other
  using Four = std::array<double, kCount>;
  using Numbers = std::array<std::uint32_t, kCount>;
  using Four3 = std::array<Four, 3>;

  // What the solver reads of four triangles in each iteration. The last four of a sheet may be fewer: what is left is
  // at corner 0 and does nothing. Slots are edges of triangles, each by the corner opposite to it.
  struct alignas(sizeof(Four)) Hot {
    std::array<Numbers, 3> corner;
    std::array<Numbers, 3> beyond;  // the slot of the triangle beyond that edge; no_slot(): there is none
    Four3 along, across, normal;    // x y z of the axes of its plane, turned with it; unit
    Four ax, ay, by;                // 1/m: gradients of corner 1, and of corner 2, which has none along
    Four shear, even;               // N m: stress by strain, and by the sum of strains, times volume
    Four3 taut;                     // N/m: by what it is stretched, corners resist to leave its plane: 11, 12, 22
    // 1/m: its share of the angle at each edge, by how far corners 1 and 2 leave its plane beyond what corner 0 does.
    std::array<std::array<Four, 2>, 3> turn;
    std::array<Four, 6> moment;  // N m: at its edges by their angles: 00, 11, 22, 01, 12, 20
  };
  // What a step reads once.
  struct alignas(sizeof(Four)) Cold {
    Four3 side;     // of each edge; -1: the triangle sees it bend from behind
    Four3 relaxed;  // xx yy xy: strain that no longer bears its stress, in the plane
    Four plain;     // 1: as it is, it has an area; 0: it has none, and no say
  };
  // Four edges that two triangles share, seen by the way round of the first. What is left of the last four is open.
  struct alignas(sizeof(Four)) Hinges {
    std::array<Numbers, 2> corner;          // of the edge
    std::array<Numbers, 2> triangle, slot;  // of either
    Four side;                              // of the second; -1: it sees them bend from behind
    Four angle;                             // rad, as at rest
    Four relaxed;                           // of what they bend by
    Four closed;                            // 0: cut
  };
  // Rooms of a pass.
  struct alignas(sizeof(Four)) Room {
    std::array<Four3, 2> force;  // N: x y z of that from outside, on corners 1 and 2
  };
  struct alignas(sizeof(Four)) Edges {
    Four3 at;  // by slots
  };
  // How strain relaxes: the share of what is missing that does in this step, and of what did that bears no stress.
  struct Relaxing {
    double pace, memory;  // memory 0: it does not
  };

  void resize(std::size_t triangles);
  std::uint32_t slot(std::size_t triangle, std::size_t edge) const {
    return static_cast<std::uint32_t>((triangle / kCount * 3 + edge) * kCount + triangle % kCount);
  }
  std::uint32_t no_slot() const { return static_cast<std::uint32_t>(3 * kCount * hot.size()); }
  math::Vec3 normal_of(std::size_t triangle) const;
  // Of the next hinge, by the triangle and its edge on both sides.
  void add_hinge(const std::array<std::uint32_t, 2>& triangle, const std::array<std::uint32_t, 2>& edge, double side);
  void set_rest_angles(const math::Vec3* x);  // once hinges have their corners: where nothing bends

  void turn_to(const math::Vec3* x, const Relaxing& relaxing);  // where corners are
  void pull(math::Vec3* to);                                    // after turn_to(): what corners feel is added
  // What they feel by displacements, as turn_to() left it; `taut` times what tension does.
  void stretch(const math::Vec3* u, double taut, math::Vec3* to);

  std::vector<Hot> hot;
  std::vector<Cold> cold;
  std::vector<Hinges> hinges;
  std::vector<Room> rooms;
  // And 0 behind all. The angle at an edge is the sum of what is at its two slots, and so is the moment.
  std::vector<Edges> bends, moments;
  std::size_t count = 0, hinge_count = 0;
  std::size_t apart = 0;  // fours between neighbours, at most
  bool wide = has_wide_vectors();

 private:
  template <class T>
  void turn_by(const math::Vec3* x, const Relaxing& relaxing);
  template <class T>
  void bend_by(const math::Vec3* x, const Relaxing& relaxing);
  template <class T>
  void stretch_four(std::size_t n, const math::Vec3* u, double taut);
  template <class T>
  void bear_four(std::size_t n);
  template <class T>
  void pull_four(std::size_t n, std::size_t some, math::Vec3* to);
  template <class T>
  void pass_by(const math::Vec3* u, double taut, math::Vec3* to);  // null: by `bends` and `rooms` as they are
  void turn_wide(const math::Vec3* x, const Relaxing& relaxing);
  void pass_wide(const math::Vec3* u, double taut, math::Vec3* to);
  void leave_out_flat();
};

}  // namespace ambf::physics::detail
