#include "ros_comm/endpoints/command_rates.h"

#include "base/clock.h"
#include "ros_comm/endpoints/conversions.h"
#include "state/command.h"

namespace ambf::ros_comm {

namespace {

constexpr std::int64_t kPeriodNs = 200'000'000;

void fill(const state::Frame& frame, const state::CommandState& told, ambf_msgs::CommandRates& out) {
  out.name = frame.structure->objects[told.object].name;
  out.source = state::name_of(told.source);
  out.in_force = told.in_force;
  out.age = told.received_ns == 0 ? -1.0 : base::to_seconds(frame.steady_ns - told.received_ns);
  out.silent = told.silent_s;
  out.received = told.received;
  out.applied = told.applied;
  out.coalesced = told.coalesced;
  out.refused = told.refused;
  out.expired = told.expired;
  out.too_long = told.beyond;
  out.periods = told.period.count;
  out.period_least = static_cast<double>(told.period.least_s);
  out.period_mean = static_cast<double>(told.period.mean_s);
  out.period_most = static_cast<double>(told.period.most_s);
  out.period_deviation = static_cast<double>(told.period.deviation_s);
  out.delays = told.delay.count;
  out.delay_least = static_cast<double>(told.delay.least_s);
  out.delay_mean = static_cast<double>(told.delay.mean_s);
  out.delay_most = static_cast<double>(told.delay.most_s);
  out.delay_deviation = static_cast<double>(told.delay.deviation_s);
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
