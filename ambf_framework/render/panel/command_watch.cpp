#include "render/panel/detail/command_watch.h"

#include <algorithm>
#include <tuple>

#include "base/clock.h"
#include "render/scene/object_kind.h"

namespace ambf::render {

namespace {

constexpr std::int64_t kRateSpan_ns = 2'000'000'000, kRateEvery_ns = 200'000'000;

std::vector<std::uint32_t> joints_of(const state::Frame& frame, const state::ObjectInfo& object) {
  std::vector<std::uint32_t> joints;
  if (!is_body(object)) return joints;
  for (const std::uint32_t joint : frame.structure->bodies[object.slot].joints)
    if (is_commanded(frame.joints[joint])) joints.push_back(joint);
  return joints;
}

}  // namespace

// Frames are stamped by the clock that commands are stamped with; pictures come at their own times.
void CommandWatch::measure(Known& known, const state::CommandState& status, std::int64_t frame_ns, Commanded& out) {
  if (known.source != status.source) {
    known.period.clear();
    known.delay.clear();
  }
  known.source = status.source;
  known.period.take(status.period, frame_ns);
  known.delay.take(status.delay, frame_ns);
  out.period = known.period.all();
  out.delay = known.delay.all();
  auto& counts = known.counts;
  if (counts.empty() || frame_ns - counts.back().ns >= kRateEvery_ns) {
    counts.push_back({frame_ns, status.received, status.applied});
  }
  while (counts.size() > 2 && frame_ns - counts[1].ns >= kRateSpan_ns) counts.pop_front();
  const double span_s = base::to_seconds(frame_ns - counts.front().ns);
  if (span_s >= 0.5 * base::to_seconds(kRateEvery_ns)) {
    out.received_hz = static_cast<double>(status.received - counts.front().received) / span_s;
    out.applied_hz = static_cast<double>(status.applied - counts.front().applied) / span_s;
  }
}

void CommandWatch::take(const state::Frame& frame, const state::CommandState& status, std::int64_t now_ns) {
  const state::ObjectInfo& object = frame.structure->objects[status.object];
  Known& known = known_[(std::uint64_t{object.id.generation} << 32) | object.id.index];
  known.seen = true;
  Commanded out;
  out.object = object.id;
  out.model = object.model;
  out.status = status;
  measure(known, status, frame.steady_ns, out);
  const bool turned = status.in_force != known.in_force;
  if (turned || status.refused != known.refused) known.shown_until_ns = now_ns + base::to_ns(kShownAfter_s);
  if (turned) known.since_ns = now_ns;
  if (turned && status.in_force) known.joint_commands.clear();
  known.in_force = status.in_force;
  known.refused = status.refused;
  out.for_s = base::to_seconds(now_ns - known.since_ns);
  if (!status.in_force && now_ns > known.shown_until_ns) return;
  if (status.in_force) {
    out.joints = joints_of(frame, object);
    std::vector<double> joint_commands{0.0};
    for (const std::uint32_t joint : out.joints) {
      joint_commands.push_back(static_cast<double>(frame.joints[joint].commanded_type));
      joint_commands.push_back(frame.joints[joint].commanded);
    }
    if (joint_commands != known.joint_commands) {
      known.joint_commands = std::move(joint_commands);
      known.changed_ns = now_ns;
    }
    if (status.received_ns != 0)
      out.age_s = base::to_seconds(std::max<std::int64_t>(0, frame.steady_ns - status.received_ns));
    out.silence = frame.run.watchdog_s > 0.0 ? status.silent_s / frame.run.watchdog_s : 0.0;
    out.unchanged_s = out.joints.empty() ? out.for_s : base::to_seconds(now_ns - known.changed_ns);
  }
  list_.push_back(std::move(out));
}

void CommandWatch::group() {
  for (std::size_t i = 0; i < list_.size(); ++i) {
    const Commanded& each = list_[i];
    if (arms_.empty() || arms_.back().model != each.model) arms_.push_back({each.model, i});
    Arm& arm = arms_.back();
    ++arm.count;
    arm.received_hz += each.received_hz;
    if (!each.status.in_force) continue;
    ++arm.in_force;
    if (arm.oldest == nullptr || each.silence > arm.oldest->silence) arm.oldest = &each;
  }
}

void CommandWatch::take(const state::Frame& frame, std::int64_t now_ns) {
  list_.clear();
  arms_.clear();
  for (auto& [key, known] : known_) known.seen = false;
  for (const state::CommandState& status : frame.commands) take(frame, status, now_ns);
  std::erase_if(known_, [](const auto& entry) { return !entry.second.seen; });
  std::sort(list_.begin(), list_.end(), [](const Commanded& a, const Commanded& b) {
    return std::tie(a.model, a.status.object) < std::tie(b.model, b.status.object);
  });
  group();
}

}  // namespace ambf::render
