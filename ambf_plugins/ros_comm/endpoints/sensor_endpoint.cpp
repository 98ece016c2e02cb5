// Sensors on ROS: what each element senses.
#include <ambf_msgs/SensorEvent.h>
#include <ambf_msgs/SensorForces.h>
#include <sensor_msgs/PointCloud2.h>

#include <algorithm>
#include <array>
#include <memory>
#include <string>
#include <vector>

#include "ros_comm/endpoints/measuring_sensors.h"
#include "ros_comm/endpoints/object_endpoint.h"
#include "ros_comm/endpoints/sensor_messages.h"
#include "ros_comm/services/step_lists.h"

namespace ambf::ros_comm {

namespace {

constexpr std::size_t kBeyondMap = 255;

// Of a range sensor: as far as its ray reaches where there is nothing.
float measured_m(const state::SensedElement& element, float range_m) {
  return element.triggered() ? static_cast<float>(element.distance_m) : range_m;
}

// The edges of one sensor. They come from the frame's log, so that none is lost between two frames that are published
// unless the log is too short for all that happened meanwhile.
class Events {
 public:
  Events(Node& node, const std::string& topic, state::ObjectId sensor)
      : sensor_(sensor), log_(node.log()), topic_(topic), publisher_(node, topic, kEventQueueSize) {}

  bool has_subscribers() const { return publisher_.subscribers() > 0; }
  // Events before the first subscriber are discarded.
  void watch(const state::Frame& frame) {
    const state::SensorEventLog* log = state::sensor_events(frame);
    if (log != nullptr && !has_subscribers()) reader_.skip(*log);
  }
  void publish(const state::Frame& frame, std::uint32_t slot) {
    const state::SensorEventLog* log = state::sensor_events(frame);
    if (log == nullptr) return;
    reader_.read(*log, [&](const state::SensorEvent& event) {
      if (event.sensor == sensor_) publish(frame, slot, event);
    });
    if (reader_.lost() < report_from_) return;
    log_.warning(
        "%s: %llu events of sensors are lost, which came too fast: a frame has the last %zu of all sensors. "
        "Logged again at ten times as many.",
        topic_.c_str(), static_cast<unsigned long long>(reader_.lost()), state::SensorEventLog::kSize);
    report_from_ = 10 * reader_.lost();
  }

 private:
  void publish(const state::Frame& frame, std::uint32_t slot, const state::SensorEvent& event) {
    const state::Structure& structure = *frame.structure;
    const std::uint32_t object = state::find(structure, event.object);
    // What has been removed since has the name with which it was sensed.
    std::string& known = names_[static_cast<std::size_t>(event.what)];
    if (object != state::kNone || !event.object.valid()) known = name_of(structure, object);
    message_.header.stamp = stamp_of(frame);
    message_.sim_step = event.sim_step;
    message_.sim_time = event.sim_time;
    message_.what = static_cast<std::uint8_t>(event.what);
    message_.begins = event.begins ? 1 : 0;
    message_.object = known;
    message_.key = state::sensors(structure)[slot].matching_key;
    publisher_.publish(message_);
  }

  static constexpr std::uint32_t kEventQueueSize = 2 * state::SensorEventLog::kSize;

  const state::ObjectId sensor_;
  base::Log& log_;
  const std::string topic_;
  state::SensorEventReader reader_;
  std::uint64_t report_from_ = 1;     // lost events
  std::array<std::string, 3> names_;  // by SensorEvent::What
  ambf_msgs::SensorEvent message_;
  TopicPublisher<ambf_msgs::SensorEvent> publisher_;
};

void fill_forces(const state::Frame& frame, std::uint32_t slot, ambf_msgs::SensorForces& message) {
  fill_times(frame, message);
  const state::ElementRange elements = state::elements_of(frame, slot);
  message.points.resize(elements.size());
  message.forces.resize(elements.size());
  message.slipped.resize(elements.size());
  for (std::size_t i = 0; i < elements.size(); ++i) {
    message.points[i] = to_ros(elements[i].point_world);
    message.forces[i] = to_ros(elements[i].force_world);
    message.slipped[i] = elements[i].slipped ? 1 : 0;
  }
}

// What a range sensor senses, as points in its own frame.
void fill_points(const state::Frame& frame, std::uint32_t slot, sensor_msgs::PointCloud2& message) {
  const state::SensorInfo& sensor = state::sensors(*frame.structure)[slot];
  const state::ElementRange elements = state::elements_of(frame, slot);
  message.header.stamp = stamp_of(frame);
  message.header.frame_id = frame.structure->objects[sensor.object].local_name;
  message.fields.resize(3);
  for (std::uint32_t axis = 0; axis < 3; ++axis) {
    message.fields[axis].name = std::string(1, "xyz"[axis]);
    message.fields[axis].offset = 4 * axis;
    message.fields[axis].datatype = sensor_msgs::PointField::FLOAT32;
    message.fields[axis].count = 1;
  }
  message.height = 1;
  message.point_step = 12;
  message.is_dense = 1;
  message.data.clear();
  for (std::size_t i = 0; i < elements.size(); ++i) {
    if (!elements[i].triggered()) continue;
    const state::SensorRay& ray = (*sensor.rays)[i];
    const math::Vec3 along = ray.end - ray.start;
    const math::Vec3 at = ray.start + along * (elements[i].distance_m / math::norm(along));
    const float point[3] = {static_cast<float>(at.x), static_cast<float>(at.y), static_cast<float>(at.z)};
    const auto* bytes = reinterpret_cast<const std::uint8_t*>(point);
    message.data.insert(message.data.end(), bytes, bytes + sizeof point);
  }
  message.width = static_cast<std::uint32_t>(message.data.size() / message.point_step);
  message.row_step = message.width * message.point_step;
}

// Further topics: NAME/Events of a sensor that is judged, NAME/forces of one that resists, NAME/points of one that
// measures ranges.
class SensorEndpoint final : public ObjectEndpoint<SensorMessages> {
 public:
  SensorEndpoint(const EndpointParts& parts, const state::ObjectInfo& object, const std::string& topic)
      : ObjectEndpoint(parts, object, topic) {
    const std::shared_ptr<const state::Structure> structure = parts.simulation.observe.structure();
    const std::uint32_t found = state::find(*structure, object.id);
    if (found == state::kNone) return;  // it was removed meanwhile
    const state::SensorInfo& sensor = state::sensors(*structure)[structure->objects[found].slot];
    if (sensor.is_judged()) events_ = std::make_unique<Events>(parts.node, topic + "/Events", object.id);
    if (sensor.type == state::SensorType::resistance)
      forces_ = std::make_unique<StatePublisher<ambf_msgs::SensorForces>>(parts.node, topic + "/forces");
    if (sensor.type == state::SensorType::range)
      points_ = std::make_unique<StatePublisher<sensor_msgs::PointCloud2>>(parts.node, topic + "/points");
  }

  bool has_subscribers() const override {
    return ObjectEndpoint::has_subscribers() || (events_ != nullptr && events_->has_subscribers()) ||
           (forces_ != nullptr && forces_->subscribers() > 0) || (points_ != nullptr && points_->subscribers() > 0);
  }
  void watch(const state::Frame& frame, bool active) override {
    ObjectEndpoint::watch(frame, active);
    if (events_ != nullptr) events_->watch(frame);
  }
  void publish(const state::Frame& frame, std::uint32_t slot) override {
    if (ObjectEndpoint::has_subscribers()) ObjectEndpoint::publish(frame, slot);
    if (events_ != nullptr) events_->publish(frame, slot);
    if (forces_ != nullptr && forces_->subscribers() > 0) {
      fill_forces(frame, slot, forces_message_);
      forces_->publish(forces_message_);
    }
    if (points_ != nullptr && points_->subscribers() > 0) {
      fill_points(frame, slot, points_message_);
      points_->publish(points_message_);
    }
  }

 private:
  std::unique_ptr<Events> events_;
  std::unique_ptr<StatePublisher<ambf_msgs::SensorForces>> forces_;
  ambf_msgs::SensorForces forces_message_;
  std::unique_ptr<StatePublisher<sensor_msgs::PointCloud2>> points_;
  sensor_msgs::PointCloud2 points_message_;
};

std::unique_ptr<comm::Endpoint> open(const EndpointParts& parts, const state::ObjectInfo& object,
                                     const std::string& topic) {
  const std::shared_ptr<const state::Structure> structure = parts.simulation.observe.structure();
  const std::uint32_t index = state::find(*structure, object.id);
  if (index != state::kNone) {
    const state::SensorType type = state::sensors(*structure)[structure->objects[index].slot].type;
    if (auto measuring = open_measuring_sensor(type, parts, object, topic)) return measuring;
  }
  return std::make_unique<SensorEndpoint>(parts, object, topic);
}

}  // namespace

void SensorMessages::fill_names(const state::Structure& structure, std::uint32_t slot, State& message) {
  const state::SensorInfo& sensor = state::sensors(structure)[slot];
  fill_placed_names(structure, sensor, message);
  message.type.data = state::name_of(sensor.type);
  message.count = sensor.elements;
  message.range.clear();
  for (const state::SensorRay& ray : *sensor.rays)
    message.range.push_back(static_cast<float>(math::norm(ray.end - ray.start)));
  message.triggered.resize(sensor.elements);
  message.measurement.resize(sensor.elements);
  message.sensed_objects.resize(sensor.elements);
  message.sensed_objects_map.resize(sensor.elements);
}

void SensorMessages::fill(const state::Frame& frame, std::uint32_t slot, State& message) {
  const state::Structure& structure = *frame.structure;
  fill_times(frame, message);
  message.pose = to_ros(state::rows(frame, state::sensor_kind().column)[slot].T_parent_object);
  const state::ElementRange elements = state::elements_of(frame, slot);
  const bool is_range = state::sensors(structure)[slot].type == state::SensorType::range;
  // The first element that senses an object; of none, under the number of objects.
  std::vector<std::size_t> first(structure.objects.size() + 1, kBeyondMap);
  for (std::size_t i = 0; i < message.count; ++i) {
    const state::SensedElement element = i < elements.size() ? elements[i] : state::SensedElement{};
    message.triggered[i] = element.triggered() ? 1 : 0;
    message.measurement[i] =
        is_range ? measured_m(element, message.range[i]) : static_cast<float>(1.0 - element.fraction);
    const std::uint32_t object = state::sensed_object(structure, element);
    const std::size_t sensed = object == state::kNone ? structure.objects.size() : object;
    first[sensed] = std::min(first[sensed], i);
    message.sensed_objects_map[i] = static_cast<std::uint8_t>(first[sensed]);
    message.sensed_objects[i].data = name_of(structure, object);
  }
}

EndpointKind sensor_endpoint_kind() {
  static const StepListsOf<SensorMessages> lists(nullptr, nullptr, &StepResponse::sensors);
  EndpointKind kind;
  kind.open = open;
  kind.step = &lists;
  return kind;
}

}  // namespace ambf::ros_comm
