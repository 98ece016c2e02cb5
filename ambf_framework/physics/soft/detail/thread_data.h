// What a Thread is made of. Private to physics/soft/. Physics thread once in a world.
#pragma once

#include <array>
#include <vector>

#include "physics/detail/bullet.h"
#include "physics/soft/detail/near_shape.h"
#include "physics/soft/detail/ray_faces.h"
#include "physics/soft/detail/thread_chain.h"
#include "physics/thread.h"

namespace ambf::physics::detail {

struct BodyData;
struct NeedleData;
struct SoftGripData;

// How far what touches a body has been drawn away across it from where it stuck (EQUATIONS 17). Not a place: where a
// segment touches wanders along it.
struct ThreadHold {
  const BodyData* body = nullptr;  // null: it does not
  btVector3 away{0, 0, 0};         // m, in the body's COM frame
  bool renewed = false;            // in this step
};

// Nodes that hang on a body.
struct ThreadAttachment {
  std::vector<std::uint32_t> nodes;
  Body* body = nullptr;           // null: on none
  std::vector<btVector3> places;  // in the body's COM frame
};

struct ThreadData : RayFaces {
  ThreadData(const ThreadDefinition& given, const SoftBody& owner);

  static constexpr std::size_t kHolds = 2;    // bodies that a node or a segment may touch
  static constexpr std::uint32_t kBlock = 8;  // segments of a block

  const SoftBody* owner;
  ThreadChain chain;
  std::vector<math::Vec3> rest;  // nodes, body frame
  math::Pose T_world_loaded;
  double radius, margin, friction;          // margin: with the radius
  double rest_length = 0.0, longest = 0.0;  // m; of all, of a segment
  std::vector<double> along;                // m, of the thread from its first node to each
  std::vector<std::uint32_t> fixed;
  std::vector<std::array<std::uint32_t, 3>> faces;
  std::vector<int> collision_groups;
  std::vector<ThreadAttachment> attachments;  // the last one: the first node, by attach_first()
  std::vector<double> contact_stiffness;      // N/m, of each node, then of each segment
  const NeedleData* needle = nullptr;         // on whose rear the first node hangs
  double node_stiffness;                      // N/m, of an attachment
  bool touches_itself, touches_others;        // threads
  std::uint64_t restarts = 0;
  bool crossings_left_out = false;
  std::size_t crossings = 0;  // of the last step
  bool frozen = false;
  bool carried = false;  // in the next step
  math::Pose carried_to;
  double max_carried_speed = 0.0;                     // m/s
  std::vector<math::Vec3> last_good;                  // positions before the last step
  std::vector<std::array<ThreadHold, kHolds>> holds;  // of each node, then of each segment
  std::vector<SoftGripData*> grips;                   // that hold nodes (held_nodes.h)
  std::vector<ThreadSpring> asked;                    // of the coming step
  std::vector<math::Vec3> answered;                   // N, of the last step, for each that was asked for
  std::size_t contacts = 0;                           // of the last step

  // Rooms of a step.
  struct Contact {
    std::uint32_t of;  // a node, or the count of nodes and a segment
    ThreadPoint point;
    btVector3 normal;  // out of the body, world
    double depth;      // m, below the margin
  };
  std::vector<btVector3> at;              // of each node
  btVector3 low{0, 0, 0}, high{0, 0, 0};  // around all nodes, margin included
  // Of kBlock segments each; none: no threads touch it.
  struct Block {
    std::uint32_t first, last;  // segments, the last one excluded
    Box box;
    double way;  // m, that a node of it moves at most within the step
  };
  std::vector<Block> blocks;
  std::vector<Contact> found;  // of one body
  std::vector<ThreadPull> pulls;
  std::size_t first_held = 0;            // of these, the first of a held node
  std::vector<BodyData*> pulled;         // the body of each pull; null: none
  std::vector<ThreadHold*> pulled_hold;  // of contacts; null: of others
  std::vector<math::Vec3> pull_force;    // N, on the thread

  void restart();  // as if new, but for the nodes
  void forget(const BodyData& body);
  void place_attachment(ThreadAttachment& attachment);
  void move_fixed(double h);
  void locate();                              // `at`, `low` and `high`
  void sweep_blocks(double slack, double h);  // thread_tangles.cpp: m, more than at its speed
  void find_bounds();                         // as SoftData has it; `at` is where nodes are now
  ThreadPoint point_of(std::size_t node) const {
    return node + 1 < rest.size() ? ThreadPoint{static_cast<std::uint32_t>(node), 0.0}
                                  : ThreadPoint{static_cast<std::uint32_t>(node - 1), 1.0};
  }
  // Whether that point hangs so near on the body that it does not touch it.
  bool hangs_on(const ThreadPoint& point, const BodyData& body) const;
};

}  // namespace ambf::physics::detail
