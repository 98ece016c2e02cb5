// Bodies that joints connect with each other. Allocates; physics thread. For use inside physics/ only.
#pragma once

#include <unordered_set>
#include <vector>

#include "physics/detail/world_data.h"

namespace ambf::physics::detail {

// The first body and all that joints connect to it, through bodies for which `belongs` is true; each once.
template <class Belongs>
std::vector<BodyData*> jointed_group(BodyData& first, Belongs&& belongs) {
  std::vector<BodyData*> group{&first};
  std::unordered_set<const BodyData*> known{&first};
  for (std::size_t i = 0; i < group.size(); ++i) {
    for (const JointData* joint : group[i]->joints) {
      BodyData& other = &joint->parent == group[i] ? joint->child : joint->parent;
      if (joint->constraint.isEnabled() && belongs(other) && known.insert(&other).second) group.push_back(&other);
    }
  }
  return group;
}

}  // namespace ambf::physics::detail
