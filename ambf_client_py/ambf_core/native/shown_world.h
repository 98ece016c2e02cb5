// A world that a Python program drives, as the simulator's windows see it: the frames that the program hands over, and
// the abilities of somebody who watches. Pause, speed, views and lights are the window's own, laid over copies of the
// frames; what would change the world itself is refused, since it belongs to the program. Two threads: that of the
// program, and that of the window. Knows nothing of Python and OpenGL.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "base/log.h"
#include "state/abilities/abilities.h"

namespace ambf::python {

class ShownWorld final : public state::ObserveAbility,
                         public state::RunAbility,
                         public state::EditAbility,
                         public state::TuneAbility,
                         public state::CommandAbility,
                         public state::PickAbility,
                         public state::EffectorAbility {
 public:
  // `log` must outlive it: what cannot be answered otherwise is refused there.
  ShownWorld(const state::Frame& frame, base::Log& log);
  state::Abilities abilities() { return {*this, *this, *this, *this, *this, *this, *this}; }

  // ---- the program's thread ----

  // What the window shows from now on: a copy. It is over when so many seconds, divided by the window's speed, have
  // passed since the one before was over, or since now if that was long ago. Frames may be of different worlds.
  void show(const state::Frame& frame, double seconds);
  // Waits until what is shown is over. While the window is paused that is so after a step by hand, a reset or end().
  // False: not within the timeout.
  bool wait_until_over(std::chrono::nanoseconds timeout);
  // Whether a reset was asked for since the last call.
  bool take_reset();
  bool paused();

  // ---- any thread ----

  // The window is gone: nobody waits for it any longer.
  void end();
  bool ended();

  // ---- abilities: the window's thread ----

  std::unique_ptr<state::FrameReader> make_reader() override;
  std::unique_ptr<state::StepReader> read_steps() override { return nullptr; }
  std::shared_ptr<const state::Structure> structure() override;
  void report_graphics(double, double) override {}
  void report_comm(double) override {}

  void set_paused(bool paused) override;
  void step_paused(unsigned steps) override;  // each lets the program go on once
  void reset_world() override;                // asks the program for it
  void reset_bodies() override { reset_world(); }
  void reset_bodies(std::vector<state::ObjectId>) override { reset_world(); }
  void set_speed(double factor) override;
  void post_world(const state::WorldCommand&) override {}
  void world_command_expired() override {}
  std::unique_ptr<state::StepTicket> step(unsigned, std::vector<state::AddressedCommand>, bool) override;
  void snapshot(const std::string&, const std::string&, state::Completion done) override { refuse(done); }
  void restore(const std::string&, const std::string&, state::Completion done) override { refuse(done); }
  void forget(const std::string&, state::Completion done) override { refuse(done); }
  std::vector<std::string> snapshots() override { return {}; }

  void load(state::LoadRequest, state::Completion done) override { refuse(done); }
  void unload(const std::string&, state::Completion done) override { refuse(done); }
  void remove(const std::string&, state::Completion done) override { refuse(done); }
  void save(state::SaveModelRequest, state::Completion done) override { refuse(done); }
  void set_parent(state::ObjectId, const std::string&, state::Completion done) override { refuse(done); }

  void set_gravity(const math::Vec3&) override;
  void set_parameter(state::ObjectId, state::Parameter, const math::Vec3&, state::Completion done) override {
    refuse(done);
  }
  void set_hold(state::ObjectId, bool, state::Completion done) override { refuse(done); }
  void set_lens(state::ObjectId camera, const state::Lens& lens) override;
  void set_beam(state::ObjectId light, const state::Beam& beam) override;

  std::unique_ptr<state::CommandPort> bind(state::ObjectId object, state::Source source) override;
  void count_refused_command(state::ObjectId) override {}
  void push(state::ObjectId, const state::Push&, state::Completion done) override { refuse(done); }
  std::unique_ptr<state::PickPort> make_pick_port() override { return nullptr; }
  std::unique_ptr<state::EffectorPort> hold(state::ObjectId, state::Source) override { return nullptr; }

 private:
  class Reader;
  class Port;
  // What the window has otherwise than the world: of a camera or a light.
  struct Own {
    state::ObjectId object;
    std::optional<math::Pose> T_parent_object{};
    std::optional<state::Lens> lens{};
    std::optional<state::Beam> beam{};
  };

  static void refuse(const state::Completion& done);
  Own& own(state::ObjectId object);  // locked
  void lay_over(state::Frame& frame) const;
  std::shared_ptr<const state::Frame> newest();

  base::Log& log_;
  std::mutex mutex_;
  std::condition_variable news_;
  std::shared_ptr<const state::Frame> given_;          // as the program has it
  std::shared_ptr<const state::Structure> given_of_;   // the structure that structure_ is a copy of
  std::shared_ptr<const state::Structure> structure_;  // with a version of its own: worlds' numbers meet
  std::shared_ptr<const state::Frame> shown_;          // what windows get
  bool changed_ = true;                                // since shown_ was made
  std::uint64_t sequence_ = 0;
  std::vector<Own> own_;
  std::int64_t due_ns_ = 0, given_ns_ = 0;
  double speed_ = 1.0;
  unsigned steps_ = 0;
  bool paused_ = false, reset_ = false, ended_ = false;
};

}  // namespace ambf::python
