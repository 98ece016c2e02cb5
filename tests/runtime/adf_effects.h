// The same scene with and without a key of ADF, simulated: how tests of the keys' effects say what must differ. One
// thread.
#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <vector>

#include "simulation_rig.h"

namespace ambf::runtime::test {

// Where the scenes are put, out of reach of the world's walled ground.
inline constexpr math::Vec3 kAboveGround{0, 0, 50};

struct Effect {
  const char* key;                         // what is proved
  std::string without, with;               // two scenes, or the same key with two values
  unsigned steps;                          // of 1 ms
  std::function<double(Rig&)> measured;    // after them
  double expected_without, expected_with;  // within `tolerance`
  double tolerance;
  std::function<std::vector<state::AddressedCommand>(Rig&)> commands = {};
};

inline void expect_effects(const std::vector<Effect>& effects) {
  for (const Effect& effect : effects) {
    const auto measure = [&effect](const std::string& scene) {
      SimulationOptions options = test::free_running();
      options.sleeping = false;
      Rig rig(options, "");
      state::LoadRequest request;
      request.text = scene;
      request.path = "scene.yaml";
      request.T_world_model.position = kAboveGround;
      rig.loaded = rig.simulation.load_and_wait(request);
      EXPECT_TRUE(rig.loaded.success) << effect.key << ": " << rig.loaded.message;
      for (const base::Diagnostic& found : rig.loaded.diagnostics)
        EXPECT_NE(found.severity, base::Severity::error) << effect.key << ": " << base::to_string(found);
      rig.simulation.set_paused(true);
      rig.simulation.begin();
      rig.step(effect.steps, effect.commands ? effect.commands(rig) : std::vector<state::AddressedCommand>());
      return effect.measured(rig);
    };
    EXPECT_NEAR(measure(effect.without), effect.expected_without, effect.tolerance) << effect.key << ", without";
    EXPECT_NEAR(measure(effect.with), effect.expected_with, effect.tolerance) << effect.key << ", with";
  }
}

inline std::string at(double x, double y, double z, double r = 0.0) {
  return "location: {position: {x: " + std::to_string(x) + ", y: " + std::to_string(y) + ", z: " + std::to_string(z) +
         "}, orientation: {r: " + std::to_string(r) + ", p: 0, y: 0}}";
}

// A static frame and an arm of 1 kg, 0.5 m out along x, hinged about y at the frame's origin: without a motor it swings
// down.
inline std::string arm(const std::string& joint, const std::string& body = "", const std::string& header = "") {
  return header +
         "bodies: [FRAME, ARM]\njoints: [J]\nFRAME: {name: frame, mass: 0, collision shape: BOX, collision geometry: "
         "{x: "
         "0.2, y: 0.2, z: 0.2}}\nARM: {name: arm, " +
         (body.empty() ? "mass: 1, collision shape: BOX, collision geometry: {x: 0.1, y: 0.1, z: 0.1}" : body) + ", " +
         at(0.5, 0, 0) +
         "}\nJ: {name: j, parent: FRAME, child: ARM, parent pivot: {x: 0, y: 0, z: 0}, child pivot: {x: -0.5, y: 0, z: "
         "0}, parent axis: {x: 0, y: 1, z: 0}, child axis: {x: 0, y: 1, z: 0}, " +
         joint + "}\n";
}

inline math::Pose place(Rig& rig, const std::string& body) {
  math::Pose pose = rig.body(body).T_world_body;
  pose.position = pose.position - kAboveGround;
  return pose;
}
inline double arm_height(Rig& rig) { return place(rig, "ARM").position.z; }
inline double swung(Rig& rig) { return arm_height(rig) < -0.1 ? 1.0 : 0.0; }

}  // namespace ambf::runtime::test
