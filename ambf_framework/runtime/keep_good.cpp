#include "runtime/detail/keep_good.h"

#include "state/structure.h"

namespace ambf::runtime {

void keep_good(const state::Frame& good, state::Frame& frame) {
  const state::Structure &old = *good.structure, &now = *frame.structure;
  std::size_t from = 0;  // those that stay are in the same order in both, before all that is new
  for (const state::ObjectInfo& object : now.objects) {
    std::size_t same = from;
    while (same < old.objects.size() && old.objects[same].id != object.id) ++same;
    if (same == old.objects.size()) break;
    const std::uint32_t slot = old.objects[same].slot;
    switch (object.kind) {
      case state::ObjectKind::rigid_body: frame.bodies[object.slot] = good.bodies[slot]; break;
      case state::ObjectKind::joint: frame.joints[object.slot] = good.joints[slot]; break;
      case state::ObjectKind::camera: frame.cameras[object.slot] = good.cameras[slot]; break;
      case state::ObjectKind::light: frame.lights[object.slot] = good.lights[slot]; break;
      case state::ObjectKind::world: break;
    }
    from = same + 1;
  }
  frame.contacts.clear();
  frame.contacts_total = 0;
  frame.sim_step = good.sim_step;
  frame.sim_time = good.sim_time;
  frame.epoch = good.epoch;
}

}  // namespace ambf::runtime
