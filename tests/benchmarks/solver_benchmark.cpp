// Thread CPU time of a whole step (collision included) for the scenes of docs/solver.md, with Bullet's sequential
// impulse at 10 and 50 iterations and with the joint block solver. Usage: ambf_solver_benchmark [part of a scene's
// name]
#include <ctime>

#include <algorithm>
#include <cstdio>
#include <functional>
#include <string>
#include <vector>

#include "tests/physics/mechanisms.h"

namespace {

using namespace ambf::physics::testing;

double thread_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

struct Case {
  std::string name;
  std::function<void(BulletScene&)> build;
};

struct Mode {
  const char* name;
  bool direct;
  int iterations;
};

// Median of the runs' means, in microseconds a step, after the scene has settled.
double microseconds_a_step(BulletScene& scene) {
  scene.step(500);
  scene.solver().clear_statistics();
  std::vector<double> runs;
  for (int run = 0; run < 9; ++run) {
    const int steps = 200;
    const double start = thread_seconds();
    scene.step(steps);
    runs.push_back((thread_seconds() - start) / steps * 1e6);
  }
  std::nth_element(runs.begin(), runs.begin() + 4, runs.end());
  return runs[4];
}

// Distance that a resting box has moved after 60 s, and that a box lifted at 5 and 50 N slips in 3.4 s, in mm.
void print_drift() {
  BulletScene scene;
  scene.add_ground();
  auto& box = scene.add_box(btVector3(0.05, 0.05, 0.05), 0.5, btVector3(0, 0, 0.05));
  scene.step(500);
  const btVector3 from = box.getWorldTransform().getOrigin();
  scene.step(60000);
  std::printf("resting box: %.6f mm in 60 s\n", 1e3 * from.distance(box.getWorldTransform().getOrigin()));
  for (const double force : {5.0, 50.0}) {
    BulletScene lifting;
    Gripper gripper = add_gripper(lifting);
    close_gripper(gripper, force);
    lifting.step(300);
    const auto in_hand = [&] {
      return gripper.fingers[0]->getWorldTransform().inverse() * gripper.box->getWorldTransform().getOrigin();
    };
    const btVector3 grasped = in_hand();
    gripper.lift->setTargetLinMotorVelocity(0.1);
    lifting.step(1000);
    gripper.lift->setTargetLinMotorVelocity(0.0);
    lifting.step(2400);
    std::printf("box lifted at %g N: slips %.5f mm in 3.4 s\n", force, 1e3 * grasped.distance(in_hand()));
  }
}

}  // namespace

int main(int argc, char** argv) {
  const std::vector<Case> cases = {
      {"1 cube", [](BulletScene& s) { s.add_ground(), add_towers(s, 1, 1); }},
      {"300 cubes", [](BulletScene& s) { s.add_ground(), add_towers(s, 300, 1); }},
      {"60 towers of 5", [](BulletScene& s) { s.add_ground(), add_towers(s, 60, 5); }},
      {"10 four-bars", [](BulletScene& s) { add_four_bars(s, 10, 0.0); }},
      {"coupled chain", [](BulletScene& s) { add_coupled_chain(s, 10, 0.0); }},
      {"coupled chain, 10 kg", [](BulletScene& s) { add_coupled_chain(s, 10, 10.0); }},
      {"7-link arm, 20 kg",
       [](BulletScene& s) {
         for (auto* joint : add_arm(s, 20.0).joints) drive(*joint, 0.0, 1000.0);
       }},
      {"manipulator", [](BulletScene& s) { add_manipulator(s, btVector3(0, 0, 1)); }},
      {"3 manipulators",
       [](BulletScene& s) {
         for (int i = 0; i < 3; ++i) add_manipulator(s, btVector3(0, i, 1));
       }},
      {"gripper holding a box",
       [](BulletScene& s) {
         Gripper g = add_gripper(s);
         close_gripper(g, 5.0);
         s.step(300);
         g.lift->setTargetLinMotorVelocity(0.05);
       }},
  };
  const Mode modes[] = {{"SI 10", false, 10}, {"SI 50", false, 50}, {"ours", true, 10}};
  std::printf("%-24s", "us of thread CPU a step");
  for (const Mode& mode : modes) std::printf("%10s", mode.name);
  std::printf("   ours: gap mm, sweeps, factorisations, solves a step\n");
  for (const Case& item : cases) {
    if (argc > 1 && item.name.find(argv[1]) == std::string::npos) continue;
    std::printf("%-24s", item.name.c_str());
    for (const Mode& mode : modes) {
      SceneOptions options;
      options.solver.direct = mode.direct;
      options.iterations = mode.iterations;
      options.batch_size = mode.direct ? 1 : 128;
      BulletScene scene(options);
      item.build(scene);
      std::printf("%10.1f", microseconds_a_step(scene));
      std::fflush(stdout);
      if (!mode.direct) continue;
      const auto& counts = scene.solver().statistics();
      const double steps = 9 * 200;
      std::printf(
          "   %.5f %6.1f %5.2f %5.2f", 1e3 * scene.largest_gap(), static_cast<double>(counts.contact_sweeps) / steps,
          static_cast<double>(counts.joints.factorisations) / steps, static_cast<double>(counts.joints.solves) / steps);
    }
    std::printf("\n");
  }
  if (argc == 1) print_drift();
  return 0;
}
