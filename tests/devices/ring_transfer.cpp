#include "tests/devices/ring_transfer.h"

#include <cmath>

#include "adf/adf.h"
#include "tests/devices/operator.h"

namespace ambf::devices::testing {
namespace {

using math::Pose;
using math::Vec3;

const std::string kModels = AMBF_SOURCE_DIR "/ambf_models/descriptions/";

// Of the scene (peg_transfer.yaml), m and rad.
constexpr double kTube = 0.0092;      // the tube's middle from the ring's, towards y
constexpr double kPinAbove = 0.0175;  // a gripper's pin from the tube, with the tips just above the board
constexpr double kBoardTop = 0.026, kRingOnBoard = 0.029, kAbovePegs = 0.075;
constexpr double kOpen = 0.35, kClosed = 0.0;  // of the jaws
constexpr double kLean = 0.14;                 // so that the two grippers' handles do not meet
constexpr Vec3 kUp{0, 0, 1};
constexpr Vec3 kRightPegs[] = {{-0.03, 0.031, 0}, {-0.03, 0.057, 0}, {0, 0.026, 0},
                               {0, 0.062, 0},     {0.03, 0.031, 0},  {0.03, 0.057, 0}};

math::Quat leaning(double angle) { return math::from_axis_angle({1, 0, 0}, angle); }

scene::World world_of_the_scene() {
  const adf::WorldResult file = adf::load_world(kModels + "world/peg_transfer_world.yaml");
  EXPECT_TRUE(file.world);
  scene::World world = *file.world;
  world.environment_file.clear();  // the bench is behind all that moves
  return world;
}

scene::InputDevice device(const std::string& side, const std::string& camera) {
  scene::InputDevice device;
  device.name = side;
  device.root_link = side + "_gripper";
  device.cameras = {camera};
  device.haptic_linear.p = Vec3{200.0, 200.0, 200.0};
  device.haptic_angular.p = Vec3{};
  device.max_force_N = 3.0;
  device.max_jerk_N_per_ms = 0.2;
  device.ramp_s = 0.3;
  return device;
}

class Transfer {
 public:
  explicit Transfer(unsigned seed)
      : random_(seed),
        session_(*adf::load_model(kModels + "multi-bodies/puzzles/peg_transfer.yaml").model, world_of_the_scene()),
        peg_(kRightPegs[seed % std::size(kRightPegs)]) {
    for (const auto& [side, camera] : {std::pair("left", "main_camera"), std::pair("right", "close_camera")}) {
      User& user = session_.join(device(side, camera));
      user.driver.traits_.gripper = true;
    }
    left_.emplace(session_, *session_.users[0], joints(), random_.uniform(0.0, 6.0));
    right_.emplace(session_, *session_.users[1], joints(), random_.uniform(0.0, 6.0));
    session_.before_cycle = [this] {
      now_s_ += Session::kStep_s;
      for (Operator* each : {&*left_, &*right_}) each->step(now_s_);
    };
    const auto structure = session_.simulation.structure();
    ring_ = structure->objects.at(state::find(*structure, "BODY ring3", state::ObjectKind::rigid_body)).slot;
  }

  TransferResult run() {
    TransferResult result;
    result.problem = carry();
    result.seconds = now_s_;
    for (const Operator* each : {&*left_, &*right_}) {
      result.max_force_N = std::max(result.max_force_N, each->force_N);
      result.max_torque_Nm = std::max(result.max_torque_Nm, each->torque_Nm);
    }
    result.limit_N = session_.users[0]->file.max_force_N;
    const Vec3 off = ring().position - peg_;
    result.off_peg_m = std::hypot(off.x, off.y);
    return result;
  }

 private:
  dvrk_arm::MtmJoints joints() {
    dvrk_arm::MtmJoints q{0.0, 0.3, 0.1, 0.0, 0.4, 0.0, 0.2};
    for (double& each : q) each += random_.uniform(-0.1, 0.1);
    return q;
  }
  const Pose& ring() const { return session_.frame.bodies[ring_].T_world_body; }
  void wait(double seconds) { session_.run(seconds); }
  // Until the tool is seen to be there.
  void move(Operator& who, const Pose& to, double jaw, double seconds) {
    who.aim(to, jaw, seconds);
    wait(seconds + 0.4);
  }
  // A gripper's pose with its jaws about the tube on this side of the ring, `above` it along the gripper.
  Pose at_tube(double side, const math::Quat& orientation, double above) const {
    const Vec3 normal = rotate(ring().orientation, kUp);
    const Vec3 y{0.0, side, 0.0};
    const Vec3 out = math::normalized(y - normal * dot(normal, y));
    return {ring().position + out * kTube + rotate(orientation, kUp) * (kPinAbove + above), orientation};
  }

  std::string carry() {
    session_.run_until_all_engaged();
    left_->begin();
    right_->begin();
    wait(0.5);
    // Pick.
    const math::Quat upright = left_->tool().orientation;
    move(*left_, at_tube(-1.0, upright, 0.035), kOpen, 1.5);
    move(*left_, at_tube(-1.0, upright, 0.0), kOpen, 1.5);
    if (norm(ring().position - Vec3{0.0, -0.058, kRingOnBoard}) > 2e-3) return "the ring was pushed on the way to it";
    move(*left_, left_->tool(), kClosed, 0.5);
    Pose to = left_->tool();
    to.position.z += kAbovePegs - kBoardTop;
    move(*left_, to, kClosed, 1.5);
    if (ring().position.z < kAbovePegs - 5e-3) return "the ring was not lifted";
    // Hand over.
    to.position += Vec3{0.0, 0.0, kAbovePegs + 0.02} - ring().position;
    to.orientation = leaning(kLean) * upright;
    move(*left_, to, kClosed, 1.5);
    const math::Quat towards = leaning(-kLean) * upright;
    move(*right_, at_tube(1.0, towards, 0.03), kOpen, 1.5);
    move(*right_, at_tube(1.0, towards, 0.0), kOpen, 1.2);
    move(*right_, right_->tool(), kClosed, 0.5);
    move(*left_, left_->tool(), kOpen, 0.5);
    to = left_->tool();
    to.position += rotate(to.orientation, kUp) * 0.04;
    move(*left_, to, kOpen, 1.0);
    if (norm(ring().position - right_->tool().position) > 0.03) return "the ring fell when it was handed over";
    // Place: level, over the peg, down, open.
    to = right_->tool();
    to.orientation = math::rotation_between(rotate(ring().orientation, kUp), kUp) * to.orientation;
    move(*right_, to, kClosed, 1.0);
    to.position = right_->tool().position + Vec3{peg_.x, peg_.y, ring().position.z} - ring().position;
    move(*right_, to, kClosed, 1.8);
    to.position = right_->tool().position + Vec3{peg_.x, peg_.y, kRingOnBoard + 2e-3} - ring().position;
    move(*right_, to, kClosed, 1.5);
    move(*right_, right_->tool(), kOpen, 0.5);
    to = right_->tool();
    to.position += rotate(to.orientation, kUp) * 0.04;
    move(*right_, to, kOpen, 1.0);
    const Vec3 off = ring().position - Vec3{peg_.x, peg_.y, kRingOnBoard};
    if (std::hypot(off.x, off.y) > 6e-3) return "the ring is not on its peg";
    if (std::abs(off.z) > 2e-3) return "the ring does not lie on the board";
    return {};
  }

  RandomMotion random_;
  Session session_;
  const Vec3 peg_;
  std::optional<Operator> left_, right_;
  std::uint32_t ring_ = 0;
  double now_s_ = 0.0;
};

}  // namespace

TransferResult transfer_ring(unsigned seed) { return Transfer(seed).run(); }

}  // namespace ambf::devices::testing
