// A sensor in the simulation, and what its readings mean to other kinds (actuators, tasks). Each type of sensor is one
// file in model/kinds/sensor/ that derives from LiveSensor, and one row of the table in types.cpp. Physics thread,
// except for what makes a sensor.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "model/detail/live_impl.h"
#include "physics/rays.h"
#include "scene/sensor.h"
#include "state/sensors.h"

namespace ambf::model {

// What one element senses, in the world, of the last reading: a body, or a face of a soft body; neither, and `fraction`
// 1, where it senses nothing.
// Bodies are alive: when objects come or go all sensors read anew before anybody can read their hits.
using ElementHit = physics::BundleHit;

// Whether a sensor's task is done (model/kinds/sensor/judgement.cpp).
struct Judgement {
  bool sensed = false, matched = false, success = false;
  state::ObjectId sensed_object, partner;  // what it senses, and the body that it is matched with
  std::uint64_t held_steps = 0;            // for which the condition of success has held
  double success_since_s = 0.0;
};

struct LiveSensor : LivePlaced {
  // The phases of a step: among the forces all sensors prepare, then each acts; all read on the new poses.
  virtual void prepare(LiveWorld::Impl& /*live*/, std::uint32_t /*slot*/) {}
  virtual void act(LiveWorld::Impl& /*live*/, std::uint32_t /*slot*/, double /*h_s*/) {}
  virtual void read(const LiveWorld::Impl& live, std::uint32_t slot) = 0;
  // Brings the reading up to date where poses changed without a step; after forget(), all of it.
  virtual void refresh(const LiveWorld::Impl& live, std::uint32_t slot) = 0;
  // Bodies came or went, or were put elsewhere by a reset or a restore: no pointer to a body survives.
  virtual void forget() = 0;
  virtual void reset() { forget(); }
  // All kinds were linked, reset or restored since the last reading: some of what it senses after it was.
  virtual void settle(const LiveWorld::Impl& live, std::uint32_t slot) { refresh(live, slot); }
  // Writes what a frame holds of it beside its hits (state/readings.h); rows are empty before.
  virtual void fill(const LiveWorld::Impl& /*live*/, std::uint32_t /*slot*/, state::Frame& /*frame*/) const {}
  // What an element that senses something measures too much, m, as of this step. Pure: nothing remembers it.
  virtual double error_m(std::uint64_t /*step*/, std::size_t /*element*/) const { return 0.0; }
  // What a snapshot keeps beside the pose: as many numbers as SensorType::saved_numbers says. restore() comes after
  // forget() and refresh().
  virtual void save(const LiveWorld::Impl& /*live*/, std::vector<double>& /*numbers*/) const {}
  virtual void restore(const LiveWorld::Impl& /*live*/, std::span<const double> /*numbers*/) {}

  // One an element; empty where the type has no rays.
  std::vector<ElementHit> hits;
  // What each element did to what it senses, in the last step; empty where the type applies no forces.
  struct Effect {
    math::Vec3 force_world;  // N, at the hit's point
    bool slipped = false;
  };
  std::vector<Effect> effects;

  // Of its identifier in the world: sensors of two instances of one file draw different noise.
  std::uint64_t noise_seed = 0;

  Judgement judgement;
  std::uint32_t key = state::kNone;  // equal for sensors with equal matching keys; kNone: none
};

// The sensor of this slot.
LiveSensor& sensor_at(const LiveWorld::Impl& live, std::uint32_t slot);
// Its pose in the world.
math::Pose pose_of_sensor(const LiveWorld::Impl& live, std::uint32_t slot);
// The body that it sits on, be it by way of other objects; null: none.
const physics::Body* carrier_of(const LiveWorld::Impl& live, std::uint32_t slot);

struct SensorType {
  state::SensorType type = state::SensorType::proximity;
  // Loader thread. `rays`: one an element, in the sensor's frame.
  std::unique_ptr<LiveSensor> (*make)(const scene::Sensor& described,
                                      const std::vector<state::SensorRay>& rays) = nullptr;
  bool casts_rays = true;
  // Of a snapshot, for a sensor with this row; null: none.
  std::size_t (*saved_numbers)(const state::SensorInfo& row) = nullptr;
};

// Null: the type is known and checked, not simulated yet.
const SensorType* sensor_type(state::SensorType type);

// The rows of the table, one in each file.
SensorType contact_sensor_type();
SensorType force_torque_sensor_type();
SensorType imu_sensor_type();
SensorType proximity_sensor_type();
SensorType range_sensor_type();
SensorType resistance_sensor_type();

}  // namespace ambf::model
