#include "ros_comm/endpoints/rates.h"

#include <dirent.h>
#include <sched.h>
#include <cstdio>
#include <cstdlib>

#include "base/clock.h"
#include "ros_comm/endpoints/conversions.h"

namespace ambf::ros_comm {

namespace {

constexpr std::int64_t kPeriodNs = 200'000'000;
constexpr std::int64_t kThreadsPeriodNs = base::kNanosecondsPerSecond;  // looking at every thread costs a file each
constexpr double kWindow_s = 1.0;                                       // of the averages in a frame's RunState
constexpr const char* kPhaseNames[state::kPhaseCount] = {"commands", "controllers", "collision",
                                                         "solver",   "integration", "publish"};

std::string read_file(const std::string& path) {
  std::string text;
  if (std::FILE* file = std::fopen(path.c_str(), "r")) {
    char buffer[4096];
    while (const std::size_t count = std::fread(buffer, 1, sizeof buffer, file)) text.append(buffer, count);
    std::fclose(file);
  }
  return text;
}

// "VmLck:  1234 kB" of this process: whether locking its memory was granted.
bool memory_is_locked() {
  const std::string status = read_file("/proc/self/status");
  const std::size_t at = status.find("VmLck:");
  return at != std::string::npos && std::atol(status.c_str() + at + 6) > 0;
}

const char* scheduler_name(int policy) {
  switch (policy & ~SCHED_RESET_ON_FORK) {
    case SCHED_FIFO: return "SCHED_FIFO";
    case SCHED_RR: return "SCHED_RR";
    default: return "SCHED_OTHER";
  }
}

}  // namespace

bool Rates::due(std::int64_t now_ns) const { return now_ns - last_ns_ >= kPeriodNs; }

const ambf_msgs::WorldRates& Rates::measure(const state::Frame& frame) {
  const double seconds = last_ns_ == 0 ? 0.0 : base::to_seconds(frame.steady_ns - last_ns_);
  last_ns_ = frame.steady_ns;
  fill_run(frame);
  fill_traffic(seconds);
  if (frame.steady_ns - last_threads_ns_ >= kThreadsPeriodNs) {
    const double since = last_threads_ns_ == 0 ? 0.0 : base::to_seconds(frame.steady_ns - last_threads_ns_);
    fill_threads(frame.run, since);
    fill_pictures(since);
    last_threads_ns_ = frame.steady_ns;
  }
  return message_;
}

void Rates::fill_run(const state::Frame& frame) {
  const state::RunState& run = frame.run;
  message_.header.stamp = stamp_of(frame);
  message_.sim_step = frame.sim_step;
  message_.epoch = static_cast<std::uint32_t>(frame.epoch);
  message_.structure_version = frame.structure->version;
  message_.mode = run.paused       ? ambf_msgs::WorldRates::PAUSED
                  : run.throttled  ? ambf_msgs::WorldRates::THROTTLED
                  : run.fixed_step ? ambf_msgs::WorldRates::FREE
                                   : ambf_msgs::WorldRates::REAL_TIME;
  message_.halted_by.clear();
  if (run.diverged && run.diverged_body < frame.structure->bodies.size()) {
    const state::BodyInfo& body = frame.structure->bodies[run.diverged_body];
    message_.halted_by = frame.structure->objects[body.object].name + " diverged";
  } else if (run.diverged) {
    message_.halted_by = "a body that is gone now diverged";
  } else if (frame.frozen_bodies > 0) {
    message_.halted_by = state::frozen_text(frame);
  }
  message_.solver = run.solver;
  message_.wall_time = frame.wall_time;
  message_.sim_time = frame.sim_time;
  message_.window = kWindow_s;
  message_.real_time_factor = run.real_time_factor;
  message_.speed_factor = run.speed_factor;
  message_.fixed_time_step = run.step_s;
  message_.steps_per_second = run.steps_per_second;
  message_.frames_per_second = run.graphics_rate;
  message_.sub_steps_given_up = run.steps_given_up;
  message_.max_sub_steps = run.max_steps_per_turn;
  message_.phase_names.assign(kPhaseNames, kPhaseNames + state::kPhaseCount);
  message_.phase_seconds.assign(run.seconds_per_phase, run.seconds_per_phase + state::kPhaseCount);
  message_.step_seconds = 0.0;
  for (const double phase : message_.phase_seconds) message_.step_seconds += phase;
  message_.bodies_awake = message_.bodies_asleep = 0;
  for (const state::BodyState& body : frame.bodies) ++(body.asleep ? message_.bodies_asleep : message_.bodies_awake);
  message_.contacts = frame.contacts_total;
}

void Rates::fill_traffic(double seconds) {
  Traffic& traffic = node_.traffic();
  const std::uint64_t states = traffic.states;
  message_.states_per_second = seconds > 0.0 ? static_cast<double>(states - last_states_) / seconds : 0.0;
  last_states_ = states;
  message_.topics = static_cast<std::uint32_t>(node_.topics());
  message_.subscribers = static_cast<std::uint32_t>(traffic.connections);
  message_.accepted_commands = traffic.accepted;
  message_.refused_commands = 0;
  message_.refused_names.clear();
  message_.refused_counts.clear();
  for (const auto& [name, count] : traffic.refused()) {
    message_.refused_names.push_back(name);
    message_.refused_counts.push_back(count);
    message_.refused_commands += count;
  }
  message_.log_messages_lost = node_.log().lost();
}

void Rates::fill_pictures(double seconds) {
  message_.picture_topics.clear();
  message_.pictures_per_second.clear();
  for (const auto& [topic, count] : node_.traffic().pictures()) {
    std::uint64_t& before = last_pictures_[topic];
    message_.picture_topics.push_back(topic);
    message_.pictures_per_second.push_back(seconds > 0.0 ? static_cast<double>(count - before) / seconds : 0.0);
    before = count;
  }
  message_.pictures_dropped = node_.traffic().pictures_dropped;
}

// Every thread of the process that has a name of its own.
void Rates::fill_threads(const state::RunState& run, double seconds) {
  message_.memory_locked = memory_is_locked();
  message_.threads.clear();
  DIR* tasks = opendir("/proc/self/task");
  if (tasks == nullptr) return;
  while (const dirent* entry = readdir(tasks)) {
    const int thread = std::atoi(entry->d_name);
    if (thread <= 0) continue;
    const std::string folder = std::string("/proc/self/task/") + entry->d_name;
    ambf_msgs::ThreadRates rates;
    rates.name = read_file(folder + "/comm");
    while (!rates.name.empty() && rates.name.back() == '\n') rates.name.pop_back();
    const int policy = sched_getscheduler(thread);
    sched_param priority{};
    if (policy < 0 || sched_getparam(thread, &priority) != 0) continue;  // it has just ended
    rates.scheduler = scheduler_name(policy);
    rates.priority = priority.sched_priority;
    // The first number of schedstat is the time spent on a processor, ns.
    const std::int64_t cpu_ns = std::strtoll(read_file(folder + "/schedstat").c_str(), nullptr, 10);
    const auto before = last_cpu_ns_.find(thread);
    if (before != last_cpu_ns_.end() && seconds > 0.0) {
      rates.load = base::to_seconds(cpu_ns - before->second) / seconds;
    }
    last_cpu_ns_[thread] = cpu_ns;
    if (rates.name == "physics") {
      rates.frequency = run.turns_per_second;
      rates.lateness_p50 = run.lateness_p50;
      rates.lateness_p99 = run.lateness_p99;
      rates.lateness_p999 = run.lateness_p999;
      rates.lateness_max = run.lateness_max;
    }
    fill_device_thread(rates);
    message_.threads.push_back(std::move(rates));
  }
  closedir(tasks);
}

void Rates::fill_device_thread(ambf_msgs::ThreadRates& rates) const {
  for (unsigned device = 0; devices_ != nullptr && device < devices_->count(); ++device) {
    if (rates.name != state::thread_name_of(device)) continue;
    state::DeviceStatus status;
    if (devices_->status(device, status)) rates.frequency = status.rate_hz;
    rates.name += " " + devices_->info(device)->name;
  }
}

}  // namespace ambf::ros_comm
