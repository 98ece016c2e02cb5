// Ghost objects feel every body and every other ghost that overlaps them, and push nothing but what `drag` carries.
#include <gtest/gtest.h>

#include <set>

#include "math/rotation.h"
#include "state/columns.h"
#include "state/ghosts.h"
#include "tests/adf/support.h"
#include "tests/model/rig.h"

namespace ambf::model::test {
namespace {

// A ball that falls through a ghost hung in the world, and one on an arm.
constexpr const char* kScene = R"(adf version: 1.0
namespace: /test/
bodies: [BODY ball, BODY arm, BODY wall]
ghost objects: [GHOST zone, GHOST tip]
BODY ball: {name: ball, mass: 0.1, location: {position: {x: 0, y: 0, z: 0.2}}, collision shape: SPHERE,
            collision geometry: {radius: 0.02}, damping: {linear: 0, angular: 0}, gravity: {x: 0, y: 0, z: -5}}
BODY arm: {name: arm, mass: 1.0, location: {position: {x: 1, y: 0, z: 0}}, collision shape: BOX,
           collision geometry: {x: 0.1, y: 0.1, z: 0.1}, inertial offset: {position: {x: 0.03, y: 0, z: 0}},
           gravity: {x: 0, y: 0, z: 0}, damping: {linear: 0, angular: 0}}
BODY wall: {name: wall, mass: 0, location: {position: {x: 1.12, y: 0, z: 0}}, collision shape: BOX,
            collision geometry: {x: 0.05, y: 0.1, z: 0.1}}
GHOST zone: {name: zone, collision shape: BOX, collision geometry: {x: 0.1, y: 0.1, z: 0.1}}
GHOST tip: {name: tip, parent: BODY arm, location: {position: {x: 0.06, y: 0, z: 0}}, collision shape: SPHERE,
            collision geometry: {radius: 0.02}}
)";

scene::Model parse(const std::string& text) {
  adf::ModelResult read = adf::parse_model(text, "ghosts.yaml");
  EXPECT_TRUE(adf::no_worse_than_information(read.diagnostics));
  return *read.model;
}

struct GhostRig : Rig {
  explicit GhostRig(const std::string& text = kScene, const math::Vec3& gravity = {0, 0, -9.81}) : Rig(gravity) {
    EXPECT_TRUE(load(parse(text)).success);
  }
  std::uint32_t ghost(const std::string& name) const { return slot(name, state::ghost_kind().kind); }
  const state::GhostState& state_of(const std::string& name) const {
    return state::rows(*frame, state::ghost_kind().column).at(ghost(name));
  }
  std::set<std::string> felt(const std::string& name) const {
    std::set<std::string> names;
    for (const state::GhostTouch& touch : state::touches_of(*frame, ghost(name)))
      names.insert(live->structure()->objects.at(touch.object).identifier);
    return names;
  }
};

using Names = std::set<std::string>;

TEST(Ghosts, FeelParentsStaticBodiesAndEachOther) {
  GhostRig rig;
  EXPECT_EQ(rig.felt("tip"), (Names{"/test/BODY arm", "/test/BODY wall"}));
  EXPECT_EQ(rig.felt("zone"), Names{});
  rig.port("zone", state::Source::ros, state::ghost_kind().kind)->post(state::PoseCommand{true, {{1.155, 0, 0}, {}}});
  rig.step();
  EXPECT_EQ(rig.felt("zone"), (Names{"/test/BODY wall", "/test/GHOST tip"}));
  EXPECT_EQ(rig.felt("tip"), (Names{"/test/BODY arm", "/test/BODY wall", "/test/GHOST zone"}));
}

TEST(Ghosts, HangInTheFrameOfTheirParentsCentreOfMass) {
  GhostRig rig;
  EXPECT_EQ(rig.state_of("tip").T_parent_object.position, (math::Vec3{0.06, 0, 0}));
  EXPECT_NEAR(rig.state_of("tip").T_world_object.position.x, 1.0 + 0.03 + 0.06, 1e-12);
  const state::ObjectId tip = rig.id("tip", state::ghost_kind().kind);
  ASSERT_TRUE(rig.apply(rig.catalogue.prepare_set_parent(tip, "BODY wall")).success);
  EXPECT_NEAR(rig.state_of("tip").T_world_object.position.x, 1.09, 1e-12) << "where it was";
}

TEST(Ghosts, PushNothing) {
  GhostRig with, without;
  without.apply(without.catalogue.prepare_remove("GHOST zone"));
  without.apply(without.catalogue.prepare_remove("GHOST tip"));
  bool felt = false;
  for (int i = 0; i < 400; ++i) {
    with.step();
    without.step();
    const state::BodyState &a = with.body("ball"), &b = without.body("ball");
    ASSERT_EQ(a.T_world_body, b.T_world_body);
    ASSERT_EQ(a.twist_world.linear, b.twist_world.linear);
    const bool inside = std::abs(a.T_world_body.position.z) < 0.07;
    EXPECT_EQ(with.felt("zone").contains("/test/BODY ball"), inside) << a.T_world_body.position.z;
    felt = felt || inside;
  }
  EXPECT_TRUE(felt);
  EXPECT_EQ(with.frame->contacts_total, 0u);
  EXPECT_EQ(with.body("arm").T_world_body.position.x, 1.0) << "the tip overlaps the wall and does not push its arm";
}

TEST(Ghosts, KeepNobodyAwake) {
  GhostRig rig(
      "bodies: [BODY rest]\nghost objects: [GHOST around]\nnamespace: /test/\n"
      "BODY rest: {name: rest, mass: 1.0, gravity: {x: 0, y: 0, z: 0}, collision shape: SPHERE,\n"
      "            collision geometry: {radius: 0.1}}\n"
      "GHOST around: {name: around, collision shape: SPHERE, collision geometry: {radius: 0.1}}\n");
  rig.step(4000);
  EXPECT_TRUE(rig.body("rest").asleep);
  EXPECT_EQ(rig.felt("around"), Names{"/test/BODY rest"}) << "sleepers are felt, too";
}

TEST(Ghosts, FeelOnlyWhatSharesTheirCollisionGroups) {
  const auto scene = [](const std::string& groups) {
    return "bodies: [BODY a, BODY b]\nghost objects: [GHOST g]\nnamespace: /test/\n"
           "BODY a: {name: a, mass: 0, collision shape: SPHERE, collision geometry: {radius: 0.1}, "
           "collision groups: [1]}\n"
           "BODY b: {name: b, mass: 0, collision shape: SPHERE, collision geometry: {radius: 0.1}}\n"
           "GHOST g: {name: g, collision shape: SPHERE, collision geometry: {radius: 0.1}, collision groups: " +
           groups + "}\n";
  };
  EXPECT_EQ(GhostRig(scene("[]")).felt("g"), (Names{"/test/BODY a", "/test/BODY b"}));
  EXPECT_EQ(GhostRig(scene("[2, 1]")).felt("g"), (Names{"/test/BODY a", "/test/BODY b"}));
  EXPECT_EQ(GhostRig(scene("[2]")).felt("g"), Names{"/test/BODY b"});
}

// ---- Drag.

struct DragScene {
  std::string first = "drag: 0.9", second = {};
  std::string text() const {
    const std::string box = "collision shape: BOX, collision geometry: {x: 1, y: 1, z: 1}";
    const std::string ball =
        "mass: 0.5, collision shape: SPHERE, collision geometry: {radius: 0.02}, damping: {linear: 0, angular: 0}";
    return "bodies: [BODY cart, BODY ball]\nghost objects: [GHOST one, GHOST two]\nnamespace: /test/\n"
           "BODY cart: {name: cart, gravity: {x: 0, y: 0, z: 0}, location: {position: {x: 0.1, y: 0, z: 0.3}}, " +
           ball + "}\nBODY ball: {name: ball, " + ball + "}\nGHOST one: {name: one, parent: BODY cart, " + box + ", " +
           first + "}\nGHOST two: {name: two, " + box + (second.empty() ? ", collision groups: [7]" : ", " + second) +
           "}\n";
  }
};

// 2.0's law: v = v_p + 0.9 (v - its part along v_p), w = 0.9 w.
math::Twist law(const math::Twist& twist, const math::Vec3& parent, double kept) {
  const double speed = math::norm(parent);
  const math::Vec3 way = speed > 0.0 ? parent * (1.0 / speed) : math::Vec3{};
  return {parent + (twist.linear - way * math::dot(twist.linear, way)) * kept, twist.angular * kept};
}

void set_twist(GhostRig& rig, const std::string& body, const math::Twist& twist) {
  const auto port = rig.port(body);
  port->post(test::twist(twist));
  rig.step();
  state::RigidBodyCommand none;
  port->post(none);
}

TEST(GhostDrag, FollowsTheLawOfTheOriginal) {
  GhostRig rig(DragScene{}.text());
  set_twist(rig, "cart", {{0.02, 0.01, -0.005}, {}});
  set_twist(rig, "ball", {{0.3, -0.2, 0.1}, {2.0, -1.0, 0.5}});
  rig.step();
  for (int i = 0; i < 50; ++i) {
    const math::Twist wanted = law(rig.body("ball").twist_world, rig.body("cart").twist_world.linear, 0.9);
    rig.step();
    const math::Twist& now = rig.body("ball").twist_world;
    ASSERT_NEAR(math::norm(now.linear - wanted.linear), 0.0, 1e-9) << i;
    ASSERT_NEAR(math::norm(now.angular - wanted.angular), 0.0, 1e-9) << i;
  }
  EXPECT_NEAR(rig.body("cart").twist_world.linear.x, 0.02, 1e-9) << "a parent is not dragged, and feels no force";
}

TEST(GhostDrag, OfTwoGhostsActsOneAfterTheOther) {
  GhostRig rig(DragScene{"drag: 0.9", "drag: 0.8"}.text());
  set_twist(rig, "cart", {{0.02, 0.01, -0.005}, {}});
  rig.step();
  for (int i = 0; i < 20; ++i) {
    math::Twist wanted = law(rig.body("ball").twist_world, rig.body("cart").twist_world.linear, 0.9);
    wanted = law(wanted, {}, 0.8);
    rig.step();
    ASSERT_NEAR(math::norm(rig.body("ball").twist_world.linear - wanted.linear), 0.0, 1e-9) << i;
  }
}

TEST(GhostDrag, GivesTheBodyItsOwnGravityBack) {
  GhostRig rig(DragScene{"drag: 0.9", "drag: 0.9"}.text());
  const auto falls_with = [&] {
    const double before = rig.body("ball").twist_world.linear.z;
    rig.step();
    return (rig.body("ball").twist_world.linear.z - before) / kStep_s;
  };
  rig.step();
  EXPECT_NEAR(falls_with(), 0.0, 1e-6);
  ASSERT_TRUE(rig.apply(rig.catalogue.prepare_remove("GHOST one")).success);
  EXPECT_NEAR(falls_with(), 0.0, 1e-6) << "the other one is still around it";
  ASSERT_TRUE(rig.apply(rig.catalogue.prepare_remove("GHOST two")).success);
  EXPECT_NEAR(falls_with(), -9.81, 1e-6);
}

TEST(Ghosts, GoOnFromASavedState) {
  const std::string text = DragScene{"drag: 0.95", "drag: 0.9"}.text();
  GhostRig rig(text), other(text);
  set_twist(rig, "ball", {{0.3, -0.2, 0.1}, {2.0, -1.0, 0.5}});
  rig.step();
  const std::vector<std::uint8_t> saved = rig.live->save();
  rig.step(30);
  ASSERT_EQ(other.live->restore(saved), "");
  other.live->fill(*other.frame);
  EXPECT_EQ(other.felt("one"), (Names{"/test/BODY ball", "/test/BODY cart", "/test/GHOST two"}));
  other.step(30);
  EXPECT_EQ(other.body("ball").twist_world.linear, rig.body("ball").twist_world.linear);
  EXPECT_EQ(other.body("ball").twist_world.angular, rig.body("ball").twist_world.angular);
  EXPECT_EQ(other.body("ball").T_world_body, rig.body("ball").T_world_body);
  EXPECT_EQ(other.body("cart").T_world_body, rig.body("cart").T_world_body);
}

TEST(Ghosts, WithoutAShapeAreReported) {
  Rig rig;
  const Prepared loaded = rig.catalogue.prepare_load(
      parse("ghost objects: [GHOST g]\nnamespace: /test/\nGHOST g: {name: g, parent: BODY none}\n"));
  EXPECT_TRUE(adf::says(loaded.diagnostics, "warning: .*GHOST g: collision shape.*feels nothing"));
  EXPECT_TRUE(adf::says(loaded.diagnostics, "GHOST g: parent"));
}

}  // namespace
}  // namespace ambf::model::test
