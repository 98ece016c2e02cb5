// A simulation on the caller's thread: the iterations of the physics thread (physics_loop.h), but no thread, ROS or GL,
// and no time that passes by itself. For tests, checks and programs that embed the simulation. Steps are the same as
// those of Step requests to a Simulation, bit for bit. Not thread-safe; several may exist side by side and be driven by
// one thread or by a thread each (docs/architecture.md).
#pragma once

#include <memory>
#include <string>

#include "base/log.h"
#include "mesh/cache.h"
#include "model/law.h"
#include "runtime/options.h"
#include "scene/colors.h"
#include "scene/description.h"
#include "state/abilities/command.h"
#include "state/abilities/edit.h"
#include "state/abilities/effector.h"
#include "state/frame.h"
#include "state/parameters.h"

namespace ambf::runtime {

class LocalSimulation final : public state::EffectorAbility {
 public:
  // Always runs fixed steps, whatever `options` say. `log` must outlive it. Simulations with the same `meshes` keep
  // each mesh and what is made of it once; null: a cache of its own.
  LocalSimulation(SimulationOptions options, const scene::World& world, scene::ColorTable colors, base::Log& log,
                  std::shared_ptr<mesh::MeshCache> meshes = nullptr);
  ~LocalSimulation() override;
  LocalSimulation(const LocalSimulation&) = delete;
  LocalSimulation& operator=(const LocalSimulation&) = delete;

  state::Outcome load(const state::LoadRequest& request);
  state::Outcome load(const scene::Model& model);
  state::Outcome unload(const std::string& model);
  state::Outcome remove(const std::string& object);
  state::Outcome save(const state::SaveModelRequest& request);

  // Runs n steps; with n = 0, cameras and static bodies follow their commands. False when the world has diverged.
  bool step(unsigned n = 1);
  // Bodies, time, step count, controllers, parents of cameras and lights: as loaded.
  void reset();
  // The whole state, kept in memory under `name` (empty: "snapshot<n>"); restores it in place; lets it go.
  state::Outcome snapshot(const std::string& name);
  state::Outcome restore(const std::string& name);
  state::Outcome forget(const std::string& name);

  // As of TuneAbility, CommandAbility and EditAbility.
  state::Outcome set_parameter(state::ObjectId object, state::Parameter parameter, const math::Vec3& value);
  void set_gravity(const math::Vec3& gravity_world);  // until reset()
  state::Outcome push(state::ObjectId body, const state::Push& push);
  state::Outcome set_parent(state::ObjectId object, const std::string& parent);
  // As of LiveWorld.
  bool hold(state::ObjectId body, state::Source source, model::Law& law);
  void let_go(state::ObjectId body, state::Source source);
  // As of EffectorAbility; a set-point is in force from the next call of step() on.
  std::unique_ptr<state::EffectorPort> hold(state::ObjectId body, state::Source source) override;

  // Null when the object does not exist or accepts no commands. The port must not outlive this object.
  std::unique_ptr<state::CommandPort> bind(state::ObjectId object, state::Source source);

  // The newest frame; valid until the next call that steps or changes the world.
  const state::Frame& frame() const;
  std::shared_ptr<const state::Structure> structure() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ambf::runtime
