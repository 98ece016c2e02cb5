// Wheels below a chassis: what carries it, drives it, turns it and holds it.
#include "physics/wheels.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "physics/mounted_bodies.h"
#include "tests/physics/fixtures.h"

namespace ambf::physics::testing {
namespace {

constexpr double kBase = 0.6, kTrack = 0.4, kRadius = 0.1, kRest = 0.15, kMass = 20.0, kStiffness = 60.0;

std::vector<Wheel> four_wheels() {
  std::vector<Wheel> wheels;
  for (const double x : {0.5 * kBase, -0.5 * kBase})
    for (const double y : {0.5 * kTrack, -0.5 * kTrack}) {
      Wheel wheel;
      wheel.connection = {x, y, 0.0};
      wheel.radius = kRadius;
      wheel.rest_length = kRest;
      wheel.stiffness = kStiffness;
      wheel.compression = wheel.relaxation = 6.0;
      wheel.friction = 1.0;
      wheel.roll_influence = 0.2;
      wheels.push_back(wheel);
    }
  return wheels;
}

// A car on a plane that rises by `slope` (rad) along x, where its springs carry it.
struct Car {
  explicit Car(double slope = 0.0, double step = 0.001, const math::Quat& heading = {})
      : world([&] {
          WorldOptions options;
          options.gravity = {-9.81 * std::sin(slope), 0.0, -9.81 * std::cos(slope)};
          options.step = step;
          return options;
        }()),
        floor(parameters(0.0, {ground()}, {})),
        chassis([&] {
          const double sink = 9.81 * std::cos(slope) / (4.0 * kStiffness);
          BodyDefinition p = parameters(kMass, {box(0.7, 0.3, 0.1)}, {0, 0, kRest + kRadius - sink});
          p.T_world_body.orientation = heading;
          p.surface.linear_damping = p.surface.angular_damping = 0.0;
          return p;
        }()),
        wheels(four_wheels()),
        orders(4) {
    world.add(floor);
    world.add(chassis);
  }
  void step(int count = 1) {
    for (int i = 0; i < count; ++i) {
      wheels.act(world, chassis, orders);
      world.step();
      wheels.advance(world, chassis);
    }
  }
  void all(double drive, double brake) {
    for (WheelOrder& order : orders) order.drive = drive, order.brake = brake;
  }
  math::Vec3 at() const { return chassis.com_pose().position; }

  World world;
  Body floor, chassis;
  Wheels wheels;
  std::vector<WheelOrder> orders;
};

TEST(Wheels, SpringsCarryTheChassisByItsMass) {
  for (const double step : {0.0005, 0.001, 0.004}) {
    Car car(0.0, step);
    car.step(static_cast<int>(2.0 / step));
    EXPECT_NEAR(car.at().z, kRest + kRadius - 9.81 / (4.0 * kStiffness), 1e-6);
    EXPECT_NEAR(car.wheels.contact(0).force.z, kMass * 9.81 / 4.0, 1e-4);
    EXPECT_LT(math::norm(car.chassis.twist().linear), 1e-6) << "it stands still";
  }
}

TEST(Wheels, DriveAcceleratesByForceByMass) {
  Car car;
  car.all(10.0, 0.0);
  car.step(500);
  const double before = car.chassis.twist().linear.x;
  car.step(1000);
  EXPECT_NEAR(car.chassis.twist().linear.x - before, 4.0 * 10.0 / kMass, 2e-3);
  EXPECT_NEAR(car.wheels.motions()[0].rate, car.chassis.twist().linear.x / kRadius, 0.02);
}

TEST(Wheels, MoreDriveThanGripSlips) {
  Car car;
  car.all(1000.0, 0.0);
  car.step(500);
  const double before = car.chassis.twist().linear.x;
  car.step(500);
  EXPECT_NEAR((car.chassis.twist().linear.x - before) / 0.5, 9.81, 0.1) << "friction 1 carries its weight";
}

TEST(Wheels, TurnOnTheRadiusOfWheelbaseAndSteering) {
  for (const double steering : {-0.3, -0.1, 0.1, 0.3}) {
    Car car;
    car.all(4.0, 0.0);
    car.step(1500);
    car.all(0.0, 0.0);
    car.orders[0].steering = car.orders[1].steering = steering;
    car.step(1000);
    const math::Twist twist = car.chassis.twist();
    // Of the middle of the rear axle, which does not slide sideways.
    const math::Vec3 ahead = math::rotate(car.chassis.com_pose().orientation, {1, 0, 0});
    const double radius = math::dot(twist.linear, ahead) / twist.angular.z;
    EXPECT_NEAR(radius, kBase / std::tan(steering), 0.05 * kBase / std::tan(std::abs(steering))) << steering;
  }
}

TEST(Wheels, FullBrakeHoldsOnASlopeWithoutCreep) {
  for (const double heading : {0.0, 0.7, kPi / 2.0}) {
    Car car(10.0 * kPi / 180.0, 0.001, math::from_axis_angle({0, 0, 1}, heading));
    car.all(0.0, 200.0);
    car.step(3000);  // until the springs have settled
    const math::Vec3 before = car.at();
    car.step(60000);
    EXPECT_LT(math::norm(car.at() - before), 1e-5) << heading;
  }
}

TEST(Wheels, ABrakeWeakerThanTheSlopeGivesWay) {
  Car car(10.0 * kPi / 180.0);
  car.all(0.0, 2.0);  // 8 of 34 N
  car.step(2000);
  EXPECT_NEAR(car.chassis.twist().linear.x, -2.0 * (9.81 * std::sin(10.0 * kPi / 180.0) - 8.0 / kMass), 0.02);
}

TEST(Wheels, PressOnWhatTheyStandOn) {
  Car car;
  Body plank(parameters(5.0, {box(2.0, 1.0, 0.05)}, {0, 0, 0.025}));
  car.world.add(plank);
  car.chassis.set_pose({{0, 0, car.at().z + 0.05}, {}});
  car.step(1000);
  std::array<Contact, 32> contacts;
  double load = 0.0;
  const std::size_t count = car.world.contacts(contacts);
  for (std::size_t i = 0; i < count; ++i) load += contacts[i].normal_impulse / 0.001;
  EXPECT_NEAR(load, (5.0 + kMass) * 9.81, 1.0);
  // A plank without friction below is pushed back by what drives the car.
  scene::Surface ice = plank.surface();
  ice.friction = 0.0;
  plank.set_surface(ice);
  car.all(5.0, 0.0);
  car.step(200);
  const double momentum = kMass * car.chassis.twist().linear.x + 5.0 * plank.twist().linear.x;
  EXPECT_LT(plank.twist().linear.x, -0.1);
  EXPECT_NEAR(momentum, 0.0, 0.02);
}

TEST(Wheels, SleepersWakeWhenTheyAreDriven) {
  Car car;
  car.all(0.0, 100.0);
  car.step(3000);
  ASSERT_TRUE(car.chassis.asleep());
  const math::Vec3 before = car.at();
  car.step(1000);
  EXPECT_EQ(car.at(), before);
  car.all(10.0, 0.0);
  car.step(500);
  EXPECT_FALSE(car.chassis.asleep());
  EXPECT_GT(car.at().x, before.x + 0.05);
}

TEST(Wheels, MountedBodiesWeighNothingAndMeetNothing) {
  World world{{}};
  Body floor(parameters(0.0, {ground()}, {})), hub(parameters(3.0, {sphere(0.1)}, {0, 0, -0.05}));
  world.add(floor);
  world.add(hub);
  set_mounted(hub, true);
  for (int i = 0; i < 100; ++i) world.step();
  EXPECT_EQ(hub.com_pose().position, (math::Vec3{0, 0, -0.05})) << "neither falls nor is pushed out";
  place_mounted(hub, {{1, 0, 2}, {}}, {{0, 0, 0.5}, {}});
  EXPECT_EQ(hub.com_pose().position, (math::Vec3{1, 0, 2}));
  set_mounted(hub, false);
  for (int i = 0; i < 100; ++i) world.step();
  EXPECT_NEAR(hub.com_pose().position.z, 2.0 + 0.05 - 0.049, 2e-3) << "a body again, thrown up as it moved";
}

}  // namespace
}  // namespace ambf::physics::testing
