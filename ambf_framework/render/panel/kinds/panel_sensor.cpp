// Sensors in the panel: pose, and what each element senses now.
#include <algorithm>
#include <cstdio>

#include "math/rotation.h"
#include "render/panel/kinds/panel_kinds.h"
#include "state/readings.h"

namespace ambf::render {

namespace {

constexpr std::size_t kMaxShownElements = 32;  // a page of the panel
constexpr std::size_t kMaxShownEvents = 5;

// What sensors without rays measure.
void draw_reading(PanelScene& scene, const state::SensorInfo& sensor, std::uint32_t slot) {
  const state::Frame& frame = scene.model.frame();
  const state::SensorReading& reading = state::reading_of(frame, slot);
  if (sensor.type == state::SensorType::imu) {
    vector_row(scene.ui, "Acceleration", reading.linear, "%.3f", "m/s\u00b2");
    vector_row(scene.ui, "Rate", reading.angular, "%.3f", "rad/s");
  } else if (sensor.type == state::SensorType::force_torque) {
    vector_row(scene.ui, "Force", reading.linear, "%.3f", "N");
    vector_row(scene.ui, "Torque", reading.angular, "%.4f", "N m");
  }
  std::size_t shown = 0;
  for (const state::SensedContact& contact : state::contacts_of(frame, slot)) {
    if (++shown > kMaxShownElements) break;
    const std::uint32_t body = frame.structure->bodies[contact.body].object;
    text_row(scene.ui, frame.structure->objects[body].local_name.c_str(), "%.4f mm  %.3f N", 1e3 * contact.distance_m,
             math::norm(contact.force_world));
  }
}

const char* what_of(state::SensorEvent::What what) {
  switch (what) {
    case state::SensorEvent::What::sensed: return "sensed";
    case state::SensorEvent::What::matched: return "matched";
    case state::SensorEvent::What::success: return "success";
  }
  return "";
}

// Whether its task is done, and what began and ended last, the newest first.
void draw_judgement(PanelScene& scene, const state::SensorInfo& sensor, std::uint32_t slot) {
  if (!sensor.is_judged()) return;
  const state::Frame& frame = scene.model.frame();
  const state::Structure& structure = *frame.structure;
  const state::SensorState& state = state::rows(frame, state::sensor_kind().column)[slot];
  if (!sensor.matching_key.empty())
    text_row(scene.ui, "Key", "%s%s", sensor.matching_key.c_str(), state.matched ? ", matched" : "");
  if (sensor.success_when != state::SuccessWhen::never) {
    if (state.success) {
      text_row(scene.ui, "Success", "since %.3f s", state.success_since_s);
    } else {
      text_row(scene.ui, "Success", "no");
    }
  }
  const state::SensorEventLog* log = state::sensor_events(frame);
  if (log == nullptr) return;
  const state::ObjectId self = structure.objects[sensor.object].id;
  const std::uint64_t kept = std::min<std::uint64_t>(log->total, state::SensorEventLog::kSize);
  std::size_t shown = 0;
  for (std::uint64_t back = 1; back <= kept && shown < kMaxShownEvents; ++back) {
    const state::SensorEvent& event = log->last[(log->total - back) % state::SensorEventLog::kSize];
    if (!(event.sensor == self)) continue;
    ++shown;
    const std::uint32_t object = state::find(structure, event.object);
    text_row(scene.ui, shown == 1 ? "Events" : "", "%.3f s  %s %s %s", event.sim_time, what_of(event.what),
             event.begins ? "begins" : "ends",
             object == state::kNone ? "" : structure.objects[object].local_name.c_str());
  }
}

void draw_details(PanelScene& scene, const state::ObjectInfo& object) {
  draw_pose_section(scene, object);
  const state::Frame& frame = scene.model.frame();
  const state::Structure& structure = *frame.structure;
  const state::SensorInfo& sensor = state::sensors(structure)[object.slot];
  const state::ElementRange elements = state::elements_of(frame, object.slot);
  if (!section(scene.ui, "Sensor", true) || !begin_rows("sensor")) return;
  text_row(scene.ui, "Type", "%s", state::name_of(sensor.type));
  text_row(scene.ui, "Triggered", "%d of %d",
           static_cast<int>(state::rows(frame, state::sensor_kind().column)[object.slot].triggered),
           static_cast<int>(sensor.elements));
  draw_judgement(scene, sensor, object.slot);
  for (std::size_t i = 0; i < elements.size() && i < kMaxShownElements; ++i) {
    const std::string label = "Element " + std::to_string(i);
    if (elements[i].triggered()) {
      const std::uint32_t sensed = state::sensed_object(structure, elements[i]);
      const double newtons = math::norm(elements[i].force_world);
      char force[40] = "";
      if (newtons > 0.0)
        std::snprintf(force, sizeof force, "  %.3f N%s", newtons, elements[i].slipped ? ", slips" : "");
      text_row(scene.ui, label.c_str(), "%.4f m  %s%s", elements[i].distance_m,
               structure.objects[sensed].local_name.c_str(), force);
    } else {
      text_row(scene.ui, label.c_str(), "-");
    }
  }
  draw_reading(scene, sensor, object.slot);
  if (elements.size() > kMaxShownElements)
    text_row(scene.ui, "More", "%d", static_cast<int>(elements.size() - kMaxShownElements));
  end_rows();
}

std::string pose_as_adf(const state::Frame& frame, std::uint32_t slot) {
  const math::Pose& T = state::rows(frame, state::sensor_kind().column)[slot].T_parent_object;
  return "location: {position: " + adf_vector(T.position) +
         ", orientation: " + adf_vector(math::to_rpy(T.orientation), "r", "p", "y") + "}\n";
}

}  // namespace

PanelKind sensor_panel_kind() {
  PanelKind kind;
  kind.color = 3;
  kind.draw_details = draw_details;
  kind.pose_as_adf = pose_as_adf;
  return kind;
}

}  // namespace ambf::render
