#include "model/detail/lineage.h"

#include <algorithm>
#include <unordered_set>

namespace ambf::model {

void Lineage::add(std::uint32_t joint, std::uint32_t parent, std::uint32_t child) {
  links_.push_back({joint, parent, child});
}

void Lineage::remove(const std::vector<std::uint32_t>& joints, const std::vector<std::uint32_t>& bodies) {
  const std::unordered_set<std::uint32_t> gone_joints(joints.begin(), joints.end());
  const std::unordered_set<std::uint32_t> gone_bodies(bodies.begin(), bodies.end());
  std::erase_if(links_, [&](const Link& link) {
    return gone_joints.contains(link.joint) || gone_bodies.contains(link.parent) || gone_bodies.contains(link.child);
  });
}

std::vector<std::uint32_t> Lineage::descendants(std::uint32_t body) const { return Descent(*this).below(body).bodies; }

std::vector<std::uint32_t> Lineage::joints(std::uint32_t body) const { return Descent(*this).below(body).joints; }

std::vector<std::uint32_t> Lineage::ancestors(std::uint32_t body) const {
  std::unordered_map<std::uint32_t, std::vector<std::uint32_t>> parents;
  for (const Link& link : links_) parents[link.child].push_back(link.parent);
  std::vector<std::uint32_t> all;
  std::unordered_set<std::uint32_t> known{body};
  const auto climb = [&](std::uint32_t from) {
    for (const std::uint32_t parent : parents[from])
      if (known.insert(parent).second) all.push_back(parent);
  };
  climb(body);
  for (std::size_t i = 0; i < all.size(); ++i) climb(all[i]);
  return all;
}

}  // namespace ambf::model
