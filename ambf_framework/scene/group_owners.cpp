#include "scene/detail/group_owners.h"

#include <algorithm>

namespace ambf::scene {

namespace {

const Key* first_bound(const Group& group) {
  const auto found =
      std::find_if(group.keys.begin(), group.keys.end(), [](const Key& key) { return bool(key.member); });
  return found == group.keys.end() ? nullptr : &*found;
}

// The description that the keys of the key's map fill: a member, or the one that holds the key.
const void* inner_owner(const Key& key, const void* owner) {
  if (!key.member) return owner;
  const Member member = key.member.find(const_cast<void*>(owner));
  if (const auto* inner = std::get_if<InnerMember>(&member)) return inner->object;
  if (const auto* vector = std::get_if<math::Vec3*>(&member)) return *vector;
  return nullptr;
}

}  // namespace

GroupOwners::GroupOwners(const Defaults& defaults) : defaults_(defaults) {
  // Blocks and headers come first: a map in one of them shows the block's values, not those that its own struct begins
  // with.
  for (const Group* group : all_groups()) {
    const Key* bound = first_bound(*group);
    if ((group->is_block || group->is_header) && bound != nullptr) add(*group, defaults_.owner_of(bound->member));
  }
  for (const Group* group : all_groups()) {
    const Key* bound = first_bound(*group);
    if (!group->is_block && !group->is_header && bound != nullptr) add(*group, defaults_.owner_of(bound->member));
  }
}

void GroupOwners::add(const Group& group, const void* owner) {
  const Key* bound = first_bound(group);
  if (owner == nullptr || bound == nullptr || !owners_.emplace(&group, owner).second) return;
  for (const Key& key : group.keys) {
    if (key.sub != nullptr && key.type == KeyType::map) add(*key.sub, inner_owner(key, owner));
  }
}

const void* GroupOwners::of(const Group& group) const {
  const auto found = owners_.find(&group);
  return found == owners_.end() ? nullptr : found->second;
}

std::string default_in(const Group& group, const Key& key, const Defaults& defaults) {
  const GroupOwners owners(defaults);
  const auto holds = [&key](const Group& candidate) {
    return std::any_of(candidate.keys.begin(), candidate.keys.end(), [&key](const Key& own) { return &own == &key; });
  };
  if (holds(group)) return default_text(key, owners.of(group));
  for (const Group* included : group.includes) {
    if (holds(*included)) return default_text(key, owners.of(*included));
  }
  return default_text(key, nullptr);
}

}  // namespace ambf::scene
