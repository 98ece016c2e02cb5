// A public suite of scenes made for the third generation of the original, loaded as its launch file says: everything is
// there, and cameras and light hang on a body that is loaded after them.
#include <gtest/gtest.h>

#include "adf/adf.h"
#include "simulation_rig.h"
#include "state/ghosts.h"
#include "tests/support/compat_models.h"

namespace ambf::runtime {
namespace {

TEST(ThirdGeneration, LoadsWholeAndRunsWithItsCamerasOnALaterBody) {
  AMBF_NEEDS_THIRD_GENERATION();
  const adf::LaunchResult launch = adf::load_launch((compat::third_generation() / "launch.yaml").string());
  ASSERT_TRUE(launch.launch);
  const adf::WorldResult world = adf::load_world(launch.launch->world_file);
  ASSERT_TRUE(world.world);
  base::Log log;
  Simulation simulation(test::free_running(), *world.world, {}, log);
  std::size_t bodies = simulation.structure()->bodies.size(), joints = 0;
  for (const std::size_t index : {6u, 7u, 8u, 9u, 10u, 11u}) {
    state::LoadRequest request;
    request.path = launch.launch->model_files.at(index);
    const adf::ModelResult model = adf::load_model(request.path);
    ASSERT_TRUE(model.model) << request.path;
    bodies += model.model->bodies.size();
    joints += model.model->joints.size();
    const state::Outcome loaded = simulation.load_and_wait(request);
    EXPECT_TRUE(loaded.success) << loaded.message;
  }
  const auto structure = simulation.structure();
  EXPECT_EQ(structure->bodies.size(), bodies);
  EXPECT_EQ(structure->joints.size(), joints);
  const std::uint32_t frame_body = state::find(*structure, "BODY CameraFrame", state::ObjectKind::rigid_body);
  ASSERT_NE(frame_body, state::kNone);
  ASSERT_EQ(structure->cameras.size(), 2u);
  for (const state::CameraInfo& camera : structure->cameras) EXPECT_EQ(camera.parent_object, frame_body);
  ASSERT_EQ(structure->lights.size(), 1u);
  EXPECT_EQ(structure->lights[0].parent_object, frame_body);

  EXPECT_EQ(state::ghosts(*structure).size(), 12u) << "a hole's each, and a finger's";
  for (const state::GhostInfo& ghost : state::ghosts(*structure)) {
    EXPECT_NE(ghost.parent_object, state::kNone) << structure->objects[ghost.object].name;
    EXPECT_NE(ghost.collision_appearance, nullptr) << structure->objects[ghost.object].name;
  }

  const std::unique_ptr<state::FrameReader> reader = simulation.make_reader();
  simulation.set_paused(true);
  simulation.begin();
  const auto ticket = simulation.step(1000, {}, false);
  while (!ticket->wait(std::chrono::seconds(1))) continue;
  EXPECT_TRUE(ticket->outcome().success) << ticket->outcome().message;
  const state::Frame& frame = *reader->latest();
  EXPECT_FALSE(frame.run.diverged);
  for (const state::BodyState& body : frame.bodies) EXPECT_TRUE(math::is_finite(body.T_world_body));
}

}  // namespace
}  // namespace ambf::runtime
