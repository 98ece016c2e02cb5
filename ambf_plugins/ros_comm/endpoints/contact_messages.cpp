#include "ros_comm/endpoints/contact_messages.h"

#include <vector>

#include "ros_comm/endpoints/conversions.h"

namespace ambf::ros_comm {

void fill(const state::Frame& frame, ambf_msgs::WorldContacts& message) {
  const state::Structure& structure = *frame.structure;
  fill_times(frame, message);
  message.total = frame.contacts_total;
  const std::size_t count = frame.contacts.size();
  message.names.clear();
  message.body_a.resize(count);
  message.body_b.resize(count);
  message.points.resize(count);
  message.normals.resize(count);
  message.distances.resize(count);
  message.forces.resize(count);
  std::vector<std::uint32_t> index(structure.bodies.size(), state::kNone);
  const auto index_of = [&](std::uint32_t body) {
    if (index[body] == state::kNone) {
      index[body] = static_cast<std::uint32_t>(message.names.size());
      message.names.push_back(name_of(structure, structure.bodies[body].object));
    }
    return index[body];
  };
  const double per_step = frame.run.step_s > 0.0 ? 1.0 / frame.run.step_s : 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    const state::ContactState& contact = frame.contacts[i];
    message.body_a[i] = index_of(contact.body_a);
    message.body_b[i] = index_of(contact.body_b);
    message.points[i].x = contact.point_world.x;
    message.points[i].y = contact.point_world.y;
    message.points[i].z = contact.point_world.z;
    message.normals[i] = to_ros(contact.normal_world);
    message.distances[i] = contact.distance;
    message.forces[i] = to_ros((contact.normal_world * contact.impulse + contact.friction_world) * per_step);
  }
}

}  // namespace ambf::ros_comm
