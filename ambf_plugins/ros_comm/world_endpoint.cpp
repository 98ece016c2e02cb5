#include "ros_comm/world_endpoint.h"

#include <functional>

#include "ros_comm/conversions.h"

namespace ambf::ros_comm {

namespace {
constexpr std::int64_t kRatesPeriodNs = 200'000'000;
constexpr const char* kPhaseNames[state::kPhaseCount] = {"commands", "controllers", "collision",
                                                         "solver",   "integration", "publish"};
}  // namespace

WorldEndpoint::WorldEndpoint(Node& node, const std::string& world_name, state::Control& control)
    : control_(control),
      state_(node, topic_name(world_name) + "/State"),
      rates_(node, topic_name(world_name) + "/Rates"),
      command_(node, topic_name(world_name) + "/Command",
               [this](const ros::MessageEvent<const ambf_msgs::WorldCmd>& event) { on_command(event); }),
      reset_(
          node, topic_name(world_name) + "/Command/Reset",
          [this](const ros::MessageEvent<const std_msgs::Empty>&) { control_.reset_world(); }, 1),
      reset_bodies_(
          node, topic_name(world_name) + "/Command/Reset/Bodies",
          [this](const ros::MessageEvent<const std_msgs::Empty>&) { control_.reset_bodies(); }, 1),
      services_(node, topic_name(world_name), control) {}

void WorldEndpoint::on_command(const ros::MessageEvent<const ambf_msgs::WorldCmd>& event) {
  const ambf_msgs::WorldCmd& message = *event.getConstMessage();
  state::WorldCommand command;
  command.enable_step_throttling = message.enable_step_throttling != 0;
  command.step_clock = message.step_clock != 0;
  command.n_skip_steps = message.n_skip_steps;
  command.client = std::hash<std::string>()(event.getPublisherName());
  control_.post_world(command);
}

void WorldEndpoint::publish(const state::Frame& frame, std::uint32_t) {
  if (state_.subscribers() > 0) {
    fill(frame, message_);
    state_.publish(message_);
  }
  if (rates_.subscribers() > 0 && frame.steady_ns - last_rates_ns_ >= kRatesPeriodNs) {
    last_rates_ns_ = frame.steady_ns;
    publish_rates(frame);
  }
}

void WorldEndpoint::publish_rates(const state::Frame& frame) {
  const state::RunState& run = frame.run;
  ambf_msgs::WorldRates message;
  message.header.stamp = stamp_of(frame);
  message.sim_step = frame.sim_step;
  message.epoch = static_cast<std::uint32_t>(frame.epoch);
  message.structure_version = frame.structure->version;
  message.mode = run.paused       ? ambf_msgs::WorldRates::PAUSED
                 : run.throttled  ? ambf_msgs::WorldRates::THROTTLED
                 : run.fixed_step ? ambf_msgs::WorldRates::FREE
                                  : ambf_msgs::WorldRates::REAL_TIME;
  message.halted_by = run.diverged ? "a body diverged; see the simulator's log" : "";
  message.wall_time = frame.wall_time;
  message.sim_time = frame.sim_time;
  message.window = 1.0;
  message.real_time_factor = run.real_time_factor;
  message.speed_factor = run.speed_factor;
  message.fixed_time_step = run.step_s;
  message.steps_per_second = run.steps_per_second;
  message.frames_per_second = run.graphics_rate;
  message.sub_steps_given_up = run.steps_given_up;
  message.max_sub_steps = run.max_steps_per_turn;
  for (int i = 0; i < state::kPhaseCount; ++i) {
    message.phase_names.emplace_back(kPhaseNames[i]);
    message.phase_seconds.push_back(run.seconds_per_phase[i]);
    message.step_seconds += run.seconds_per_phase[i];
  }
  for (const state::BodyState& body : frame.bodies) ++(body.asleep ? message.bodies_asleep : message.bodies_awake);
  message.contacts = frame.contacts_total;
  message.refused_commands = run.commands_refused;
  ambf_msgs::ThreadRates physics;
  physics.name = "physics";
  physics.frequency = run.turns_per_second;
  physics.load = run.physics_cpu_share;
  physics.lateness_p50 = run.lateness_p50;
  physics.lateness_p99 = run.lateness_p99;
  physics.lateness_p999 = run.lateness_p999;
  physics.lateness_max = run.lateness_max;
  message.threads.push_back(std::move(physics));
  rates_.publish(message);
}

}  // namespace ambf::ros_comm
