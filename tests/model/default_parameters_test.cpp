// Live parameters follow the defaults that blocks begin with: what a file leaves out is what a reset of the world
// restores.
#include <gtest/gtest.h>

#include "adf/adf.h"
#include "rig.h"

namespace ambf::model::test {
namespace {

TEST(DefaultParameters, OfAChangedDescriptionAreWhatAResetRestores) {
  adf::Options options;
  options.look_for_files = false;
  scene::Body changed;
  changed.surface.friction = 0.625;
  changed.linear.p = {3.0, 4.0, 5.0};
  options.defaults.set(changed);
  const adf::ModelResult parsed = adf::parse_model(
      "bodies: [BODY A]\nnamespace: /test/\nBODY A: {name: A, mass: 1, collision shape: BOX, "
      "collision geometry: {x: 0.1, y: 0.1, z: 0.1}, restitution: 0.25}\n",
      "changed.yaml", options);
  ASSERT_TRUE(parsed.model);
  Rig rig;
  rig.load(*parsed.model);
  const state::ObjectId body = rig.id("A");
  for (const state::Parameter parameter :
       {state::Parameter::friction, state::Parameter::restitution, state::Parameter::linear_p}) {
    ASSERT_TRUE(rig.live->set_parameter(body, parameter, {0.125, 0.125, 0.125}));
  }
  rig.live->fill_parameters(*rig.frame);
  EXPECT_EQ(rig.frame->body_parameters[rig.slot("A")].surface.friction, 0.125);

  rig.live->reset();
  rig.live->fill_parameters(*rig.frame);
  const state::BodyParameters& restored = rig.frame->body_parameters[rig.slot("A")];
  EXPECT_EQ(restored.surface.friction, 0.625);
  EXPECT_EQ(restored.surface.restitution, 0.25);
  EXPECT_EQ(restored.linear.p, (math::Vec3{3.0, 4.0, 5.0}));
}

}  // namespace
}  // namespace ambf::model::test
