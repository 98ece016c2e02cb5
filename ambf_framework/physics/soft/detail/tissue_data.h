// What a Tissue is made of. Private to physics/soft/. Physics thread once in a world.
#pragma once

#include <array>
#include <vector>

#include "physics/detail/bullet.h"
#include "physics/soft/detail/link_touch.h"
#include "physics/soft/detail/point_cells.h"
#include "physics/soft/detail/ray_faces.h"
#include "physics/soft/detail/sheet_rims.h"
#include "physics/soft/detail/soft_sleep.h"
#include "physics/soft/detail/tissue_cuts.h"
#include "physics/soft/detail/tissue_solid.h"
#include "physics/soft/detail/tissue_tips.h"
#include "physics/soft/detail/touch_edges.h"
#include "physics/tissue.h"

namespace ambf::physics::detail {

struct BladeData;
struct BodyData;
struct NeedleData;
struct SoftGripData;

// Where a point touched a body first: friction pulls it back there (EQUATIONS 17).
struct TissueHold {
  const BodyData* body = nullptr;  // null: it does not
  btVector3 place{0, 0, 0};        // in the body's COM frame
  bool renewed = false;            // in this step
};

// Corners that hang on a body.
struct TissueAttachment {
  std::vector<std::uint32_t> loaded;   // in their order, without copies that cuts make
  std::vector<std::uint32_t> corners;  // copies included
  Body* body = nullptr;                // null: on none
  std::vector<btVector3> places;       // of `corners`, in the body's COM frame
};

// How surfaces of tissue meet each other (tissue_touch.cpp).
struct TouchRooms {
  TouchRooms(const TissueDefinition& given);
  void let_go(const TissueData* tissue);  // null: all
  void stay(const TissueData& faces);     // where they hold, though their corners went there from where `at` has them
  void measure(const TissueGrid& grid);   // its surface, as loaded, cuts included

  bool itself, others;
  // As loaded, body frame.
  std::vector<math::Vec3> face_middle, face_normal, element_middle, point_place;
  std::vector<double> face_radius;  // m
  // Of each point of what cannot be cut the weight, of four, that is all of it: it is at that corner. kNoLone: none is.
  static constexpr std::uint8_t kNoLone = 4;
  std::vector<std::uint8_t> lone;
  // Of points as they are, by cells of element_size. Of points at one corner, of several elements, the first stands for
  // all.
  std::uint64_t counted = ~std::uint64_t{0};  // the count of moves that the next four are of
  std::vector<btVector3> normal;              // out of the tissue
  std::vector<double> area;                   // m^2
  std::vector<std::uint32_t> at_corner;       // the point that stands for it
  PointCells cells;
  // Of one search: the face that a point is the least behind.
  struct Behind {
    std::uint32_t face = 0;
    bool front = true;   // it is on the side of the face that its normal points to
    double way = 0.0;    // m, from the point against its normal to the face
    double depth = 0.0;  // m, along the face's
    double full = 0.0;   // 0 to 1, of the push: less beside the face; 0: it is behind none
    std::array<double, 3> share{};
    btVector3 normal;
    bool rim = false;       // it is pushed out of the face's rim, in the plane of that
    bool entering = false;  // it came over the face from beyond its rim, and is not well over it yet
  };
  std::vector<Behind> behind;  // of each point
  // Of a sheet that touches itself, likewise (rim_touch.cpp): the rim that a point of a rim is the nearest to.
  struct NearRim {
    double distance = -1.0;  // m, along the plane; below 0: there is none
    double depth = 0.0;      // m, how far it is within that rim, beyond what it was as loaded
    double across = 0.0;     // m, from the rim's line
    double above = 0.0;      // m, over its plane
    std::uint32_t face = 0;
    std::uint8_t opposite = 0;  // of the face's corners, to that rim
    std::array<double, 3> share{};
    btVector3 out;
  };
  std::vector<NearRim> near_rims;
  // Where a point touched a face first: friction pulls it back there (EQUATIONS 17).
  struct Hold {
    const TissueData* of = nullptr;  // null: it does not
    std::uint32_t face = 0;
    std::array<double, 3> share{};
    bool front = true;      // of a sheet: on which side
    bool rim = false;       // beyond the face's rim
    bool entering = false;  // as Behind has it
    double above = 0.0;     // m, of a rim: over the face's plane
  };
  std::vector<Hold> holds;        // of each point
  std::vector<TissueTouch> made;  // of the step
  // Of a sheet, of each of these: what of it is of a solid, which feels it in its own step.
  struct Felt {
    TissueData* solid = nullptr;  // null: it does not
    TissueTouch at;
  };
  std::vector<Felt> felt;
  bool left_out = false;  // there was no room for further ones
  SheetRims rims;
  TouchEdges edges;
  // Of one tissue (touch_pairs.cpp): what may touch, by faces, until something has moved far enough.
  struct Pair {
    std::uint32_t face, point;
  };
  bool paired = false;                        // false: to be found anew
  std::vector<PointCells::Sorted> paired_at;  // where points were when they were found
  std::vector<Pair> pairs;
  std::vector<std::uint32_t> paired_points, paired_faces;  // the points, and all faces around them
  std::vector<std::uint8_t> is_paired;                     // of each point
};

// An element that an edge may be in or beside.
struct NearElement {
  std::uint32_t element = 0;
  math::Vec3 corner;       // its first
  math::Vec3 middle;       // of its corners
  math::Vec3 least, most;  // around its corners, from its middle
};

struct TissueData : RayFaces {
  TissueData(const TissueDefinition& given, const SoftBody& owner);

  static constexpr std::size_t kHolds = 2;  // bodies that one point may touch

  const SoftBody* owner;
  TissueGrid grid;
  TissueSolid solid;
  TissueCuts cuts;
  math::Pose T_world_loaded;
  double margin, friction;
  double slab;                          // N/m^3, of a contact
  double corner_stiffness;              // N/m, of a spring that holds a corner
  double thread_stiffness;              // N/m, of thread between two places of it
  std::vector<double> point_stiffness;  // N/m, of a contact
  std::vector<std::uint32_t> fixed;     // corners
  std::vector<int> collision_groups;
  std::vector<TissueAttachment> attachments;
  bool frozen = false;
  bool carried = false;  // in the next step
  math::Pose carried_to;
  double max_carried_speed = 0.0;                     // m/s
  std::vector<math::Vec3> last_good;                  // positions before the last step
  std::vector<std::array<TissueHold, kHolds>> holds;  // of each point
  std::vector<SoftGripData*> grips;                   // that hold points (held_nodes.h)
  std::size_t contacts = 0;                           // of the last step
  double last_step_s = 0.001;
  // Of what can be cut, as loaded: the middles of elements, and of a sheet those of seams, behind them.
  std::vector<math::Vec3> middles;

  // Rooms of a step.
  struct Contact {
    std::uint32_t point;
    btVector3 normal;  // out of the body, world
    double depth;      // m, below the margin
  };
  std::vector<double> of_corner;          // of each corner as something is summed up
  std::vector<btVector3> at;              // of each point
  btVector3 low{0, 0, 0}, high{0, 0, 0};  // around all points, margin included
  std::vector<Contact> found;             // of one body
  std::vector<TissueSpring> springs;
  std::vector<BodyData*> pulled;         // the body of each spring
  std::vector<math::Vec3> spring_force;  // N, on the tissue
  std::vector<TissueLink> links;         // of threads
  TouchRooms touch;
  TipRooms tips;
  SoftSleep sleep;
  // With bodies of links (links/link_touch.cpp).
  std::vector<math::Vec3> hit;       // m/s, by which they move corners in this step; none: none does
  std::vector<LinkHold> link_holds;  // of each point
  std::vector<NearFace> near_links;  // likewise; room of a search
  bool stepped = false;              // in this step of the world
  std::vector<BladeData*> blades;    // that cut in this step
  std::vector<NeedleData*> needles;  // that sew in this step
  std::vector<NearElement> near_elements;
  std::vector<std::uint32_t> near_seams;

  bool is_sheet() const { return !grid.triangles.empty(); }
  void restart();                     // as if new, but for the corners
  void forget(const BodyData& body);  // it goes
  void move_fixed(double h);
  void locate();         // `at`, `low` and `high`
  void follow_cuts();    // after corners were numbered anew
  void follow_points();  // after some went to the surface of a cut from where `at` has them
  void share_area();     // of a sheet's corners among its points
  void find_bounds();    // as SoftData has it; `at` is where points are now
};

// Of its surface with itself, and with that of another tissue, which is as it is now.
void add_touches(TissueData& tissue, double h);
void add_touches(TissueData& tissue, TissueData& other, double h);
// Of a sheet and a solid, those from the `first` on: both are in the sheet's solve, and what the solid is to feel acts
// in its step, which comes later (tissue_sheet_touch.cpp).
void lay_on(TissueData& sheet, TissueData& solid, std::size_t first, double h);
void press_on_solids(TissueData& sheet, double h);

// The stiffness that a spring may have, of `count` between points and a body (tissue_step.cpp).
double held_back_in_all(double stiffness, const BodyData& body, const btVector3& at, double h, std::size_t count);

}  // namespace ambf::physics::detail
