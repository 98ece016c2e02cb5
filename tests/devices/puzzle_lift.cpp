#include "tests/devices/puzzle_lift.h"

#include <cmath>
#include <memory>

#include "adf/adf.h"
#include "tests/devices/operator.h"
#include "tests/support/compat_models.h"

namespace ambf::devices::testing {
namespace {

using math::Pose;
using math::Vec3;

// Of the scene, m. The handles are stirrups: their sides, 55 mm thick, are what a gripper grasps from above.
constexpr double kSides[] = {0.126, -0.129};   // from the puzzle's middle, towards x
constexpr double kHandle = 0.985;              // towards y
constexpr double kPads = 0.335;                // from a gripper's palm to the middle of its pads
constexpr double kAbove = 0.3, kLifted = 0.3;  // over the floor's puzzle
constexpr double kAim = 0.01;
constexpr Vec3 kAside{-0.25, 0.0, 0.0};
constexpr double kOpen = 0.42, kClosed = 0.0;

// A gripper's fingers point along -x of its palm: down, opening towards x of the world.
math::Quat pointing_down() { return math::from_axis_angle(math::normalized(Vec3{1, 1, 1}), -2.0 * M_PI / 3.0); }

scene::World world_of_the_original() {
  return *adf::load_world((compat::descriptions() / "world/world.yaml").string()).world;
}

class Lift {
 public:
  explicit Lift(unsigned seed)
      : random_(seed),
        session_(*adf::load_model(compat::model("puzzles/puzzle1.yaml")).model, world_of_the_original()) {
    session_.log.allow("");  // what is said of old files is judged elsewhere (tests/runtime/compat_run_test.cpp)
    session_.run(1.0);       // the puzzle falls to the floor
    for (const double side : kSides) {
      for (const double end : {-1.0, 1.0}) {
        // Nobody aims at the same place twice.
        join({side, end * kHandle + random_.uniform(-kAim, kAim), random_.uniform(0.0, 0.5 * kAim)}, side > 0.0);
      }
    }
    session_.before_cycle = [this] {
      now_s_ += Session::kStep_s;
      for (const auto& each : operators_) each->step(now_s_);
    };
  }

  LiftResult run() {
    LiftResult result;
    result.problem = carry();
    result.seconds = now_s_;
    for (const auto& each : operators_) result.max_force_N = std::max(result.max_force_N, each->force_N);
    result.limit_N = kMaxForce_N;
    const Vec3 off = puzzle().position - goal_;
    result.off_m = std::hypot(off.x, off.y);
    return result;
  }

 private:
  static constexpr double kMaxForce_N = 5.0;

  // With a gripper above this side of a handle.
  void join(const Vec3& side, bool haptic) {
    scene::InputDevice device;
    device.multibody_file = compat::model("grippers/pr2 gripper.yaml");
    device.haptic_linear.p = haptic ? Vec3{10.0, 10.0, 10.0} : Vec3{};  // as in the original's device file
    device.haptic_angular.p = Vec3{};
    device.workspace_scaling = 5.0;
    device.max_force_N = kMaxForce_N;
    device.ramp_s = 0.3;
    state::LoadRequest request;
    request.path = device.multibody_file;
    request.T_world_model = pose_at(side, kAbove) * inverse(Pose{{0.5, 0.0, -0.5}, {}});  // where the file has the palm
    const state::Outcome loaded = session_.simulation.load(request);
    EXPECT_TRUE(loaded.success) << loaded.message;
    session_.iterate();
    User& user = session_.join(device, haptic ? 1000.0 : 300.0, loaded.model);
    user.driver.traits_.gripper = true;
    user.driver.traits_.force = haptic;
    dvrk_arm::MtmJoints joints{0.0, 0.3, 0.1, 0.0, 0.4, 0.0, 0.2};
    for (double& each : joints) each += random_.uniform(-0.1, 0.1);
    operators_.push_back(std::make_unique<Operator>(session_, user, joints, random_.uniform(0.0, 6.0)));
    sides_.push_back(side);
  }
  const Pose& puzzle() const {
    const state::Structure& structure = *session_.frame.structure;
    const std::uint32_t object = state::find(structure, "/ambf/env/CenterPuzzle", state::ObjectKind::rigid_body);
    return session_.frame.bodies[structure.objects[object].slot].T_world_body;
  }
  // Of a palm whose pads are `above` the side of a handle that its operator grasps.
  Pose pose_at(const Vec3& side, double above) const {
    return {puzzle().position + side + Vec3{0.0, 0.0, kPads + above}, pointing_down()};
  }
  void move_all(double above, const Vec3& by, double jaw, double seconds) {
    for (std::size_t i = 0; i < operators_.size(); ++i) {
      Operator& each = *operators_[i];
      Pose to = above >= 0.0 ? pose_at(sides_[i], above) : each.wanted();
      to.position += by;
      each.aim(to, jaw, seconds);
    }
    session_.run(seconds + 0.5);
  }

  std::string carry() {
    session_.run_until_all_engaged();
    for (const auto& each : operators_) each->begin();
    const double floor = puzzle().position.z;
    move_all(kAbove, {}, 0.2, 0.5);  // the hands meet the jaws
    move_all(kAbove, {}, kOpen, 0.7);
    move_all(0.0, {}, kOpen, 1.5);
    const Vec3 start = puzzle().position;
    move_all(-1.0, {}, kClosed, 0.8);
    move_all(-1.0, {0.0, 0.0, kLifted}, kClosed, 3.0);
    if (puzzle().position.z < floor + 0.7 * kLifted) return "the puzzle was not lifted";
    move_all(-1.0, kAside, kClosed, 3.0);
    move_all(-1.0, {0.0, 0.0, -kLifted}, kClosed, 2.0);
    move_all(-1.0, {}, kOpen, 0.8);
    move_all(-1.0, {0.0, 0.0, kAbove}, kOpen, 1.5);
    goal_ = start + kAside;
    const Vec3 off = puzzle().position - goal_;
    if (std::hypot(off.x, off.y) > 0.05) return "the puzzle is not where it should be";
    if (std::abs(off.z) > 0.02) return "the puzzle does not lie on the floor";
    return {};
  }

  RandomMotion random_;
  Session session_;
  std::vector<std::unique_ptr<Operator>> operators_;
  std::vector<Vec3> sides_;  // of handles, that the operators grasp
  Vec3 goal_;
  double now_s_ = 0.0;
};

}  // namespace

LiftResult lift_puzzle(unsigned seed) { return Lift(seed).run(); }

}  // namespace ambf::devices::testing
