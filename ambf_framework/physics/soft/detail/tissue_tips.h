// Corners, edges and tips of bodies that touch faces of tissue between its points (tissue_tips.cpp): points of tissue
// meet bodies in tissue_step.cpp. Private to physics/soft/. Physics thread once in a world.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "physics/detail/bullet.h"
#include "physics/meshes/surface_tips.h"
#include "physics/tissue.h"

namespace ambf::physics::detail {

struct BodyData;
struct TissueData;

// A place of a body that touches a face. It stays on the side of the face that it came from, however deep it is pushed.
struct BodyTip {
  const BodyData* body = nullptr;
  std::uint64_t number = 0;
  btVector3 normal;  // unit, from the tissue to the body
  std::uint32_t face = 0;
  std::array<double, 3> share{};  // of the face's points, where it touches
  // Where friction pulls it back to (EQUATIONS 17).
  std::uint32_t stuck_face = 0;
  std::array<double, 3> stuck{};
  bool renewed = false;  // in this step
};

struct TipRooms {
  static constexpr std::size_t kMaxPlaces = 1024;  // of all bodies that are looked at in a step

  explicit TipRooms(const TissueGrid& grid);
  void let_go(const BodyData* body);  // null: all

  std::vector<BodyTip> tips;
  bool left_out = false;  // there was no room for a tip, or to look at one

  // Rooms of a step.
  // Of a place the face that it touches, or may touch.
  struct Best {
    std::uint32_t face = 0;
    std::array<double, 3> share{};
    double full = 0.0;      // 0 to 1: less beside the face; 0: there is none
    double distance = 0.0;  // m: the smaller, the better
    double side = 0.0;      // 1: it is, or came from, in front of the face; -1: behind
    double above = 0.0;     // m, out of the face on that side
  };
  struct Place {
    BodyData* body = nullptr;
    btVector3 at, moves;  // m, world: where it is, and goes in the coming step
    double radius = 0.0;
    std::uint64_t number = 0;
    std::size_t known = 0;  // of `tips`; beyond them: it touched nothing before
    btVector3 touched;      // m, world, where it did
    Best best;
    bool touches = false;
  };
  struct Met {
    std::size_t tip = 0, place = 0;
    double depth = 0.0, full = 0.0;  // m
    double stiffness = 0.0;          // N/m
  };
  struct Made {
    std::size_t touch = 0;  // of TouchRooms::made
    BodyData* body = nullptr;
    math::Vec3 force;  // N, on the tissue
  };
  // Faces that follow each other, and a box around them.
  struct Run {
    btVector3 low, high;                // m, world, if `runs_known`
    std::vector<std::uint32_t> points;  // of its faces, each once
  };
  static constexpr std::size_t kRun = 16;  // faces
  bool runs_known = false;                 // of this step
  std::vector<Run> runs;
  std::vector<std::uint32_t> near_run;  // of the places of one body, those that one is near
  std::vector<SurfaceTip> surface;
  std::vector<Place> places;                  // body by body, along x
  std::vector<Met> met;                       // of one body
  std::vector<Made> made;                     // of the step; of solids
  std::uint64_t counted = ~std::uint64_t{0};  // the count of moves that `normal` is of
  std::vector<btVector3> normal;              // of the surface at each point, by the first point at that place
  std::vector<std::uint32_t> stands_for;
};

// How far a body goes at most within a step of h seconds by its velocity, m.
double way_of(const BodyData& body, double h);
// Which of a body's corners, edges and tips touch; fills `tips.met`. The body has the velocity expected of it.
void find_tips(TissueData& tissue, BodyData& body, double h);
// Springs for them.
void add_tips(TissueData& tissue, BodyData& body, double h);
// When the step is done: the opposite forces on bodies; what no longer touches is forgotten, and what went through a
// face touches it from now on.
void end_tips(TissueData& tissue, double h);

}  // namespace ambf::physics::detail
