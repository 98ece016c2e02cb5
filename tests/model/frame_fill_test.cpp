// Filling a frame writes all that its columns compute: nothing of an earlier step, or of a new frame's NaN, stays.
#include <gtest/gtest.h>

#include <cmath>

#include "rig.h"
#include "state/columns.h"
#include "tests/support/views.h"

namespace ambf::model::test {
namespace {

// Joints, contacts (boxes side by side on the ground), a camera and a light.
scene::Model scene_of_all_kinds() {
  scene::Model out = chain(3);
  out.bodies.push_back(box("ground", 0.0, {2, 0, -0.5}, 1.0));
  out.bodies.push_back(box("resting", 1.0, {2, 0, 0.05}));
  out.cameras.push_back(test_camera({1, 0, 0}, "BODY link1"));
  out.lights.push_back(test_light());
  return out;
}

TEST(Frames, AreFilledInAllColumns) {
  Rig rig({0, 0, -9.81});
  ASSERT_TRUE(rig.load(scene_of_all_kinds()).success);
  rig.step(20);
  ASSERT_GT(rig.frame->contacts.size(), 0u);
  const auto zeros = state::make_frame(rig.live->structure()), nans = state::make_frame(rig.live->structure());
  nans->contacts.resize(base::kMaxContactsInFrame);
  state::fill_nan(*nans);
  for (state::Frame* frame : {zeros.get(), nans.get()}) {
    rig.live->fill(*frame);
    rig.live->fill_parameters(*frame);
  }
  state::for_each_column([&](const state::FrameColumn& column) {
    state::StateHash expected, filled;
    column.hash(*zeros, expected);
    column.hash(*nans, filled);
    EXPECT_EQ(expected.value(), filled.value()) << column.traits().name;
  });
}

TEST(Frames, AreNewWithNaNInDebugBuilds) {
#ifdef NDEBUG
  GTEST_SKIP() << "a release build";
#endif
  Rig rig;
  const Prepared prepared = rig.catalogue.prepare_load(chain(2));
  for (const auto& frame : prepared.frames) {
    EXPECT_TRUE(std::isnan(frame->bodies.at(1).T_world_body.position.x));
    EXPECT_TRUE(std::isnan(frame->joints.at(0).position));
  }
}

}  // namespace
}  // namespace ambf::model::test
