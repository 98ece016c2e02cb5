// Values of bodies that no body can have: repaired, refused, or hinted at.
#include <gtest/gtest.h>

#include "model/detail/plausible.h"
#include "rig.h"

namespace ambf::model {
namespace {

using test::box;
using test::model;
using test::Rig;

constexpr double kSide_m = 0.1;

scene::Body with_inertia(const math::Vec3& inertia) {
  scene::Body body = box("odd", 1.0, {0, 0, 0.05 + 1e-4}, kSide_m);
  body.inertia = inertia;
  return body;
}

// The only finding of loading this body beside a floor; none: an empty one.
base::Diagnostic finding_of(Rig& rig, const scene::Body& body) {
  const scene::Body floor = box("floor", 0.0, {0, 0, -0.5}, 1.0);
  const base::Diagnostics found = rig.catalogue.check_load(model("odd.yaml", {floor, body}));
  EXPECT_LE(found.size(), 1u);
  return found.empty() ? base::Diagnostic{} : found.front();
}

TEST(Plausible, InertiasThatABodyCanHaveAreNotMentioned) {
  Rig rig;
  EXPECT_EQ(finding_of(rig, with_inertia({1e-3, 2e-3, 3e-3})).message, "");
  EXPECT_EQ(finding_of(rig, with_inertia({1e-9, 1e-3, 1e-3})).message, "");  // a needle
  EXPECT_EQ(finding_of(rig, with_inertia({0, 0, 0})).message, "");           // not given
}

TEST(Plausible, ASmallExcessIsHintedAt) {
  Rig rig;
  const base::Diagnostic found = finding_of(rig, with_inertia({1e-3, 1e-3, 5e-3}));
  EXPECT_EQ(found.severity, base::Severity::information);
  EXPECT_EQ(found.block, "BODY odd");
  EXPECT_EQ(found.key, "inertia");
}

TEST(Plausible, AnImpossibleInertiaIsRepairedAndTheBodyRestsOnItsFloor) {
  Rig rig({0, 0, -9.8});
  scene::Body odd = with_inertia({1e-12, 1, 1e12});
  Rig other;
  EXPECT_EQ(finding_of(other, odd).severity, base::Severity::warning);
  rig.load(model("odd.yaml", {box("floor", 0.0, {0, 0, -0.5}, 1.0), odd}));
  const math::Vec3 used = rig.info("odd").inertia;
  EXPECT_NEAR(std::max({used.x, used.y, used.z}) / (used.x + used.y + used.z), 0.5, 1e-9);  // a flat body's
  rig.step(500);
  EXPECT_NEAR(rig.body("odd").T_world_body.position.z, 0.05, 2e-3);
}

TEST(Plausible, APointCloudHasAtMostSoManyPoints) {
  scene::Body body = box("cloud", 1.0, {0, 0, 0});
  body.collision.mesh_type = scene::CollisionMeshType::point_cloud;
  Findings good("file.yaml"), found("file.yaml");
  EXPECT_TRUE(usable_cloud(65536, body, good));
  EXPECT_TRUE(good.take().empty());
  EXPECT_FALSE(usable_cloud(249'001, body, found));
  const base::Diagnostics said = found.take();
  ASSERT_EQ(said.size(), 1u);
  EXPECT_EQ(said[0].severity, base::Severity::error);
  EXPECT_NE(said[0].message.find("249001 points; expected at most 65536"), std::string::npos) << said[0].message;
  body.collision.mesh_type = scene::CollisionMeshType::convex_hull;
  EXPECT_TRUE(usable_cloud(249'001, body, good));
}

TEST(Plausible, AMeshInMillimetresIsHintedAtAndOneBeyondTheWorldIsLeftOut) {
  Rig rig;
  scene::Body body = box("odd", 1.0, {0, 0, 0.0}, 1.0);
  EXPECT_EQ(finding_of(rig, body).message, "");
  body.collision.scale = 3e6;
  const base::Diagnostic found = finding_of(rig, body);
  EXPECT_EQ(found.severity, base::Severity::error);
  EXPECT_NE(found.message.find("at most 1e+06 m"), std::string::npos) << found.message;
}

}  // namespace
}  // namespace ambf::model
