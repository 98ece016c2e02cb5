// Vehicles: their wheels carry them, are placed under them, and are waited for; commands, snapshots, resets, removal.
#include "state/vehicles.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "adf/adf.h"
#include "math/rotation.h"
#include "rig.h"

namespace ambf::model::test {
namespace {

constexpr double kBase = 0.6, kMass = 20.0;

std::string wheel(const std::string& body, double x, double y) {
  return "    - {body: BODY " + body +
         ", radius: 0.1, friction: 1, roll influence: 0.2, offset: {x: " + std::to_string(x) +
         ", y: " + std::to_string(y) +
         ", z: 0}, suspension: {stiffness: 60, damping: 6, compression: 6, rest length: 0.15}, steering limits: {low: "
         "-0.4, high: 0.4}, max engine power: 30, max brake power: 60}\n";
}

const std::string kCar =
    "namespace: /test/\nvehicles: [VEHICLE car]\nVEHICLE car:\n  name: car\n  chassis: BODY chassis\n  wheels:\n" +
    wheel("w0", 0.3, 0.2) + wheel("w1", 0.3, -0.2) + wheel("w2", -0.3, 0.2) + wheel("w3", -0.3, -0.2);

constexpr const char* kParts = R"(namespace: /test/
bodies: [BODY floor, BODY chassis, BODY w0, BODY w1, BODY w2, BODY w3]
joints: [JOINT axle]
BODY floor: {name: floor, mass: 0, collision shape: PLANE, collision geometry: {normal: {x: 0, y: 0, z: 1}, offset: 0}}
BODY chassis: {name: chassis, mass: 20, location: {position: {x: 0, y: 0, z: 0.209}}, collision shape: BOX,
               collision geometry: {x: 0.7, y: 0.3, z: 0.1}, damping: {linear: 0, angular: 0}}
BODY w0: {name: w0, mass: 1, location: {position: {x: 0, y: 2, z: 3}}, collision shape: CYLINDER,
          collision geometry: {radius: 0.1, height: 0.05, axis: Y}}
BODY w1: {name: w1, mass: 1, location: {position: {x: 0, y: 3, z: 3}},
          collision shape: SPHERE, collision geometry: {radius: 0.1}}
BODY w2: {name: w2, mass: 1, location: {position: {x: 0, y: 4, z: 3}},
          collision shape: SPHERE, collision geometry: {radius: 0.1}}
BODY w3: {name: w3, mass: 0, location: {position: {x: 0, y: 5, z: 3}},
          collision shape: SPHERE, collision geometry: {radius: 0.1}}
JOINT axle: {name: axle, parent: BODY chassis, child: BODY w0, type: revolute, parent pivot: {x: 0.3, y: 0.2, z: 0},
             child pivot: {x: 0, y: 0, z: 0}, parent axis: {x: 0, y: 1, z: 0}, child axis: {x: 0, y: 1, z: 0}}
)";

struct CarRig : Rig {
  explicit CarRig(bool car_first = false) : Rig({0, 0, -9.81}) {
    for (const bool car : {car_first, !car_first}) load_text(car ? kCar : kParts);
  }
  CarRig(const CarRig&) = delete;
  void load_text(const std::string& text) {
    adf::ModelResult read = adf::parse_model(text, "car.yaml");
    ASSERT_TRUE(read.model && !base::has_errors(read.diagnostics));
    ASSERT_TRUE(load(*read.model).success);
  }
  state::ObjectKind kind() const { return state::vehicle_kind().kind; }
  const state::VehicleState& car() const {
    return state::rows(*frame, state::vehicle_kind().column).at(slot("car", kind()));
  }
  state::WheelRange wheels() const { return state::wheels_of(*frame, slot("car", kind())); }
  void order(double drive, double steering = 0.0, double brake = 0.0, bool handbrake = false) {
    if (port_ == nullptr) port_ = port("car", state::Source::ros, kind());
    port_->post(state::KindCommand{state::VehicleCommand{
        {}, {steering, steering}, {drive, drive, drive, drive}, {brake, brake, brake, brake}, handbrake}});
  }
  void drive(int steps, double force, double steering = 0.0, double brake = 0.0) {
    for (int i = 0; i < steps; i += 100) {
      order(force, steering, brake);
      step(100);
    }
  }

 private:
  std::unique_ptr<state::CommandPort> port_;
};

class LoadOrders : public ::testing::TestWithParam<bool> {};

TEST_P(LoadOrders, AVehicleDrivesOnWheelsOfTheSameOrAnotherFile) {
  CarRig rig(GetParam());
  rig.step(500);
  EXPECT_NEAR(rig.body("chassis").T_world_body.position.z, 0.209, 1e-3) << "its wheels carry it";
  EXPECT_EQ(rig.car().T_world_object, rig.body("chassis").T_world_body);
  rig.drive(1000, 10.0);
  EXPECT_NEAR(rig.car().speed, 4.0 * 10.0 / kMass, 0.02) << "a second of F / m; the wheels weigh nothing";
  const math::Vec3 hub = rig.body("w1").T_world_body.position;
  const math::Vec3 chassis = rig.body("chassis").T_world_body.position;
  EXPECT_NEAR(hub.x - chassis.x, 0.3, 0.01);
  EXPECT_NEAR(hub.y - chassis.y, -0.2, 0.01);
  EXPECT_NEAR(hub.z, 0.1, 0.01) << "it stands on the ground";
  EXPECT_NEAR(rig.wheels()[1].rate, rig.car().speed / 0.1, 0.5);
}

INSTANTIATE_TEST_SUITE_P(Vehicles, LoadOrders, ::testing::Bool(),
                         [](const auto& parameter) { return parameter.param ? "CarFirst" : "PartsFirst"; });

TEST(Vehicles, WheelsAreSeenToRollSteerAndSpring) {
  CarRig rig;
  rig.step(300);
  const double length = rig.wheels()[0].suspension_m;
  EXPECT_NEAR(length, 0.15 - 9.81 / 240.0, 1e-3);
  rig.drive(100, 5.0, 0.3);
  const math::Pose steered = rig.wheels()[0].T_chassis_wheel;
  const math::Vec3 axle = math::rotate(steered.orientation, {0, -1, 0});
  EXPECT_NEAR(std::atan2(axle.x, -axle.y), 0.3, 1e-9) << "to the left";
  EXPECT_NEAR(math::rotate(rig.wheels()[2].T_chassis_wheel.orientation, {0, -1, 0}).y, -1.0, 1e-9) << "not steered";
  const double way = rig.car().T_world_object.position.x;
  rig.drive(500, 5.0, 0.0);
  const math::Vec3 spoke = math::rotate(rig.wheels()[2].T_chassis_wheel.orientation, {0, 0, 1});
  EXPECT_GT(std::abs(spoke.x), 0.05) << "it rolled, after " << rig.car().T_world_object.position.x - way << " m";
  EXPECT_NEAR(spoke.y, 0.0, 1e-9);
  // A push down is seen in the suspension, and in the body that is the wheel.
  const auto push = rig.port("chassis");
  push->post(force({0, 0, -100}));
  rig.step(400);
  EXPECT_LT(rig.wheels()[0].suspension_m, length - 0.01);
}

TEST(Vehicles, TurnAsTheirWheelbaseAndSteeringSay) {
  for (const double steering : {-0.3, 0.3}) {
    CarRig rig;
    rig.drive(1500, 5.0);
    rig.drive(1500, 0.0, steering);
    const math::Twist twist = rig.body("chassis").twist_world;
    const double radius = rig.car().speed / twist.angular.z;
    EXPECT_NEAR(radius, kBase / std::tan(steering), 0.05 * kBase / std::tan(std::abs(steering)));
  }
}

TEST(Vehicles, CommandsEndWithTheirWatchdogAndTheHandbrakeStays) {
  CarRig rig;
  rig.drive(500, 30.0, 0.2);
  rig.step(600);
  EXPECT_EQ(rig.wheels()[0].steering, 0.0);
  const double rolling = rig.car().speed;
  EXPECT_GT(rolling, 1.0);
  rig.step(200);
  EXPECT_NEAR(rig.car().speed, rolling, 0.02) << "nothing drives and nothing brakes";
  rig.order(30.0, 0.0, 0.0, true);
  rig.step(1500);
  EXPECT_TRUE(rig.car().handbrake);
  EXPECT_NEAR(rig.car().speed, 0.0, 1e-3) << "the command has ended, its handbrake has not";
  rig.order(30.0);
  rig.step(200);
  EXPECT_FALSE(rig.car().handbrake);
  EXPECT_GT(rig.car().speed, 0.5);
}

TEST(Vehicles, CommandsAreCutToWhatTheWheelsCanDo) {
  CarRig rig;
  rig.drive(1000, 1e6, 5.0);
  EXPECT_NEAR(rig.wheels()[0].steering, 0.4, 1e-12);
  EXPECT_LT(rig.car().speed, 4.0 * 30.0 / kMass + 0.1);
}

TEST(Vehicles, SenselessCommandsAreRefused) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(state::check(state::VehicleCommand{{}, {0.1}, {1.0}, {}, true}), "");
  EXPECT_NE(state::check(state::VehicleCommand{{{nan, 0, 0}, {}}, {}, {}, {}, false}), "");
  EXPECT_NE(state::check(state::VehicleCommand{{}, {nan}, {}, {}, false}), "");
  EXPECT_NE(state::check(state::VehicleCommand{{}, {}, {1e12}, {}, false}), "");
  EXPECT_NE(state::check(state::VehicleCommand{{}, {}, {}, {-std::numeric_limits<double>::infinity()}, false}), "");
  EXPECT_NE(state::check(state::VehicleCommand{{}, std::vector<double>(1000), {}, {}, false}), "");
}

TEST(Vehicles, ContinueFromSnapshotsBitForBit) {
  CarRig one, two;
  one.drive(700, 20.0, 0.3, 5.0);
  const std::vector<std::uint8_t> saved = one.live->save();
  ASSERT_EQ(two.live->restore(saved), "");
  two.live->fill(*two.frame);
  one.live->fill(*one.frame);
  EXPECT_EQ(one.wheels()[0].T_chassis_wheel, two.wheels()[0].T_chassis_wheel);
  for (int i = 0; i < 300; ++i) {
    one.step();
    two.step();
    ASSERT_EQ(one.body("chassis").T_world_body, two.body("chassis").T_world_body) << i;
    for (const char* name : {"w0", "w3"}) ASSERT_EQ(one.body(name).T_world_body, two.body(name).T_world_body) << i;
  }
}

TEST(Vehicles, AResetPutsChassisAndWheelsBack) {
  CarRig rig;
  const math::Pose hub = rig.body("w2").T_world_body;
  EXPECT_NEAR(hub.position.x, -0.3, 1e-3) << "from the moment of loading";
  rig.drive(1000, 20.0, 0.2);
  rig.order(0.0, 0.0, 0.0, true);
  rig.step();
  rig.live->reset();
  rig.live->fill(*rig.frame);
  EXPECT_EQ(rig.body("w2").T_world_body, hub);
  EXPECT_FALSE(rig.car().handbrake);
  EXPECT_EQ(rig.wheels()[0].rate, 0.0);
}

TEST(Vehicles, WhatIsRemovedIsNoWheelAnyMore) {
  CarRig rig;
  rig.step(300);
  ASSERT_TRUE(rig.apply(rig.catalogue.prepare_remove("BODY w0")).success);
  rig.step(500);
  EXPECT_FALSE(rig.wheels()[0].present);
  EXPECT_LT(rig.body("chassis").T_world_body.position.z, 0.2) << "it hangs down where it has no wheel";
  rig.load_text(
      "namespace: /test/\nbodies: [BODY w0]\nBODY w0: {name: w0, mass: 1, collision shape: SPHERE, collision geometry: "
      "{radius: 0.1}}\n");
  rig.step(1500);
  EXPECT_TRUE(rig.wheels()[0].present);
  EXPECT_NEAR(rig.body("chassis").T_world_body.position.z, 0.209, 2e-3);
  ASSERT_TRUE(rig.apply(rig.catalogue.prepare_remove("VEHICLE car")).success);
  rig.step(1000);
  EXPECT_LT(rig.body("chassis").T_world_body.position.z, 0.1) << "it lies on the ground";
  const auto lift = rig.port("w1");
  lift->post(force({0, 0, 20}));
  const double before = rig.body("w1").T_world_body.position.z;
  rig.step(300);
  EXPECT_GT(rig.body("w1").T_world_body.position.z, before + 0.1) << "a body like any other";
}

TEST(Vehicles, AChassisThatGoesLeavesItsWheelsToThemselves) {
  CarRig rig;
  rig.drive(300, 20.0);
  ASSERT_TRUE(rig.apply(rig.catalogue.prepare_remove("BODY chassis")).success);
  const auto lift = rig.port("w1");
  lift->post(force({0, 0, 20}));
  const double before = rig.body("w1").T_world_body.position.z;
  rig.step(300);
  EXPECT_GT(rig.body("w1").T_world_body.position.z, before + 0.1);
}

TEST(Vehicles, BodiesMadeOfWheelsMeshesAreRemovedWithTheirVehicle) {
  CarRig rig;
  const std::string mesh_wheel =
      "{mesh: wheel.obj, radius: 0.1, offset: {x: 0, y: 0, z: 0}, suspension: {stiffness: 60, damping: 6, "
      "compression: 6, rest length: 0.15}}";
  const std::string text =
      "namespace: /test/\nvehicles: [VEHICLE cart]\nVEHICLE cart: {name: cart, chassis: BODY none, wheels: [" +
      mesh_wheel + ", " + mesh_wheel + "]}\n";
  const std::size_t before = rig.frame->structure->objects.size();
  adf::Options options;
  options.look_for_files = false;
  const adf::ModelResult read = adf::parse_model(text, "cart.yaml", options);
  ASSERT_TRUE(read.model && rig.load(*read.model).success);
  rig.step();
  ASSERT_EQ(rig.frame->structure->objects.size(), before + 3);
  ASSERT_TRUE(rig.apply(rig.catalogue.prepare_remove("wheel1_of_cart")).success) << "one may go before";
  ASSERT_TRUE(rig.apply(rig.catalogue.prepare_remove("VEHICLE cart")).success);
  rig.step();
  EXPECT_EQ(rig.frame->structure->objects.size(), before);
  EXPECT_TRUE(rig.load(*read.model).success);
}

TEST(Vehicles, ANewCommandWithinBoundsReleasesAFrozenChassis) {
  CarRig rig;
  rig.step(500);
  const auto port = rig.port("car", state::Source::pointer, rig.kind());
  rig.live->set_gravity({0, 0, -1e12});
  rig.step();
  ASSERT_EQ(rig.live->freeze_diverged().size(), 1u);
  rig.live->set_gravity({0, 0, -9.81});
  rig.step(10);
  ASSERT_EQ(rig.frame->frozen_bodies, 1u);
  port->post(state::KindCommand{state::VehicleCommand{{{1e9, 0, 0}, {}}, {}, {}, {}, false}});
  rig.step(10);
  EXPECT_EQ(rig.frame->frozen_bodies, 1u) << "too much";
  const double before = rig.car().T_world_object.position.x;
  rig.drive(1000, 10.0);
  EXPECT_EQ(rig.frame->frozen_bodies, 0u);
  EXPECT_GT(rig.car().T_world_object.position.x, before + 0.5);
}

}  // namespace
}  // namespace ambf::model::test
