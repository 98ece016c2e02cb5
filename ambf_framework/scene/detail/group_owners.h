// For each group of keys a description that its keys fill, with all its defaults: where docs and schemas find the
// values that they show. One thread.
#pragma once

#include <map>
#include <vector>

#include "scene/keys.h"

namespace ambf::scene {

// The keys of a group without those that it includes; of a model file also the lists of all kinds of block.
std::vector<const Key*> own_keys(const Group& group);

class GroupOwners {
 public:
  explicit GroupOwners(const Defaults& defaults);

  // Null for a group without bound keys.
  const void* of(const Group& group) const;

 private:
  void add(const Group& group, const void* owner);

  const Defaults& defaults_;
  std::map<const Group*, const void*> owners_;
};

}  // namespace ambf::scene
