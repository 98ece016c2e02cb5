#include "render/panel/relations.h"

#include "render/scene/object_kind.h"
#include "state/kind_rows.h"

namespace ambf::render {

state::ObjectId parent_of(const state::Structure& all, state::ObjectId object) {
  const std::uint32_t index = state::find(all, object);
  if (index == state::kNone) return {};
  const state::ObjectInfo& info = all.objects[index];
  const auto id_of_body = [&](std::uint32_t slot) { return all.objects[all.bodies[slot].object].id; };
  const auto id_of = [&](std::uint32_t i) { return i == state::kNone ? state::ObjectId{} : all.objects[i].id; };
  if (is_joint(info)) return id_of_body(all.joints[info.slot].parent_body);
  if (is_body(info)) {
    for (const state::JointInfo& joint : all.joints) {
      if (joint.child_body == info.slot) return id_of_body(joint.parent_body);
    }
    return {};
  }
  const state::PlacedInfo* placed = state::rows_of(info.kind).placed(all, info.slot);
  return placed == nullptr ? state::ObjectId{} : id_of(placed->parent_object);
}

std::vector<state::ObjectId> mechanism_of(const state::Structure& all, state::ObjectId body) {
  const std::uint32_t object = state::find(all, body);
  if (object == state::kNone || !is_body(all.objects[object])) return {};
  std::vector<bool> in(all.bodies.size());
  std::vector<std::uint32_t> open{all.objects[object].slot};
  in[open.front()] = true;
  std::vector<state::ObjectId> found;
  while (!open.empty()) {
    const std::uint32_t slot = open.back();
    open.pop_back();
    found.push_back(all.objects[all.bodies[slot].object].id);
    if (all.bodies[slot].mass <= 0.0) continue;  // what else hangs on it does not move with it
    for (const state::JointInfo& joint : all.joints) {
      if (joint.parent_body != slot && joint.child_body != slot) continue;
      const std::uint32_t other = joint.parent_body == slot ? joint.child_body : joint.parent_body;
      if (in[other] || all.bodies[other].mass <= 0.0) continue;
      in[other] = true;
      open.push_back(other);
    }
  }
  return found;
}

double pulled_by(const state::Frame& frame, state::ObjectId body) {
  const state::Structure& all = *frame.structure;
  const std::uint32_t object = state::find(all, body);
  if (object == state::kNone || !is_body(all.objects[object])) return 0.0;
  math::Vec3 force;
  for (const state::PickState& pick : frame.picks) {
    if (pick.body == all.objects[object].slot) force += pick.force_world;
  }
  return math::norm(force);
}

}  // namespace ambf::render
