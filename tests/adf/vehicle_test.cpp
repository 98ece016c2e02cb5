// Vehicle blocks: what they say, and what is wrong with them, with file, line and column.
#include "scene/vehicle.h"

#include "tests/adf/support.h"

namespace ambf::adf {
namespace {

// A vehicle whose one wheel has these keys besides what it needs.
ModelResult parse_wheel(const std::string& keys, const std::string& suspension = "stiffness: 20, rest length: 0.5") {
  return parse(
      "vehicles: [VEHICLE car]\nnamespace: /t/\n"
      "VEHICLE car:\n"
      "  name: car\n"
      "  chassis: BODY chassis\n"
      "  wheels:\n"
      "    - {radius: 0.3, offset: {x: 1, y: 0, z: 0}, suspension: {" +
      suspension + "}, " + keys + "}\n");
}

const scene::Vehicle& vehicle_of(const ModelResult& result) { return result.model->blocks.at(0).as<scene::Vehicle>(); }

TEST(Vehicle, SaysHowItsWheelsHangAndWhatTheyCanDo) {
  const ModelResult result = parse_wheel(
      "body: BODY w, friction: 2, roll influence: 0.3, down direction: {x: 0, y: 0, z: -1}, axel direction: "
      "{x: 0, y: 1, z: 0}, front: true, steering limits: {low: -0.4, high: 0.5}, max engine power: 30, max brake "
      "power: 40",
      "stiffness: 20, damping: 1, compression: 0.5, rest length: 0.5");
  ASSERT_TRUE(result.model);
  EXPECT_TRUE(no_worse_than_information(result.diagnostics));
  const scene::Vehicle& vehicle = vehicle_of(result);
  EXPECT_EQ(vehicle.parent, "BODY chassis");
  ASSERT_EQ(vehicle.wheels.size(), 1u);
  const scene::Wheel& wheel = vehicle.wheels.front();
  EXPECT_EQ(wheel.body, "BODY w");
  EXPECT_EQ(wheel.connection, (math::Vec3{1, 0, 0}));
  EXPECT_EQ(wheel.axle, (math::Vec3{0, 1, 0}));
  EXPECT_EQ(wheel.radius_m, 0.3);
  EXPECT_EQ(wheel.damping, 1.0);
  EXPECT_EQ(wheel.compression, 0.5);
  EXPECT_EQ(wheel.rest_length_m, 0.5);
  EXPECT_EQ(wheel.steering_low, -0.4);
  EXPECT_EQ(wheel.steering_high, 0.5);
  EXPECT_EQ(wheel.max_drive_N, 30.0);
  EXPECT_EQ(wheel.max_brake_N, 40.0);
  EXPECT_TRUE(wheel.front);
}

TEST(Vehicle, AWheelOfAMeshGetsABodyWithoutTopics) {
  const ModelResult result = parse_wheel("mesh: wheel.obj");
  ASSERT_TRUE(result.model);
  EXPECT_TRUE(no_worse_than_information(result.diagnostics));
  ASSERT_EQ(result.model->bodies.size(), 1u);
  const scene::Body& body = result.model->bodies.front();
  EXPECT_EQ(vehicle_of(result).wheels.front().body, body.identity.identifier);
  EXPECT_TRUE(body.identity.passive);
  EXPECT_EQ(body.mass, 0.0);
  EXPECT_EQ(body.visual.mesh_file, "wheel.obj");
}

TEST(Vehicle, WrongWheelsAreErrorsAtTheirPlace) {
  const std::string at = "^model.yaml:7:[0-9]+: error: \\[VEHICLE car: ";
  const auto refused = [&](const ModelResult& result, const std::string& what) {
    EXPECT_TRUE(says(result.diagnostics, at + what));
    EXPECT_TRUE(result.model && result.model->blocks.empty()) << "it is left out";
  };
  refused(parse_wheel("friction: 1"), "wheels\\[0\\]/body\\] missing, and so is `mesh`");
  refused(parse_wheel("body: w, down direction: {x: 0, y: 0, z: 0}"), "down direction\\] expected a direction");
  refused(parse_wheel("body: w, axel direction: {x: 0, y: 0, z: 0}"), "axel direction\\] expected a direction");
  refused(parse_wheel("body: w, axel direction: {x: 0, y: 0, z: 1}"), "wheels\\[0\\]/axel direction\\] .*across");
  refused(parse_wheel("body: BODY chassis"), "wheels\\[0\\]/body\\] .*is the chassis or another wheel");
  refused(parse_wheel("body: w", "stiffness: -1, rest length: 0.5"), "wheels\\[0\\]/suspension/stiffness\\]");
  refused(parse_wheel("body: w", "stiffness: 1, rest length: 0"), "wheels\\[0\\]/suspension/rest length\\]");
}

TEST(Vehicle, WhatMayBeMeantIsAWarning) {
  EXPECT_TRUE(says(parse_wheel("body: w, steering limits: {low: 1, high: -1}").diagnostics,
                   "model.yaml:7:[0-9]+: warning: .*steering limits\\] low is above high .they are exchanged."));
  EXPECT_TRUE(says(parse_wheel("body: w, steering limits: {low: -30, high: 30}").diagnostics,
                   "warning: .*more than a quarter turn"));
  EXPECT_TRUE(says(parse_wheel("body: w, mesh: w.obj").diagnostics, "warning: .*mesh\\] not used: `body` counts"));
}

}  // namespace
}  // namespace ambf::adf
