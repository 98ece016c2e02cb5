// Contact sensors: what touches their body, or is nearer to it than their threshold.
#include <array>

#include "base/limits.h"
#include "model/kinds/sensor.h"
#include "physics/proximity.h"
#include "physics/world.h"
#include "state/readings.h"

namespace ambf::model {
namespace {

struct LiveContactSensor final : LiveSensor {
  explicit LiveContactSensor(double threshold_m) : threshold_(threshold_m) {}

  // Contacts are those of the frame: nothing is kept.
  void read(const LiveWorld::Impl&, std::uint32_t) override {}
  void refresh(const LiveWorld::Impl&, std::uint32_t) override {}
  void forget() override {}

  void fill(const LiveWorld::Impl& live, std::uint32_t slot, state::Frame& frame) const override {
    std::vector<state::SensedContact>& out = state::sensed_contacts(frame);
    const auto first = static_cast<std::uint32_t>(out.size());
    if (const physics::Body* body = carrier_of(live, slot)) {
      const OwnContacts own = own_contacts(frame, body->user_index());
      const TypedTable<LiveBody> bodies = live.tables.bodies();
      for (std::uint32_t other = 0; other < bodies.size(); ++other)
        if (bodies[other].body.get() != body) add(live, *body, *bodies[other].body, frame, own, out);
    }
    state::SensorReading& reading = state::sensor_readings(frame)[slot];
    reading.first_contact = first;
    reading.contacts = static_cast<std::uint32_t>(out.size()) - first;
    auto& row = state::rows(frame, state::sensor_kind().column)[slot];
    for (std::uint32_t i = first; i < out.size(); ++i)
      if (i == first || out[i].body != out[i - 1].body) ++row.triggered;
  }

 private:
  // Of a frame's contacts: indices.
  struct OwnContacts {
    std::array<std::uint32_t, base::kMaxContactsOfASensor> index;
    std::size_t count = 0;
  };

  static OwnContacts own_contacts(const state::Frame& frame, std::uint32_t body) {
    OwnContacts own;
    for (std::uint32_t i = 0; i < frame.contacts.size() && own.count < own.index.size(); ++i)
      if (frame.contacts[i].body_a == body || frame.contacts[i].body_b == body) own.index[own.count++] = i;
    return own;
  }

  // What physics made contacts of has all its points; of others the nearest one counts.
  void add(const LiveWorld::Impl& live, const physics::Body& body, const physics::Body& other,
           const state::Frame& frame, const OwnContacts& own, std::vector<state::SensedContact>& out) const {
    if (!physics::within_reach(body, other, threshold_)) return;
    const auto room = [&] { return out.size() < out.capacity(); };
    bool found = false;
    const double per_step = 1.0 / live.physics->options().step;
    for (std::size_t i = 0; i < own.count; ++i) {
      const state::ContactState& contact = frame.contacts[own.index[i]];
      const bool is_a = contact.body_a == body.user_index();
      if ((is_a ? contact.body_b : contact.body_a) != other.user_index()) continue;
      if (contact.distance > threshold_ && contact.impulse <= 0.0) continue;
      found = true;
      const math::Vec3 on_a = contact.point_world + contact.normal_world * contact.distance;
      const math::Vec3 impulse = contact.normal_world * contact.impulse + contact.friction_world;
      const double sign = is_a ? 1.0 : -1.0;
      if (room())
        out.push_back({other.user_index(), is_a ? contact.point_world : on_a, contact.normal_world * sign,
                       contact.distance, impulse * (sign * per_step)});
    }
    if (found || !physics::may_meet(body, other)) return;
    const auto near = physics::proximity(body, other, threshold_);
    if (near && room()) out.push_back({other.user_index(), near->point_on_b, near->normal_on_b, near->distance, {}});
  }

  const double threshold_;  // m
};

}  // namespace

SensorType contact_sensor_type() {
  SensorType row;
  row.type = state::SensorType::contact;
  row.make = [](const scene::Sensor& described, const std::vector<state::SensorRay>&) -> std::unique_ptr<LiveSensor> {
    return std::make_unique<LiveContactSensor>(described.distance_threshold_m);
  };
  row.casts_rays = false;
  return row;
}

}  // namespace ambf::model
