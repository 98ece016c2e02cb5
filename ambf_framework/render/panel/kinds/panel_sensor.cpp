// Sensors in the panel: pose, and what each element senses now.
#include "math/rotation.h"
#include "render/panel/kinds/panel_kinds.h"
#include "state/readings.h"

namespace ambf::render {

namespace {

constexpr std::size_t kMaxShownElements = 32;  // a page of the panel

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
  for (std::size_t i = 0; i < elements.size() && i < kMaxShownElements; ++i) {
    const std::string label = "Element " + std::to_string(i);
    if (elements[i].triggered()) {
      const std::uint32_t body = structure.bodies[elements[i].body].object;
      text_row(scene.ui, label.c_str(), "%.4f m  %s", elements[i].distance_m,
               structure.objects[body].local_name.c_str());
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
