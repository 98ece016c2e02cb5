// Resistive sensors: their forces by their formulas, and what these hold (docs/sensors.md).
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <utility>

#include "math/rotation.h"
#include "model/saved_state.h"
#include "tests/model/resistive.h"

namespace ambf::model {
namespace {

using namespace test;

// A static block A with one ray upwards from its top, into a block B that moves.
struct Touch {
  explicit Touch(const Numbers& n, double depth = 0.5, double mass = 1e6)
      : world(box("a", 0.0, {0, 0, 0}, {0.2, 0.2, 0.2}) +
                  box("b", mass, {0, 0, 0.1 + n.range * (1.0 - depth) + 0.05}, {0.1, 0.1, 0.1}) +
                  sensor("s", "a", {{0, 0, 0.1}}, {0, 0, 1}, n),
              "SENSOR s") {}
  void drag(const math::Vec3& velocity, int steps) {  // B
    const auto port = world.rig.port("b");
    port->post(test::twist({velocity, {}}));
    world.rig.step(steps);
  }
  ResistiveWorld world;
};

TEST(Resistance, NormalForceGrowsWithDepthAndPointsAwayFromTheSensorsBody) {
  double before = 0.0;
  for (const double depth : {0.1, 0.4, 0.9}) {
    Touch touch({.stiffness = 3.0}, depth);
    touch.world.rig.step(1);
    const math::Vec3 force = touch.world.force("s");
    EXPECT_NEAR(force.z, 3.0 * depth, 1e-9);
    EXPECT_NEAR(math::norm(force - math::Vec3{0, 0, force.z}), 0.0, 1e-12);
    EXPECT_GT(force.z, before);
    before = force.z;
  }
}

// d = 1 where the ray begins inside of what it meets: the contact is not lost.
TEST(Resistance, HoldsOnWhereTheRayBeginsInside) {
  Touch touch({.stiffness = 2.0}, 1.5);
  touch.world.rig.step(1);
  EXPECT_NEAR(touch.world.force("s").z, 2.0, 1e-12);
}

// A body of 0.4 kg in steps of 1 ms: 0.5 m / h = 200 N s/m, and m / h^2 = 4e5 N/m. At the limits nothing is said.
TEST(Resistance, GainsThatAreCutWhateverIsMetAreToldWithTheirLimits) {
  const auto told = [](Numbers n, double mass, double step_s) {
    Rig rig({}, step_s);
    const std::string block = sensor("s", "a", {{0, 0, 0.1}}, {0, 0, 1}, n);
    const adf::ModelResult read = adf::parse_model(
        "namespace: /test/\nbodies: [BODY a]\nsensors: [SENSOR s]\n" + box("a", mass, {}, {0.2, 0.2, 0.2}) + block,
        "limits.yaml");
    return rig.load(*read.model).diagnostics;
  };
  const auto below = [](double factor, const char* variable) {
    return Numbers{.stick = 2e5 * factor,
                   .damping = 2e5 * factor,
                   .slide = 200.0 * factor,
                   .stiffness = 2.0,
                   .contact_damping = 4.0 * factor,
                   .range = 0.02,
                   .variable = variable};
  };
  EXPECT_TRUE(told(below(0.99, "true"), 0.4, 0.001).empty());
  EXPECT_TRUE(told(below(1.01, "true"), 0.0, 0.001).empty()) << "static: only what is met bounds it";
  const base::Diagnostics found = told(below(1.01, "true"), 0.4, 0.001);
  EXPECT_TRUE(adf::says(found, "limits.yaml:[0-9]+:[0-9]+: .*SENSOR s: contact damping. 4.04 .*at most 4 N s"));
  EXPECT_TRUE(adf::says(found, "warning: .*friction: dynamic. 202 .*at most 200 N s/m"));
  EXPECT_TRUE(adf::says(found, "warning: .*friction: damping. 2.02e.05 .*at most 2e.05 N/m"));
  EXPECT_TRUE(adf::says(found, "warning: .*friction: static. 2.02e.05 .*at most 2e.05 1/m"));
  EXPECT_FALSE(adf::says(told(below(1.01, "false"), 0.4, 0.001), "friction: static")) << "no normal force: 4e5 N/m";
  EXPECT_TRUE(told(below(1.01, "true"), 0.4, 0.0005).empty()) << "shorter steps bear more";
}

TEST(Resistance, EveryParameterActsAsItsFormulaSays) {
  for (const double factor : {0.25, 1.0, 4.0}) {
    const Numbers base{.stick = 100.0, .area = 1.0, .stiffness = 2.0};
    // Dragged by 1 mm in x: the stretch is -1 mm, so that A pulls B back. In front of the drag's last step.
    const auto stuck = [&](Numbers n, double depth = 0.5) {
      Touch touch(n, depth);
      touch.drag({0.01, 0, 0}, 101);
      return touch.world.force("s").x;
    };
    Numbers n = base;
    n.stick *= factor;
    EXPECT_NEAR(stuck(n), -100.0 * factor * 1e-3 * 1.0, 1e-4 * factor) << "Eq. 6.1, F_N = 1 N";
    n.variable = "depth";
    EXPECT_NEAR(stuck(n), -100.0 * factor * 1e-3 * 0.5, 1e-4 * factor) << "Eq. 6.12";
    n.variable = "false";
    EXPECT_NEAR(stuck(n), -100.0 * factor * 1e-3, 1e-4 * factor);
    n = base;
    n.stiffness *= factor;
    EXPECT_NEAR(stuck(n), -100.0 * 1e-3 * factor, 1e-4 * factor) << "by the normal force";
    EXPECT_NEAR(stuck(base, 0.2 * factor), -100.0 * 1e-3 * 2.0 * 0.2 * factor, 1e-4 * factor) << "by the depth";
    n = base;
    n.stick = 0.0;
    n.slide = 3.0 * factor;
    EXPECT_NEAR(stuck(n), -3.0 * factor * 0.01, 1e-4 * factor) << "Eq. 6.6";
    n.slide = 0.0;
    n.damping = 50.0 * factor;
    EXPECT_NEAR(stuck(n), -50.0 * factor * 1e-3 * 0.01, 1e-5 * factor) << "of the stretch, a millisecond";

    // Pressed at 1 cm/s: d grows by 0.01 / range a second.
    n = {.stiffness = 0.0, .contact_damping = 0.1 * factor, .range = 0.02};
    Touch pressed(n, 0.3);
    pressed.drag({0, 0, -0.01}, 10);
    EXPECT_NEAR(pressed.world.force("s").z, 0.1 * factor * 0.01 / 0.02, 1e-4 * factor) << "Eq. 6.4";
    n.range *= factor;
    Touch longer(n, 0.3);
    longer.drag({0, 0, -0.01}, 10);
    EXPECT_NEAR(longer.world.force("s").z, 0.1 * 0.01 / 0.02, 1e-4) << "a longer ray: less depth a metre";

    // It slips each time the stretch exceeds the area.
    n = base;
    n.area = 0.001 * factor;
    Touch slipping(n);
    const auto port = slipping.world.rig.port("b");
    port->post(test::twist({{0.01, 0, 0}, {}}));
    int slips = 0;
    for (int i = 0; i < 2000; ++i) {
      port->post(test::twist({{0.01, 0, 0}, {}}));
      slipping.world.rig.step(1);
      slips += slipping.world.elements("s")[0].slipped ? 1 : 0;
    }
    EXPECT_NEAR(slips, 0.02 / n.area, 0.1 * 20.0 / factor + 1.0);
  }
}

// (c): the body under the rays is dragged along, whether they stick or slip.
TEST(Resistance, FrictionPullsTheWayTheSensorsBodyMoves) {
  for (const double area : {1.0, 1e-4}) {
    ResistiveWorld world(box("a", 0.0, {0, 0, 0}, {0.2, 0.2, 0.2}) + box("b", 10.0, {0, 0, 0.16}, {0.1, 0.1, 0.1}) +
                             sensor("s", "a", {{0.02, 0, 0.1}, {-0.02, 0, 0.1}}, {0, 0, 1},
                                    {.stick = 1000.0, .slide = 0.5, .area = area}),
                         "SENSOR s");
    const auto port = world.rig.port("a");
    double sum = 0.0;
    for (int i = 0; i < 100; ++i) {
      port->post(test::pose({{1e-4 * i, 0, 0}, {}}));
      world.rig.step(1);
      sum += world.force("s").x;
    }
    EXPECT_GT(sum, 0.0) << area;
    EXPECT_GT(world.at("b").x, 0.0) << area;
  }
}

TEST(Resistance, KeepsMomentumAtAnyPoseWithBothBodiesMoving) {
  std::mt19937 engine(5);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  for (const bool b_first : {false, true}) {
    for (int trial = 0; trial < 5; ++trial) {
      const std::string offset =
          ", inertial offset: {position: {x: 0.03, y: -0.02, z: 0.05}}, collision offset: {position: {x: 0, y: 0, z: "
          "0}}";
      const std::string a = box("a", 0.7, {0, 0, 0}, {0.1, 0.1, 0.1}, offset);
      const std::string b = box("b", 0.4, {0.01, 0.02, 0.115}, {0.1, 0.1, 0.1}, offset);
      ResistiveWorld world(
          (b_first ? b + a : a + b) + sensor("s", "a", {{0.03, 0.01, 0.05}, {-0.02, 0.03, 0.05}}, {0, 0, 1},
                                             {.stick = 1000.0, .damping = 10.0, .slide = 0.5, .contact_damping = 5.0}),
          "SENSOR s");
      const auto momentum = [&](math::Vec3& angular) {
        math::Vec3 linear;
        angular = {};
        for (const char* name : {"a", "b"}) {
          const state::BodyState& body = world.rig.body(name);
          const state::BodyInfo& info = world.rig.info(name);
          const math::Pose com = body.T_world_body * info.T_body_com;
          const math::Vec3 p = body.twist_world.linear * info.mass;
          const math::Vec3 w = math::rotate(math::inverse(com.orientation), body.twist_world.angular);
          linear += p;
          angular += math::cross(com.position, p) + math::rotate(com.orientation, math::scaled(w, info.inertia));
        }
        return linear;
      };
      {
        const auto port = world.rig.port("b");
        port->post(test::twist({{0.02 * any(engine), 0.02 * any(engine), -0.01}, {0, 0, 0.1 * any(engine)}}));
        world.rig.step(1);
        port->post(state::RigidBodyCommand{});
        world.rig.step(1);
      }
      math::Vec3 angular_before, angular;
      const math::Vec3 before = momentum(angular_before);
      bool touched = false;
      for (int i = 0; i < 200; ++i) {
        world.rig.step(1);
        touched = touched || math::norm(world.force("s")) > 1e-3;
      }
      EXPECT_TRUE(touched);
      EXPECT_NEAR(math::norm(momentum(angular) - before), 0.0, 1e-10);
      EXPECT_NEAR(math::norm(angular - angular_before), 0.0, 1e-7);
    }
  }
}

// (f): a box of 0.4 kg stands on rays from below.
TEST(Resistance, DepthAtRestIsThatOfTheForceAtAnyRate) {
  for (const double h : {0.004, 0.002, 0.001, 0.0005}) {
    ResistiveWorld world(
        box("a", 0.0, {0, 0, 0}, {0.2, 0.2, 0.2}) + box("b", 0.4, {0, 0, 0.167}, {0.1, 0.1, 0.1}) +
            sensor("s", "a", grid(3, 3, 0.08, 0.1), {0, 0, 1}, {.stick = 1000.0, .slide = 0.5, .contact_damping = 5.0}),
        "SENSOR s", {0, 0, -kGravity}, h);
    world.rig.step(static_cast<int>(2.0 / h));
    const double depth = (0.12 - (world.at("b").z - 0.05)) / 0.02;
    EXPECT_NEAR(depth, 0.4 * kGravity / 9.0, 0.05 * 0.4 * kGravity / 9.0) << h;
    EXPECT_NEAR(world.force("s").z, 0.4 * kGravity, 1e-3) << h;
  }
}

// BENCHMARKS 6.10: the slope is static and tilted gravity.
TEST(Resistance, HoldsABoxOnASlope) {
  const math::Vec3 gravity = math::rotate(math::from_rpy(0, -20.0 * 3.14159265358979 / 180.0, 0), {0, 0, -kGravity});
  for (const auto& [h, sleeping] :
       {std::pair(0.004, true), std::pair(0.001, true), std::pair(0.001, false), std::pair(0.0005, true)}) {
    for (const bool sensors : {true, false}) {
      ResistiveWorld world(box("slope", 0.0, {0, 0, -0.5}, {4, 4, 1}) +
                               box("b", 0.5, {0, 0, 0.0105}, {0.1, 0.1, 0.02}) +
                               sensor("s", "b", grid(3, 3, 0.08, -0.005), {0, 0, -1},
                                      {.stick = 5000.0, .damping = 0.1, .slide = 0.8, .contact_damping = 0.1}),
                           sensors ? "SENSOR s" : "", {0, 0, -kGravity}, h, sleeping);
      world.load_slowly(gravity, 0.5);
      world.rig.step(static_cast<int>(1.5 / h));
      const math::Vec3 settled = world.at("b");
      world.rig.step(static_cast<int>(sensors ? 6.0 / h : 0.5 / h));
      if (sensors) {
        EXPECT_LT(math::norm(world.at("b") - settled), 1e-5) << h << (sleeping ? "" : ", without sleep");
      } else {
        EXPECT_GT(math::norm(world.at("b") - settled), 0.1) << "nothing else holds it";
      }
    }
  }
}

// BENCHMARKS 6.7: pushed beyond what sticks, it slips by the contact area each time; below, not at all. It does not
// tilt.
TEST(Resistance, SlipsInASawtoothBeyondItsLimitAndNotBelow) {
  const Numbers n{.stick = 100.0, .slide = 1.0, .area = 0.002, .contact_damping = 0.1, .variable = "false"};
  const double limit = 9 * n.stick * n.area;  // N
  for (const double share : {0.9, 1.2}) {
    ResistiveWorld world(box("floor", 0.0, {0, 0, -0.5}, {4, 4, 1}) +
                             box("b", 0.5, {0, 0, 0.0105}, {0.1, 0.1, 0.02}, ", inertia: {ix: 100, iy: 100, iz: 100}") +
                             sensor("s", "b", grid(3, 3, 0.08, -0.005), {0, 0, -1}, n),
                         "SENSOR s", {0, 0, -kGravity});
    world.rig.step(200);
    const double start = world.at("b").x;
    const auto port = world.rig.port("b");
    int slips = 0;
    for (int i = 0; i < 3000; ++i) {
      port->post(test::force({share * limit * std::min(1.0, i / 1000.0), 0, 0}));
      world.rig.step(1);
      slips += world.elements("s")[4].slipped ? 1 : 0;
    }
    const double way = world.at("b").x - start;
    if (share < 1.0) {
      EXPECT_EQ(slips, 0);
      EXPECT_LT(way, n.area);
    } else {
      EXPECT_GT(slips, 3);
      EXPECT_NEAR(way / (slips + 0.5), n.area, 0.1 * n.area) << "a tooth of the saw";
    }
  }
}

TEST(Resistance, GraspHoldsWhatItsLimitBearsAndLetsTheRestSlide) {
  for (const int elements : {4, 12, 50}) {
    for (const double mass : {0.4, 0.8}) {
      EXPECT_LT(ResistiveGrasp(elements, mass, 4.0 / 3.0).drop(elements == 12 ? 10.0 : 1.0), 0.001)
          << elements << " " << mass;
      EXPECT_GT(ResistiveGrasp(elements, mass, 2.0 / 3.0).drop(0.5), 0.01) << elements << " " << mass;
    }
  }
}

TEST(Resistance, AnObjectHeldOffCentreHangsStill) {
  ResistiveGrasp grasp(12, 0.4, 2.0, 0.02);
  grasp.drop(1.0);
  const math::Pose then = grasp.world->rig.body("b").T_world_body;
  grasp.world->rig.step(1000);
  EXPECT_LT(math::norm(grasp.world->rig.body("b").T_world_body.position - then.position), 1e-4);
}

// Table 6.2 and Fig. 6.10: with a literal derivative these grasps blow up within a second.
TEST(Resistance, IsStableWithThePublishedNumbers) {
  const struct {
    double mass, stick, slide, stiffness, damping, area;
  } kRows[] = {{0.4, 1000, 0.5, 1.0, 5, 0.001},
               {0.8, 1000, 0.5, 1.0, 5, 0.001},
               {0.6, 5000, 0.8, 0.8, 0.1, 0.001},
               {0.002, 1000, 0.3, 0.05, 500, 0.005},
               {0.5, 5000, 0.1, 1.0, 50, 0.001}};
  for (const auto& row : kRows) {
    for (const int side : {1, 2, 5}) {
      const Numbers n{row.stick, 0.1, row.slide, row.area, row.stiffness, row.damping, 0.02, "true"};
      ResistiveWorld world(box("a", 0.0, {0, 0, 0}, {0.2, 0.2, 0.2}) +
                               box("b", row.mass, {0, 0, 0.1695}, {0.1, 0.1, 0.1}) +
                               sensor("s", "a", grid(2 * side, 2 * side, 0.08, 0.1), {0, 0, 1}, n),
                           "SENSOR s", {0, 0, -kGravity});
      double fastest = 0.0;
      for (int i = 0; i < 1000; ++i) {
        world.rig.step(1);
        fastest = std::max(fastest, math::norm(world.rig.body("b").twist_world.linear));
      }
      EXPECT_LT(fastest, 2.0) << row.mass << " kg, " << 4 * side * side << " rays";
    }
  }
}

TEST(Resistance, GoesOnFromASnapshotInMidSlip) {
  const auto make = [] {
    return std::make_unique<ResistiveWorld>(
        box("floor", 0.0, {0, 0, -0.5}, {4, 4, 1}) + box("b", 0.5, {0, 0, 0.0505}, {0.1, 0.1, 0.1}) +
            sensor("s", "b", grid(2, 2, 0.08, -0.04), {0, 0, -1},
                   {.stick = 1000.0, .slide = 1.0, .area = 0.0005, .contact_damping = 5.0}),
        "SENSOR s", math::Vec3{2.0, 0, -kGravity});
  };
  const auto world = make(), other = make();
  world->rig.step(300);
  EXPECT_GT(world->at("b").x, 0.001);
  const auto saved = world->rig.live->save();
  ASSERT_EQ(other->rig.live->restore(saved), "");
  world->rig.live->fill(*world->rig.frame);
  other->rig.live->fill(*other->rig.frame);
  EXPECT_EQ(state::state_hash(*world->rig.frame), state::state_hash(*other->rig.frame));
  for (ResistiveWorld* each : {world.get(), other.get()}) each->rig.step(200);
  EXPECT_EQ(state::state_hash(*world->rig.frame), state::state_hash(*other->rig.frame));
}

TEST(Resistance, LetsGoOfABodyThatIsRemovedOrReset) {
  Touch touch({.stick = 1000.0, .area = 0.1}, 0.5, 1.0);
  touch.drag({0.01, 0, 0}, 100);
  ASSERT_GT(math::norm(touch.world.force("s")), 0.1);
  touch.world.rig.live->reset();
  touch.world.rig.step(1);
  EXPECT_NEAR(touch.world.force("s").x, 0.0, 1e-9) << "no stretch from before";
  ASSERT_TRUE(touch.world.rig.apply(touch.world.rig.catalogue.prepare_remove("BODY b")).success);
  touch.world.rig.step(2);
  EXPECT_EQ(touch.world.force("s"), math::Vec3{});
}

}  // namespace
}  // namespace ambf::model
