// Scenes with resistive sensors, as text: what resistance_test.cpp and touch_benchmark.cpp share.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "math/rotation.h"
#include "state/sensors.h"
#include "tests/adf/support.h"
#include "tests/model/rig.h"

namespace ambf::model::test {

inline constexpr double kGravity = 9.81;

// What a test changes of a sensor.
struct Numbers {
  double stick = 0.0, damping = 0.0, slide = 0.0, area = 0.001, stiffness = 1.0, contact_damping = 0.0, range = 0.02;
  const char* variable = "true";
};

inline std::string vector(const math::Vec3& v) {
  std::ostringstream text;
  text.precision(17);
  text << "{x: " << v.x << ", y: " << v.y << ", z: " << v.z << "}";
  return text.str();
}

// A sensor on `parent` whose rays begin at `starts`, all along `direction`.
inline std::string sensor(const std::string& name, const std::string& parent, const std::vector<math::Vec3>& starts,
                          const math::Vec3& direction, const Numbers& n) {
  std::ostringstream text;
  text.precision(17);
  text << "SENSOR " << name << ": {name: " << name << ", type: Resistance, parent: BODY " << parent
       << ", range: " << n.range << ", contact area: " << n.area << ", contact stiffness: " << n.stiffness
       << ", contact damping: " << n.contact_damping << ", friction: {static: " << n.stick << ", damping: " << n.damping
       << ", dynamic: " << n.slide << ", variable: " << n.variable << "}, array: [";
  for (const math::Vec3& start : starts)
    text << "{offset: " << vector(start) << ", direction: " << vector(direction) << "}, ";
  return text.str() + "]}\n";
}

inline std::string box(const std::string& name, double mass, const math::Vec3& at, const math::Vec3& size,
                       const std::string& more = {}) {
  std::ostringstream text;
  text.precision(17);
  text << "BODY " << name << ": {name: " << name << ", mass: " << mass << ", location: {position: " << vector(at)
       << "}, collision shape: BOX, collision geometry: " << vector(size)
       << ", friction: {static: 0, rolling: 0}, damping: {linear: 0, angular: 0}" << more << "}\n";
  return text.str();
}

struct ResistiveWorld {
  ResistiveWorld(const std::string& text, const std::string& sensors, const math::Vec3& gravity = {},
                 double step_s = 0.001, bool sleeping = true)
      : rig(gravity, step_s, sleeping) {
    std::string bodies;
    for (std::size_t at = text.find("BODY "); at != std::string::npos; at = text.find("\nBODY ", at + 1)) {
      const std::size_t begin = text[at] == '\n' ? at + 1 : at;
      bodies += (bodies.empty() ? "" : ", ") + text.substr(begin, text.find(':', begin) - begin);
    }
    const adf::ModelResult read = adf::parse_model(
        "namespace: /test/\nbodies: [" + bodies + "]\nsensors: [" + sensors + "]\n" + text, "resistance.yaml");
    EXPECT_FALSE(base::has_errors(read.diagnostics)) << text;
    EXPECT_TRUE(rig.load(*read.model).success);
  }
  state::ElementRange elements(const std::string& name) const {
    return state::elements_of(*rig.frame, rig.slot(name, state::sensor_kind().kind));
  }
  math::Vec3 force(const std::string& name) const {
    math::Vec3 sum;
    for (const state::SensedElement& element : elements(name)) sum += element.force_world;
    return sum;
  }
  math::Vec3 at(const std::string& body) const { return rig.body(body).T_world_body.position; }
  // From none to all of it, slowly: nothing swings.
  void load_slowly(const math::Vec3& gravity, double seconds) {
    const int steps = static_cast<int>(std::lround(seconds / rig.h_s));
    for (int i = 1; i <= steps; ++i) {
      rig.live->set_gravity(gravity * (static_cast<double>(i) / steps));
      rig.step(1);
    }
  }
  Rig rig;
};

// Rays on a rectangle of `width`, at the height z.
inline std::vector<math::Vec3> grid(int nx, int ny, double width, double z) {
  std::vector<math::Vec3> points;
  for (int i = 0; i < nx; ++i)
    for (int j = 0; j < ny; ++j) points.push_back({width * ((i + 0.5) / nx - 0.5), width * ((j + 0.5) / ny - 0.5), z});
  return points;
}

// BENCHMARKS 6.9, Table 6.2: two jaws hold an object with no friction of Bullet's.
struct ResistiveGrasp {
  ResistiveGrasp(int elements, double mass, double share, double off_centre = 0.0) {
    // Of the rays on each side, their normal force for `share` of the weight: stick * area is 1.
    const double normal = share * mass * kGravity / elements;
    Numbers n{.stick = 1000.0, .damping = 0.1, .slide = 0.5, .area = 0.001, .stiffness = 1.0, .contact_damping = 5.0};
    n.stiffness = normal / 0.5;
    std::vector<math::Vec3> left = grid(elements / 2, 1, 0.08, 0.0), right;
    for (math::Vec3& p : left) {
      p = {0.05, p.x, off_centre};
      right.push_back({-0.05, p.y, off_centre});
    }
    world.emplace(box("l", 0.0, {-0.11, 0, 0}, {0.1, 0.1, 0.1}) + box("r", 0.0, {0.11, 0, 0}, {0.1, 0.1, 0.1}) +
                      box("b", mass, {0, 0, 0}, {0.1, 0.1, 0.1}) + sensor("sl", "l", left, {1, 0, 0}, n) +
                      sensor("sr", "r", right, {-1, 0, 0}, n),
                  "SENSOR sl, SENSOR sr");
  }
  double drop(double seconds) {
    world->load_slowly({0, 0, -kGravity}, 0.5);
    world->rig.step(static_cast<int>(seconds * 1000));
    return -world->at("b").z;
  }
  std::optional<ResistiveWorld> world;
};

}  // namespace ambf::model::test
