#include "communication.h"

#ifdef AMBF_WITH_ROS
#include <algorithm>
#include <filesystem>

#include "adf/crtk_arms.h"
#include "base/realtime.h"
#include "comm/server.h"
#include "crtk/arm_kind.h"
#include "crtk/crtk.h"
#include "dvrk_arm/drivers.h"
#include "render/images/jpeg.h"
#include "ros_comm/child_program.h"
#include "ros_comm/environment.h"
#include "ros_comm/ros_middleware.h"
#endif

namespace ambf::simulator {

namespace {

class Nothing final : public Communication {
 public:
  explicit Nothing(std::string why) : why_(std::move(why)) {}
  std::string nothing_published() const override { return why_; }

 private:
  std::string why_;
};

#ifdef AMBF_WITH_ROS
constexpr int kPublisherPriority = 10;  // below physics
constexpr int kSendingPriority = 9;

class Ros final : public Communication {
 public:
  Ros(const CommandLine& options, const state::Abilities& simulation, base::Log& log)
      : middleware_(ros_comm::RosMiddleware::start(
            simulation, log, options.fixed_physics_timestep ? 0 : kSendingPriority, render::encode_jpeg)),
        server_(simulation.observe, *middleware_, server_options(options)) {
    if (!options.legacy_states.empty()) start_relay(options.legacy_states, log);
    if (!options.crtk_files.empty()) start_crtk(options, simulation, log);
  }

  state::PictureSink* pictures() override { return &middleware_->pictures(); }

 private:
  static comm::ServerOptions server_options(const CommandLine& options) {
    comm::ServerOptions out;
    out.rates.low_hz = options.override_min_comm_hz;
    out.rates.high_hz = options.override_max_comm_hz;
    const bool real_time = !options.fixed_physics_timestep;
    out.publisher_thread_started = [real_time] {
      base::enter_real_time("publisher", real_time ? kPublisherPriority : 0);
    };
    return out;
  }

  void start_relay(const std::string& generation, base::Log& log) {
    std::error_code none;
    const std::filesystem::path here = std::filesystem::read_symlink("/proc/self/exe", none).parent_path();
    std::string problem;
    constexpr bool kErrorsShown = true;
    if (relay_.start({(here / "ambf_legacy_states").string(), generation}, problem, kErrorsShown)) {
      log.info("states are published as AMBF %s does, too: by a relay under the same names",
               generation == "g2" ? "1.0" : "3.0");
    } else {
      log.error("--legacy_states: %s", problem.c_str());
    }
  }

  void start_crtk(const CommandLine& options, const state::Abilities& simulation, base::Log& log) {
    std::vector<adf::CrtkArm> arms;
    for (const std::string& file : options.crtk_files) {
      adf::CrtkArmsResult read = adf::load_crtk_arms(file);
      log.report(read.diagnostics);
      for (adf::CrtkArm& arm : read.arms) {
        const auto same = [&](const adf::CrtkArm& other) { return other.name == arm.name; };
        const auto first = std::find_if(arms.begin(), arms.end(), same);
        if (first == arms.end()) {
          arms.push_back(std::move(arm));
          continue;
        }
        log.report(base::Diagnostic{base::Severity::error,
                                    arm.file,
                                    arm.line,
                                    arm.column,
                                    arm.name,
                                    {},
                                    "an arm of this name is in '" + first->file + "'",
                                    "give each arm its own name"});
      }
    }
    std::string name_space = options.ns;
    while (!name_space.empty() && name_space.back() == '/') name_space.pop_back();
    if (!name_space.empty() && name_space.front() != '/') name_space.insert(0, 1, '/');
    if (arms.empty()) return;
    crtk_ = std::make_unique<crtk::Interface>(arms, name_space, simulation, middleware_->node(), log,
                                              options.fixed_physics_timestep ? 0 : kPublisherPriority, options.clock);
  }

  std::unique_ptr<ros_comm::RosMiddleware> middleware_;
  comm::Server server_;
  ros_comm::ChildProgram relay_;
  const dvrk_arm::ArmConnection arms_{middleware_->node()};
  std::unique_ptr<crtk::Interface> crtk_;
};
#endif

}  // namespace

std::string Communication::problem_of_environment(const CommandLine& options) {
#ifdef AMBF_WITH_ROS
  if (!options.no_ros) return ros_comm::problem_of_environment();
#endif
  (void)options;
  return {};
}

void Communication::register_kinds() {
#ifdef AMBF_WITH_ROS
  crtk::register_arms();
#endif
}

void Communication::register_drivers(base::Log& log) {
#ifdef AMBF_WITH_ROS
  dvrk_arm::register_drivers(log);
#else
  (void)log;
#endif
}

std::unique_ptr<Communication> Communication::start(const CommandLine& options, const state::Abilities& simulation,
                                                    base::Log& log) {
#ifdef AMBF_WITH_ROS
  if (options.clock && options.crtk_files.empty()) log.warning("--clock has no effect without --crtk");
  if (!options.no_ros) return std::make_unique<Ros>(options, simulation, log);
  if (!options.crtk_files.empty()) log.warning("--crtk has no effect with --no_ros");
  return std::make_unique<Nothing>("this program was started without ROS (--no_ros)");
#else
  log.info("built without ROS: no topics");
  if (!options.crtk_files.empty()) log.warning("--crtk has no effect: this program was built without ROS");
  (void)options, (void)simulation;
  return std::make_unique<Nothing>("this program was built without ROS");
#endif
}

}  // namespace ambf::simulator
