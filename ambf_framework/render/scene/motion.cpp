#include "render/scene/motion.h"

#include <algorithm>
#include <cmath>

#include "math/rotation.h"
#include "render/scene/object_kind.h"
#include "render/scene/soft_surface.h"
#include "state/kind_rows.h"

namespace ambf::render {

namespace {

// Frames closer than this are drawn as they come; farther apart than the other, things stood still in between.
constexpr std::int64_t kShortGap_ns = 10'000'000, kLongGap_ns = 300'000'000;

math::Pose blend(const math::Pose& a, const math::Pose& b, double share) {
  if (a == b) return b;
  math::Quat q = b.orientation;
  const math::Quat& p = a.orientation;
  if (p.x * q.x + p.y * q.y + p.z * q.z + p.w * q.w < 0.0) q = {-q.x, -q.y, -q.z, -q.w};
  const auto mix = [share](double x, double y) { return x + share * (y - x); };
  return {a.position + share * (b.position - a.position),
          math::normalized(math::Quat{mix(p.x, q.x), mix(p.y, q.y), mix(p.z, q.z), mix(p.w, q.w)})};
}

void blend(const std::vector<math::Pose>& a, const std::vector<math::Pose>& b, double share,
           std::vector<math::Pose>& out) {
  out.resize(b.size());
  for (std::size_t i = 0; i < b.size(); ++i) out[i] = blend(a[i], b[i], share);
}

}  // namespace

const math::Pose* ScenePoses::of(const state::ObjectInfo& object) const {
  const auto kind = static_cast<std::size_t>(object.kind);
  const std::vector<math::Pose>* poses = is_body(object) ? &bodies : kind < placed.size() ? &placed[kind] : nullptr;
  return poses != nullptr && object.slot < poses->size() ? &(*poses)[object.slot] : nullptr;
}

void Motion::take(const state::Frame& frame) {
  if (newest_.structure != nullptr && frame.sequence <= newest_.sequence) return;
  std::swap(older_, newest_);
  newest_.sequence = frame.sequence;
  newest_.epoch = frame.epoch;
  newest_.steady_ns = frame.steady_ns;
  newest_.structure = frame.structure;
  ScenePoses& poses = newest_.poses;
  poses.bodies.resize(frame.bodies.size());
  poses.placed.resize(state::kind_count());
  poses.lenses.resize(frame.cameras.size());
  poses.beams.resize(frame.lights.size());
  for (std::size_t i = 0; i < frame.bodies.size(); ++i) poses.bodies[i] = frame.bodies[i].T_world_body;
  for (std::size_t i = 0; i < frame.cameras.size(); ++i) poses.lenses[i] = frame.cameras[i].lens;
  for (std::size_t i = 0; i < frame.lights.size(); ++i) poses.beams[i] = frame.lights[i].beam;
  node_positions(frame, poses.nodes);
  state::for_each_kind([&](state::ObjectKind kind, const state::KindInfo& info) {
    if (!info.has_parent) return;
    const state::KindRows& rows = state::rows_of(kind);
    std::vector<math::Pose>& placed = poses.placed[static_cast<std::size_t>(kind)];
    placed.resize(rows.count(*frame.structure));
    for (std::uint32_t slot = 0; slot < placed.size(); ++slot) placed[slot] = *rows.T_world(frame, slot);
  });
}

const ScenePoses& Motion::at(std::int64_t now_ns) {
  const bool comparable = older_.structure != nullptr && older_.structure == newest_.structure &&
                          older_.epoch == newest_.epoch && newest_.sequence > older_.sequence;
  if (!comparable) return newest_.poses;
  const std::int64_t seen_apart = newest_.steady_ns - older_.steady_ns;
  const std::int64_t gap = seen_apart / static_cast<std::int64_t>(newest_.sequence - older_.sequence);
  if (gap < kShortGap_ns || gap > kLongGap_ns || newest_.sequence != older_.sequence + 1) return newest_.poses;
  const double share = std::clamp(static_cast<double>(now_ns - newest_.steady_ns) / static_cast<double>(gap), 0.0, 1.0);
  blend(older_.poses.bodies, newest_.poses.bodies, share, between_.bodies);
  between_.placed.resize(newest_.poses.placed.size());
  for (std::size_t kind = 0; kind < between_.placed.size(); ++kind)
    blend(older_.poses.placed[kind], newest_.poses.placed[kind], share, between_.placed[kind]);
  const std::vector<math::Vec3>&from = older_.poses.nodes, &to = newest_.poses.nodes;
  between_.nodes = to;
  if (from.size() == to.size())
    for (std::size_t i = 0; i < to.size(); ++i) between_.nodes[i] = from[i] + share * (to[i] - from[i]);
  between_.lenses = newest_.poses.lenses;
  between_.beams = newest_.poses.beams;
  return between_;
}

}  // namespace ambf::render
