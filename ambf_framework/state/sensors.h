// Sensors as all threads see them: their rows of a structure and of a frame. A sensor has one element or more (rays);
// what each senses is a row of the column of elements, in the order of the sensors and their elements. Plain data,
// read by any thread. C++17.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "base/limits.h"
#include "state/kind_rows.h"

namespace ambf::state {

// As files spell them: `type` of a sensor block.
enum class SensorType : std::uint8_t { proximity, resistance, range, contact, imu, force_torque };
const char* name_of(SensorType type);

// In the sensor's frame, m.
struct SensorRay {
  math::Vec3 start, end;
};

// When a sensor's task is done.
enum class SuccessWhen : std::uint8_t {
  never,    // it has none
  matched,  // it and a sensor of the same key sense each other's bodies
  present,  // it senses something
  absent    // it senses nothing
};

struct SensorInfo : PlacedInfo {
  SensorType type = SensorType::proximity;
  // One an element; null: the sensor casts no rays.
  std::shared_ptr<const std::vector<SensorRay>> rays;
  // Triangles of elements: the surface through what they sense, counter-clockwise seen from where the rays point. Null
  // or empty: they lie on none.
  std::shared_ptr<const std::vector<std::array<std::uint32_t, 3>>> skin;
  std::uint32_t first_element = 0, elements = 0;  // rows of the column of elements
  bool contact_details = true;                    // Contact: points, not names alone
  std::uint32_t joint = kNone;                    // Force Torque: slot of the joint; kNone: it is gone
  bool visible = false;                           // drawn also while the layer of sensors is off
  double visible_size_m = 0.02;
  std::string matching_key;  // empty: none
  SuccessWhen success_when = SuccessWhen::never;
  double hold_s = 0.0;  // how long the condition holds before it is a success

  bool is_judged() const { return !matching_key.empty() || success_when != SuccessWhen::never; }
};

struct SensorState : PlacedState {
  std::uint64_t triggered = 0;  // elements that sense something
  bool matched = false, success = false;
  double success_since_s = 0.0;  // simulated time; 0 without success
};

// That something began or ended at a sensor which is judged (SensorInfo::is_judged).
struct SensorEvent {
  enum class What : std::uint8_t { sensed, matched, success };
  ObjectId sensor, object;  // what it senses or is matched with; not valid: nothing
  std::uint32_t sim_step = 0;
  double sim_time = 0.0;  // s
  What what = What::sensed;
  bool begins = false;
};

// The last events of all sensors; event number i (from 0) is at i % size. What a reader finds overwritten, since more
// came between two frames that it read, SensorEventReader counts.
struct SensorEventLog {
  static constexpr std::size_t kSize = base::kMaxSensorEvents;
  std::uint64_t total = 0;  // since the world was made
  std::array<SensorEvent, kSize> last;
};

// Reads each event once, from frame to frame.
class SensorEventReader {
 public:
  void skip(const SensorEventLog& log) { next_ = log.total; }
  // Calls `each` with every event since the last call. A log that is older than what was read has none.
  template <class Each>
  void read(const SensorEventLog& log, Each&& each) {
    if (log.total <= next_) return;
    if (log.total - next_ > SensorEventLog::kSize) {
      lost_ += log.total - next_ - SensorEventLog::kSize;
      next_ = log.total - SensorEventLog::kSize;
    }
    for (; next_ < log.total; ++next_) each(log.last[next_ % SensorEventLog::kSize]);
  }
  // Events that were overwritten before they were read.
  std::uint64_t lost() const { return lost_; }

 private:
  std::uint64_t next_ = 0, lost_ = 0;
};

// What one element senses. World frame; the values of the last reading.
struct SensedElement {
  std::uint32_t body = kNone;            // slot among bodies; kNone: it senses none
  std::uint32_t soft_body = kNone;       // slot among soft bodies; kNone: it senses none
  std::int32_t triangle = -1;            // of a triangle mesh, or the face of a soft body (SoftShape::faces); else -1
  double fraction = 1.0;                 // of the ray, 0 .. 1; 1: not triggered
  double distance_m = 0.0;               // from the ray's start; not triggered: the ray's length
  math::Vec3 point_world, normal_world;  // normal of the surface, unit; zero when not triggered
  // Resistance: what acted on the body in the last step, N, at the point; and whether it slipped in it.
  math::Vec3 force_world;
  bool slipped = false;

  bool triggered() const { return body != kNone || soft_body != kNone; }
};

template <class Visit>
void visit_computed(SensorState& row, Visit& visit) {
  visit(row.T_parent_object), visit(row.T_world_object);
  visit(row.success_since_s);
}
template <class Visit>
void visit_computed(SensedElement& row, Visit& visit) {
  visit(row.fraction), visit(row.distance_m);
  visit(row.point_world), visit(row.normal_world), visit(row.force_world);
}

// A sensor obeys no command: one only raises its publishing rate, as for every object.
struct SensorCommand {};

const PlacedKind<SensorState>& sensor_kind();

const std::vector<SensorInfo>& sensors(const Structure& structure);

// What an element senses, as an index into Structure::objects; kNone: nothing.
std::uint32_t sensed_object(const Structure& structure, const SensedElement& element);

// The elements of a sensor, begin and end; both null where the frame has none (a diverged world, new structure).
struct ElementRange {
  const SensedElement* first = nullptr;
  const SensedElement* last = nullptr;
  const SensedElement* begin() const { return first; }
  const SensedElement* end() const { return last; }
  std::size_t size() const { return static_cast<std::size_t>(last - first); }
  const SensedElement& operator[](std::size_t i) const { return first[i]; }
};
ElementRange elements_of(const Frame& frame, std::uint32_t sensor_slot);

// All rows, for the physics thread to fill.
std::vector<SensedElement>& sensed_elements(Frame& frame);

// Null where no sensor is judged.
const SensorEventLog* sensor_events(const Frame& frame);
SensorEventLog* sensor_events(Frame& frame);

}  // namespace ambf::state
