// A running simulation: the physics thread, the loader thread, the catalogue and the answering thread, with all
// abilities (state/abilities/). The program and tests create one; comm, render, devices and plugins see only the
// abilities they need.
#pragma once

#include <memory>
#include <string>

#include "base/log.h"
#include "runtime/options.h"
#include "scene/colors.h"
#include "scene/description.h"
#include "state/abilities/abilities.h"

namespace ambf::inputs {
class Recorder;  // inputs/recorder.h
}

namespace ambf::runtime {

class Simulation final : public state::ObserveAbility,
                         public state::RunAbility,
                         public state::EditAbility,
                         public state::TuneAbility,
                         public state::CommandAbility,
                         public state::PickAbility,
                         public state::EffectorAbility {
 public:
  // Starts all threads, the world holding still: begin() sets it going, so that what is loaded before takes part from
  // step 0 on. `log` and `recorder` must outlive it. `recorder`: where all inputs go (decision 0032); null: nowhere.
  Simulation(const SimulationOptions& options, const scene::World& world, scene::ColorTable colors, base::Log& log,
             inputs::Recorder* recorder = nullptr);
  ~Simulation() override;  // stops everything; requests in flight are answered with success = false

  void begin();

  state::Abilities abilities() { return {*this, *this, *this, *this, *this, *this, *this}; }

  std::unique_ptr<state::FrameReader> make_reader() override;
  std::unique_ptr<state::StepReader> read_steps() override;
  std::shared_ptr<const state::Structure> structure() override;
  std::unique_ptr<state::CommandPort> bind(state::ObjectId object, state::Source source) override;
  void post_world(const state::WorldCommand& command) override;
  void world_command_expired() override;
  void count_refused_command(state::ObjectId object) override;
  void report_graphics(double pictures_per_second, double seconds_per_picture) override;
  void report_comm(double seconds_per_frame) override;
  void set_paused(bool paused) override;
  void step_paused(unsigned steps) override;
  void reset_world() override;
  void reset_bodies() override;
  void reset_bodies(std::vector<state::ObjectId> bodies) override;
  void set_gravity(const math::Vec3& gravity_world) override;
  void set_speed(double factor) override;
  void set_parameter(state::ObjectId object, state::Parameter parameter, const math::Vec3& value,
                     state::Completion done) override;
  void set_hold(state::ObjectId object, bool hold, state::Completion done) override;
  void push(state::ObjectId body, const state::Push& push, state::Completion done) override;
  void set_lens(state::ObjectId camera, const state::Lens& lens) override;
  void set_parent(state::ObjectId object, const std::string& parent, state::Completion done) override;
  void set_beam(state::ObjectId light, const state::Beam& beam) override;
  std::unique_ptr<state::StepTicket> step(unsigned n, std::vector<state::AddressedCommand> commands,
                                          bool keep_frame) override;
  void load(state::LoadRequest request, state::Completion done) override;
  void unload(const std::string& model, state::Completion done) override;
  void remove(const std::string& object, state::Completion done) override;
  void save(state::SaveModelRequest request, state::Completion done) override;
  void snapshot(const std::string& name, const std::string& path, state::Completion done) override;
  void restore(const std::string& name, const std::string& path, state::Completion done) override;
  void forget(const std::string& name, state::Completion done) override;
  std::vector<std::string> snapshots() override;
  std::unique_ptr<state::PickPort> make_pick_port() override;  // must end before the simulation

  std::unique_ptr<state::EffectorPort> hold(state::ObjectId body, state::Source source) override;

  // load(), and waits for the outcome. Never call it from a completion.
  state::Outcome load_and_wait(state::LoadRequest request);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ambf::runtime
