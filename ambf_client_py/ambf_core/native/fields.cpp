#include "fields.h"

#include <algorithm>
#include <array>
#include <cstdint>

#include "base/limits.h"
#include "state/actuators.h"
#include "state/readings.h"
#include "state/sensors.h"
#include "state/tasks.h"

namespace ambf::python {
namespace {

// In the order in which show() fills them.
enum StateField : std::size_t {
  kSimTime,
  kSimStep,
  kDiverged,
  kFrozenBodies,
  kBodyPose,
  kBodyTwist,
  kBodyReaction,
  kBodyFrozen,
  kJointPosition,
  kJointVelocity,
  kJointEffort,
  kJointCommanded,
  kJointCommandedMode,
  kContactCount,
  kContactBodies,
  kContactPoint,
  kContactNormal,
  kContactDistance,
  kContactImpulse,
  kContactFriction,
  kSensorTriggered,
  kSensorMatched,
  kSensorSuccess,
  kSensorReading,
  kElementBody,
  kElementDistance,
  kElementPoint,
  kElementForce,
  kActuatorHeld,
  kActuatorBodies,
  kActuatorForce,
  kPunctureCount,
  kPunctureNeedle,
  kPunctureOut,
  kPuncturePoint,
  kPunctureRest,
  kPunctureForce,
  kTaskSuccess,
  kTaskDone,
  kTaskTime,
  kTaskCounts,
  kGoalDone,
  kGoalError,
  kPieceHeldBy,
  kStateFields
};

constexpr std::array<Field, kStateFields> kState{{
    {"sim_time", Rows::one, 1, Element::f64},
    {"sim_step", Rows::one, 1, Element::i64},
    {"diverged", Rows::one, 1, Element::flag},
    {"frozen_bodies", Rows::one, 1, Element::i32},
    {"body_pose", Rows::bodies, 7, Element::f64},
    {"body_twist", Rows::bodies, 6, Element::f64},
    {"body_reaction", Rows::bodies, 6, Element::f64},
    {"body_frozen", Rows::bodies, 1, Element::flag},
    {"joint_position", Rows::joints, 1, Element::f64},
    {"joint_velocity", Rows::joints, 1, Element::f64},
    {"joint_effort", Rows::joints, 1, Element::f64},
    {"joint_commanded", Rows::joints, 1, Element::f64},
    {"joint_commanded_mode", Rows::joints, 1, Element::i8},
    {"contact_count", Rows::one, 1, Element::i32},
    {"contact_bodies", Rows::contacts, 2, Element::i32},
    {"contact_point", Rows::contacts, 3, Element::f64},
    {"contact_normal", Rows::contacts, 3, Element::f64},
    {"contact_distance", Rows::contacts, 1, Element::f64},
    {"contact_impulse", Rows::contacts, 1, Element::f64},
    {"contact_friction", Rows::contacts, 3, Element::f64},
    {"sensor_triggered", Rows::sensors, 1, Element::i64},
    {"sensor_matched", Rows::sensors, 1, Element::flag},
    {"sensor_success", Rows::sensors, 1, Element::flag},
    {"sensor_reading", Rows::sensors, 6, Element::f64},
    {"element_body", Rows::elements, 1, Element::i32},
    {"element_distance", Rows::elements, 1, Element::f64},
    {"element_point", Rows::elements, 3, Element::f64},
    {"element_force", Rows::elements, 3, Element::f64},
    {"actuator_held", Rows::actuators, 1, Element::i32},
    {"actuator_bodies", Rows::actuators, base::kMaxHeldBodies, Element::i32},
    {"actuator_force", Rows::actuators, 3, Element::f64},
    {"puncture_count", Rows::one, 1, Element::i32},
    {"puncture_needle", Rows::punctures, 1, Element::i32},
    {"puncture_out", Rows::punctures, 1, Element::flag},
    {"puncture_point", Rows::punctures, 3, Element::f64},
    {"puncture_rest", Rows::punctures, 3, Element::f64},
    {"puncture_force", Rows::punctures, 3, Element::f64},
    {"task_success", Rows::tasks, 1, Element::flag},
    {"task_done", Rows::tasks, 1, Element::i32},
    {"task_time", Rows::tasks, 1, Element::f64},
    {"task_counts", Rows::tasks, 4, Element::i32},
    {"goal_done", Rows::goals, 1, Element::flag},
    {"goal_error", Rows::goals, 2, Element::f64},
    {"piece_held_by", Rows::pieces, 1, Element::i64},
}};

void put(double*& to, const math::Vec3& v) {
  *to++ = v.x;
  *to++ = v.y;
  *to++ = v.z;
}

void show_bodies(const state::Frame& frame, const Memory& state) {
  double* pose = at<double>(state, kBodyPose);
  double* twist = at<double>(state, kBodyTwist);
  double* reaction = at<double>(state, kBodyReaction);
  auto* frozen = at<std::int8_t>(state, kBodyFrozen);
  for (const state::BodyState& body : frame.bodies) {
    put(pose, body.T_world_body.position);
    const math::Quat& q = body.T_world_body.orientation;
    for (const double value : {q.x, q.y, q.z, q.w}) *pose++ = value;
    put(twist, body.twist_world.linear);
    put(twist, body.twist_world.angular);
    put(reaction, body.wrench_body.force);
    put(reaction, body.wrench_body.torque);
    *frozen++ = static_cast<std::int8_t>(body.frozen);
  }
}

void show_joints(const state::Frame& frame, const Memory& state) {
  for (std::size_t i = 0; i < frame.joints.size(); ++i) {
    const state::JointState& joint = frame.joints[i];
    at<double>(state, kJointPosition)[i] = joint.position;
    at<double>(state, kJointVelocity)[i] = joint.velocity;
    at<double>(state, kJointEffort)[i] = joint.effort;
    at<double>(state, kJointCommanded)[i] = joint.commanded;
    at<std::int8_t>(state, kJointCommandedMode)[i] = static_cast<std::int8_t>(joint.commanded_type);
  }
}

// Rows behind the last contact are zeros: only those that the frame before filled are cleared.
void show_contacts(const state::Frame& frame, const Memory& state) {
  auto* count = at<std::int32_t>(state, kContactCount);
  const auto before = static_cast<std::size_t>(*count);
  const std::size_t now = std::min(frame.contacts.size(), base::kMaxContactsInFrame);
  *count = static_cast<std::int32_t>(now);
  auto* bodies = at<std::int32_t>(state, kContactBodies);
  double* point = at<double>(state, kContactPoint);
  double* normal = at<double>(state, kContactNormal);
  double* friction = at<double>(state, kContactFriction);
  for (std::size_t i = 0; i < std::max(before, now); ++i) {
    const state::ContactState none{0, 0, {}, {}, 0.0, 0.0, {}};
    const state::ContactState& contact = i < now ? frame.contacts[i] : none;
    *bodies++ = static_cast<std::int32_t>(contact.body_a);
    *bodies++ = static_cast<std::int32_t>(contact.body_b);
    put(point, contact.point_world);
    put(normal, contact.normal_world);
    at<double>(state, kContactDistance)[i] = contact.distance;
    at<double>(state, kContactImpulse)[i] = contact.impulse;
    put(friction, contact.friction_world);
  }
}

// -1 stands for no body.
std::int32_t row_of(std::uint32_t slot) { return slot == state::kNone ? -1 : static_cast<std::int32_t>(slot); }

void show_sensors(const state::Frame& frame, const Memory& state) {
  const std::vector<state::SensorState>& sensors = state::rows(frame, state::sensor_kind().column);
  double* value = at<double>(state, kSensorReading);
  auto* body = at<std::int32_t>(state, kElementBody);
  double* distance = at<double>(state, kElementDistance);
  double* point = at<double>(state, kElementPoint);
  double* force = at<double>(state, kElementForce);
  for (std::uint32_t slot = 0; slot < sensors.size(); ++slot) {
    const state::SensorState& sensor = sensors[slot];
    at<std::int64_t>(state, kSensorTriggered)[slot] = static_cast<std::int64_t>(sensor.triggered);
    at<std::int8_t>(state, kSensorMatched)[slot] = static_cast<std::int8_t>(sensor.matched);
    at<std::int8_t>(state, kSensorSuccess)[slot] = static_cast<std::int8_t>(sensor.success);
    const state::SensorReading& reading = state::reading_of(frame, slot);
    put(value, reading.linear);
    put(value, reading.angular);
    for (const state::SensedElement& element : state::elements_of(frame, slot)) {
      *body++ = row_of(element.body);
      *distance++ = element.distance_m;
      put(point, element.point_world);
      put(force, element.force_world);
    }
  }
}

void show_actuators(const state::Frame& frame, const Memory& state) {
  const std::vector<state::ActuatorState>& actuators = state::rows(frame, state::actuator_kind().column);
  auto* bodies = at<std::int32_t>(state, kActuatorBodies);
  double* force = at<double>(state, kActuatorForce);
  for (std::size_t slot = 0; slot < actuators.size(); ++slot) {
    const state::ActuatorState& actuator = actuators[slot];
    at<std::int32_t>(state, kActuatorHeld)[slot] = static_cast<std::int32_t>(actuator.held_count);
    for (std::uint32_t i = 0; i < actuator.held.size(); ++i) {
      *bodies++ = i < actuator.held_count ? row_of(actuator.held[i]) : -1;
    }
    put(force, actuator.force_world);
  }
}

// Rows behind the last puncture are zeros, their needle -1: only those that the frame before filled are cleared.
void show_punctures(const state::Frame& frame, const Memory& state) {
  auto* count = at<std::int32_t>(state, kPunctureCount);
  const auto before = static_cast<std::size_t>(*count);
  std::size_t row = 0;
  const auto write = [&](std::int32_t needle, const state::HeldNode& node) {
    at<std::int32_t>(state, kPunctureNeedle)[row] = needle;
    at<std::int8_t>(state, kPunctureOut)[row] =
        static_cast<std::int8_t>(node.puncture == state::HeldNode::Puncture::out);
    double* point = at<double>(state, kPuncturePoint) + 3 * row;
    double* rest = at<double>(state, kPunctureRest) + 3 * row;
    double* force = at<double>(state, kPunctureForce) + 3 * row;
    put(point, node.target_world);
    put(rest, node.rest);
    put(force, node.force_world);
    ++row;
  };
  for (const state::HeldNode& node : state::held_nodes(frame)) {
    if (node.puncture != state::HeldNode::Puncture::none) write(static_cast<std::int32_t>(node.actuator), node);
  }
  *count = static_cast<std::int32_t>(row);
  while (row < before) write(-1, {});
}

void show_tasks(const state::Frame& frame, const Memory& state) {
  const std::vector<state::TaskState>& tasks = state::rows(frame, state::task_kind().column);
  auto* counts = at<std::int32_t>(state, kTaskCounts);
  auto* done = at<std::int8_t>(state, kGoalDone);
  double* error = at<double>(state, kGoalError);
  auto* held_by = at<std::int64_t>(state, kPieceHeldBy);
  for (std::uint32_t slot = 0; slot < tasks.size(); ++slot) {
    const state::TaskState& task = tasks[slot];
    at<std::int8_t>(state, kTaskSuccess)[slot] = static_cast<std::int8_t>(task.success);
    at<std::int32_t>(state, kTaskDone)[slot] = static_cast<std::int32_t>(task.goals_done);
    at<double>(state, kTaskTime)[slot] = task.time_s;
    for (const std::uint32_t count : {task.drops, task.touches, task.hand_overs, task.wrong_order})
      *counts++ = static_cast<std::int32_t>(count);
    for (const state::TaskGoalState& goal : state::goals_of(frame, slot)) {
      *done++ = static_cast<std::int8_t>(goal.done);
      *error++ = goal.distance_m;
      *error++ = goal.angle_rad;
    }
    for (const state::TaskPieceState& piece : state::pieces_of(frame, slot)) *held_by++ = piece.held_by;
  }
}

}  // namespace

std::span<const Field> state_fields() { return kState; }

const char* name_of(Rows rows) {
  static constexpr std::array kNames{"one",       "bodies",    "joints", "contacts", "sensors", "elements",
                                     "actuators", "punctures", "tasks",  "goals",    "pieces"};
  return kNames[static_cast<std::size_t>(rows)];
}

std::size_t rows_of(const state::Structure& structure, Rows rows) {
  switch (rows) {
    case Rows::one: return 1;
    case Rows::bodies: return structure.bodies.size();
    case Rows::joints: return structure.joints.size();
    case Rows::contacts: return base::kMaxContactsInFrame;
    case Rows::sensors: return state::sensors(structure).size();
    case Rows::elements: {
      const std::vector<state::SensorInfo>& sensors = state::sensors(structure);
      return sensors.empty() ? 0 : std::size_t{sensors.back().first_element} + sensors.back().elements;
    }
    case Rows::actuators: return state::actuators(structure).size();
    case Rows::punctures: {
      const std::vector<state::ActuatorInfo>& all = state::actuators(structure);
      const auto needles = std::count_if(all.begin(), all.end(), [](const state::ActuatorInfo& each) {
        return each.type == state::ActuatorType::needle;
      });
      return static_cast<std::size_t>(needles) * state::kMaxHeldNodes;
    }
    case Rows::tasks: return state::tasks(structure).size();
    case Rows::goals: return state::count_goals(structure);
    case Rows::pieces: return state::count_pieces(structure);
  }
  return 0;
}

std::size_t bytes_of(const state::Structure& structure, const Field& field) {
  const std::size_t element = field.element >= Element::i8 ? 1 : field.element == Element::i32 ? 4 : 8;
  return rows_of(structure, field.rows) * field.columns * element;
}

void show(const state::Frame& frame, const Memory& state) {
  *at<double>(state, kSimTime) = frame.sim_time;
  *at<std::int64_t>(state, kSimStep) = frame.sim_step;
  *at<std::int8_t>(state, kDiverged) = static_cast<std::int8_t>(frame.run.diverged);
  *at<std::int32_t>(state, kFrozenBodies) = static_cast<std::int32_t>(frame.frozen_bodies);
  show_bodies(frame, state);
  show_joints(frame, state);
  show_contacts(frame, state);
  show_sensors(frame, state);
  show_actuators(frame, state);
  show_punctures(frame, state);
  show_tasks(frame, state);
}

}  // namespace ambf::python
