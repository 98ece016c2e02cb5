// Soft bodies as all threads see them: nodes, whose positions are rows of a column of frames, and a skin that says
// where drawn vertices are on them. Plain data, read by any thread. C++17.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "state/command.h"
#include "state/kind_rows.h"

namespace ambf::state {

// A drawn vertex on a triangle of nodes (EQUATIONS 16): weight[0] x_a + weight[1] x_b + weight[2] x_c + height n, with
// the triangle's unit normal n.
struct SkinVertex {
  std::array<std::uint32_t, 3> node{};  // of this body
  std::array<float, 3> weight{1.0F, 0.0F, 0.0F};
  float height = 0.0F;  // m
};

// Between two nodes of this body, as loaded; without the ones that `bending constraint` adds.
struct SoftLink {
  std::array<std::uint32_t, 2> node{};
  float length_m = 0.0F;
};

// Vertices of a drawn thread around each node; behind those of all nodes come one at either end.
inline constexpr std::size_t kTubeSides = 8;

// Never changes while the body is loaded.
struct SoftShape {
  std::vector<std::array<std::uint32_t, 3>> faces;  // of nodes
  std::vector<std::array<std::uint32_t, 2>> lines;  // links that are no edges of faces
  std::vector<SoftLink> links;                      // edges of faces, and lines; each once
  float tube_radius_m = 0.0F;    // above 0: a thread; what is drawn is a tube about its nodes, of kTubeSides each
  std::vector<SkinVertex> skin;  // vertices of all parts' submeshes of the appearance, in order
};

struct SoftBodyInfo : PlacedInfo {
  std::shared_ptr<const mesh::Appearance> appearance;  // as loaded; null: nothing is drawn
  std::shared_ptr<const SoftShape> shape;
  std::uint32_t first_node = 0, nodes = 0;  // rows of the column of nodes
  std::vector<bool> fixed;                  // of each node, whether only pose commands move it
  double mass = 0.0;                        // kg, of the nodes that are not fixed
  std::uint32_t saved = 0;                  // numbers of its saved state
  std::vector<std::string> attach_to;       // tissue: names of bodies that it grows on
  std::vector<std::uint32_t> attached;      // their slots; kNone: it is not there
};

// The pose is that of the centre of all nodes, turned as fits them best.
struct SoftBodyState : PlacedState {
  bool frozen = false;  // it diverged
};

struct SoftNode {
  math::Vec3 position_world;  // m
};

template <class Visit>
void visit_computed(SoftBodyState& row, Visit& visit) {
  visit(row.T_parent_object), visit(row.T_world_object);
}
template <class Visit>
void visit_computed(SoftNode& row, Visit& visit) {
  visit(row.position_world);
}

// A soft body that a pointer holds.
struct SoftPick {
  std::uint32_t picker = 0;         // PickPort::id()
  std::uint32_t soft_body = kNone;  // slot
  math::Vec3 point_world;           // where it is held: the middle of the nodes that are
  math::Vec3 target_world;          // where that point is pulled to
  math::Vec3 force_world;           // N, on it in the last step
};
template <class Visit>
void visit_computed(SoftPick& row, Visit& visit) {
  visit(row.point_world), visit(row.target_world), visit(row.force_world);
}

struct NodeForce {
  std::uint32_t node = 0;  // of this body
  math::Vec3 force_world;  // N
};

// In force until replaced, or ended by its watchdog.
struct SoftBodyCommand {
  math::Wrench wrench_world;  // at the centre of the nodes that are not fixed
  bool carries = false;
  math::Pose T_world_body;  // carries: where fixed nodes go; the body frame is that of its file
  std::vector<NodeForce> node_forces;
};

// Why a command to a body of so many nodes was refused; empty: it is fit to act on. A quaternion is normalised in
// place.
std::string check(SoftBodyCommand& command, std::size_t nodes);

const PlacedKind<SoftBodyState>& soft_body_kind();
const std::vector<SoftBodyInfo>& soft_bodies(const Structure& structure);

// Of one body; both null where the frame has none (a diverged world, new structure).
struct NodeRange {
  const SoftNode* first = nullptr;
  const SoftNode* last = nullptr;
  const SoftNode* begin() const { return first; }
  const SoftNode* end() const { return last; }
  const SoftNode& operator[](std::size_t node) const { return first[node]; }
  std::size_t size() const { return static_cast<std::size_t>(last - first); }
};
NodeRange nodes_of(const Frame& frame, std::uint32_t soft_body_slot);

// By picker.
const std::vector<SoftPick>& soft_picks(const Frame& frame);
std::vector<SoftPick>& soft_picks(Frame& frame);

// All rows, for the physics thread to fill: at most their vector's capacity.
std::vector<SoftNode>& soft_nodes(Frame& frame);

}  // namespace ambf::state
