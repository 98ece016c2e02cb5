#include "crtk/served_arm.h"

#include "base/clock.h"
#include "crtk/arm_topics.h"

namespace ambf::crtk {

ServedArm::ServedArm(adf::CrtkArm arm, const state::Abilities& simulation, base::Log& log)
    : arm_(std::move(arm)), simulation_(simulation), log_(log), control_(arm_), rate_(arm_.rate_hz, arm_.rate_hz) {}

ServedArm::~ServedArm() { close(); }

void ServedArm::open(ros_comm::Node& node, const std::string& name_space) {
  const std::string prefix = name_space + "/" + arm_.name;
  auto topics = std::make_unique<ArmTopics>(node, prefix, arm_);
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    topics_ = std::move(topics);
    control_.take_events();  // nobody could hear them
    topics_->publish({control_.state_event()});
    topics_->publish_ratios(control_);
  }
  open_ = true;
  commands_in_ = std::make_unique<ArmCommands>(node, prefix, arm_, [this](const Act& act) { execute(act); });
  log_.info("CRTK: arm %s below %s", arm_.name.c_str(), prefix.c_str());
}

void ServedArm::close() {
  commands_in_.reset();
  std::unique_ptr<ArmTopics> topics;  // ends after the lock
  const std::lock_guard<std::mutex> lock(mutex_);
  topics.swap(topics_);
  port_.reset();
}

void ServedArm::execute(const Act& act) {
  const std::lock_guard<std::mutex> lock(mutex_);
  const double velocity = control_.ratio_velocity(), acceleration = control_.ratio_acceleration();
  act(control_);
  const bool scaled = velocity != control_.ratio_velocity() || acceleration != control_.ratio_acceleration();
  if (scaled && topics_) topics_->publish_ratios(control_);
  post();
  announce();
}

void ServedArm::search(const state::Structure& structure) {
  structure_version_ = structure.version;
  ArmJoints found;
  std::string problem;
  const ArmJoints::Found what = found.find(arm_, structure, problem);
  if (what == ArmJoints::Found::all) {
    const bool same = bound_ && found.same_as(joints_);
    joints_ = std::move(found);
    if (!same) port_ = simulation_.command.bind(joints_.base(), state::Source::plugin);
    bound_ = port_ != nullptr;
    found_ = bound_;
    return;
  }
  if (what == ArmJoints::Found::no_joint && !warned_ && !bound_) {
    warned_ = true;
    log_.report(base::Diagnostic{base::Severity::error, arm_.file, arm_.base_line, arm_.base_column, arm_.name, "base",
                                 problem, "the arm has no topics; name its joints in `joints`"});
  }
  if (!bound_) return;
  bound_ = false;
  port_.reset();
  control_.fault(problem);
}

void ServedArm::update(const state::Frame& frame) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (frame.sequence == sequence_) return;
  sequence_ = frame.sequence;
  if (frame.structure->version != structure_version_) search(*frame.structure);
  if (!bound_ && !topics_ && !warned_ && frame.sim_step > 0) {
    warned_ = true;
    log_.report(base::Diagnostic{base::Severity::warning, arm_.file, arm_.base_line, arm_.base_column, arm_.name,
                                 "base", "the scene has no body '" + arm_.base + "'",
                                 "its topics come once a model with it is loaded"});
  }
  const std::int64_t now_ns = base::steady_ns();
  if (bound_) {
    control_.update(joints_.read(frame), now_ns);
    post();
  }
  announce();
  if (topics_ && rate_.due(now_ns, true)) {
    topics_->publish(control_, bound_ ? joints_.gripper(frame) : std::nullopt);
  }
}

// With each frame anew, so that the watchdog lets go if this program's part hangs.
void ServedArm::post() {
  if (port_ == nullptr) return;
  const std::vector<Target> targets = control_.targets();
  if (targets.empty()) {
    if (commands_) port_->release();
    commands_ = false;
    return;
  }
  joints_.fill(targets, control_.measured(), command_);
  port_->post(command_);
  commands_ = true;
}

void ServedArm::announce() {
  const std::vector<Event> events = control_.take_events();
  for (const Event& event : events) {
    if (event.kind == Event::Kind::warning) log_.warning("CRTK: %s: %s", arm_.name.c_str(), event.text.c_str());
    if (event.kind == Event::Kind::error) log_.error("CRTK: %s: %s", arm_.name.c_str(), event.text.c_str());
  }
  if (topics_) topics_->publish(events);
}

}  // namespace ambf::crtk
