#include "model/detail/lineage.h"

#include <algorithm>

namespace ambf::model {
namespace {

const std::vector<std::uint32_t> kNobody;

bool contains(const std::vector<std::uint32_t>& list, std::uint32_t value) {
  return std::find(list.begin(), list.end(), value) != list.end();
}

}  // namespace

void Lineage::add(std::uint32_t joint, std::uint32_t parent, std::uint32_t child) {
  links_.push_back({joint, parent, child});
  connect(links_.back());
}

void Lineage::list_joint(Node& above, std::uint32_t above_body, std::uint32_t child, std::uint32_t joint) {
  if (!above.known_joints.insert(joint).second) return;
  if (child != above_body && above.known_descendants.insert(child).second) {
    above.descendants.push_back(child);
    above.found_by.push_back(joint);
  } else {
    above.closing.push_back(joint);
  }
}

// Alg. 1: everything above (the parent and its ancestors) learns of everything below (the child's descendants and the
// child).
void Lineage::connect(const Link& link) {
  std::vector<std::uint32_t> above = nodes_[link.parent].ancestors;
  above.insert(above.begin(), link.parent);
  // Copies: in a directed cycle a body is above and below at once.
  const Node child = nodes_[link.child];

  for (const std::uint32_t body : above) {
    Node& node = nodes_[body];
    for (std::size_t i = 0; i < child.descendants.size(); ++i)
      list_joint(node, body, child.descendants[i], child.found_by[i]);
    list_joint(node, body, link.child, link.joint);
    for (const std::uint32_t joint : child.closing)
      if (node.known_joints.insert(joint).second) node.closing.push_back(joint);
  }

  std::vector<std::uint32_t> below = child.descendants;
  below.push_back(link.child);
  for (const std::uint32_t body : below) {
    Node& node = nodes_[body];
    for (const std::uint32_t ancestor : above)
      if (ancestor != body && node.known_ancestors.insert(ancestor).second) node.ancestors.push_back(ancestor);
  }
}

void Lineage::remove(const std::vector<std::uint32_t>& joints, const std::vector<std::uint32_t>& bodies) {
  const std::vector<Link> before = std::move(links_);
  links_.clear();
  nodes_.clear();
  for (const Link& link : before) {
    if (contains(joints, link.joint) || contains(bodies, link.parent) || contains(bodies, link.child)) continue;
    links_.push_back(link);
    connect(link);
  }
}

const std::vector<std::uint32_t>& Lineage::descendants(std::uint32_t body) const {
  const auto node = nodes_.find(body);
  return node == nodes_.end() ? kNobody : node->second.descendants;
}

std::vector<std::uint32_t> Lineage::joints(std::uint32_t body) const {
  const auto node = nodes_.find(body);
  if (node == nodes_.end()) return {};
  std::vector<std::uint32_t> all = node->second.found_by;
  all.insert(all.end(), node->second.closing.begin(), node->second.closing.end());
  return all;
}

const std::vector<std::uint32_t>& Lineage::ancestors(std::uint32_t body) const {
  const auto node = nodes_.find(body);
  return node == nodes_.end() ? kNobody : node->second.ancestors;
}

}  // namespace ambf::model
