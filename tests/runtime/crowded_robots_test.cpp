// Two robots loaded at one place: every mesh of one is inside its like of the other. That is a mistake, and must stay
// one that a running simulation survives: finite, affordable and said once.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <ctime>

#include "tests/runtime/model_rig.h"

namespace ambf::runtime {
namespace {

using namespace test;

constexpr unsigned kSettle = 100, kSteps = 1000;

// All threads'; while steps are waited for, only the physics thread has anything to do.
double process_cpu_s() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

struct Outcome {
  double seconds_per_step = 0.0;
  double farthest = 0.0, fastest = 0.0;  // of any body, from where it was loaded
  bool finite = true;
  int warnings = 0;  // of crowded meshes
};

Outcome two_psms(double apart) {
  Outcome result;
  ModelRig rig(bare_world());
  for (int i = 0; i < 2; ++i) {
    state::LoadRequest request;
    request.path = compat::model("robots/blender-psm.yaml");
    request.name_prefix = i == 0 ? "/one" : "/two";
    request.T_world_model.position.x = apart * i;
    const state::Outcome loaded = rig.simulation.load_and_wait(request);
    EXPECT_TRUE(loaded.success) << loaded.message;
  }
  std::vector<math::Vec3> start;
  for (const state::BodyState& body : rig.frame().bodies) start.push_back(body.T_world_body.position);
  EXPECT_GE(start.size(), 16u);
  EXPECT_TRUE(rig.step(kSettle).success);
  const double begin = process_cpu_s();
  EXPECT_TRUE(rig.step(kSteps).success);
  result.seconds_per_step = (process_cpu_s() - begin) / kSteps;
  for (unsigned done = 0; done < 1000; done += 50) {
    EXPECT_TRUE(rig.step(50).success);
    const state::Frame& frame = rig.frame();
    for (std::size_t i = 0; i < start.size(); ++i) {
      const double away = math::norm(frame.bodies[i].T_world_body.position - start[i]);
      const double speed = math::norm(frame.bodies[i].twist_world.linear);
      result.finite = result.finite && std::isfinite(away) && std::isfinite(speed);
      result.farthest = std::max(result.farthest, away);
      result.fastest = std::max(result.fastest, speed);
    }
  }
  for (base::LogRecord record; rig.log.take(record);)
    result.warnings += record.severity >= base::Severity::warning && record.text.find("triangles") != std::string::npos;
  return result;
}

TEST(CrowdedRobots, TwoAtOnePlaceStayFiniteAndAffordableAndAreSaidOnce) {
  AMBF_NEEDS_COMPAT();
  const Outcome apart = two_psms(5.0), together = two_psms(0.0);
  std::printf("two PSMs: %.0f us a step 5 m apart, %.0f at one place (%.1f times); there up to %.2f m away, %.2f m/s\n",
              apart.seconds_per_step * 1e6, together.seconds_per_step * 1e6,
              together.seconds_per_step / apart.seconds_per_step, together.farthest, together.fastest);
  EXPECT_TRUE(apart.finite);
  EXPECT_TRUE(together.finite);
  EXPECT_LT(together.seconds_per_step, 60.0 * apart.seconds_per_step);
  EXPECT_LT(together.farthest, 2.0);
  EXPECT_LT(together.fastest, 10.0);
  EXPECT_EQ(apart.warnings, 0);
  EXPECT_LE(together.warnings, 1);
}

}  // namespace
}  // namespace ambf::runtime
