// Magnets: each body that the sensor senses is pulled with strength (1 - d / range)^2, d being the distance of the
// nearest hit along its ray; at the middle of its hits.
#include <cmath>

#include "math/rotation.h"
#include "model/kinds/actuator/detail/live_actuator.h"
#include "model/kinds/sensor.h"
#include "physics/mounted_bodies.h"

namespace ambf::model {
namespace {

// 1 / mass that a force at a point along a direction feels, 1/kg.
double inverse_mass_at(const physics::Body& body, const math::Vec3& point, const math::Vec3& direction) {
  if (body.is_static()) return 0.0;
  const math::Pose com = body.com_pose();
  const math::Vec3 arm = math::rotate(math::inverse(com.orientation), math::cross(point - com.position, direction));
  const math::Vec3 inertia = body.inertia();
  return 1.0 / body.mass() + arm.x * arm.x / inertia.x + arm.y * arm.y / inertia.y + arm.z * arm.z / inertia.z;
}

// How the sensor meets a body: the nearest hit says how strong the pull is, all of them where it acts. At the nearest
// alone, what lies flat on the magnet would be pulled at whichever of its points is nearest by a rounding error, and
// would tip over it.
struct Hold {
  double distance = 0.0, range = 0.0;  // m, of the nearest hit; range 0: none within range
  math::Vec3 point, towards;           // means, weighted by what a magnet of one ray would pull; towards: unit
};

Hold hold_on(const LiveWorld::Impl& live, std::uint32_t sensor, const physics::Body& body, double range_m) {
  const auto& rays = *state::sensors(*live.structure)[sensor].rays;
  const std::vector<ElementHit>& hits = sensor_at(live, sensor).hits;
  const math::Quat R_world_sensor = pose_of_sensor(live, sensor).orientation;
  Hold hold;
  double sum = 0.0;
  for (std::size_t i = 0; i < hits.size(); ++i) {
    if (hits[i].body != &body) continue;
    const math::Vec3 back = rays[i].start - rays[i].end;
    const double length = math::norm(back), distance = hits[i].fraction * length;
    const double range = range_m > 0.0 ? range_m : length;
    if (distance >= range) continue;
    const double left = 1.0 - distance / range, weight = left * left;
    sum += weight;
    hold.point += hits[i].point * weight;
    hold.towards += back * (weight / length);
    if (hold.range > 0.0 && distance >= hold.distance) continue;
    hold.distance = distance;
    hold.range = range;
  }
  const double aligned = math::norm(hold.towards);
  if (hold.range == 0.0 || aligned < 1e-9 * sum) return {};  // rays from all sides pull nowhere
  hold.point = hold.point / sum;
  hold.towards = math::rotate(R_world_sensor, hold.towards / aligned);
  return hold;
}

}  // namespace

void pull(const LiveWorld::Impl& live, std::uint32_t sensor, physics::Body& holder, double h_s,
          LiveActuator& actuator) {
  actuator.pulled.clear();
  actuator.pull_world = {};
  list_sensed(live, sensor, holder, actuator.pulled);
  for (const physics::Body* sensed : actuator.pulled) {
    const Hold hold = hold_on(live, sensor, *sensed, actuator.range_m);
    physics::Body& body = *live.tables.bodies()[sensed->user_index()].body;
    if (hold.range == 0.0 || physics::is_mounted(body)) continue;
    const double inverse_mass =
        inverse_mass_at(body, hold.point, hold.towards) + inverse_mass_at(holder, hold.point, hold.towards);
    if (inverse_mass <= 0.0) continue;
    // At the distance that the step will end with, and with the slope of the pull as an implicit stiffness (EQUATIONS
    // 16): it grows as the two come near, and must not throw light bodies at the holder.
    const double closing = math::dot(body.velocity_at(hold.point) - holder.velocity_at(hold.point), hold.towards);
    const double left = 1.0 - std::clamp((hold.distance - h_s * closing) / hold.range, 0.0, 1.0);
    const double slope = 2.0 * actuator.strength_N * left / hold.range;
    const double force = actuator.strength_N * left * left / (1.0 + h_s * h_s * slope * inverse_mass);
    body.apply_force(hold.towards * force, hold.point);
    holder.apply_force(hold.towards * -force, hold.point);
    actuator.pull_world += hold.towards * force;
  }
}

}  // namespace ambf::model
