#include "model/saved_state.h"

#include <cmath>
#include <span>

#include "base/hash.h"
#include "model/detail/state_bytes.h"
#include "physics/world.h"

namespace ambf::model {
namespace {

using state::CartesianCommandType;
using state::JointCommandType;
using state::ObjectKind;

constexpr std::uint64_t kMagic = 0x4554415453464d41;  // "AMFSTATE"
constexpr std::uint32_t kVersion = 3;
constexpr std::size_t kMaxEntries = 1u << 20;  // joints in one command
constexpr std::size_t kLongestName = 4096;
constexpr std::uint64_t kMostSteps = std::uint64_t{1} << 53;
constexpr std::uint64_t kLastOrder = std::uint64_t{1} << 62;  // of posts: none will ever wrap round
constexpr double kLargest = 1e12;                             // beyond what any world of ours does: damage
constexpr double kMostCommanded = 1e9;                        // as state::check() has it
constexpr double kFarthest = 1e12;                            // m

std::uint64_t fnv1a(const std::uint8_t* data, std::size_t size) {
  base::Fnv1a hash;
  hash.add_bytes(data, size);
  return hash.value();
}

// Which objects, of which kinds, in which order: a state fits no other structure.
std::uint64_t fingerprint(const state::Structure& structure) {
  base::Fnv1a hash;
  for (const state::ObjectInfo& object : structure.objects) {
    hash.add_byte(static_cast<unsigned char>(object.kind));
    hash.add_text(object.identifier);
    hash.add_byte(0);
  }
  return hash.value();
}

// ---- One function a struct: what is written, read, and must hold.

template <class Archive, class Parameters>
void transfer(Archive& archive, Parameters& parameters, ObjectKind kind) {
  for (int i = 0; i < state::kParameterCount; ++i) {
    const auto parameter = static_cast<state::Parameter>(i);
    const state::ParameterInfo& info = state::info_of(parameter);
    if (info.kind != kind) continue;
    math::Vec3 value = value_of(parameters, parameter);
    archive.number(value.x, info.least, info.most, info.name);
    if (info.per_axis) archive.number(value.y, info.least, info.most, info.name);
    if (info.per_axis) archive.number(value.z, info.least, info.most, info.name);
    set_value(parameters, parameter, value);
  }
}

template <class Archive>
void transfer(Archive& archive, math::Pose& value) {
  pose(archive, value, kFarthest, "the controller's set-point");
}
template <class Archive>
void transfer(Archive& archive, math::Twist& value) {
  vector(archive, value.linear, kLargest, "the set-point's rate");
  vector(archive, value.angular, kLargest, "the set-point's rate");
}
template <class Archive>
void transfer(Archive& archive, double& value) {
  archive.number(value, -kLargest, kLargest, "the controller's set-point");
}

template <class Archive, class Value, class Rate>
void transfer(Archive& archive, ReferenceRate<Value, Rate>& reference) {
  transfer(archive, reference.last);
  transfer(archive, reference.rate);
  archive.number(reference.since_change_s, 0.0, reference.kLongAgo_s, "the set-point's age");
  archive.number(reference.hold_left_s, -kLargest, reference.kLongAgo_s, "the set-point's time to live");
  archive.flag(reference.running, "whether the set-point moves");
}

template <class Archive>
void transfer(Archive& archive, CartesianController::State& controller) {
  for (math::Vec3* part : {&controller.linear_integral, &controller.angular_integral, &controller.last_linear_error,
                           &controller.last_angular_error})
    vector(archive, *part, kLargest, "the controller's memory");
  archive.flag(controller.running, "whether the controller runs");
  transfer(archive, controller.reference);
}

template <class Archive>
void transfer(Archive& archive, JointController::State& controller) {
  archive.number(controller.integral, -kLargest, kLargest, "the controller's integral");
  archive.number(controller.last_error, -kLargest, kLargest, "the controller's last error");
  archive.flag(controller.running, "whether the controller runs");
  transfer(archive, controller.reference);
}

// Only what counts is kept; the rest may be anything.
template <class Archive>
void transfer(Archive& archive, state::RigidBodyCommand& command) {
  archive.choice(command.type, 0, static_cast<int>(CartesianCommandType::velocity), "the type of a command");
  switch (command.type) {
    case CartesianCommandType::none: break;
    case CartesianCommandType::force:
      vector(archive, command.wrench_world.force, kMostCommanded, "a commanded force");
      vector(archive, command.wrench_world.torque, kMostCommanded, "a commanded torque");
      break;
    case CartesianCommandType::position: pose(archive, command.T_world_body, 1e6, "a commanded pose"); break;
    case CartesianCommandType::velocity:
      vector(archive, command.twist_world.linear, 1e6, "a commanded velocity");
      vector(archive, command.twist_world.angular, 1e6, "a commanded velocity");
      break;
  }
  archive.size(command.joints, kMaxEntries, 1 + sizeof(double), "the number of commanded joints");
  for (state::JointCommand& joint : command.joints) {
    archive.choice(joint.type, static_cast<int>(JointCommandType::none), static_cast<int>(JointCommandType::velocity),
                   "the type of a joint's command");
    double value = joint.type == JointCommandType::none ? 0.0 : joint.value;
    archive.number(value, -kMostCommanded, kMostCommanded, "a joint's command");
    joint.value = value;
  }
}

template <class Archive>
void transfer(Archive& archive, state::PoseCommand& command) {
  archive.flag(command.enabled, "whether a pose is commanded");
  if (command.enabled) pose(archive, command.T_parent_object, 1e6, "a commanded pose");
}

template <class Archive>
void transfer(Archive& archive, std::vector<SavedCommand>& commands, bool of_body, std::uint64_t last_order) {
  archive.size(commands, state::kMaxSources, 1 + sizeof(double), "the number of sources");
  int last_source = -1;
  for (SavedCommand& saved : commands) {
    archive.choice(saved.source, 0, state::kMaxSources - 1, "the source of a command");
    archive.require(saved.source > last_source, "sources must come in their order, each once");
    last_source = saved.source;
    archive.count(saved.order, 1, last_order, "the order of a command");
    archive.number(saved.age_s, 0.0, kLargest, "the age of a command");
    if constexpr (Archive::kReads) {
      if (of_body) saved.command.emplace<state::RigidBodyCommand>();
      if (!of_body) saved.command.emplace<state::PoseCommand>();
    }
    std::visit([&](auto& command) { transfer(archive, command); }, saved.command);
  }
}

template <class Archive>
void transfer(Archive& archive, SavedBody& body, bool is_static, double step_s, std::uint64_t last_order) {
  transfer(archive, body.parameters, ObjectKind::rigid_body);
  const double longest = 1e5 / step_s;  // state::check(Push)
  archive.count(body.push_steps, 0, is_static ? 0 : static_cast<std::uint64_t>(longest), "what is left of a push");
  if (body.push_steps > 0) {
    vector(archive, body.push.force_world, kMostCommanded, "the force of a push");
    vector(archive, body.push.torque_world, kMostCommanded, "the torque of a push");
    vector(archive, body.push.point_body, 1e6, "the point of a push");
    archive.number(body.push.seconds, 0.0, 1e5, "the length of a push");
  }
  transfer(archive, body.controller);
  transfer(archive, body.commands, true, last_order);
}

template <class Archive>
void transfer(Archive& archive, SavedJoint& joint, std::uint64_t last_order) {
  transfer(archive, joint.parameters, ObjectKind::joint);
  transfer(archive, joint.controller);
  archive.choice(joint.type, static_cast<int>(JointCommandType::none), static_cast<int>(JointCommandType::velocity),
                 "the type of the joint's command");
  archive.number(joint.value, -kMostCommanded, kMostCommanded, "the joint's command");
  archive.count(joint.order, 0, last_order, "the order of the joint's command");
}

template <class Archive>
void transfer(Archive& archive, std::string& name) {
  archive.size(name, kLongestName, 1, "the length of the parent's name");
  archive.bytes(name.data(), name.size());
  bool plain = true;
  for (const char c : name) plain = plain && static_cast<unsigned char>(c) >= 0x20 && c != 0x7f;
  archive.require(plain, "the parent's name must be without control characters");
}

template <class Archive>
void transfer(Archive& archive, SavedPlaced& placed, ObjectKind kind, const state::Structure& structure,
              std::uint64_t last_order) {
  std::uint64_t parent = placed.parent_object == state::kNone ? structure.objects.size() : placed.parent_object;
  archive.count(parent, 0, structure.objects.size(), "the parent");  // the number of objects: the world
  placed.parent_object = parent == structure.objects.size() ? state::kNone : static_cast<std::uint32_t>(parent);
  archive.require(placed.parent_object == state::kNone || structure.objects[parent].kind != ObjectKind::joint,
                  "the parent must not be a joint");
  transfer(archive, placed.parent_name);
  pose(archive, placed.T_parent_initial, kFarthest, "its first place");
  pose(archive, placed.T_parent, kFarthest, "its place");
  archive.flag(placed.orphaned, "whether it lost its parent");
  if (kind == ObjectKind::camera) {
    state::Lens& lens = placed.lens;
    for (double* number : {&lens.near_m, &lens.far_m, &lens.field_of_view_rad, &lens.orthographic_width_m,
                           &lens.eye_separation_m, &lens.focal_length_m})
      archive.number(*number, -kLargest, kLargest, "the lens");
    archive.flag(lens.orthographic, "the projection");
    archive.flag(lens.stereo, "the mode");
    if constexpr (Archive::kReads) archive.require(state::check(lens).empty(), state::check(lens));
  } else {
    state::Beam& beam = placed.beam;
    archive.choice(beam.type, 0, static_cast<int>(state::LightType::directional), "the type of light");
    for (double* number : {&beam.cutoff_angle_rad, &beam.spot_exponent, &beam.attenuation_constant,
                           &beam.attenuation_linear, &beam.attenuation_quadratic})
      archive.number(*number, -kLargest, kLargest, "the beam");
    archive.choice(beam.shadow_quality, 0, 5, "the shadow quality");
    if constexpr (Archive::kReads) archive.require(state::check(beam).empty(), state::check(beam));
  }
  transfer(archive, placed.commands, false, last_order);
}

template <class Archive>
void transfer(Archive& archive, SavedState& saved, const state::Structure& structure, double step_s) {
  archive.size(saved.physics, std::size_t{1} << 40, 1, "the length of physics' part");
  archive.bytes(saved.physics.data(), saved.physics.size());
  archive.count(saved.steps, 0, kMostSteps, "the number of steps");
  archive.number(saved.sim_time, 0.0, kLargest, "the time");
  archive.require(
      !(std::abs(saved.sim_time - static_cast<double>(saved.steps) * step_s) > 1e-6 * (1.0 + saved.sim_time)),
      "the time must be that of its steps");
  archive.count(saved.last_order, 0, kLastOrder, "the number of commands");
  const auto name = [&](const auto& info) { archive.at("'" + structure.objects[info.object].name + "'"); };
  for (std::size_t i = 0; i < structure.bodies.size(); ++i) {
    name(structure.bodies[i]);
    transfer(archive, saved.bodies[i], structure.bodies[i].mass == 0.0, step_s, saved.last_order);
  }
  for (std::size_t i = 0; i < structure.joints.size(); ++i) {
    name(structure.joints[i]);
    transfer(archive, saved.joints[i], saved.last_order);
  }
  for (std::size_t i = 0; i < structure.cameras.size(); ++i) {
    name(structure.cameras[i]);
    transfer(archive, saved.cameras[i], ObjectKind::camera, structure, saved.last_order);
  }
  for (std::size_t i = 0; i < structure.lights.size(); ++i) {
    name(structure.lights[i]);
    transfer(archive, saved.lights[i], ObjectKind::light, structure, saved.last_order);
  }
  archive.at("");
}

// ---- What holds between several of them.

// Cameras and lights may hang on each other, but never in a circle.
std::string check_circles(const SavedState& saved, const state::Structure& structure) {
  const auto parent_of = [&](std::uint32_t object) {
    const state::ObjectInfo& info = structure.objects[object];
    if (info.kind == ObjectKind::camera) return saved.cameras[info.slot].parent_object;
    return info.kind == ObjectKind::light ? saved.lights[info.slot].parent_object : state::kNone;
  };
  for (std::uint32_t start = 0; start < structure.objects.size(); ++start) {
    std::size_t links = 0;
    for (std::uint32_t object = start; object != state::kNone; object = parent_of(object))
      if (++links > structure.objects.size())
        return "'" + structure.objects[start].name + "': what it hangs on must not hang on itself";
  }
  return {};
}

std::string check_physics(const SavedState& saved, const state::Structure& structure, double step_s) {
  physics::StateLayout layout{{}, structure.joints.size(), step_s};
  for (const state::BodyInfo& body : structure.bodies) layout.is_static.push_back(body.mass == 0.0);
  const auto fault = physics::World::check_state(saved.physics, layout);
  if (!fault) return {};
  if (fault->of == physics::StateFault::Of::whole) return fault->message;
  const std::uint32_t object = fault->of == physics::StateFault::Of::body ? structure.bodies[fault->index].object
                                                                          : structure.joints[fault->index].object;
  return "'" + structure.objects[object].name + "': " + fault->message;
}

struct Head {
  std::uint64_t magic = 0;
  std::uint32_t version = 0;
  std::uint32_t zero = 0;
  std::uint64_t fingerprint = 0;
};

}  // namespace

std::vector<ParentChange> parent_changes(const SavedState& state, const state::Structure& structure) {
  std::vector<ParentChange> changes;
  const auto compare = [&](const std::vector<SavedPlaced>& saved, const auto& infos) {
    for (std::size_t slot = 0; slot < infos.size(); ++slot) {
      const std::uint32_t parent = saved[slot].parent_object;
      if (parent == infos[slot].parent_object && saved[slot].parent_name == infos[slot].parent_name) continue;
      changes.push_back({structure.objects[infos[slot].object].id,
                         parent == state::kNone ? state::ObjectId{} : structure.objects[parent].id,
                         saved[slot].parent_name});
    }
  };
  compare(state.cameras, structure.cameras);
  compare(state.lights, structure.lights);
  return changes;
}

std::vector<std::uint8_t> encode(SavedState state, const state::Structure& structure) {
  std::vector<std::uint8_t> bytes;
  StateWriter out(bytes);
  Head head{kMagic, kVersion, 0, fingerprint(structure)};
  out.bytes(&head, sizeof head);
  transfer(out, state, structure, 1.0);
  std::uint64_t checksum = fnv1a(bytes.data(), bytes.size());
  out.bytes(&checksum, sizeof checksum);
  return bytes;
}

std::string decode(const std::vector<std::uint8_t>& bytes, const state::Structure& structure, double step_s,
                   SavedState& out) {
  std::uint64_t checksum = 0;
  Head head;
  if (bytes.size() < sizeof head + sizeof checksum) return "not a saved state";
  const std::size_t size = bytes.size() - sizeof checksum;
  std::memcpy(&checksum, bytes.data() + size, sizeof checksum);
  StateReader in(bytes.data(), size);
  in.bytes(&head, sizeof head);
  if (head.magic != kMagic) return "not a saved state";
  if (head.version != kVersion)
    return "saved by another version of AMBF (format " + std::to_string(head.version) + ", expected " +
           std::to_string(kVersion) + ")";
  if (checksum != fnv1a(bytes.data(), size)) return "the saved state is damaged: its checksum is wrong";
  if (head.zero != 0) return "the saved state is damaged: four bytes of its head must be 0 (at byte 12)";
  if (head.fingerprint != fingerprint(structure)) return "the saved state belongs to other objects than those loaded";

  out.bodies.resize(structure.bodies.size());
  out.joints.resize(structure.joints.size());
  out.cameras.resize(structure.cameras.size());
  out.lights.resize(structure.lights.size());
  transfer(in, out, structure, step_s);
  std::string wrong = in.complaint();
  if (wrong.empty() && in.left() != 0) wrong = std::to_string(in.left()) + " bytes too many";
  if (wrong.empty()) wrong = check_circles(out, structure);
  if (wrong.empty()) wrong = check_physics(out, structure, step_s);
  return wrong.empty() ? wrong : "the saved state is damaged: " + wrong;
}

}  // namespace ambf::model
