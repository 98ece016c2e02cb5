// What LiveWorld is made of, shared by its source files. For use inside model/ only.
#pragma once

#include <memory>
#include <vector>

#include "model/detail/laws.h"
#include "model/detail/live_commands.h"
#include "model/detail/live_effectors.h"
#include "model/detail/live_objects.h"
#include "model/detail/live_picks.h"
#include "model/live_world.h"
#include "model/step_actors.h"
#include "physics/world.h"
#include "state/sensors.h"

namespace ambf::model {

class Kind;

struct KindMoves;  // swap.h

inline constexpr std::size_t kMaxCutReports = 64;

struct LiveWorld::Impl {
  Impl(std::unique_ptr<physics::World> physics_world, CommandTable& table);

  // Before its first command: its motor holds it, or it is free.
  static void let_idle(LiveJoint& joint);
  // Pose in the world of an object; `object` is an index into structure->objects.
  math::Pose pose_of(std::uint32_t object) const;
  // Null unless an object of this kind has this id.
  LiveObject* find(state::ObjectId id, state::ObjectKind kind) const;
  // Slot of a body, or state::kNone.
  std::uint32_t body_slot(state::ObjectId id) const;
  void reparent(state::ObjectKind kind, const KindMoves& moves) const;
  // Those of bodies that have some left.
  void act_pushes(double h_s);
  void list_pushed();
  void each_object(void (Kind::*act)(Impl&, std::uint32_t) const);  // of every kind, in the order of registration
  void end_pushes();
  void prepare_effectors(double h_s);
  void act_effectors(double h_s);
  // Has the first cut of a source's command, push or law to a body logged, while there is room.
  void report_cut(std::uint32_t body, state::Source source);
  void report_cut(LiveBody& live, state::Source source);  // of what has no command slot
  void report_cut_gains(LiveBody& live);
  // False: there is no room now.
  bool report_cut(std::uint32_t body, const CutReport::Touch& touch);
  bool report_soft_body(std::uint32_t soft_body, CutReport::Of of);
  void report_needle(std::uint32_t actuator, CutReport::Of of, bool& reported);

  std::unique_ptr<physics::World> physics;
  std::shared_ptr<const state::Structure> structure;
  LiveTables tables;  // before `physics` is destroyed LiveWorld takes everything out of it
  LiveCommands commands;
  Laws laws;
  StepActors actors;
  LivePicks picks;
  LiveEffectors effectors;
  mutable std::vector<physics::Contact> contacts;  // room for a frame's
  std::uint64_t steps = 0;                         // since the start or the last reset
  double sim_time = 0.0;                           // s
  std::uint64_t epoch = 0;
  mutable bool changed = true;
  std::uint64_t parameters_version = 1;  // + 1 a change of any
  std::vector<CutReport> cut_reports;    // since they were last taken; room for kMaxCutReports
  std::vector<std::uint32_t> pushed;     // slots of bodies with push_steps; room for all
  std::unique_ptr<state::SensorEventLog> sensor_events = std::make_unique<state::SensorEventLog>();
  std::vector<std::uint32_t> resisted;  // by slot of bodies: elements of resistive sensors that touch it, this step

  // Mean CPU seconds of sampled steps, in our own phases.
  double commands_s = 0.0, controllers_s = 0.0;  // controllers: all that is no physics
  std::uint32_t until_sample = 0;
};

}  // namespace ambf::model
