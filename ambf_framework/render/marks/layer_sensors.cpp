// Sensors: their rays with red starts and green ends (Fig. 6.8c), what they sense and its forces; and skins through
// these points (Fig. 6.5b).
#include <algorithm>
#include <cmath>

#include "render/marks/layer_shapes.h"
#include "state/sensors.h"

namespace ambf::render {

namespace {

constexpr DebugColor kStart{0.90F, 0.16F, 0.14F, 1.0F}, kEnd{0.20F, 0.78F, 0.25F, 1.0F},
    kIdle{0.60F, 0.63F, 0.68F, 0.7F}, kSensed{1.0F, 0.80F, 0.15F, 1.0F}, kSlips{0.95F, 0.25F, 0.85F, 1.0F};
constexpr DebugColor kSkin{0.20F, 0.66F, 0.62F, 0.45F}, kPressed{0.95F, 0.45F, 0.15F, 0.75F},
    kSeam{0.05F, 0.20F, 0.20F, 0.55F};
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
    out.point(met, elements[i].slipped ? kSlips : kSensed, 1.3 * point_px, Seen::through);
    draw_force(in, met, elements[i].force_world, out);
  }
}

DebugColor between(const DebugColor& a, const DebugColor& b, double share) {
  DebugColor color{};
  for (std::size_t i = 0; i < color.size(); ++i) color[i] = a[i] + static_cast<float>(share) * (b[i] - a[i]);
  return color;
}

// Through what each ray senses, else its end.
void draw_skin(const LayerInput& in, const state::SensorInfo& sensor, WorldShapes& out) {
  const state::ObjectInfo& object = in.frame.structure->objects[sensor.object];
  const math::Pose* T_world_sensor = in.poses.of(object);
  if (T_world_sensor == nullptr || sensor.rays == nullptr || sensor.skin == nullptr) return;
  const state::ElementRange elements = state::elements_of(in.frame, object.slot);
  if (elements.size() < sensor.rays->size()) return;
  const auto at = [&](std::uint32_t i) {
    const state::SensorRay& ray = (*sensor.rays)[i];
    const double reach = elements[i].triggered() ? elements[i].fraction : 1.0;  // as drawn
    return *T_world_sensor * (ray.start + reach * (ray.end - ray.start));
  };
  const auto depth = [&](std::uint32_t i) { return elements[i].triggered() ? 1.0 - elements[i].fraction : 0.0; };
  for (const auto& [a, b, c] : *sensor.skin) {
    const math::Vec3 corners[] = {at(a), at(b), at(c)};
    const double pressed = std::max({depth(a), depth(b), depth(c)});
    const DebugColor color = between(kSkin, kPressed, std::sqrt(std::clamp(pressed, 0.0, 1.0)));
    out.triangle(corners[0], corners[1], corners[2], color, Seen::through);
    for (std::size_t i = 0; i < 3; ++i) out.line(corners[i], corners[(i + 1) % 3], kSeam, in.scale.ui(), Seen::through);
  }
}

}  // namespace

void draw_sensor_skins(const LayerInput& in, WorldShapes& out) {
  for (const state::SensorInfo& sensor : state::sensors(*in.frame.structure)) draw_skin(in, sensor, out);
}

void draw_sensors(const LayerInput& in, WorldShapes& out) {
  for (const state::SensorInfo& sensor : state::sensors(*in.frame.structure)) draw_sensor(in, sensor, out);
}

void draw_visible_sensors(const LayerInput& in, WorldShapes& out) {
  for (const state::SensorInfo& sensor : state::sensors(*in.frame.structure))
    if (sensor.visible) draw_sensor(in, sensor, out);
}

}  // namespace ambf::render
