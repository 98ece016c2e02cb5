#include "state/actuators.h"

#include <algorithm>
#include <utility>

#include "state/detail/built_in_kinds.h"
#include "state/sensors.h"
#include "state/soft_bodies.h"

namespace ambf::state {
namespace {

PlacedKind<ActuatorState> registered_kind;
ColumnId<HeldNode> registered_held;

std::size_t count_held_nodes(const Structure& structure) {
  const std::vector<ActuatorInfo>& all = actuators(structure);
  if (soft_bodies(structure).empty()) return 0;
  return kMaxHeldNodes * static_cast<std::size_t>(std::count_if(all.begin(), all.end(), [](const ActuatorInfo& each) {
           return each.type == ActuatorType::constraint || each.type == ActuatorType::needle;
         }));
}

}  // namespace

const char* name_of(ActuatorType type) {
  switch (type) {
    case ActuatorType::constraint: break;
    case ActuatorType::magnet: return "Magnet";
    case ActuatorType::blade: return "Blade";
    case ActuatorType::needle: return "Needle";
  }
  return "Constraint";
}

void register_actuator_kind() {
  KindInfo info;
  info.name = "actuator";
  info.label = "actuator";
  info.plural = "actuators";
  registered_kind = register_placed_kind<ActuatorInfo, ActuatorState>(std::move(info));
  ColumnTraits traits;
  traits.name = "held_nodes";
  traits.hashed = true;
  traits.while_diverged = WhileDiverged::last_good_structure;
  traits.rows_of = count_held_nodes;
  registered_held = register_column<HeldNode>(std::move(traits));
}

const PlacedKind<ActuatorState>& actuator_kind() {
  register_built_in_kinds();
  return registered_kind;
}

const std::vector<HeldNode>& held_nodes(const Frame& frame) { return rows(frame, registered_held); }
std::vector<HeldNode>& held_nodes(Frame& frame) { return rows(frame, registered_held); }

const std::vector<ActuatorInfo>& actuators(const Structure& structure) {
  static const std::vector<ActuatorInfo> none;
  const auto number = static_cast<std::size_t>(actuator_kind().kind);
  const bool has_table = number < structure.registered.size() && structure.registered[number].has_value();
  return has_table ? table<ActuatorInfo>(structure, actuator_kind().kind) : none;
}

std::uint32_t holder_of(const Structure& structure, std::uint32_t object) {
  while (object != kNone) {
    const ObjectInfo& info = structure.objects[object];
    if (info_of(info.kind).has_mass) return info.slot;
    const PlacedInfo* placed = rows_of(info.kind).placed(structure, info.slot);
    object = placed == nullptr ? kNone : placed->parent_object;
  }
  return kNone;
}

std::string check(ActuatorCommand& command, const Structure& structure, std::uint32_t actuator) {
  if (!command.actuate) return {};
  const std::uint32_t holder = holder_of(structure, actuator);
  if (holder == kNone) return "the actuator hangs on no body that could hold anything";
  const ActuatorInfo& info = actuators(structure)[structure.objects[actuator].slot];
  if (info.type == ActuatorType::needle && info.thread_object == kNone)
    return "a needle without a thread ties nothing, and sews what its tip is pressed into without commands";
  // They cut what the edge meets, and tie or untie what is sewn, whatever is named.
  if (info.type == ActuatorType::blade || info.type == ActuatorType::needle) {
    command = {true, {}, info.type == ActuatorType::needle && command.use_sensor, {}, false, {}};
    return {};
  }
  if (info.type == ActuatorType::magnet) command = {true, {}, true, {}, false, {}};
  if (command.use_sensor) {
    const std::uint32_t sensor = command.sensor.valid() ? find(structure, command.sensor) : info.sensor_object;
    return sensor != kNone && structure.objects[sensor].kind == sensor_kind().kind ? "" : "there is no such sensor";
  }
  const std::uint32_t body = find(structure, command.body);
  if (body != kNone && structure.objects[body].kind == soft_body_kind().kind)
    return command.use_offset ? "a soft body is held where it is: body_offset is of rigid bodies" : "";
  if (body == kNone || !info_of(structure.objects[body].kind).has_mass) return "there is no such body";
  if (structure.objects[body].slot == holder) return "it cannot hold the body that it sits on";
  if (structure.bodies[holder].mass == 0.0 && structure.bodies[structure.objects[body].slot].mass == 0.0)
    return "neither the body that it sits on nor the other one moves";
  if (!command.use_offset) return {};
  PoseCommand offset{true, command.T_held_grasp};
  std::string refusal = check(offset);
  command.T_held_grasp = offset.T_parent_object;
  return refusal.empty() ? refusal : "body_offset: " + refusal;
}

}  // namespace ambf::state
