#include "state/soft_bodies.h"

#include <cmath>

#include "base/bounds.h"
#include "base/limits.h"
#include "math/rotation.h"
#include "state/detail/built_in_kinds.h"

namespace ambf::state {
namespace {

PlacedKind<SoftBodyState> registered_kind;
ColumnId<SoftNode> registered_nodes;
ColumnId<SoftPick> registered_picks;

constexpr double kMaxLength = 1e6;  // m

std::size_t count_nodes(const Structure& structure) {
  const std::vector<SoftBodyInfo>& all = soft_bodies(structure);
  return all.empty() ? 0 : std::size_t{all.back().first_node} + all.back().nodes;
}

bool within(const math::Vec3& v, double limit) {
  return std::abs(v.x) <= limit && std::abs(v.y) <= limit && std::abs(v.z) <= limit;  // false for NaN
}

}  // namespace

void register_soft_body_kind() {
  KindInfo info;
  info.name = "soft_body";
  info.label = "soft body";
  info.plural = "soft bodies";
  registered_kind = register_placed_kind<SoftBodyInfo, SoftBodyState>(std::move(info));
  ColumnTraits traits;
  traits.name = "soft_nodes";
  traits.hashed = true;
  traits.while_diverged = WhileDiverged::last_good_structure;
  traits.rows_of = count_nodes;
  registered_nodes = register_column<SoftNode>(std::move(traits));
  ColumnTraits picks;
  picks.name = "soft_picks";
  picks.while_diverged = WhileDiverged::last_good_structure;
  picks.rows_of = [](const Structure& structure) {
    return soft_bodies(structure).empty() ? std::size_t{0} : std::size_t{base::kMaxPicks};
  };
  registered_picks = register_column<SoftPick>(std::move(picks));
}

const PlacedKind<SoftBodyState>& soft_body_kind() {
  register_built_in_kinds();
  return registered_kind;
}

const std::vector<SoftBodyInfo>& soft_bodies(const Structure& structure) {
  static const std::vector<SoftBodyInfo> none;
  const auto number = static_cast<std::size_t>(soft_body_kind().kind);
  const bool has_table = number < structure.registered.size() && structure.registered[number].has_value();
  return has_table ? table<SoftBodyInfo>(structure, soft_body_kind().kind) : none;
}

NodeRange nodes_of(const Frame& frame, std::uint32_t soft_body_slot) {
  const SoftBodyInfo& body = soft_bodies(*frame.structure)[soft_body_slot];
  const std::vector<SoftNode>& all = rows(frame, registered_nodes);
  if (std::size_t{body.first_node} + body.nodes > all.size()) return {};
  return {all.data() + body.first_node, all.data() + body.first_node + body.nodes};
}

std::vector<SoftNode>& soft_nodes(Frame& frame) { return rows(frame, registered_nodes); }

const std::vector<SoftPick>& soft_picks(const Frame& frame) { return rows(frame, registered_picks); }
std::vector<SoftPick>& soft_picks(Frame& frame) { return rows(frame, registered_picks); }

std::string check(SoftBodyCommand& command, std::size_t nodes) {
  if (!within(command.wrench_world.force, base::kMaxForce) || !within(command.wrench_world.torque, base::kMaxForce))
    return "wrench is not finite or beyond 1e9 N";
  if (command.node_forces.size() > nodes)
    return std::to_string(command.node_forces.size()) + " forces for " + std::to_string(nodes) +
           " nodes: give each node one";
  for (const NodeForce& each : command.node_forces) {
    if (each.node >= nodes)
      return "there is no node " + std::to_string(each.node) + ": the body has " + std::to_string(nodes) + ", from 0";
    if (!within(each.force_world, base::kMaxForce))
      return "the force on node " + std::to_string(each.node) + " is not finite or beyond 1e9 N";
  }
  if (!command.carries) return {};
  if (!within(command.T_world_body.position, kMaxLength)) return "position is not finite or beyond 1e6 m";
  if (!math::is_finite(command.T_world_body.orientation)) return "orientation is not finite";
  const double length = math::norm(command.T_world_body.orientation);
  if (!(length >= 0.9 && length <= 1.1)) return "orientation is not a unit quaternion";
  command.T_world_body.orientation = math::normalized(command.T_world_body.orientation);
  return {};
}

}  // namespace ambf::state
