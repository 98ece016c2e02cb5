#include "render/panel/command_watch.h"

#include "base/clock.h"

namespace ambf::render {

void CommandWatch::note(const state::Frame& frame, state::ObjectId object, std::vector<std::uint32_t> joints,
                        std::int64_t now_ns) {
  std::vector<double> told;
  for (const std::uint32_t joint : joints) {
    told.push_back(static_cast<double>(frame.joints[joint].commanded_type));
    told.push_back(frame.joints[joint].commanded);
  }
  const auto [at, is_new] = known_.try_emplace((std::uint64_t{object.generation} << 32) | object.index);
  Known& known = at->second;
  if (is_new) known.since_ns = now_ns;
  if (is_new || told != known.told) {
    known.changed_ns = now_ns;
    known.told = std::move(told);
  }
  known.seen = true;
  const std::int64_t changed_ns = joints.empty() ? known.since_ns : known.changed_ns;
  list_.push_back(
      {object, std::move(joints), base::to_seconds(now_ns - known.since_ns), base::to_seconds(now_ns - changed_ns)});
}

void CommandWatch::take(const state::Frame& frame, std::int64_t now_ns) {
  const state::Structure& all = *frame.structure;
  list_.clear();
  for (auto& [key, known] : known_) known.seen = false;
  for (std::size_t slot = 0; slot < all.bodies.size(); ++slot) {
    if (!frame.bodies[slot].active) continue;
    std::vector<std::uint32_t> joints;
    for (const std::uint32_t joint : all.bodies[slot].joints) {
      if (is_commanded(frame.joints[joint])) joints.push_back(joint);
    }
    note(frame, all.objects[all.bodies[slot].object].id, std::move(joints), now_ns);
  }
  for (std::size_t slot = 0; slot < all.cameras.size(); ++slot) {
    if (frame.cameras[slot].active) note(frame, all.objects[all.cameras[slot].object].id, {}, now_ns);
  }
  for (std::size_t slot = 0; slot < all.lights.size(); ++slot) {
    if (frame.lights[slot].active) note(frame, all.objects[all.lights[slot].object].id, {}, now_ns);
  }
  std::erase_if(known_, [](const auto& entry) { return !entry.second.seen; });
}

}  // namespace ambf::render
