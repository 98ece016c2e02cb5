// The part of SurfaceContacts that chooses the few contacts that reach the solver.
#include <algorithm>

#include "physics/meshes/detail/constants.h"
#include "physics/meshes/detail/surface_contacts.h"

namespace ambf::physics::detail {

const std::vector<SurfaceContacts::Chosen>& SurfaceContacts::choose() {
  chosen_.clear();
  group_of_.assign(contacts_.size(), -1);
  for (int group = 0; group < kMaxGroups; ++group) {
    std::size_t deepest = contacts_.size();
    for (std::size_t i = 0; i < contacts_.size(); ++i)
      if (group_of_[i] < 0 && (deepest == contacts_.size() || contacts_[i].distance < contacts_[deepest].distance))
        deepest = i;
    if (deepest == contacts_.size()) break;
    for (std::size_t i = 0; i < contacts_.size(); ++i)
      if (group_of_[i] < 0 && contacts_[i].normal.dot(contacts_[deepest].normal) > kSameDirectionCosine)
        group_of_[i] = group;
    group_of_[deepest] = group;
    choose_group(group, contacts_[deepest]);
  }
  return chosen_;
}

// The extreme ones in four directions, where being deeper counts as being farther out; and the deepest.
void SurfaceContacts::choose_group(int group, const SurfaceContact& deepest) {
  const std::size_t first = chosen_.size();
  btVector3 side, other;
  btPlaneSpace1(deepest.normal, side, other);
  std::size_t shallowest = first;
  bool noticed = false;  // the deepest
  for (const btVector3& direction : {side + other, -side - other, side - other, other - side}) {
    std::size_t best = contacts_.size();
    double best_score = 0.0;
    for (std::size_t i = 0; i < contacts_.size(); ++i) {
      if (group_of_[i] != group) continue;
      const double score = direction.dot(contacts_[i].point) - kDepthPreference * contacts_[i].distance;
      if (best == contacts_.size() || score > best_score + 1e-9) {
        best = i;
        best_score = score;
      }
    }
    const SurfaceContact& contact = contacts_[best];
    noticed = noticed || contact.distance < deepest.distance + kSameDepth;
    const bool known = std::any_of(
        chosen_.begin() + static_cast<std::ptrdiff_t>(first), chosen_.end(),
        [&](const Chosen& c) { return (c.contact.point - contact.point).length2() < kSamePoint * kSamePoint; });
    if (known) continue;
    chosen_.push_back({contact, group});
    if (contact.distance > chosen_[shallowest].contact.distance) shallowest = chosen_.size() - 1;
  }
  if (noticed) return;
  if (chosen_.size() - first < kMaxGroupSize) {
    chosen_.push_back({deepest, group});
  } else {
    chosen_[shallowest].contact = deepest;
  }
}

}  // namespace ambf::physics::detail
