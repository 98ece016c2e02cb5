// IMUs, force torque sensors and contact sensors read what mechanics says.
#include <gtest/gtest.h>

#include <random>

#include "math/rotation.h"
#include "state/columns.h"
#include "state/readings.h"
#include "tests/adf/support.h"
#include "tests/model/rig.h"

namespace ambf::model::test {
namespace {

constexpr double kGravity = 9.81;

std::string number(double value) { return std::to_string(value); }
std::string rpy(const math::Vec3& angles) {
  return "{r: " + number(angles.x) + ", p: " + number(angles.y) + ", y: " + number(angles.z) + "}";
}

struct SensorRig : Rig {
  explicit SensorRig(const std::string& text) : Rig({0, 0, -kGravity}) {
    adf::ModelResult read = adf::parse_model("namespace: /test/\n" + text, "sensors.yaml");
    EXPECT_TRUE(adf::no_worse_than_information(read.diagnostics));
    EXPECT_TRUE(load(*read.model).success);
  }
  std::uint32_t sensor(const std::string& name) const { return slot(name, state::sensor_kind().kind); }
  const state::SensorReading& reading(const std::string& name) const { return state::reading_of(*frame, sensor(name)); }
  math::Pose sensor_pose(const std::string& name) const {
    return state::rows(*frame, state::sensor_kind().column).at(sensor(name)).T_world_object;
  }
};

constexpr const char* kBox =
    "collision shape: BOX, collision geometry: {x: 0.1, y: 0.1, z: 0.1}, "
    "damping: {linear: 0, angular: 0}";

TEST(Imu, ReadsGravityUpwardsAtRestInAnyPose) {
  std::mt19937 engine(4);
  std::uniform_real_distribution<double> angle(-3.1, 3.1);
  std::string text = "bodies: [BODY b]\nsensors: [";
  std::string blocks = std::string("BODY b: {name: b, mass: 0, ") + kBox + "}\n";
  for (int i = 0; i < 100; ++i) {
    const std::string name = "s" + std::to_string(i);
    text += (i > 0 ? ", " : "") + name;
    blocks += name + ": {name: " + name + ", type: IMU, parent: BODY b, location: {orientation: " +
              rpy({angle(engine), angle(engine), angle(engine)}) + "}}\n";
  }
  SensorRig rig(text + "]\n" + blocks);
  rig.step(3);
  for (int i = 0; i < 100; ++i) {
    const std::string name = "s" + std::to_string(i);
    const math::Vec3 in_world = math::rotate(rig.sensor_pose(name).orientation, rig.reading(name).linear);
    EXPECT_NEAR(math::norm(in_world - math::Vec3{0, 0, kGravity}), 0.0, 1e-9);
    EXPECT_EQ(rig.reading(name).angular, math::Vec3{});
  }
}

TEST(Imu, ReadsNothingInFreeFall) {
  SensorRig rig(std::string("bodies: [BODY b]\nsensors: [s]\nBODY b: {name: b, mass: 2, ") + kBox +
                "}\ns: {name: s, type: IMU, parent: BODY b, location: {position: {x: 0.2, y: 0.1, z: 0}}}\n");
  EXPECT_NEAR(rig.reading("s").linear.z, kGravity, 1e-9) << "before the first step it has no acceleration";
  rig.step(20);
  EXPECT_NEAR(math::norm(rig.reading("s").linear), 0.0, 0.01 * kGravity);
}

constexpr const char* kArm = R"(bodies: [BODY base, BODY arm]
joints: [JOINT hinge]
sensors: [SENSOR imu, SENSOR wrist]
BODY base: {name: base, mass: 0}
BODY arm: {name: arm, mass: 2.0, inertia: {ix: 0.01, iy: 0.02, iz: 0.02}, location: {position: {x: 0.3, y: 0, z: 0}},
           damping: {linear: 0, angular: 0}}
JOINT hinge: {name: hinge, type: revolute, parent: BODY base, child: BODY arm, parent axis: {x: 0, y: 0, z: 1},
              child axis: {x: 0, y: 0, z: 1}, parent pivot: {x: 0, y: 0, z: 0}, child pivot: {x: -0.3, y: 0, z: 0},
              damping: 0, enable motor: false}
SENSOR imu: {name: imu, type: IMU, parent: BODY arm, location: {position: {x: 0.2, y: 0, z: 0}}}
SENSOR wrist: {name: wrist, type: Force Torque, joint: JOINT hinge,
               location: {position: {x: -0.3, y: 0, z: 0}, orientation: {r: 0, p: 0, y: 1.2}}}
)";

// Turned by a torque from rest: the arm's inertia about the hinge is 0.02 + 2 * 0.09.
struct TurningArm : SensorRig {
  TurningArm() : SensorRig(kArm), hand(port("arm")) {}
  void turn(double torque, int steps) {
    hand->post(force({}, {0, 0, torque}));
    step(steps);
  }
  std::unique_ptr<state::CommandPort> hand;
  static constexpr double kInertia = 0.02 + 2.0 * 0.09;
};

TEST(Imu, ReadsTheAccelerationOfItsPointOnATurningArm) {
  TurningArm rig;
  const double torque = 1.0, radius = 0.5, turning = torque / TurningArm::kInertia;
  rig.turn(torque, 400);
  const state::SensorReading& reading = rig.reading("imu");
  const double rate = rig.joint_state("hinge").velocity;
  EXPECT_NEAR(rate, turning * 0.4, 0.01 * rate);
  EXPECT_NEAR(reading.angular.z, rate, 1e-6);
  EXPECT_NEAR(reading.linear.x, -rate * rate * radius, 0.01 * rate * rate * radius);
  EXPECT_NEAR(reading.linear.y, turning * radius, 0.01 * turning * radius);
  EXPECT_NEAR(reading.linear.z, kGravity, 0.01 * kGravity);
}

TEST(ForceTorque, ReadsAToolsWeightInItsOwnAxes) {
  TurningArm rig;
  rig.step(50);
  EXPECT_EQ(state::sensors(*rig.live->structure())[rig.sensor("wrist")].parent_object, rig.object("arm"));
  const math::Pose T = rig.sensor_pose("wrist");
  const math::Vec3 force_world = math::rotate(T.orientation, rig.reading("wrist").linear);
  const math::Vec3 torque_world = math::rotate(T.orientation, rig.reading("wrist").angular);
  const double weight = 2.0 * kGravity;
  EXPECT_NEAR(math::norm(force_world - math::Vec3{0, 0, weight}), 0.0, 0.01 * weight);
  EXPECT_NEAR(math::norm(torque_world - math::Vec3{0, -0.3 * weight, 0}), 0.0, 0.01 * 0.3 * weight)
      << "holds up a weight 0.3 m along x";
}

TEST(ForceTorque, ReadsAPushedTipWhileTheToolAccelerates) {
  TurningArm rig;
  rig.step(50);
  const state::SensorReading rest = rig.reading("wrist");
  rig.hand->post(force({0, 0, -5.0}, {0, 0, 0.8}));  // on the tool's centre of mass
  rig.step(300);
  const double rate = rig.joint_state("hinge").velocity;
  ASSERT_GT(rate, 0.5);
  const math::Pose T_arm = rig.body("arm").T_world_body;
  const math::Vec3 outwards = math::rotate(T_arm.orientation, {1, 0, 0}), along{-outwards.y, outwards.x, 0};
  const double turning = 0.8 / TurningArm::kInertia;
  const math::Vec3 wanted =
      outwards * (-2.0 * 0.3 * rate * rate) + along * (2.0 * 0.3 * turning) + math::Vec3{0, 0, 2.0 * kGravity + 5.0};
  const math::Vec3 read = math::rotate(rig.sensor_pose("wrist").orientation, rig.reading("wrist").linear);
  EXPECT_NEAR(math::norm(read - wanted), 0.0, 0.01 * math::norm(wanted));
  EXPECT_NEAR(math::norm(rest.linear), 2.0 * kGravity, 0.2);
}

TEST(ForceTorque, OfAJointThatIsGoneReadsNothing) {
  TurningArm rig;
  rig.step(20);
  ASSERT_TRUE(rig.apply(rig.catalogue.prepare_remove("JOINT hinge")).success);
  rig.step();
  EXPECT_EQ(rig.reading("wrist").linear, math::Vec3{});
}

TEST(ForceTorque, WithoutAJointIsRefused) {
  const auto check = [](const std::string& keys) {
    return adf::parse_model("namespace: /t/\nsensors: [S]\nS: {name: S, type: Force Torque, " + keys + "}\n", "m.yaml");
  };
  EXPECT_TRUE(adf::says(check("parent: BODY x").diagnostics, "error: .*S: joint.*missing"));
  Rig rig;
  const Prepared loaded = rig.catalogue.prepare_load(*check("joint: JOINT none").model);
  EXPECT_TRUE(adf::says(loaded.diagnostics, "error: .*S: joint.*there is no joint \"JOINT none\""));
}

TEST(MeasuringSensors, HaveNoiseThatRepeats) {
  const std::string text = std::string("bodies: [BODY b]\nsensors: [s, t]\nBODY b: {name: b, mass: 0, ") + kBox +
                           "}\ns: {name: s, type: IMU, parent: BODY b, noise: {linear: 0.1, angular: 0.02}}\n"
                           "t: {name: t, type: IMU, parent: BODY b, noise: {linear: 0.1}}\n";
  SensorRig rig(text), again(text);
  math::Vec3 linear, angular, squares;
  const int count = 4000;
  for (int i = 0; i < count; ++i) {
    rig.step(), again.step();
    const state::SensorReading& reading = rig.reading("s");
    ASSERT_EQ(reading.linear, again.reading("s").linear);
    ASSERT_NE(reading.linear, rig.reading("t").linear) << "each sensor has its own";
    linear += reading.linear * (1.0 / count);
    angular += reading.angular * (1.0 / count);
    const math::Vec3 off = reading.linear - math::Vec3{0, 0, kGravity};
    squares += math::scaled(off, off) * (1.0 / count);
    ASSERT_EQ(rig.reading("t").angular, math::Vec3{});
  }
  EXPECT_NEAR(math::norm(linear - math::Vec3{0, 0, kGravity}), 0.0, 0.01);
  EXPECT_NEAR(math::norm(angular), 0.0, 0.002);
  for (const double square : {squares.x, squares.y, squares.z}) EXPECT_NEAR(std::sqrt(square), 0.1, 0.005);
}

TEST(MeasuringSensors, GoOnFromASavedState) {
  TurningArm rig;
  SensorRig other(kArm);
  rig.step(600);
  const std::vector<std::uint8_t> saved = rig.live->save();
  rig.live->fill(*rig.frame);
  ASSERT_EQ(other.live->restore(saved), "");
  other.live->fill(*other.frame);
  EXPECT_EQ(state::state_hash(*rig.frame), state::state_hash(*other.frame));
  rig.step(20);
  other.step(20);
  EXPECT_EQ(other.reading("imu").linear, rig.reading("imu").linear);
  EXPECT_EQ(other.reading("wrist").linear, rig.reading("wrist").linear);
}

TEST(MeasuringSensors, StartAnewAfterAReset) {
  TurningArm rig;
  rig.turn(1.0, 100);
  rig.live->reset();
  rig.live->fill(*rig.frame);
  EXPECT_EQ(rig.reading("wrist").linear, math::Vec3{});
  EXPECT_NEAR(rig.reading("imu").linear.z, kGravity, 1e-9);
  rig.step();
  EXPECT_NEAR(rig.reading("imu").linear.x, 0.0, 1e-6) << "no jump from the speed before";
}

// ---- Contact sensors.

constexpr const char* kTable = R"(bodies: [BODY table, BODY box, BODY near, BODY linked]
joints: [JOINT weld]
sensors: [SENSOR feel]
BODY table: {name: table, mass: 0, collision shape: BOX, collision geometry: {x: 1, y: 1, z: 0.1}}
BODY box: {name: box, mass: 2.0, location: {position: {x: 0, y: 0, z: 0.1}}, collision shape: BOX,
           collision geometry: {x: 0.1, y: 0.1, z: 0.1}}
BODY near: {name: near, mass: 0, location: {position: {x: 0, y: 0, z: -0.103}}, collision shape: BOX,
            collision geometry: {x: 0.1, y: 0.1, z: 0.1}}
BODY linked: {name: linked, mass: 0, location: {position: {x: 0.5, y: 0, z: 0}}, collision shape: BOX,
              collision geometry: {x: 0.2, y: 0.2, z: 0.2}}
JOINT weld: {name: weld, type: fixed, parent: BODY linked, child: BODY table, parent axis: {x: 0, y: 0, z: 1},
             child axis: {x: 0, y: 0, z: 1}, parent pivot: {x: 0, y: 0, z: 0}, child pivot: {x: 0.5, y: 0, z: 0}}
)";

std::vector<std::uint32_t> touched(const SensorRig& rig) {
  std::vector<std::uint32_t> bodies;
  for (const state::SensedContact& contact : state::contacts_of(*rig.frame, rig.sensor("feel")))
    if (bodies.empty() || bodies.back() != contact.body) bodies.push_back(contact.body);
  return bodies;
}

TEST(ContactSensors, FeelWhatPressesOnTheirBody) {
  SensorRig rig(std::string(kTable) + "SENSOR feel: {name: feel, type: Contact, parent: BODY table}\n");
  rig.step(500);
  EXPECT_EQ(touched(rig), std::vector<std::uint32_t>{rig.slot("box")});
  math::Vec3 force_world;
  for (const state::SensedContact& contact : state::contacts_of(*rig.frame, rig.sensor("feel"))) {
    EXPECT_NEAR(contact.normal_world.z, -1.0, 1e-6) << "from the box towards the table";
    EXPECT_NEAR(contact.point_world.z, 0.05, 1e-4);
    force_world += contact.force_world;
  }
  EXPECT_NEAR(force_world.z, -2.0 * kGravity, 0.01 * 2.0 * kGravity);
  EXPECT_EQ(state::rows(*rig.frame, state::sensor_kind().column)[rig.sensor("feel")].triggered, 1u);
  rig.apply(rig.catalogue.prepare_remove("BODY box"));
  EXPECT_TRUE(touched(rig).empty());
}

TEST(ContactSensors, FeelWhatIsNearerThanTheirThreshold) {
  const auto scene = [](const std::string& threshold) {
    return std::string(kTable) +
           "SENSOR feel: {name: feel, type: contact, parent: BODY table, distance threshold: " + threshold + "}\n";
  };
  SensorRig less(scene("0.002")), more(scene("0.004"));
  less.step(500), more.step(500);
  EXPECT_EQ(touched(less), std::vector<std::uint32_t>{less.slot("box")});
  EXPECT_EQ(touched(more), (std::vector<std::uint32_t>{more.slot("box"), more.slot("near")})) << "a static one, too";
  const state::ContactRange contacts = state::contacts_of(*more.frame, more.sensor("feel"));
  ASSERT_GT(contacts.size(), 0u);
  EXPECT_NEAR((contacts.end() - 1)->distance_m, 0.003, 1e-6);
}

}  // namespace
}  // namespace ambf::model::test
