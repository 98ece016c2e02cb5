// What actuators take of soft bodies (EQUATIONS 16): the corners of sensed faces, or the nearest node.
#include "model/kinds/actuator/detail/live_actuator.h"
#include "model/kinds/sensor.h"
#include "model/kinds/soft_body.h"
#include "physics/soft_body.h"

namespace ambf::model {
namespace {

constexpr double kReach_m = 0.1;  // of an actuator to the node that it takes

}  // namespace

void hold_sensed_faces(const LiveWorld::Impl& live, std::uint32_t sensor, physics::Body& holder,
                       physics::SoftGrip& grip) {
  for (const ElementHit& hit : sensor_at(live, sensor).hits) {
    if (hit.soft == nullptr) continue;
    physics::SoftBody& body = soft_body_at(live, hit.soft->user_index());
    for (const std::uint32_t node : body.faces()[static_cast<std::size_t>(hit.triangle)]) grip.hold(holder, body, node);
  }
}

void hold_nearest_node(const LiveWorld::Impl& live, std::uint32_t soft_body, const math::Vec3& place_world,
                       physics::Body& holder, physics::SoftGrip& grip) {
  physics::SoftBody& body = soft_body_at(live, soft_body);
  std::size_t nearest = body.node_count();
  double distance = kReach_m;
  for (std::size_t node = 0; node < body.node_count(); ++node) {
    const double other = math::norm(body.position(node) - place_world);
    if (!(other <= distance) || (other == distance && nearest < body.node_count())) continue;
    distance = other;
    nearest = node;
  }
  if (nearest < body.node_count()) grip.hold(holder, body, nearest);
}

}  // namespace ambf::model
