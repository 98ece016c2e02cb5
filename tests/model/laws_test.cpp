// Laws that hold a body add, and each source's share of the last step is in the frame.
#include <gtest/gtest.h>

#include <optional>

#include "base/limits.h"
#include "math/rotation.h"
#include "model/law.h"
#include "rig.h"
#include "state/columns.h"

namespace ambf::model::test {
namespace {

using state::Source;

// A law that the product does not know: a damped spring from the centre of mass to a point of the world.
class SpringToPoint final : public Law {
 public:
  SpringToPoint(double stiffness, double damping, const math::Vec3& point_world)
      : stiffness_(stiffness), damping_(damping), point_world_(point_world) {}
  math::Wrench act(const physics::Body& body, double) override {
    const math::Vec3 com = body.com_pose().position;
    return {(point_world_ - com) * stiffness_ - body.twist().linear * damping_, {}};
  }

 private:
  double stiffness_, damping_;
  math::Vec3 point_world_;
};

// Boxes of 2 kg, neither gravity nor damping: what laws do is all that changes their momentum.
struct LawRig : Rig {
  explicit LawRig(int boxes = 1) {
    scene::Model scene = model("scene", {});
    for (int i = 0; i < boxes; ++i) {
      scene.bodies.push_back(box("a" + std::to_string(i), kMass, {2.0 * i, 0, 0}));
      scene.bodies.back().surface.linear_damping = scene.bodies.back().surface.angular_damping = 0.0;
    }
    load(scene);
  }
  std::optional<math::Wrench> share(Source source, const std::string& body = "a0") const {
    for (const state::LawShare& row : frame->law_shares)
      if (row.body == slot(body) && row.source == source) return row.wrench_world;
    return std::nullopt;
  }
  math::Wrench sum() const {
    math::Wrench sum;
    for (const state::LawShare& row : frame->law_shares) {
      sum.force += row.wrench_world.force;
      sum.torque += row.wrench_world.torque;
    }
    return sum;
  }
  static constexpr double kMass = 2.0;
};

void expect_near(const math::Vec3& a, const math::Vec3& b, double tolerance) {
  EXPECT_NEAR(a.x, b.x, tolerance);
  EXPECT_NEAR(a.y, b.y, tolerance);
  EXPECT_NEAR(a.z, b.z, tolerance);
}

TEST(Laws, ABodyThatNobodyHoldsHasNoShare) {
  LawRig rig;
  const auto port = rig.port("a0");
  rig.step();
  EXPECT_TRUE(rig.frame->law_shares.empty());
  port->post(joints({to_effort(1.0)}));
  rig.step();
  EXPECT_TRUE(rig.frame->law_shares.empty()) << "a command for joints only";
}

TEST(Laws, EachSourceOfAWrenchHasItsShare) {
  LawRig rig(2);
  const auto ros = rig.port("a0"), steps = rig.port("a0", Source::step_service), other = rig.port("a1");
  ros->post(force({1, 0, 0}, {0, 0, 0.1}));
  steps->post(force({0, 2, 0}));
  other->post(force({0, 0, 3}));
  rig.step();
  ASSERT_EQ(rig.frame->law_shares.size(), 3u);
  EXPECT_EQ(rig.frame->law_shares_total, 3u);
  EXPECT_EQ(rig.share(Source::ros)->force, (math::Vec3{1, 0, 0}));
  EXPECT_EQ(rig.share(Source::ros)->torque, (math::Vec3{0, 0, 0.1}));
  EXPECT_EQ(rig.share(Source::step_service)->force, (math::Vec3{0, 2, 0}));
  EXPECT_EQ(rig.share(Source::ros, "a1")->force, (math::Vec3{0, 0, 3}));
  steps->release();
  rig.step();
  EXPECT_FALSE(rig.share(Source::step_service));
  ASSERT_TRUE(rig.share(Source::ros));
  rig.step(600);
  EXPECT_TRUE(rig.frame->law_shares.empty()) << "expired";
}

// Nothing else acts: the shares of a step are what changes momentum in it.
TEST(Laws, SharesOfTargetsArePreciselyWhatChangesMomentum) {
  LawRig rig;
  const auto ros = rig.port("a0"), panel = rig.port("a0", Source::panel);
  const auto expect_momentum = [&](Source leads) {
    const math::Twist before = rig.body("a0").twist_world;
    rig.step();
    const math::Twist after = rig.body("a0").twist_world;
    ASSERT_TRUE(rig.share(leads));
    expect_near(rig.sum().force * kStep_s, (after.linear - before.linear) * LawRig::kMass, 1e-12);
    const double inertia = rig.info("a0").inertia.x;  // of a cube: the same about every axis
    expect_near(rig.sum().torque * kStep_s, (after.angular - before.angular) * inertia, 1e-12);
  };
  ros->post(force({1, -2, 3}, {0.01, 0.02, 0.03}));
  panel->post(pose({{0.1, 0.2, -0.1}, math::from_axis_angle({0, 0, 1}, 0.3)}));
  for (int i = 0; i < 20; ++i) expect_momentum(Source::panel);
  ros->post(twist({{0.3, 0, 0.1}, {0, 0.5, 0}}));
  expect_momentum(Source::ros);
  EXPECT_FALSE(rig.share(Source::panel)) << "who wrote last leads";
  expect_near(rig.body("a0").twist_world.linear, {0.3, 0, 0.1}, 1e-12);
}

TEST(Laws, AMadeUpLawAddsToACommand) {
  LawRig rig;
  constexpr double kStiffness = 200.0;
  SpringToPoint spring(kStiffness, 30.0, {0, 0, 0.5});
  const auto ros = rig.port("a0");
  ASSERT_TRUE(rig.live->hold(rig.id("a0"), Source::device_0, spring));
  const math::Vec3 pull{4, 0, 0};
  rig.step(3000, [&](int) { ros->post(force(pull)); });
  expect_near(rig.body("a0").T_world_body.position, math::Vec3{0, 0, 0.5} + pull * (1.0 / kStiffness), 1e-6);
  EXPECT_EQ(rig.share(Source::ros)->force, pull);
  expect_near(rig.share(Source::device_0)->force, -pull, 1e-4);

  rig.live->let_go(rig.id("a0"), Source::device_0);
  rig.step();
  EXPECT_FALSE(rig.share(Source::device_0));
  EXPECT_NEAR(rig.body("a0").twist_world.linear.x, kStep_s * pull.x / LawRig::kMass, 1e-6)
      << "only the command is left";
}

TEST(Laws, OneLawAndItsCommandOfOneSourceAreOneShare) {
  LawRig rig;
  SpringToPoint spring(100.0, 0.0, {1, 0, 0}), stiffer(200.0, 0.0, {1, 0, 0});
  const auto device = rig.port("a0", Source::device_0);
  ASSERT_TRUE(rig.live->hold(rig.id("a0"), Source::device_0, spring));
  ASSERT_TRUE(rig.live->hold(rig.id("a0"), Source::device_0, stiffer)) << "replaces the other one";
  device->post(force({0, 5, 0}));
  rig.step();
  ASSERT_EQ(rig.frame->law_shares.size(), 1u);
  expect_near(rig.share(Source::device_0)->force, {200, 5, 0}, 1e-12);
}

TEST(Laws, APushIsAShareOfWhoPushesWhileItLasts) {
  LawRig rig;
  state::Push push{{0, 0, 3}, {0.1, 0, 0}, {0.05, 0, 0}, 0.01, Source::plugin};
  ASSERT_TRUE(rig.live->push(rig.id("a0"), push));
  rig.step();
  expect_near(rig.share(Source::plugin)->force, {0, 0, 3}, 1e-12);
  expect_near(rig.share(Source::plugin)->torque, {0.1, -0.15, 0}, 1e-12);
  rig.step(9);
  EXPECT_TRUE(rig.share(Source::plugin));
  rig.step();
  EXPECT_FALSE(rig.share(Source::plugin));
}

TEST(Laws, APointersPullIsAShare) {
  LawRig rig;
  state::PickHit hit;
  PickTable& table = rig.live->pick_table();
  const int slot = table.take();
  ASSERT_EQ(slot, 0);
  table[0].presses = 1;
  ASSERT_TRUE(rig.live->pick(0, 1, {0.04, 0, 1}, {0.04, 0, -1}, hit));
  table[0].target.post({1, {0.04, 0, 0.3}}, 0);
  rig.live->take_picks(false);
  rig.step();
  ASSERT_TRUE(rig.share(Source::pointer));
  ASSERT_EQ(rig.frame->picks.size(), 1u);
  EXPECT_EQ(rig.share(Source::pointer)->force, rig.frame->picks[0].force_world);
  EXPECT_GT(rig.share(Source::pointer)->force.z, 0.0);
  EXPECT_LT(rig.share(Source::pointer)->torque.y, 0.0) << "it pulls beside the centre of mass";
  expect_near(rig.sum().force * kStep_s, rig.body("a0").twist_world.linear * LawRig::kMass, 1e-9);
}

TEST(Laws, OnlyMovingBodiesThatExistCanBeHeld) {
  LawRig rig(2);
  rig.load(model("ground", {box("floor", 0.0, {0, 0, -5})}));
  SpringToPoint spring(100.0, 0.0, {1, 0, 0});
  EXPECT_FALSE(rig.live->hold(rig.id("floor"), Source::plugin, spring));
  EXPECT_FALSE(rig.live->hold({}, Source::plugin, spring));
  const state::ObjectId gone = rig.id("a1");
  ASSERT_TRUE(rig.live->hold(gone, Source::plugin, spring));
  ASSERT_TRUE(rig.live->hold(rig.id("a0"), Source::plugin, spring));
  rig.step();
  ASSERT_TRUE(rig.apply(rig.catalogue.prepare_remove("BODY a1")).diagnostics.empty());
  EXPECT_EQ(rig.frame->law_shares.size(), 1u) << "shares of the last step stay with the body that stays";
  rig.step();
  EXPECT_EQ(rig.frame->law_shares.size(), 1u);
  EXPECT_FALSE(rig.live->hold(gone, Source::plugin, spring));
  rig.live->let_go(gone, Source::plugin);
}

TEST(Laws, ARestoredWorldShowsTheSharesOfItsLastStep) {
  LawRig rig;
  SpringToPoint spring(100.0, 1.0, {1, 0, 0});
  ASSERT_TRUE(rig.live->hold(rig.id("a0"), Source::device_0, spring));
  const auto ros = rig.port("a0");
  ros->post(force({0, 1, 0}));
  rig.step(20);
  const auto bytes = rig.live->save();
  const std::uint64_t hash = state::state_hash(*rig.frame);
  rig.step(30);
  const std::uint64_t later = state::state_hash(*rig.frame);
  ASSERT_NE(hash, later);
  ASSERT_EQ(rig.live->restore(bytes), "");
  rig.live->fill(*rig.frame);
  EXPECT_EQ(rig.frame->law_shares.size(), 2u);
  EXPECT_EQ(state::state_hash(*rig.frame), hash);
  rig.step(30);
  EXPECT_EQ(state::state_hash(*rig.frame), later);
  rig.frame->law_shares.pop_back();
  EXPECT_NE(state::state_hash(*rig.frame), later) << "shares are hashed";
  rig.live->reset();
  rig.live->fill(*rig.frame);
  EXPECT_TRUE(rig.frame->law_shares.empty());
}

TEST(Laws, EverySourceThatThereMayBeCommandsAndOneMoreIsRefused) {
  LawRig rig;
  std::vector<std::unique_ptr<state::CommandPort>> ports;
  for (int source = 0; source < base::kMaxSources; ++source) {
    ports.push_back(rig.port("a0", static_cast<Source>(source)));
    ASSERT_NE(ports.back(), nullptr) << source;
    ports.back()->post(force({1, 0, 0}));
  }
  EXPECT_EQ(rig.port("a0", static_cast<Source>(base::kMaxSources)), nullptr);
  rig.step();
  EXPECT_EQ(rig.frame->law_shares.size(), std::size_t{base::kMaxSources});
  EXPECT_EQ(rig.frame->commands.at(0).sources, ~state::SourceSet{0});
  EXPECT_NEAR(rig.body("a0").twist_world.linear.x, kStep_s * base::kMaxSources / LawRig::kMass, 1e-12);
}

TEST(Laws, SharesWithoutRoomAreCountedAndTheirLawsActAllTheSame) {
  constexpr int kBoxes = 5;
  constexpr std::size_t kAll = static_cast<std::size_t>(kBoxes) * base::kMaxSources;
  static_assert(kAll > kBoxes + base::kSpareLaws);
  LawRig rig(kBoxes);
  std::vector<std::unique_ptr<state::CommandPort>> ports;
  for (int i = 0; i < kBoxes; ++i)
    for (int source = 0; source < base::kMaxSources; ++source) {
      ports.push_back(rig.port("a" + std::to_string(i), static_cast<Source>(source)));
      ports.back()->post(force({1, 0, 0}));
    }
  rig.step();
  EXPECT_EQ(rig.frame->law_shares.size(), kBoxes + base::kSpareLaws);
  EXPECT_EQ(rig.frame->law_shares_total, kAll);
  for (int i = 0; i < kBoxes; ++i)
    EXPECT_NEAR(rig.body("a" + std::to_string(i)).twist_world.linear.x, kStep_s * base::kMaxSources / LawRig::kMass,
                1e-12);
}

TEST(Laws, ALawTooManyIsRefused) {
  constexpr int kBoxes = 5;
  LawRig rig(kBoxes);
  SpringToPoint spring(100.0, 0.0, {1, 0, 0});
  std::size_t held = 0;
  for (int i = 0; i < kBoxes; ++i)
    for (int source = 0; source < base::kMaxSources; ++source)
      held += rig.live->hold(rig.id("a" + std::to_string(i)), static_cast<Source>(source), spring) ? 1 : 0;
  EXPECT_EQ(held, kBoxes + base::kSpareLaws);
  rig.live->let_go(rig.id("a0"), Source::ros);
  EXPECT_TRUE(rig.live->hold(rig.id("a4"), static_cast<Source>(base::kMaxSources - 1), spring));
}

}  // namespace
}  // namespace ambf::model::test
