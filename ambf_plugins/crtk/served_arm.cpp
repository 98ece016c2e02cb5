#include "crtk/served_arm.h"

#include <cmath>

#include "base/clock.h"
#include "crtk/arm_kind.h"
#include "crtk/arm_layout.h"
#include "crtk/arm_topics.h"
#include "math/rotation.h"

namespace ambf::crtk {

namespace {

constexpr std::int64_t kKeepAlive_ns = 50'000'000;  // far below the watchdog's period
constexpr std::int64_t kBusyAgain_ns = 20'000'000, kIdleAfter_ns = 10'000'000, kGiveUp_ns = 1'000'000'000;

// An endoscope's view has the picture's axes, x left, y up, z away (CRTK 6). Its tip has x up, y right (frames.md).
const math::Pose kT_tip_picture{{}, math::from_axis_angle({0.0, 0.0, 1.0}, -M_PI / 2)};

}  // namespace

ServedArm::ServedArm(const adf::CrtkArm& arm, const state::Abilities& simulation, const Stamps& stamps, base::Log& log)
    : name_(arm.name),
      view_(arm.view),
      simulation_(simulation),
      stamps_(stamps),
      log_(log),
      control_(arm),
      rate_(arm.rate_hz, arm.rate_hz) {}

ServedArm::~ServedArm() { close(); }

void ServedArm::open(ros_comm::Node& node, const std::string& name_space) {
  const std::string prefix = name_space + "/" + name_;
  const adf::CrtkArm arm = [&] {
    const std::lock_guard<std::mutex> lock(mutex_);
    return control_.description();
  }();
  auto topics = std::make_unique<ArmTopics>(node, prefix, arm, stamps_);
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    topics_ = std::move(topics);
    control_.take_events();  // nobody could hear them
    topics_->publish({control_.state_event()});
    topics_->publish_latched(control_);
  }
  open_ = true;
  commands_in_ = std::make_unique<ArmCommands>(node, prefix, arm, [this](const Act& act) { execute(act); });
  log_.info("CRTK: arm %s below %s", name_.c_str(), prefix.c_str());
}

void ServedArm::close() {
  commands_in_.reset();
  std::unique_ptr<ArmTopics> topics;  // ends after the lock
  const std::lock_guard<std::mutex> lock(mutex_);
  topics.swap(topics_);
  if (port_) port_->release();
  port_.reset();
}

void ServedArm::execute(const Act& act) {
  const std::lock_guard<std::mutex> lock(mutex_);
  const double velocity = control_.ratio_velocity(), acceleration = control_.ratio_acceleration();
  const std::string tool = control_.description().kinematics.tool;
  act(control_);
  const bool scaled = velocity != control_.ratio_velocity() || acceleration != control_.ratio_acceleration();
  if (scaled && topics_) topics_->publish_latched(control_);
  if (tool != control_.description().kinematics.tool) {
    structure_version_ = 0;  // its joints may have other names
    const std::string& camera = control_.description().camera;
    if (!camera.empty() && !camera_.found()) control_.say("only the kinematics turn: the arm has no camera " + camera);
  }
  has_work_ = has_work_ || control_.exchanging();
  post();
  announce(base::steady_ns());
}

// The arm's object: whole, on this base, and made of what the arm is now.
std::uint32_t ServedArm::find_object(const state::Structure& structure, std::uint32_t base) {
  if (loaded_text_ != model_text(control_.description(), structure.objects[base].identifier)) return state::kNone;
  const auto& arms = state::table<ArmInfo>(structure, arm_kind().kind);
  for (std::uint32_t slot = 0; slot < arms.size(); ++slot) {
    if (arms[slot].arm == name_ && arms[slot].parent_object == base && arms[slot].whole()) return slot;
  }
  return state::kNone;
}

// Asks for the arm's object; an older one goes first. The loader does both in this order.
void ServedArm::load(const state::Structure& structure) {
  const std::string text = model_text(control_.description(), structure.objects[joints_.base()].identifier);
  std::string old;
  {
    const std::lock_guard<std::mutex> lock(loaded_->mutex);
    if (loaded_->pending || !loaded_->problem.empty()) return;
    loaded_->pending = true;
    old.swap(loaded_->model);
  }
  loaded_text_ = text;
  if (!old.empty()) simulation_.edit.unload(old, [](const state::Outcome&) {});
  state::LoadRequest request;
  request.text = text;
  request.not_saved = true;
  simulation_.edit.load(std::move(request), [shared = loaded_](const state::Outcome& outcome) {
    const std::lock_guard<std::mutex> lock(shared->mutex);
    shared->pending = false;
    shared->model = outcome.model;
    if (!outcome.success) shared->problem = outcome.message.empty() ? "no reason is known" : outcome.message;
  });
}

void ServedArm::search(const state::Frame& frame) {
  const state::Structure& structure = *frame.structure;
  structure_version_ = structure.version;
  std::string problem;
  const adf::CrtkArm& arm = control_.description();
  ArmJoints::Found what = joints_.find(arm, structure, problem);
  ask_again_ = false;
  if (what == ArmJoints::Found::all) {
    const MotionJudge::Verdict verdict = judge_.of(arm, frame, joints_.base());
    ask_again_ = verdict == MotionJudge::Verdict::unknowable;
    if (ask_again_ || verdict == MotionJudge::Verdict::pending) {
      has_work_ = true;
      bound_ = false;
      return;
    }
    if (verdict == MotionJudge::Verdict::differs) {
      what = ArmJoints::Found::no_joint;
      problem = "the model's joints do not move as its kinematics say";
      warned_ = true;
    }
  }
  if (what == ArmJoints::Found::all) {
    slot_ = find_object(structure, joints_.base());
    if (slot_ == state::kNone) {
      load(structure);
      bound_ = false;
      return;
    }
    const state::ObjectId object =
        structure.objects[state::table<ArmInfo>(structure, arm_kind().kind)[slot_].object].id;
    if (port_ == nullptr || !(object == object_)) {
      port_ = simulation_.command.bind(object, state::Source::plugin);
      if (port_ && frame.run.fixed_step) port_->hold();  // a slow thread of ours must not change what steps do
      object_ = object;
      control_.bound();
    }
    bound_ = port_ != nullptr;
    found_ = bound_;
    base_id_ = structure.objects[joints_.base()].id;
    if (tool_version_ != 0 && structure.version >= tool_version_ && bound_) {
      tool_version_ = 0;
      control_.update(read(frame, control_.measured().stamp_ns), base::steady_ns());
      control_.exchanged();
    }
    return;
  }
  const bool will_be_back = control_.exchanging() && (tool_version_ == 0 || structure.version < tool_version_);
  if (what == ArmJoints::Found::no_joint && will_be_back) {
    bound_ = false;
    return;
  }
  tool_version_ = 0;
  if (what == ArmJoints::Found::no_joint && !warned_ && !found_) {
    warned_ = true;
    log_.report(base::Diagnostic{base::Severity::error, arm.file, arm.base_line, arm.base_column, arm.name, "base",
                                 problem, "the arm has no topics; name its joints in `joints`"});
  }
  if (!bound_ && !control_.exchanging()) return;
  bound_ = false;
  port_.reset();
  control_.fault(problem);
}

Measured ServedArm::read(const state::Frame& frame, std::int64_t stamp_ns) const {
  const ArmInfo& info = state::table<ArmInfo>(*frame.structure, arm_kind().kind)[slot_];
  const ArmState& state = state::rows(frame, arm_kind().column)[slot_];
  Axes position, velocity, effort;
  measure(info, frame.joints, position, velocity, effort);
  const auto axes = static_cast<std::ptrdiff_t>(info.limits.joints + 1);
  Measured made;
  made.valid = true;
  made.position.assign(position.begin(), position.begin() + axes);
  made.velocity.assign(velocity.begin(), velocity.begin() + axes);
  made.effort.assign(effort.begin(), effort.begin() + axes);
  made.motion = state.motion;
  made.active = state.active;
  made.stands = frame.run.paused || frame.run.throttled;
  made.sim_time = frame.sim_time;
  made.epoch = frame.epoch;
  made.stamp_ns = stamp_ns;
  return made;
}

// The kinematics' base is where the body is (docs/crtk.md).
std::optional<math::Pose> ServedArm::T_world_base(const state::Frame& frame) const {
  if (!bound_ && !control_.exchanging()) return std::nullopt;
  return frame.bodies[frame.structure->objects[joints_.base()].slot].T_world_body;
}

std::optional<math::Pose> ServedArm::T_world_view(const state::Frame& frame) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (sequence_ != frame.sequence) return std::nullopt;  // its body is of another structure, perhaps
  const std::optional<math::Pose> base = T_world_base(frame);
  if (!base || !control_.measured().valid) return std::nullopt;
  const math::Pose T_world_tip = *base * control_.local_pose(control_.measured_joints());
  return control_.description().is_endoscope() ? T_world_tip * kT_tip_picture : T_world_tip;
}

void ServedArm::update(const state::Frame& frame, std::int64_t stamp_ns, const ServedArm* viewer) {
  const std::optional<math::Pose> T_world_view = viewer != nullptr ? viewer->T_world_view(frame) : std::nullopt;
  const std::lock_guard<std::mutex> lock(mutex_);
  // A paused world: clients take silence for a lost connection.
  if (frame.sequence == sequence_ && tool_version_ == 0 && structure_version_ != 0) {
    announce(base::steady_ns());
    publish(frame, base::steady_ns());
    return;
  }
  sequence_ = frame.sequence;
  if (frame.structure->version != structure_version_ || (ask_again_ && !frame.run.diverged)) search(frame);
  const adf::CrtkArm& arm = control_.description();
  if (!found_ && !warned_ && frame.sim_step > 0 && joints_.base() == state::kNone) {
    warned_ = true;
    log_.report(base::Diagnostic{base::Severity::warning, arm.file, arm.base_line, arm.base_column, arm.name, "base",
                                 "the scene has no body '" + arm.base + "'",
                                 "its topics come once a model with it is loaded"});
  }
  if (!bound_ && !load_failed_) {
    const std::lock_guard<std::mutex> lock_loaded(loaded_->mutex);
    load_failed_ = !loaded_->problem.empty();
    if (load_failed_) log_.error("CRTK: arm %s: %s", name_.c_str(), loaded_->problem.c_str());
  }
  const std::int64_t now_ns = base::steady_ns();
  if (viewer != nullptr) {
    const std::optional<math::Pose> base = T_world_view ? T_world_base(frame) : std::nullopt;
    control_.see_from(viewer->name(), base ? std::optional(math::inverse(*T_world_view) * *base) : std::nullopt);
  }
  if (bound_) {
    control_.update(read(frame, stamp_ns), now_ns);
    post();
    turn_camera(frame);
  }
  // So that the watchdog lets go if this program's part hangs.
  if (port_ != nullptr && (bound_ || control_.exchanging()) && now_ns - kept_ns_ >= kKeepAlive_ns) {
    port_->keep_alive();
    kept_ns_ = now_ns;
  }
  announce(now_ns);
  publish(frame, now_ns);
}

void ServedArm::publish(const state::Frame& frame, std::int64_t now_ns) {
  if (!topics_ || !rate_.due(now_ns, true)) return;
  topics_->publish(control_, bound_ ? joints_.gripper(frame) : std::nullopt);
}

std::optional<ServedArm::Frames> ServedArm::frames() {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (!bound_ || !control_.measured().valid || !control_.knows_base_frame()) return std::nullopt;
  const math::Pose base = control_.base_frame();
  return Frames{control_.frame(), base, base * control_.local_pose(control_.measured_joints()),
                control_.measured().stamp_ns};
}

void ServedArm::post() {
  if (port_ == nullptr) return;
  if (const std::optional<ArmCommand> command = control_.take_command()) port_->post(state::KindCommand{*command});
}

// Clients take a move for begun when they receive `busy` later, by their own clock, than they sent it. Simulated clocks
// advance in steps: so a move stays busy until time went on for everybody, and it is said again then.
bool ServedArm::must_wait(const Event& event, std::int64_t now_ns) {
  if (!stamps_.simulated() || event.kind != Event::Kind::state || event.busy || busy_told_ns_ == 0) return false;
  const bool all_see = now_ns - busy_told_ns_ >= kBusyAgain_ns && stamps_.now() > busy_told_stamp_;
  if (busy_again_ns_ == 0) {
    if (!all_see && now_ns - busy_told_ns_ < kGiveUp_ns) return true;
    if (topics_) topics_->publish({Event{Event::Kind::state, event.state, event.homed, true}});
    busy_again_ns_ = now_ns;
    return true;
  }
  return now_ns - busy_again_ns_ < kIdleAfter_ns;
}

void ServedArm::announce(std::int64_t now_ns) {
  for (Event& event : control_.take_events()) {
    if (event.kind == Event::Kind::warning) log_.warning("CRTK: %s: %s", name_.c_str(), event.text.c_str());
    if (event.kind == Event::Kind::error) log_.error("CRTK: %s: %s", name_.c_str(), event.text.c_str());
    untold_.push_back(std::move(event));
  }
  while (!untold_.empty() && !must_wait(untold_.front(), now_ns)) {
    const Event event = std::move(untold_.front());
    untold_.pop_front();
    if (event.kind == Event::Kind::state) {
      busy_told_ns_ = event.busy ? now_ns : 0;
      busy_told_stamp_ = stamps_.now();
      busy_again_ns_ = 0;
    }
    if (topics_) topics_->publish({event});
  }
}

}  // namespace ambf::crtk
