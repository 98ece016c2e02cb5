// Two users on one tool, in lockstep with the real physics: whatever becomes of one of them (clutch, camera clutch, a
// camera turned by somebody else, loss, dominance), the other one's work goes on without a jolt, and has all of the
// motion. Three devices as stiff as a step can bear are stable with hands that give way.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "adf/adf.h"
#include "tests/devices/session_rig.h"

namespace ambf::devices::testing {
namespace {

using math::Vec3;
using state::DeviceParameter;

constexpr double kMaxJolt_m = 1e-4;
constexpr double kSpeed = 0.013;  // of the hands, m/s at most

// What becomes of the second user for a while; `in_force` is called in each cycle of it, with 0 .. 1.
struct Event {
  const char* name;
  bool ends_pull;     // the second user moves nothing meanwhile
  double camera_rad;  // how far its camera is turned, at least
  double unknown_s;   // until then the second user's reference stays where it is, and so does half of the pull
  std::function<void(Session&, User&)> begin;
  std::function<void(Session&, User&, double way)> in_force;
  std::function<void(Session&, User&)> end;
};

void nothing(Session&, User&) {}
void nothing_meanwhile(Session&, User&, double) {}

void clutch(User& user, bool down) { user.press(user.file.buttons.clutch, down); }
void camera_clutch(User& user, bool down) { user.press(user.file.buttons.camera_clutch, down); }

// 0.5, 0, 1, 0, 0.5: as the hub sets a pair.
void set_dominance(Session& session, double of_second) {
  session.users[0]->inbox.settings.try_push({DeviceParameter::dominance, {1.0 - of_second, 0.0, 0.0}});
  session.users[1]->inbox.settings.try_push({DeviceParameter::dominance, {of_second, 0.0, 0.0}});
}

// Somebody else, through ROS, turns the user's camera by up to 1.5 rad about the vertical, and back.
void turn_camera(Session& session, User& user, double way) {
  const double step = std::numbers::pi * std::sin(2.0 * std::numbers::pi * way) * Session::kStep_s;
  const math::Pose now = session.camera(user);
  const math::Pose turned{now.position, math::normalized(math::from_axis_angle({0, 0, 1}, step) * now.orientation)};
  user.ros_camera->post(state::PoseCommand{true, turned});
}

const Event kEvents[] = {
    {"Clutch", true, 0.0, 0.0, [](Session&, User& user) { clutch(user, true); }, nothing_meanwhile,
     [](Session&, User& user) { clutch(user, false); }},
    {"CameraClutch", true, 0.3, 0.0, [](Session&, User& user) { camera_clutch(user, true); },
     [](Session&, User& user, double) {  // the hand moves and turns the camera
       user.hand().position += Vec3{1e-5, 2e-5, 0.0};
       user.hand().orientation = math::normalized(math::exp({1e-4, 0.0, 3e-4}) * user.hand().orientation);
     },
     [](Session&, User& user) { camera_clutch(user, false); }},
    {"TurnedCamera", false, 1.4, 0.0, nothing, turn_camera, nothing},
    {"Loss", true, 0.0, 0.0, [](Session&, User& user) { user.driver.reading = Reading::lost; },
     [](Session&, User& user, double way) {
       if (way > 0.5) user.hand() = {{0.3, -0.2, 0.1}, math::from_axis_angle({0.6, 0.0, 0.8}, 1.0)};
     },
     [](Session&, User& user) { Session::plug_in(user); }},
    {"Silence", true, 0.0, 0.032, [](Session&, User& user) { user.driver.reading = Reading::nothing_new; },
     nothing_meanwhile, [](Session&, User& user) { user.driver.reading = Reading::sample; }},
    {"Absence", true, 0.0, 0.0, [](Session&, User& user) { user.driver.next.ready = false; }, nothing_meanwhile,
     [](Session&, User& user) { user.driver.next.ready = true; }},
    {"Dominance", false, 0.0, 0.0, [](Session& session, User&) { set_dominance(session, 0.0); },
     [](Session& session, User&, double way) {
       if (std::abs(way - 0.3) < 1e-3) set_dominance(session, 1.0);
       if (std::abs(way - 0.8) < 1e-3) set_dominance(session, 0.0);
     },
     [](Session& session, User&) { set_dominance(session, 0.5); }},
};

constexpr int kEvent = 1500;  // cycles

class PartnerTest : public ::testing::TestWithParam<Event> {
 protected:
  static std::unique_ptr<Session> two_users(const scene::Model& model) {
    auto session = std::make_unique<Session>(model);
    const auto file =
        adf::load_input_devices(AMBF_SOURCE_DIR "/ambf_models/descriptions/input_devices/input_devices_siso.yaml");
    EXPECT_TRUE(file.devices);
    for (scene::InputDevice device : file.devices->devices) {
      device.ramp_s = 0.05;
      session->join(device);
    }
    session->run_until_all_engaged();
    session->run(0.1);
    return session;
  }
};

class AbsentPartnerTest : public PartnerTest {};

// Both hands go the same way, slowly; the tool goes it whatever becomes of one of them.
TEST_P(PartnerTest, GivesTheToolNoJolt) {
  const auto trace = [&](bool happens) {
    const auto session = two_users(shared_tool_scene());
    User& second = *session->users[1];
    const math::Quat camera = session->camera(second).orientation;
    double camera_turned = 0.0;
    std::vector<math::Pose> poses;
    for (int cycle = -300; cycle < kEvent + 1500; ++cycle) {
      if (happens && cycle == 0) GetParam().begin(*session, second);
      if (happens && cycle == kEvent) GetParam().end(*session, second);
      const bool in_force = happens && cycle >= 0 && cycle < kEvent;
      if (in_force) GetParam().in_force(*session, second, static_cast<double>(cycle) / kEvent);
      const double angle = 2.0 * Session::kStep_s * cycle;
      const Vec3 way = Vec3{1.0, -0.5, 0.7} * (0.005 * 2.0 * Session::kStep_s * std::cos(angle));
      const Vec3 turn = Vec3{0.3, 1.0, -0.4} * (0.05 * 2.0 * Session::kStep_s * std::cos(angle));
      for (const auto& user : session->users)
        if (user->status().connected) session->displace(*user, way, turn);
      session->iterate();
      EXPECT_TRUE(!in_force || cycle < 60 || !GetParam().ends_pull || !second.status().engaged);
      poses.push_back(session->tool(second));
      camera_turned = std::max(camera_turned, angle_between(camera, session->camera(second).orientation));
    }
    EXPECT_TRUE(!happens || camera_turned >= GetParam().camera_rad) << camera_turned;
    EXPECT_TRUE(second.status().engaged) << "it works again in the end";
    return poses;
  };
  const std::vector<math::Pose> calm = trace(false), troubled = trace(true);
  double apart = 0.0, turned = 0.0, step = 0.0;
  for (std::size_t i = 1; i < calm.size(); ++i) {
    apart = std::max(apart, norm(troubled[i].position - calm[i].position));
    turned = std::max(turned, angle_between(troubled[i].orientation, calm[i].orientation));
    const Vec3 moves = troubled[i].position - troubled[i - 1].position;
    step = std::max(step, norm(moves - (calm[i].position - calm[i - 1].position)));
  }
  std::printf("%s: the tool is up to %.4f mm and %.5f rad beside its way, in a step %.5f mm\n", GetParam().name,
              1e3 * apart, turned, 1e3 * step);
  EXPECT_LT(apart, kMaxJolt_m + 0.5 * kSpeed * GetParam().unknown_s);
  EXPECT_LT(turned, 2e-3);
  EXPECT_LT(step, 1e-5);
}

TEST_P(AbsentPartnerTest, LeavesTheOtherOneAllOfTheMotion) {
  const auto session = two_users(shared_tool_scene());
  User &first = *session->users[0], &second = *session->users[1];
  const Vec3 start = session->tool(first).position, way{0.06, 0.0, -0.08};  // 10 cm
  GetParam().begin(*session, second);
  session->run(0.05);
  for (int i = 0; i < 1000; ++i) {
    session->displace(first, way * 1e-3);
    session->iterate();
  }
  session->run(0.4);
  EXPECT_LT(norm(session->tool(first).position - start - way), 5e-4);
  EXPECT_GT(norm(session->tool(first).position - start), 0.0995);
  const Vec3 brought = session->tool(first).position;
  GetParam().end(*session, second);
  double jolt = 0.0;
  for (int i = 0; i < 600; ++i) {
    session->iterate();
    jolt = std::max(jolt, norm(session->tool(first).position - brought));
  }
  EXPECT_TRUE(second.status().engaged);
  EXPECT_LT(jolt, kMaxJolt_m);
}

// Both press the tool into a wall.
TEST_P(PartnerTest, LeavesTheOtherOneTheWall) {
  scene::Model model = shared_tool_scene();
  model.bodies.push_back(wall_beside("wall", {0, 1, 0}, 1e-3));
  const auto session = two_users(model);
  User &first = *session->users[0], &second = *session->users[1];
  for (int i = 0; i < 200; ++i) {
    for (User* user : {&first, &second}) session->displace(*user, {0.0, 5e-5, 0.0});
    session->iterate();
  }
  session->run(0.3);
  const Vec3 pressed = session->tool(first).position;
  const double force = first.felt_world().force.y;
  ASSERT_LT(force, -1.5) << "10 mm, 1 mm of it to the wall, 200 N/m";
  double jolt = 0.0, jerk = 0.0, change = 0.0, last = norm(second.driver.written.force);
  for (int cycle = 0; cycle < kEvent + 600; ++cycle) {
    if (cycle == 0) GetParam().begin(*session, second);
    if (cycle == kEvent) GetParam().end(*session, second);
    if (cycle < kEvent) GetParam().in_force(*session, second, static_cast<double>(cycle) / kEvent);
    session->iterate();
    jolt = std::max(jolt, std::abs(session->tool(first).position.y - pressed.y));
    change = std::max(change, std::abs(first.felt_world().force.y - force));
    // A fault ends the force linearly within 30 ms; all else is bounded by the device's max jerk.
    const double now = norm(second.status().wrench_u_written.force);
    jerk = std::max(jerk, now - last);
    last = now;
  }
  EXPECT_LT(jolt, kMaxJolt_m);
  EXPECT_LT(change, 0.02 * std::abs(force)) << "what the first user feels of the wall";
  EXPECT_LE(jerk, second.file.max_jerk_N_per_ms + 1e-9) << "the second user's force comes back by a ramp";
}

std::vector<Event> events_that_end_the_pull() {
  std::vector<Event> ends;
  for (const Event& event : kEvents)
    if (event.ends_pull) ends.push_back(event);
  return ends;
}

INSTANTIATE_TEST_SUITE_P(Whatever, PartnerTest, ::testing::ValuesIn(kEvents),
                         [](const auto& parameter) { return parameter.param.name; });

INSTANTIATE_TEST_SUITE_P(Whatever, AbsentPartnerTest, ::testing::ValuesIn(events_that_end_the_pull()),
                         [](const auto& parameter) { return parameter.param.name; });

// A hand of 0.4 kg, which its owner pulls to a place like a spring: it gives way to what it feels.
struct GivingHand {
  static constexpr double kMass_kg = 0.4, kArm_N_m = 300.0, kArm_Ns_m = 8.0;
  Vec3 goal_u, velocity;

  void step(User& user) {
    const Vec3 arm = (goal_u - user.hand().position) * kArm_N_m - velocity * kArm_Ns_m;
    velocity += (arm + user.driver.written.force) * (Session::kStep_s / kMass_kg);
    user.hand().position += velocity * Session::kStep_s;
  }
};

TEST(Sharing, ThreeDevicesAtTheBoundOfTheirGainsAreStableWithHandsThatGiveWay) {
  Session session(shared_tool_scene());
  session.log.expect_warning("the gains of its input devices and controllers add up to more");
  // What one device alone may have on 0.1 kg (docs/effectors.md): m / (4 h^2) and m / (2 h).
  constexpr double kMass = 0.1, kInertia = kMass * kToolSide_m * kToolSide_m / 6.0, kStep = Session::kStep_s;
  const auto gains = [](double mass) {
    const double k = mass / (4.0 * kStep * kStep), b = mass / (2.0 * kStep);
    scene::DeviceGains out;
    out.p = Vec3{k, k, k};
    out.d = Vec3{b, b, b};
    return out;
  };
  scene::InputDevice device;
  device.root_link = "right_gripper";
  device.controller_linear = gains(kMass);
  device.controller_angular = gains(kInertia);
  device.haptic_linear.p = Vec3{400.0, 400.0, 400.0};
  device.ramp_s = 0.05;
  for (const char* camera : {"main_camera", "close_camera", "main_camera"}) {
    device.cameras = {camera};
    session.join(device);
  }
  session.run_until_all_engaged();
  std::vector<GivingHand> hands(3);
  const Vec3 goals_world[] = {{0.03, 0.0, 0.0}, {0.0, -0.03, 0.03}, {0.0, 0.0, -0.06}};
  for (std::size_t i = 0; i < 3; ++i) {
    User& user = *session.users[i];
    hands[i].goal_u = user.hand().position + rotate(inverse(session.camera(user).orientation), goals_world[i]);
  }
  double early = 0.0, late = 0.0;
  const Vec3 start = session.tool(*session.users[0]).position;
  for (int i = 0; i < 3000; ++i) {
    for (std::size_t k = 0; k < 3; ++k) hands[k].step(*session.users[k]);
    session.iterate();
    if (i < 500) early = std::max(early, session.tool_speed(*session.users[0]));
    if (i >= 2500) late = std::max(late, session.tool_speed(*session.users[0]));
  }
  ASSERT_NE(session.effector(*session.users[0]), nullptr);
  EXPECT_TRUE(session.effector(*session.users[0])->bounded);
  EXPECT_GT(early, 0.05);
  EXPECT_LT(late, 1e-3) << "all is at rest";
  // The mean of the three references, each as far as its hand still is from its goal.
  Vec3 mean;
  for (const auto& user : session.users) mean += session.effector(*user)->T_world_ref.position / 3.0;
  EXPECT_LT(norm(session.tool(*session.users[0]).position - mean), 1e-5);
  EXPECT_GT(norm(session.tool(*session.users[0]).position - start), 0.005);
}

}  // namespace
}  // namespace ambf::devices::testing
