// What a SoftBody is made of. Private to physics/soft/. Physics thread once in a world.
#pragma once

#include <BulletSoftBody/btSoftBody.h>

#include <array>
#include <memory>
#include <vector>

#include "physics/detail/bullet.h"
#include "physics/soft/detail/link_touch.h"
#include "physics/soft/detail/node_runs.h"
#include "physics/soft/detail/point_cells.h"
#include "physics/soft/detail/ray_faces.h"
#include "physics/soft/detail/soft_sleep.h"
#include "physics/soft_body.h"
#include "physics/soft_grip.h"

namespace ambf::physics::detail {

struct BodyData;
struct SoftGripData;
struct TissueData;

// The spring of a held node in the step that is being made (held_nodes.cpp). World axes.
struct HeldSpring {
  btVector3* x;        // m, of the node as it is being solved
  const btVector3* q;  // m, of the node as the step began
  double inverse_mass;
  BodyData* holder;  // null: held in the world
  HeldNode* held;
  btVector3 place, lever;  // m, from the holder's COM: where it is held, and where the node is; else from the origin
  double max_force;        // N
  double stiffness;        // N/m, damping included
  btVector3 from_damping;  // N, of the gap as the step began
  btMatrix3x3 share;       // of what is missing of the force, that a pass adds
  btVector3 force{0, 0, 0};
};

// Of a soft body whose step is ours (link_step.cpp).
struct CloseLink {
  std::uint32_t a, b;  // nodes
  double yield, rest;  // Bullet's m_c0: both inverse masses by the stiffness; m^2, of its length at rest
};

// Of a node with a body, as btSoftBody::RContact is; most are with bodies that no push moves.
struct NodeContact {
  std::uint32_t node;
  std::int32_t moving;  // in SoftData::moving_contacts; -1: the body is static
  btVector3 normal;
  btVector3 carried;  // m, the way of a static body's surface in the step
  double offset;      // m, of the surface along the normal
  double impulse;     // Ns/m, of a node on a static body
  double yield, slip, hardness;
};

struct MovingContact {
  btRigidBody* rigid;
  btVector3 lever;
  btMatrix3x3 impulse;
};

struct SoftData : RayFaces {
  SoftData(const SoftDefinition& given, const SoftBody& owner);

  const SoftBody* owner;

  std::vector<btVector3> rest;  // m, body frame
  // As given: Bullet shuffles its own where constraints are randomized.
  std::vector<std::array<std::uint32_t, 3>> faces;
  std::vector<std::uint32_t> fixed;
  std::vector<int> collision_groups;
  btTransform T_world_loaded;
  double total_mass;                 // kg, before nodes were fixed
  std::vector<double> mass_of_node;  // likewise
  btVector3 rest_centre{0, 0, 0};
  btSoftBodyWorldInfo surroundings;  // of this body alone
  std::unique_ptr<btSoftBody> soft;
  bool frozen = false;
  bool carried = false;  // in the next step
  btTransform carried_to;
  double max_carried_speed = 0.0;         // m/s
  std::vector<btVector3> last_good;       // positions before the last step
  btVector3 low{0, 0, 0}, high{0, 0, 0};  // around all nodes of this step, margin included
  std::vector<btVector3> now;             // m, positions: Bullet's own lie far apart
  std::vector<btVector3> velocity;        // m/s, likewise
  std::vector<double> inverse_mass;       // 1/kg, likewise
  NodeRuns runs;                          // as of find_bounds() or, in the step, of its beginning

  // No more than links, contacts of nodes and what holds them: then the step is made by link_step.cpp, with Bullet's
  // numbers, from `now`, `velocity`, `inverse_mass` and `links`; `contacts` are those of the step. Of Bullet's nodes
  // only forces are read: they stay where they were loaded.
  bool is_plain = false;
  std::vector<CloseLink> links;
  std::vector<NodeContact> contacts;
  std::vector<MovingContact> moving_contacts;
  bool pushed = true;              // forces act on nodes in the next step
  double speeds2 = 0.0;            // m^2/s^2, the sum of all squares; infinite: unknown
  double impulse_of = -1.0;        // 1/kg: the inverse mass of the node that the next is of
  double impulse_on_static = 0.0;  // Ns/m, of a contact with what does not move, in this step

  // With tissue. What it was given last is what it is given while this sleeps.
  std::vector<FaceContact> on_tissue;
  static constexpr std::size_t kHolds = 2;
  std::vector<LinkHold> holds;               // of each node, on so many tissues
  std::vector<NearFace> near_tissue;         // of each node; room of a search
  PointCells cells;                          // likewise
  std::vector<double> face_size;             // m, the longest edge as loaded
  bool was_held = true, may_be_held = true;  // as the step begins, and after it: some hold is somewhere

  void find_bounds();

  // Whether all nodes hang together by links, and all faces over edges: Bullet's way to make trees ends only then.
  bool nodes_are_one_piece = true, faces_are_one_piece = true;

  std::vector<SoftGripData*> grips;  // that hold nodes, in the order in which they began to
  std::vector<HeldSpring> springs;   // of the step that is being made

  SoftSleep sleep;
  bool touched_moving = false;  // in the last step: a body that its push moves

  bool meets_bodies_by_nodes() const;
  bool meets_bodies_by_clusters() const;
  bool meets_soft_bodies() const;
  bool meets(const TissueData& tissue) const;  // wherever both are
  bool touches(const TissueData& tissue) const;
  void make_room_for_touches();
  LinkHold* hold_of(std::size_t node, const TissueData* tissue);  // null: one that is free; null if there is none
  void forget(TissueData& tissue);                                // it goes
  void end_touches();                                             // of the step
  void let_go(TissueData* tissue);                                // of what is held there; null: of all its nodes
  void forget_contacts();  // they name bodies, which may be gone before the next step
  void begin_step(double h, const btVector3& gravity);
  void end_step(double h);
  void stop();           // no node has a velocity
  void follow_bullet();  // `now` and `velocity`
  void find_pieces();
  void restart_bullet();  // trees, normals, joints of clusters; `now` and `velocity` follow
  void place(std::size_t node, const btVector3& at, const btVector3& speed);  // without a force; restart() follows
  void gather_links(const SoftDefinition& given);
  void restart();  // as if new, but for the nodes' positions and velocities
};

// Of its parts (soft_parts.cpp): what each node weighs, kg, and links as stiff as those say.
std::vector<double> masses_of_parts(const SoftDefinition& given);
void stiffen_parts(btSoftBody& soft, const SoftDefinition& given);

}  // namespace ambf::physics::detail
