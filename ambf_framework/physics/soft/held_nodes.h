// What holds nodes of a soft body in a step. Private to physics/. Physics thread.
#pragma once

#include <vector>

#include "physics/detail/body_data.h"
#include "physics/soft_grip.h"

namespace ambf::physics::detail {

struct HeldSpring;
struct SoftData;

struct SoftGripData {
  SoftGripOptions options;
  BodyData* holder = nullptr;  // null: it holds nothing, or in the world
  std::vector<HeldNode> held;

  bool take(const WorldData& world, BodyData* by, SoftBody& body, std::size_t node, const math::Vec3& place);
  void release();
  void let_go_of(const SoftBody& body);
};

// Those that hold nodes of a body of any sort, in the order in which they began to.
std::vector<SoftGripData*>& grips_of(const SoftBody& body);
void let_go(const SoftBody& body);  // all of them do
// All that holds nodes of these bodies by this holder lets go.
void release_grips_of(const std::vector<SoftBody*>& bodies, const BodyData& holder);
// Whether this node does not meet that body: it is held there, or by a body that a joint connects to it.
bool held_off(const std::vector<SoftGripData*>& grips, const SoftBody& soft, std::size_t node, const BodyData& body);
// The springs of all nodes that are held, for this step.
void make_springs(SoftData& data, double h);
// Adds what is missing of each spring's force. `node_step`: the length of the step for nodes, s.
void pull(std::vector<HeldSpring>& springs, double node_step, double h);
// btSoftBody::solveConstraints() with the springs of held nodes among the links. The velocities of the holders are
// changed by what the springs do to them. `h`: the length of the step, s.
void solve_with_held_nodes(SoftData& data, double h);

}  // namespace ambf::physics::detail
