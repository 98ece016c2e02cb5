#include "scene/chain.h"

#include <algorithm>
#include <limits>
#include <vector>

#include "math/rotation.h"
#include "scene/lookup.h"

namespace ambf::scene {
namespace {

struct Link {
  const Joint* joint = nullptr;
  std::size_t parent = 0, child = 0;
};

std::vector<std::string> bodies_of(const Model& model) {
  std::vector<std::string> bodies;
  for (const Body& body : model.bodies) bodies.push_back(body.identity.name_space + body.identity.identifier);
  return bodies;
}

// The model's joints whose bodies exist.
std::vector<Link> links_of(const Model& model, const std::vector<std::string>& bodies) {
  std::vector<Link> links;
  for (const Joint& joint : model.joints) {
    const std::string& space = joint.identity.name_space;
    const auto parent = find_joint_body(bodies, {}, joint.parent, space, "").index;
    const auto child = find_joint_body(bodies, {}, joint.child, space, "").index;
    if (parent && child) links.push_back({&joint, *parent, *child});
  }
  return links;
}

kinematics::AdfGeometry geometry_of(const Model& model, const Link& link) {
  const Joint& joint = *link.joint;
  return {joint.parent_pivot * model.bodies[link.parent].scale,
          joint.child_pivot * model.bodies[link.child].scale,
          joint.parent_axis,
          joint.child_axis,
          joint.child_offset,
          joint.joint_offset};
}

// The fewest links from one body to another, breadth first; empty when nothing connects them.
std::vector<const Link*> path(const std::vector<Link>& links, std::size_t count, std::size_t root, std::size_t tip) {
  std::vector<const Link*> to(count, nullptr);
  std::vector<std::size_t> reached{root};
  for (std::size_t next = 0; next < reached.size(); ++next) {
    for (const Link& link : links) {
      if (link.parent != reached[next] || link.child == root || to[link.child] != nullptr) continue;
      to[link.child] = &link;
      reached.push_back(link.child);
    }
  }
  std::vector<const Link*> way;
  for (std::size_t body = tip; body != root && to[body] != nullptr; body = to[body]->parent) way.push_back(to[body]);
  std::reverse(way.begin(), way.end());
  return way;
}

}  // namespace

ChainResult chain_between(const Model& model, const std::string& root, const std::string& tip) {
  const std::vector<std::string> bodies = bodies_of(model);
  const auto from = find_identifier(bodies, root).index, to = find_identifier(bodies, tip).index;
  if (!from || !to) return {std::nullopt, "no body, or more than one, is named '" + (from ? tip : root) + "'"};
  std::vector<Link> links = links_of(model, bodies);
  std::erase_if(links, [](const Link& link) { return link.joint->type == state::JointType::p2p; });
  const auto way = path(links, bodies.size(), *from, *to);
  if (way.empty()) return {std::nullopt, "no joints lead from '" + root + "' to '" + tip + "'"};
  constexpr double kUnlimited = std::numeric_limits<double>::infinity();
  kinematics::Chain chain;
  for (const Link* link : way) {
    const Joint& joint = *link->joint;
    const kinematics::AdfGeometry geometry = geometry_of(model, *link);
    const bool prismatic = joint.type == state::JointType::prismatic;
    if (joint.type == state::JointType::fixed) {
      kinematics::append_fixed(chain, geometry);
    } else if (prismatic || joint.type == state::JointType::revolute) {
      const double lower = joint.limits ? (*joint.limits)[0] : -kUnlimited;
      const double upper = joint.limits ? (*joint.limits)[1] : kUnlimited;
      kinematics::append(chain, geometry, prismatic, lower, upper, joint.identity.name);
    } else {
      return {std::nullopt, "joint '" + joint.identity.name + "' is neither revolute, prismatic nor fixed"};
    }
  }
  return {std::move(chain), {}};
}

std::optional<kinematics::MechanismJoint::Kind> mechanism_kind(state::JointType type) {
  using Kind = kinematics::MechanismJoint::Kind;
  switch (type) {
    case state::JointType::fixed: return Kind::fixed;
    case state::JointType::revolute:
    case state::JointType::torsion_spring: return Kind::revolute;
    case state::JointType::prismatic:
    case state::JointType::linear_spring: return Kind::prismatic;
    case state::JointType::p2p: return Kind::point;
    case state::JointType::cone_twist:
    case state::JointType::six_dof:
    case state::JointType::six_dof_spring: break;
  }
  return std::nullopt;
}

std::vector<kinematics::MechanismJoint> mechanism_joints(const Model& model) {
  std::vector<kinematics::MechanismJoint> made;
  for (const Link& link : links_of(model, bodies_of(model))) {
    const Joint& joint = *link.joint;
    const auto kind = mechanism_kind(joint.type);
    if (!kind) continue;
    const kinematics::AdfGeometry geometry = geometry_of(model, link);
    const math::Pose T_parent_child =
        math::inverse(model.bodies[link.parent].T_world_body) * model.bodies[link.child].T_world_body;
    // Located bodies may be a little beside what the joint allows: it is where they are along its free direction.
    kinematics::MechanismJoint moving{
        joint.identity.name,          *kind, link.parent, link.child, geometry.parent_pivot, geometry.parent_axis,
        kinematics::at_zero(geometry)};
    const math::Pose& zero = moving.T_parent_child;
    double position = 0.0;
    if (kind == kinematics::MechanismJoint::Kind::revolute) {
      position = dot(geometry.parent_axis, math::log(T_parent_child.orientation * math::inverse(zero.orientation)));
    } else if (kind == kinematics::MechanismJoint::Kind::prismatic) {
      position = dot(geometry.parent_axis, T_parent_child.position - zero.position);
    }
    moving.T_parent_child = kinematics::at_position(moving, position);
    moving.position = position;
    if (kind == kinematics::MechanismJoint::Kind::point) moving.T_parent_child = T_parent_child;
    made.push_back(std::move(moving));
  }
  return made;
}

}  // namespace ambf::scene
