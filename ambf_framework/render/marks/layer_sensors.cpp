// Sensors: their rays with red starts and green ends (Fig. 6.8c), and what they sense.
#include <algorithm>

#include "render/marks/layer_shapes.h"
#include "state/sensors.h"

namespace ambf::render {

namespace {

constexpr DebugColor kStart{0.90F, 0.16F, 0.14F, 1.0F}, kEnd{0.20F, 0.78F, 0.25F, 1.0F},
    kIdle{0.60F, 0.63F, 0.68F, 0.7F}, kSensed{1.0F, 0.80F, 0.15F, 1.0F};
constexpr double kMinPoint_px = 3.0, kMaxPoint_px = 12.0;

void draw_sensor(const LayerInput& in, const state::SensorInfo& sensor, WorldShapes& out) {
  const state::ObjectInfo& object = in.frame.structure->objects[sensor.object];
  const math::Pose* T_world_sensor = in.poses.of(object);
  if (T_world_sensor == nullptr || sensor.rays == nullptr) return;
  const state::ElementRange elements = state::elements_of(in.frame, object.slot);
  const double pixel_m = in.scale.metres(T_world_sensor->position, 1.0);
  const double ui = in.scale.ui();
  const double point_px = std::clamp(sensor.visible_size_m / pixel_m, kMinPoint_px * ui, kMaxPoint_px * ui);
  for (std::size_t i = 0; i < sensor.rays->size(); ++i) {
    const state::SensorRay& ray = (*sensor.rays)[i];
    const math::Vec3 start = *T_world_sensor * ray.start, end = *T_world_sensor * ray.end;
    const bool triggered = i < elements.size() && elements[i].triggered();
    out.point(start, kStart, point_px, Seen::through);
    out.point(end, kEnd, point_px, Seen::through);
    if (!triggered) {
      out.line(start, end, kIdle, ui);
      continue;
    }
    // As drawn: the pose may be between two frames.
    const math::Vec3 met = start + (end - start) * elements[i].fraction;
    out.line(start, met, kSensed, 2.0 * ui, Seen::through);
    out.line(met, end, kIdle, ui);
    out.point(met, kSensed, 1.3 * point_px, Seen::through);
  }
}

}  // namespace

void draw_sensors(const LayerInput& in, WorldShapes& out) {
  for (const state::SensorInfo& sensor : state::sensors(*in.frame.structure)) draw_sensor(in, sensor, out);
}

void draw_visible_sensors(const LayerInput& in, WorldShapes& out) {
  for (const state::SensorInfo& sensor : state::sensors(*in.frame.structure))
    if (sensor.visible) draw_sensor(in, sensor, out);
}

}  // namespace ambf::render
