#include "ros_comm/endpoints/command_rates.h"

#include "base/clock.h"
#include "ros_comm/endpoints/conversions.h"
#include "state/command.h"

namespace ambf::ros_comm {

namespace {

constexpr std::int64_t kPeriodNs = 200'000'000;

void fill(const state::Frame& frame, const state::CommandState& command, ambf_msgs::CommandRates& out) {
  out.name = frame.structure->objects[command.object].name;
  out.source = state::name_of(command.source);
  out.in_force = command.in_force;
  out.age = command.received_ns == 0 ? -1.0 : base::to_seconds(frame.steady_ns - command.received_ns);
  out.silent = command.silent_s;
  out.received = command.received;
  out.applied = command.applied;
  out.coalesced = command.coalesced;
  out.refused = command.refused;
  out.expired = command.expired;
  out.too_long = command.beyond;
  out.periods = command.period.count;
  out.period_least = static_cast<double>(command.period.min_s);
  out.period_mean = static_cast<double>(command.period.mean_s);
  out.period_most = static_cast<double>(command.period.max_s);
  out.period_deviation = static_cast<double>(command.period.deviation_s);
  out.delays = command.delay.count;
  out.delay_least = static_cast<double>(command.delay.min_s);
  out.delay_mean = static_cast<double>(command.delay.mean_s);
  out.delay_most = static_cast<double>(command.delay.max_s);
  out.delay_deviation = static_cast<double>(command.delay.deviation_s);
}

}  // namespace

bool CommandRates::due(std::int64_t now_ns) const { return now_ns - last_ns_ >= kPeriodNs; }

const ambf_msgs::WorldCommandRates& CommandRates::measure(const state::Frame& frame) {
  last_ns_ = frame.steady_ns;
  message_.header.stamp = stamp_of(frame);
  message_.sim_step = frame.sim_step;
  message_.watchdog = frame.run.watchdog_s;
  message_.objects.resize(frame.commands.size());
  for (std::size_t i = 0; i < frame.commands.size(); ++i) fill(frame, frame.commands[i], message_.objects[i]);
  return message_;
}

}  // namespace ambf::ros_comm
