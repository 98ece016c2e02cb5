#include "scene/chain.h"

#include <algorithm>
#include <limits>
#include <vector>

#include "scene/lookup.h"

namespace ambf::scene {
namespace {

struct Link {
  const Joint* joint = nullptr;
  std::size_t parent = 0, child = 0;
};

// The model's joints whose bodies exist.
std::vector<Link> links_of(const Model& model, const std::vector<std::string>& bodies) {
  std::vector<Link> links;
  for (const Joint& joint : model.joints) {
    const std::string& space = joint.identity.name_space;
    const auto parent = find_joint_body(bodies, {}, joint.parent, space, "").index;
    const auto child = find_joint_body(bodies, {}, joint.child, space, "").index;
    if (parent && child && joint.type != state::JointType::p2p) links.push_back({&joint, *parent, *child});
  }
  return links;
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
  std::vector<std::string> bodies;
  for (const Body& body : model.bodies) bodies.push_back(body.identity.name_space + body.identity.identifier);
  const auto from = find_identifier(bodies, root).index, to = find_identifier(bodies, tip).index;
  if (!from || !to) return {std::nullopt, "no body, or more than one, is named '" + (from ? tip : root) + "'"};
  const std::vector<Link> links = links_of(model, bodies);
  const auto way = path(links, bodies.size(), *from, *to);
  if (way.empty()) return {std::nullopt, "no joints lead from '" + root + "' to '" + tip + "'"};
  constexpr double kUnlimited = std::numeric_limits<double>::infinity();
  kinematics::Chain chain;
  for (const Link* link : way) {
    const Joint& joint = *link->joint;
    kinematics::AdfGeometry geometry{joint.parent_pivot * model.bodies[link->parent].scale,
                                     joint.child_pivot * model.bodies[link->child].scale,
                                     joint.parent_axis,
                                     joint.child_axis,
                                     joint.child_offset,
                                     joint.joint_offset};
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

}  // namespace ambf::scene
