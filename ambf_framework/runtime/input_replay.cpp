#include "runtime/input_replay.h"

#include <cstdio>
#include <optional>
#include <utility>

#include "inputs/physics_records.h"
#include "runtime/detail/physics_loop.h"
#include "runtime/detail/replayed_devices.h"
#include "runtime/detail/replayed_scene.h"
#include "runtime/detail/request_scope.h"
#include "runtime/detail/requests.h"
#include "runtime/detail/world_setup.h"

namespace ambf::runtime {

using inputs::RawRecord;
using inputs::Type;

struct InputReplay::Impl final : LoopHost {
  Impl(const SimulationOptions& options, const scene::World& world, scene::ColorTable colors,
       std::vector<devices::ReplayedDevice::Setup> setups, inputs::Recording& recording_in, base::Log& log)
      : recording(recording_in),
        scene(options, world, std::move(colors), recording, log),
        loop(options, time_config(options, world), make_live_world(options, world, scene.work().commands()), log,
             *this),
        devices(std::move(setups), recording) {}

  bool good() const { return outcome.problem.empty() && !at_end; }
  void fail(std::string problem) {
    if (!good()) return;
    outcome.problem = std::move(problem);
    outcome.other_scene = !scene.start_seen();
  }
  // Before the simulation was set going there is nothing but the scene that could differ.
  void differ(const std::string& what) {
    fail(scene.start_seen() ? what : "the scene is another one than that of the recording: " + what);
  }
  template <class Record>
  std::optional<Record> decoded(const RawRecord& raw) {
    std::optional<Record> record = raw.as<Record>();
    if (!record) fail("the recording is damaged: a record is not what it says");
    return record;
  }

  // ---- What the physics thread found.

  void put_back(const RawRecord& raw) {
    model::CommandTable& commands = scene.work().commands();
    model::EffectorTable& effectors = loop.world().effector_table();
    bool there = true;
    switch (raw.type) {
      case Type::set_point:
        if (const auto found = decoded<inputs::SetPointRecord>(raw)) put_back(*found);
        break;
      case Type::effector_ended:
        if (const auto found = decoded<inputs::EffectorEndedRecord>(raw))
          there = effectors.replay_ended(found->slot, found->hold, found->released);
        break;
      case Type::command:
        if (const auto found = decoded<inputs::CommandRecord>(raw)) put_back(*found);
        break;
      case Type::kind_command:
        if (const auto found = decoded<inputs::KindCommandRecord>(raw))
          there = commands.replay({found->object, found->source, found->received_ns, found->posted_ns}, found->bytes);
        break;
      case Type::command_kept:
        if (const auto found = decoded<inputs::CommandKeptRecord>(raw))
          there = commands.replay_kept({found->object, found->source, 0, found->posted_ns});
        break;
      case Type::command_ended:
        if (const auto found = decoded<inputs::CommandEndedRecord>(raw))
          there = commands.replay_ended(found->object, found->source);
        break;
      case Type::command_lasting:
        if (const auto found = decoded<inputs::CommandLastingRecord>(raw))
          there = commands.replay_lasting(found->object, found->source, found->lasting);
        break;
      case Type::pick_target:
        if (const auto found = decoded<inputs::PickTargetRecord>(raw)) {
          there = found->pointer < base::kMaxPicks && math::is_finite(found->point_world);
          if (there) loop.world().pick_table()[found->pointer].target.post({found->press, found->point_world}, 0);
        }
        break;
      default:
        if (const auto found = decoded<inputs::PickEndedRecord>(raw)) {
          there = found->pointer < base::kMaxPicks;
          if (there) loop.world().pick_table()[found->pointer].ended.store(found->press, std::memory_order_release);
        }
        break;
    }
    if (!there) fail("the recording is damaged: an object that is commanded is not there");
  }

  bool run_device(state::Source source, std::int64_t until_ns) {
    const ReplayedDevices::Ran ran = devices.run_until(source, until_ns, loop.frames().newest());
    if (ran == ReplayedDevices::Ran::failed) differ(devices.problem());
    at_end |= ran == ReplayedDevices::Ran::at_end;
    return good();
  }

  void put_back(const inputs::SetPointRecord& found) {
    if (!run_device(found.source, found.posted_ns)) return;
    const state::SetPoint* posted = devices.set_point(found.source, found.posted_ns);
    model::EffectorTable& table = loop.world().effector_table();
    if (posted == nullptr || !table.replay(found.slot, {found.hold, found.body, found.source, *posted})) {
      fail("the recording is damaged: a device posted no such set-point");
    }
  }

  void put_back(const inputs::CommandRecord& found) {
    if (found.source >= state::Source::device_0) {
      if (!run_device(found.source, found.received_ns)) return;
      const auto* recorded = std::get_if<state::PoseCommand>(&found.command);
      const math::Pose* posted = devices.camera_pose(found.source, found.object, found.received_ns);
      if (recorded == nullptr || posted == nullptr || !(*posted == recorded->T_parent_object)) {
        return differ("a device moves its camera otherwise than in the recording, at step " +
                      std::to_string(loop.world().sim_step()));
      }
    }
    state::Command checked = found.command;
    auto* body = std::get_if<state::RigidBodyCommand>(&checked);
    const bool refused =
        !(body != nullptr ? state::check(*body) : state::check(std::get<state::PoseCommand>(checked))).empty();
    model::CommandTable& table = scene.work().commands();
    if (refused || !table.replay({found.object, found.source, found.received_ns, found.posted_ns}, found.command)) {
      fail("the recording is damaged: it has a command that nothing obeys");
    }
  }

  // All that was found by what the physics thread does next.
  void put_back_found() {
    for (const RawRecord* raw = recording.peek(inputs::kPhysicsStream);
         good() && raw != nullptr && inputs::is_found(raw->type); raw = recording.peek(inputs::kPhysicsStream)) {
      put_back(*recording.next(inputs::kPhysicsStream));
    }
  }

  // ---- What it did.

  void repeat(const RawRecord& raw) {
    RequestScope scope(loop);
    switch (raw.type) {
      case Type::iteration:
        if (const auto did = decoded<inputs::IterationRecord>(raw)) {
          put_back_found();
          if (good()) loop.begin_iteration(did->watch_s, did->steps, did->still);
        }
        break;
      case Type::take:
        if (const auto did = decoded<inputs::TakeRecord>(raw)) take(*did);
        break;
      case Type::published:
        if (const auto did = decoded<inputs::PublishedRecord>(raw)) publish(*did);
        break;
      case Type::scene_request:
        if (const auto did = decoded<inputs::SceneRequestRecord>(raw)) serve(*did);
        break;
      case Type::pause:
        if (const auto did = decoded<inputs::PauseRecord>(raw)) scope.set_paused(did->paused);
        break;
      case Type::reset:
        if (const auto did = decoded<inputs::ResetRecord>(raw)) {
          if (did->of == inputs::ResetOf::world) scope.reset_world();
          if (did->of == inputs::ResetOf::bodies) scope.reset_bodies();
          if (did->of == inputs::ResetOf::some_bodies) scope.reset_bodies(did->some);
        }
        break;
      case Type::parameter:
        if (const auto did = decoded<inputs::ParameterRecord>(raw);
            did && fit(state::check(did->parameter, did->value)))
          scope.set_parameter(did->object, did->parameter, did->value);
        break;
      case Type::push:
        if (const auto did = decoded<inputs::PushRecord>(raw); did && fit(state::check(did->push)))
          scope.push(did->body, did->push);
        break;
      case Type::gravity:
        if (const auto did = decoded<inputs::GravityRecord>(raw); did && fit_if(math::is_finite(did->gravity_world)))
          scope.set_gravity(did->gravity_world);
        break;
      case Type::hold:
        if (const auto did = decoded<inputs::HoldRecord>(raw)) scope.set_hold(did->object, did->hold);
        break;
      case Type::lens:
        if (const auto did = decoded<inputs::LensRecord>(raw); did && fit(state::check(did->lens)))
          scope.set_lens(did->camera, did->lens);
        break;
      case Type::beam:
        if (const auto did = decoded<inputs::BeamRecord>(raw); did && fit(state::check(did->beam)))
          scope.set_beam(did->light, did->beam);
        break;
      case Type::pick:
        if (const auto did = decoded<inputs::PickRecord>(raw);
            did && fit_if(did->pointer < base::kMaxPicks && math::is_finite(did->from_world) &&
                          math::is_finite(did->to_world))) {
          put_back_found();
          state::PickHit hit;
          scope.pick(did->pointer, did->press, did->from_world, did->to_world, hit);
        }
        break;
      default: fail("the recording is damaged: it has a record of no known type"); break;
    }
  }

  bool fit(const std::string& refused) { return fit_if(refused.empty()); }
  bool fit_if(bool fits) {
    if (!fits) fail("the recording is damaged: it has a request that is refused");
    return fits;
  }

  void take(const inputs::TakeRecord& did) {
    put_back_found();
    if (!good()) return;
    if (!did.step) return loop.take_commands(did.watch_s);
    loop.step(did.watch_s);
    ++outcome.steps;
  }

  void serve(const inputs::SceneRequestRecord& did) {
    std::string problem;
    RequestPtr request = scene.next_request(did.change, problem);
    if (request == nullptr && problem.empty()) {
      at_end = true;
      return;
    }
    if (request == nullptr) {
      fail(problem);
      outcome.other_scene = true;
      return;
    }
    put_back_found();
    watch_now_s = did.watch_s;
    RequestScope scope(loop);
    request->run(scope);
    request->answer(true);
    if (!scene.is_as_recorded(problem)) fail(problem);
  }

  void publish(const inputs::PublishedRecord& did) {
    published = did;
    loop.publish(did.now_ns);
  }

  // ---- LoopHost.

  double watch_s(double) override { return watch_now_s; }

  // A change of the structure publishes, too: the record follows that of the request.
  std::int64_t frame_time_ns(std::int64_t now_ns) override {
    if (devices.finish_frame(loop.frames().newest()) == ReplayedDevices::Ran::failed) differ(devices.problem());
    if (!published) {
      const RawRecord* raw = recording.peek(inputs::kPhysicsStream);
      if (raw != nullptr && raw->type == Type::published)
        published = decoded<inputs::PublishedRecord>(*recording.next(inputs::kPhysicsStream));
    }
    return published ? published->now_ns : now_ns;
  }

  // The throttle decides when steps are run, which the recording has; here only devices see it.
  void add_reports(state::RunState& run) override {
    if (published) run.throttled = published->throttled;
  }

  void on_published() override {
    if (!published) return;
    const inputs::PublishedRecord was = *std::exchange(published, std::nullopt);
    const state::Frame& now = *loop.frames().newest();
    ++outcome.frames;
    outcome.sim_time_s = now.sim_time;
    const std::uint64_t hash = state::state_hash(now);
    if (now.sequence != was.frame || hash != was.state_hash) {
      char text[160];
      std::snprintf(text, sizeof text,
                    "frame %llu (step %u, recorded: step %u) has state_hash %016llx, recorded: %016llx",
                    static_cast<unsigned long long>(now.sequence), now.sim_step, was.sim_step,
                    static_cast<unsigned long long>(hash), static_cast<unsigned long long>(was.state_hash));
      differ(text);
    }
    put_back_found();  // by what a request did after the frame of its change
  }

  inputs::Recording& recording;
  ReplayedScene scene;
  PhysicsLoop loop;
  ReplayedDevices devices;
  std::optional<inputs::PublishedRecord> published;
  double watch_now_s = 0.0;
  bool at_end = false;
  ReplayOutcome outcome;
};

InputReplay::InputReplay(const SimulationOptions& options, const scene::World& world, scene::ColorTable colors,
                         std::vector<devices::ReplayedDevice::Setup> devices, inputs::Recording& recording,
                         base::Log& log)
    : impl_(std::make_unique<Impl>(options, world, std::move(colors), std::move(devices), recording, log)) {}

InputReplay::~InputReplay() = default;

ReplayOutcome InputReplay::run(const std::function<bool()>& stop) {
  constexpr unsigned kStopEvery = 1024;  // records
  Impl& replay = *impl_;
  for (unsigned done = 0; replay.good() && (done % kStopEvery != 0 || !stop()); ++done) {
    const RawRecord* raw = replay.recording.next(inputs::kPhysicsStream);
    if (raw == nullptr) break;
    replay.repeat(*raw);
  }
  replay.outcome.cycles = replay.devices.cycles();
  replay.outcome.set_points = replay.devices.set_points();
  return replay.outcome;
}

const state::Frame* InputReplay::frame() const { return impl_->loop.frames().newest(); }

}  // namespace ambf::runtime
