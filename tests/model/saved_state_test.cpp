// State files are what anybody may have written: whatever is in them, a world that restores one either is as it was or
// is sane.
#include <gtest/gtest.h>

#include <bit>
#include <cstring>
#include <limits>

#include "base/hash.h"
#include "model/kinds/placed.h"
#include "model/saved_state.h"
#include "rig.h"
#include "tests/support/slowness.h"
#include "tests/support/views.h"

namespace ambf::model::test {
namespace {

using Bytes = std::vector<std::uint8_t>;

// A bit of everything that a state holds: joints under all kinds of command, a push, a sleeper's table, a camera and a
// light.
scene::Model small_world() {
  scene::Model all = chain(3);
  all.bodies.push_back(box("loose", 1.0, {3, 0, 0}));
  all.cameras.push_back(test_camera({1, 0, 0}, "BODY link0"));
  all.lights.push_back(test_light({0, 0, 3}));
  return all;
}

struct World : Rig {
  World() : Rig({0, 0, -9.8}) {
    load(small_world());
    const std::uint32_t joint = object("j1", state::ObjectKind::joint);
    live->set_parameter(live->structure()->objects[joint].id, state::Parameter::joint_p, {30, 30, 30});
    live->set_parameter(id("loose"), state::Parameter::friction, {kFriction, kFriction, kFriction});
    base = port("link0"), pusher = port("loose"), mover = port("loose", state::Source::panel);
    look = port("eye", state::Source::ros, state::ObjectKind::camera);
    base->post(joints({to_position(0.3), to_velocity(0.1)}));
    pusher->post(force({1, 2, 3}));
    mover->post(pose({{3, 0, 1}, {}}));
    state::PoseCommand view;
    view.enabled = true;
    view.T_parent_object.position = {0, 5, 0};
    look->post(view);
    live->push(id("loose"), {{0, 0, 4}, {}, {}, 10.0});
    device = live->effector_table().hold(*live->structure(), id("link2"), state::Source::device_0);
    hold_at({0.3, 0, 0.1}, 47);
    hold_at({0.3, 0, 0.2}, 3);  // on its way
  }
  void hold_at(const math::Vec3& position, int steps) {
    state::SetPoint set_point;
    set_point.T_world_ref.position = position;
    set_point.gains.linear_stiffness = {kGain, 0, 20};
    set_point.period_s = 0.01;
    set_point.pulls = set_point.engaged = true;
    device->post(set_point);
    live->take_effectors(watchdog_s, 1);
    step(steps);
  }

  static constexpr double kFriction = 0.6180339, kGain = 7.1234567;  // like no other numbers in the state
  std::unique_ptr<state::CommandPort> base, pusher, mover, look;
  std::unique_ptr<state::EffectorPort> device;
};

// As a forger would.
void sign(Bytes& bytes) {
  base::Fnv1a hash;
  hash.add_bytes(bytes.data(), bytes.size() - 8);
  const std::uint64_t checksum = hash.value();
  std::memcpy(bytes.data() + bytes.size() - 8, &checksum, 8);
}

std::size_t place_of(const Bytes& bytes, double value) {
  const auto wanted = std::bit_cast<std::array<std::uint8_t, 8>>(value);
  return static_cast<std::size_t>(std::search(bytes.begin(), bytes.end(), wanted.begin(), wanted.end()) -
                                  bytes.begin());
}

template <class T>
Bytes with(Bytes bytes, std::size_t at, const T& value) {
  std::memcpy(bytes.data() + at, &value, std::min(sizeof value, bytes.size() - 8 - at));
  sign(bytes);
  return bytes;
}

// Empty, or what is wrong.
std::string insane(const Rig& rig) {
  const state::Frame& frame = *rig.frame;
  for (const state::BodyState& body : frame.bodies) {
    if (!math::is_finite(body.T_world_body) || !math::is_finite(body.twist_world)) return "a body is not finite";
    if (math::norm(body.twist_world.linear) > 1e4 || math::norm(body.twist_world.angular) > 1e4) return "too fast";
    if (std::abs(math::norm(body.T_world_body.orientation) - 1.0) > 1e-3) return "no rotation";
    if (!math::is_finite(body.wrench_body)) return "a reaction is not finite";
  }
  for (const state::JointState& joint : frame.joints) {
    if (!std::isfinite(joint.position) || !std::isfinite(joint.velocity) || !std::isfinite(joint.effort))
      return "joint";
    if (!(std::abs(joint.commanded) <= 1e9)) return "a joint's command is out of range";
    if (joint.commanded_type < state::JointCommandType::none ||
        joint.commanded_type > state::JointCommandType::velocity)
      return "a joint's command is of no type";
  }
  for (int i = 0; i < state::kParameterCount; ++i) {
    const auto parameter = static_cast<state::Parameter>(i);
    const auto bad = [&](const auto& values) {
      return std::any_of(values.begin(), values.end(),
                         [&](const auto& each) { return !state::check(parameter, value_of(each, parameter)).empty(); });
    };
    const bool of_body = state::info_of(parameter).kind == state::ObjectKind::rigid_body;
    if (of_body ? bad(frame.body_parameters) : bad(frame.joint_parameters)) return state::info_of(parameter).name;
  }
  for (const state::CameraState& camera : frame.cameras)
    if (!math::is_finite(camera.T_world_camera) || !state::check(camera.lens).empty()) return "camera";
  for (const state::LightState& light : frame.lights)
    if (!math::is_finite(light.T_world_light) || !state::check(light.beam).empty()) return "light";
  if (!(frame.sim_time >= 0.0) || !math::is_finite(frame.gravity_world)) return "time or gravity";
  return {};
}

void look_at(Rig& rig) {
  rig.live->fill(*rig.frame);
  rig.live->fill_parameters(*rig.frame);
}

// Tries one forged state; the world is the good one's before and after.
class Tried {
 public:
  Tried(World& world, const Bytes& good) : world_(world), good_(good) {
    restore_good();
    hash_ = state::state_hash(*world_.frame);
  }
  void operator()(const Bytes& forged, const std::string& what) {
    const std::string error = world_.live->restore(forged);
    look_at(world_);
    ASSERT_EQ(insane(world_), "") << what;
    if (!error.empty()) {
      ++refused;
      ASSERT_EQ(state::state_hash(*world_.frame), hash_) << what << ": refused, but not without a trace";
      return;
    }
    ++taken;
    // Now or ever: what the values make of the world is either sane or caught as divergence.
    for (int i = 0; i < 2 && world_.live->diverged_body() == state::kNone; ++i) {
      world_.step();
      look_at(world_);
    }
    if (world_.live->diverged_body() == state::kNone) {
      ASSERT_EQ(insane(world_), "") << what << ", after steps";
    }
    restore_good();
  }
  int refused = 0, taken = 0;

 private:
  void restore_good() {
    ASSERT_EQ(world_.live->restore(good_), "");
    look_at(world_);
  }
  World& world_;
  const Bytes& good_;
  std::uint64_t hash_ = 0;
};

TEST(SavedState, NoByteOfASignedFileIsTrusted) {
  World world;
  const Bytes good = world.live->save();
  Tried try_out(world, good);
  // Under a sanitizer one byte in five, by which all eight bytes of numbers come up.
  constexpr int kEvery = kTestSlowness > 1 ? 5 : 1;
  for (std::size_t at = 0; at + 8 < good.size(); at += kEvery) {
    for (const unsigned flip : {0x01u, 0x40u, 0x80u, 0xffu}) {
      Bytes forged = good;
      forged[at] = static_cast<std::uint8_t>(forged[at] ^ flip);
      sign(forged);
      ASSERT_NO_FATAL_FAILURE(try_out(forged, "byte " + std::to_string(at) + " ^ " + std::to_string(flip)));
    }
  }
  EXPECT_GT(try_out.refused, static_cast<int>(good.size()) / 2 / kEvery);
  EXPECT_GT(try_out.taken, 100 / kEvery);  // low bits of numbers: another state, but a sane one
}

TEST(SavedState, NoNumberOfASignedFileIsTrusted) {
  World world;
  const Bytes good = world.live->save();
  Tried try_out(world, good);
  for (std::size_t at = 0; at + 16 <= good.size(); ++at) {
    for (const double value : {std::nan(""), std::numeric_limits<double>::infinity(), -1.0, 1e7, 1e300, -1e13, 0.5})
      ASSERT_NO_FATAL_FAILURE(
          try_out(with(good, at, value), "byte " + std::to_string(at) + " = " + std::to_string(value)));
  }
}

TEST(SavedState, OfEveryLengthButItsOwnIsRefused) {
  World world;
  const Bytes good = world.live->save();
  const std::uint64_t before = state::state_hash(*world.frame);
  for (std::size_t size = 0; size < good.size(); ++size) {
    Bytes cut(good.begin(), good.begin() + static_cast<std::ptrdiff_t>(size));
    if (size >= 8) sign(cut);
    ASSERT_NE(world.live->restore(cut), "") << size;
  }
  Bytes longer = good;
  longer.insert(longer.end() - 8, 5, 0);
  sign(longer);
  EXPECT_NE(world.live->restore(longer).find("5 bytes too many"), std::string::npos);
  look_at(world);
  EXPECT_EQ(state::state_hash(*world.frame), before);
}

TEST(SavedState, ARefusalSaysWhatWasExpectedWhere) {
  World world;
  const Bytes good = world.live->save();
  const auto error = [&](std::size_t at, double value) { return world.live->restore(with(good, at, value)); };
  const std::size_t friction = place_of(good, World::kFriction);
  ASSERT_LT(friction, good.size());
  const std::string expected =
      "'/test/loose': friction must lie between 0 and 1e+06 (at byte " + std::to_string(friction) + ")";
  EXPECT_NE(error(friction, std::nan("")).find(expected), std::string::npos) << error(friction, std::nan(""));
  EXPECT_NE(error(friction, -0.1).find(expected), std::string::npos);
  EXPECT_EQ(error(friction, 0.7), "");
  // Physics' part, which has its own checks: link1's position.
  const std::size_t gain = place_of(good, World::kGain);
  EXPECT_NE(world.live->restore(with(good, gain, -1.0)).find("a device's gain must not be negative"),
            std::string::npos);
  const std::size_t x = place_of(good, world.body("link1").T_world_body.position.x);
  ASSERT_LT(x, good.size());
  EXPECT_NE(error(x, 1e300).find("'/test/link1': its position must be finite"), std::string::npos) << error(x, 1e300);
}

TEST(SavedState, KeepsLensesBeamsAndParents) {
  World world;
  const state::ObjectId eye = world.id("eye", state::ObjectKind::camera);
  const state::ObjectId lamp = world.id("lamp", state::ObjectKind::light);
  ASSERT_TRUE(world.apply(world.catalogue.prepare_set_parent(lamp, "BODY loose")).success);
  ASSERT_TRUE(world.apply(world.catalogue.prepare_set_parent(eye, "")).success);
  state::Lens lens;
  lens.field_of_view_rad = 1.25;
  lens.optics = {1.2, 0.1, -0.05, 0.04};
  world.live->set_lens(eye, lens);
  state::Beam beam;
  beam.type = state::LightType::directional;
  world.live->set_beam(lamp, beam);
  look_at(world);
  const Bytes saved = world.live->save();
  const math::Pose T_world_eye = world.frame->cameras[0].T_world_camera;
  const math::Pose T_world_lamp = world.frame->lights[0].T_world_light;

  World fresh;  // where both hang as their file says
  SavedState state;
  ASSERT_EQ(decode(saved, *fresh.live->structure(), kStep_s, state), "");
  EXPECT_NE(fresh.live->restore(saved), "");  // not without the change of parents
  const auto changes = parent_changes(state, *fresh.live->structure());
  ASSERT_EQ(changes.size(), 2u);
  ASSERT_TRUE(fresh.apply(fresh.catalogue.prepare_parents(changes)).success);
  fresh.live->restore(state);
  look_at(fresh);
  const state::Structure& structure = *fresh.live->structure();
  EXPECT_EQ(structure.cameras[0].parent_object, state::kNone);
  EXPECT_EQ(structure.lights[0].parent_object, fresh.object("loose"));
  EXPECT_EQ(fresh.frame->cameras[0].T_world_camera, T_world_eye);
  EXPECT_EQ(fresh.frame->lights[0].T_world_light, T_world_lamp);
  EXPECT_EQ(fresh.frame->cameras[0].lens, lens);
  EXPECT_EQ(fresh.frame->lights[0].beam.type, state::LightType::directional);

  ASSERT_TRUE(fresh.apply(fresh.catalogue.prepare_parents_as_loaded()).success);
  fresh.live->reset();
  look_at(fresh);
  EXPECT_EQ(fresh.live->structure()->cameras[0].parent_name, "BODY link0");
  EXPECT_EQ(fresh.live->structure()->lights[0].parent_object, state::kNone);
  EXPECT_NEAR(fresh.frame->cameras[0].T_parent_camera.position.x, 1.0, 1e-12);
  EXPECT_NEAR(fresh.frame->lights[0].T_world_light.position.z, 3.0, 1e-12);
  EXPECT_FALSE(fresh.catalogue.prepare_parents_as_loaded().success);  // nothing left to do
}

TEST(SavedState, CirclesOfParentsAreRefused) {
  Rig rig;
  scene::Model all = small_world();
  all.cameras[0].parent = "LIGHT lamp";
  rig.load(all);
  SavedState state;
  const Bytes saved = rig.live->save();
  ASSERT_EQ(decode(saved, *rig.live->structure(), kStep_s, state), "");
  const auto lamp = [&]() -> SavedPlaced& {
    return static_cast<SavedPlaced&>(*state.objects[static_cast<std::size_t>(state::ObjectKind::light)][0]);
  };
  lamp().parent_object = rig.object("eye", state::ObjectKind::camera);
  const Bytes forged = encode(state, *rig.live->structure());
  EXPECT_NE(decode(forged, *rig.live->structure(), kStep_s, state).find("hang on itself"), std::string::npos);
  lamp().parent_object = rig.object("j1", state::ObjectKind::joint);
  const Bytes on_joint = encode(state, *rig.live->structure());
  EXPECT_NE(decode(on_joint, *rig.live->structure(), kStep_s, state).find("joint"), std::string::npos);
}

}  // namespace
}  // namespace ambf::model::test
