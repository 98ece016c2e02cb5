// LiveWorld::save and restore: the whole state as bytes.
#include <span>

#include "model/live_impl.h"
#include "model/live_world.h"
#include "model/state_bytes.h"

namespace ambf::model {
namespace {

constexpr std::uint64_t kMagic = 0x4554415453464d41;  // "AMFSTATE"
constexpr std::uint32_t kVersion = 2;
constexpr std::uint32_t kMaxEntries = 1u << 20;  // joints in one command: more is damage

std::uint64_t fnv1a(const std::uint8_t* data, std::size_t size) {
  std::uint64_t hash = 0xcbf29ce484222325ull;
  for (std::size_t i = 0; i < size; ++i) hash = (hash ^ data[i]) * 0x100000001b3ull;
  return hash;
}

// Which objects, of which kinds, in which order (FNV-1a): a state fits no other structure.
std::uint64_t fingerprint(const state::Structure& structure) {
  std::vector<std::uint8_t> names;
  for (const state::ObjectInfo& object : structure.objects) {
    names.push_back(static_cast<std::uint8_t>(object.kind));
    names.insert(names.end(), object.identifier.begin(), object.identifier.end());
    names.push_back(0);
  }
  return fnv1a(names.data(), names.size());
}

struct SavedBody {
  state::BodyParameters parameters;
  state::Push push;
  std::uint64_t push_steps = 0;
  CartesianController::State controller;
};

// One source's command in force.
struct SavedCommand {
  std::int32_t source = 0;
  std::uint64_t order = 0;
  double age_s = 0.0;  // since its last sign of life
  state::Command command;
};

struct SavedJoint {
  state::JointParameters parameters;
  JointController::State controller;
  state::JointCommandType type = state::JointCommandType::none;
  double value = 0.0;
  std::uint64_t order = 0;  // 0: nobody leads
};

struct SavedPlaced {
  math::Pose T_parent;
  bool orphaned = false;
};

void put_command(StateWriter& out, const state::Command& command) {
  if (const auto* pose = std::get_if<state::PoseCommand>(&command)) {
    out.put(*pose);
    return;
  }
  const auto& body = std::get<state::RigidBodyCommand>(command);
  out.put(body.type);
  out.put(body.wrench_world);
  out.put(body.T_world_body);
  out.put(body.twist_world);
  out.put(static_cast<std::uint32_t>(body.joints.size()));
  for (const state::JointCommand& joint : body.joints) out.put(joint);
}

state::Command get_command(StateReader& in, bool of_body) {
  if (!of_body) return in.get<state::PoseCommand>();
  state::RigidBodyCommand body;
  body.type = in.get<state::CartesianCommandType>();
  body.wrench_world = in.get<math::Wrench>();
  body.T_world_body = in.get<math::Pose>();
  body.twist_world = in.get<math::Twist>();
  const auto count = in.get<std::uint32_t>();
  for (std::uint32_t i = 0; i < count && count < kMaxEntries && in.good(); ++i)
    body.joints.push_back(in.get<state::JointCommand>());
  return body;
}

void put_commands(StateWriter& out, const CommandSlots& slots, double now_s) {
  std::uint32_t count = 0;
  slots.each([&](int, const CommandSlot& slot) { count += slot.in_force ? 1 : 0; });
  out.put(count);
  slots.each([&](int source, const CommandSlot& slot) {
    if (!slot.in_force) return;
    out.put(std::int32_t{source});
    out.put(slot.order);
    out.put(now_s - slot.since_s);
    put_command(out, slot.command());
  });
}

std::vector<SavedCommand> get_commands(StateReader& in, bool of_body) {
  std::vector<SavedCommand> commands;
  const auto count = in.get<std::uint32_t>();
  for (std::uint32_t i = 0; i < count && count <= state::kMaxSources && in.good(); ++i) {
    SavedCommand saved;
    saved.source = in.get<std::int32_t>();
    saved.order = in.get<std::uint64_t>();
    saved.age_s = in.get<double>();
    saved.command = get_command(in, of_body);
    if (saved.source >= 0 && saved.source < state::kMaxSources) commands.push_back(std::move(saved));
  }
  return commands;
}

}  // namespace

std::vector<std::uint8_t> LiveWorld::save() {
  Impl& live = *impl_;
  std::vector<std::uint8_t> bytes;
  StateWriter out(bytes);
  out.put(kMagic);
  out.put(kVersion);
  out.put(fingerprint(*live.structure));

  std::vector<std::byte> physics;
  live.physics->save_state(physics);
  out.put(static_cast<std::uint64_t>(physics.size()));
  out.put_bytes(physics.data(), physics.size());

  out.put(live.steps);
  out.put(live.sim_time);
  out.put(live.commands.last_order());
  const double now_s = live.commands.watchdog_now_s();
  for (const auto& body : live.tables.bodies) {
    out.put(SavedBody{parameters_of(*body), body->push, body->push_steps, body->controller.state()});
    put_commands(out, *body->slots, now_s);
  }
  for (const auto& joint : live.tables.joints)
    out.put(SavedJoint{parameters_of(*joint), joint->controller.state(), joint->order.type, joint->order.value,
                       joint->order.led == nullptr ? 0 : joint->order.order});
  for (const auto* table : {&live.tables.cameras, &live.tables.lights}) {
    for (const auto& placed : *table) {
      out.put(SavedPlaced{placed->T_parent, placed->orphaned});
      put_commands(out, *placed->slots, now_s);
    }
  }
  out.put(fnv1a(bytes.data(), bytes.size()));
  live.changed = true;
  return bytes;
}

std::string LiveWorld::restore(const std::vector<std::uint8_t>& bytes) {
  Impl& live = *impl_;
  std::uint64_t checksum = 0;
  if (bytes.size() < sizeof checksum) return "not a saved state";
  const std::size_t size = bytes.size() - sizeof checksum;
  std::memcpy(&checksum, bytes.data() + size, sizeof checksum);
  StateReader in(bytes.data(), size);
  if (in.get<std::uint64_t>() != kMagic) return "not a saved state";
  if (const auto version = in.get<std::uint32_t>(); version != kVersion)
    return "saved by another version of AMBF (format " + std::to_string(version) + ", expected " +
           std::to_string(kVersion) + ")";
  if (checksum != fnv1a(bytes.data(), size)) return "the saved state is damaged";
  if (in.get<std::uint64_t>() != fingerprint(*live.structure))
    return "the saved state belongs to other objects than those loaded";

  // Everything is read before anything is changed.
  const auto physics_size = static_cast<std::size_t>(in.get<std::uint64_t>());
  const std::uint8_t* physics = in.take(physics_size);
  const auto steps = in.get<std::uint64_t>();
  const auto sim_time = in.get<double>();
  const auto last_order = in.get<std::uint64_t>();
  std::vector<SavedBody> bodies;
  std::vector<std::vector<SavedCommand>> body_commands, placed_commands;
  for (std::size_t i = 0; i < live.tables.bodies.size() && in.good(); ++i) {
    bodies.push_back(in.get<SavedBody>());
    body_commands.push_back(get_commands(in, true));
  }
  std::vector<SavedJoint> joints;
  for (std::size_t i = 0; i < live.tables.joints.size(); ++i) joints.push_back(in.get<SavedJoint>());
  std::vector<SavedPlaced> placed;
  for (std::size_t i = 0; i < live.tables.cameras.size() + live.tables.lights.size() && in.good(); ++i) {
    placed.push_back(in.get<SavedPlaced>());
    placed_commands.push_back(get_commands(in, false));
  }
  if (!in.good() || in.left() != 0) return "the saved state is damaged";
  if (!live.physics->restore_state({reinterpret_cast<const std::byte*>(physics), physics_size}))
    return "the saved state does not fit these bodies and joints";

  live.picks.end_all();
  live.commands.forget_all();
  const double now_s = live.commands.watchdog_now_s();
  const auto put_in_force = [&](ObjectRef object, const std::vector<SavedCommand>& commands) {
    for (const SavedCommand& saved : commands) {
      CommandSlot& slot = live.commands.slots(object)->find_or_make(saved.source);
      slot.in_force = slot.from_snapshot = true;
      slot.order = saved.order;
      slot.since_s = now_s - saved.age_s;
      slot.restored = saved.command;
    }
    if (!commands.empty()) live.commands.merge(object);
  };
  for (std::uint32_t slot = 0; slot < live.tables.bodies.size(); ++slot) {
    put_in_force({state::ObjectKind::rigid_body, slot}, body_commands[slot]);
    LiveBody& body = *live.tables.bodies[slot];
    set_parameters(body, bodies[slot].parameters, live.physics->options().step);
    body.push = bodies[slot].push;
    body.push_steps = bodies[slot].push_steps;
    body.controller.set_state(bodies[slot].controller);  // merge() began afresh
  }
  live.list_pushed();
  ++live.parameters_version;
  for (std::size_t slot = 0; slot < live.tables.joints.size(); ++slot) {
    LiveJoint& joint = *live.tables.joints[slot];
    set_parameters(joint, joints[slot].parameters);
    joint.controller.set_state(joints[slot].controller);
    joint.order = {joints[slot].type, joints[slot].value, joints[slot].order,
                   live.commands.leading_slot(joints[slot].order)};
  }
  std::size_t next = 0;
  for (auto* table : {&live.tables.cameras, &live.tables.lights}) {
    const auto kind = table == &live.tables.cameras ? state::ObjectKind::camera : state::ObjectKind::light;
    for (std::uint32_t slot = 0; slot < table->size(); ++slot, ++next) {
      put_in_force({kind, slot}, placed_commands[next]);
      (*table)[slot]->T_parent = placed[next].T_parent;
      (*table)[slot]->orphaned = placed[next].orphaned;
    }
  }
  live.commands.set_last_order(last_order);
  live.steps = steps;
  live.sim_time = sim_time;
  ++live.epoch;
  live.changed = true;
  return "";
}

}  // namespace ambf::model
