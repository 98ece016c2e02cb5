// Resistive sensors: rays that resist what they meet, along the ray and across it (Alg. 11, Eq. 6.1 to 6.12; corrected
// as docs/sensors.md says). A is the sensor's body, B what a ray hits; forces act on both at one point.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

#include "math/rotation.h"
#include "model/kinds/sensor/detail/ray_reader.h"
#include "model/kinds/sensor/detail/resistance_limits.h"

namespace ambf::model {
namespace {

constexpr double kDampingStep_s = 1e-3;  // what `friction: damping` is per
constexpr std::size_t kNumbersPerElement = 15;

// How a ray holds on to what it met.
struct Anchor {
  const physics::Body* body = nullptr;  // null: to nothing
  math::Vec3 at_sensor, at_body;        // Q_A in the sensor's frame, Q_B in the body's, m
  double depth = 0.0;                   // of the last step, 0 .. 1
  math::Vec3 stretch;                   // of the last step, e_T, m
};

// n (K n) of one body at a point (Eq. 2.22): what a unit impulse along n there changes of its speed, 1/kg.
double mobility(const physics::Body* body, const math::Vec3& point, const math::Vec3& n) {
  if (body == nullptr || body->is_static() || body->frozen()) return 0.0;
  const math::Pose com = body->com_pose();
  const math::Vec3 turn = math::rotate(math::inverse(com.orientation), math::cross(point - com.position, n));
  const math::Vec3 inertia = body->inertia();
  const auto part = [](double t, double i) { return i > 0.0 ? t * t / i : 0.0; };
  return 1.0 / body->mass() + part(turn.x, inertia.x) + part(turn.y, inertia.y) + part(turn.z, inertia.z);
}

math::Vec3 across(const math::Vec3& v, const math::Vec3& n) { return v - n * math::dot(v, n); }

struct LiveResistance final : LiveSensor {
  LiveResistance(const scene::Sensor& described, const std::vector<state::SensorRay>& rays)
      : reader_(rays, RayRules::own_body_and_what_it_passes, 0),
        friction_(described.friction),
        area_m_(described.contact_area_m),
        stiffness_(described.contact_stiffness),
        damping_(described.contact_damping),
        anchors_(rays.size()) {
    effects.resize(rays.size());
    reader_.forget(hits);
  }

  void read(const LiveWorld::Impl& live, std::uint32_t slot) override { reader_.read(live, slot, hits); }
  // Lets go of what is no longer met at once, so that no anchor outlives its body.
  void refresh(const LiveWorld::Impl& live, std::uint32_t slot) override {
    reader_.refresh(live, slot, hits);
    for (std::size_t i = 0; i < anchors_.size(); ++i)
      if (anchors_[i].body != hits[i].body) anchors_[i] = {};
  }
  void forget() override { reader_.forget(hits); }
  void reset() override {
    forget();
    std::fill(anchors_.begin(), anchors_.end(), Anchor{});
    std::fill(effects.begin(), effects.end(), Effect{});
  }

  // It has a parent that is not there yet, or any more: it pushes nothing from where it happens to be.
  static bool waits_for_parent(const LiveWorld::Impl& live, std::uint32_t slot) {
    const state::SensorInfo& info = state::sensors(*live.structure)[slot];
    return info.parent_object == state::kNone && !info.parent_name.empty();
  }

  void prepare(LiveWorld::Impl& live, std::uint32_t slot) override {
    refresh(live, slot);
    if (waits_for_parent(live, slot)) return;
    for (const ElementHit& hit : hits)
      if (hit.body != nullptr) ++live.resisted[hit.body->user_index()];
  }

  void act(LiveWorld::Impl& live, std::uint32_t slot, double h_s) override {
    if (waits_for_parent(live, slot)) {
      std::fill(effects.begin(), effects.end(), Effect{});
      std::fill(anchors_.begin(), anchors_.end(), Anchor{});
      return;
    }
    const math::Pose T_world_sensor = pose_of_sensor(live, slot);
    const physics::Body* carrier = carrier_of(live, slot);
    for (std::size_t i = 0; i < hits.size(); ++i) {
      effects[i] = {};
      if (hits[i].body == nullptr) continue;
      const std::uint32_t body = hits[i].body->user_index();
      const physics::Ray& ray = reader_.ray(i);
      const math::Vec3 along = math::rotate(T_world_sensor.orientation, ray.end - ray.start);
      const Contact contact{T_world_sensor, carrier, hits[i], along, h_s, live.resisted[body]};
      CutReport::Touch cut;
      effects[i] = resist(contact, anchors_[i], cut);
      // Once, and once more when it is the first that sticks less.
      bool& reported = cut.stick_limit > 0.0 ? stick_cut_reported_ : cut_reported_;
      if (!reported && cut.elements > 0) {
        cut.sensor = slot;
        reported = live.report_cut(body, cut);
        cut_reported_ |= reported;
      }
      live.tables.bodies()[body].body->apply_force(effects[i].force_world, hits[i].point);
      if (carrier != nullptr)
        live.tables.bodies()[carrier->user_index()].body->apply_force(-effects[i].force_world, hits[i].point);
    }
  }

  void save(const LiveWorld::Impl&, std::vector<double>& numbers) const override {
    for (std::size_t i = 0; i < anchors_.size(); ++i) {
      const Anchor& anchor = anchors_[i];
      const double body = anchor.body == nullptr ? -1.0 : static_cast<double>(anchor.body->user_index());
      numbers.push_back(body);
      for (const math::Vec3& v : {anchor.at_sensor, anchor.at_body, anchor.stretch, effects[i].force_world})
        numbers.insert(numbers.end(), {v.x, v.y, v.z});
      numbers.push_back(anchor.depth);
      numbers.push_back(effects[i].slipped ? 1.0 : 0.0);
    }
  }
  // An anchor on a body that its ray does not meet is damage, or was lost since: refresh() drops it.
  void restore(const LiveWorld::Impl& live, std::span<const double> numbers) override {
    for (std::size_t i = 0; i < anchors_.size(); ++i) {
      const std::span<const double> of = numbers.subspan(i * kNumbersPerElement, kNumbersPerElement);
      const auto vector = [&](std::size_t at) { return math::Vec3{of[at], of[at + 1], of[at + 2]}; };
      effects[i] = {vector(10), of[14] == 1.0};
      anchors_[i] = {};
      if (!(of[0] >= 0.0 && of[0] < static_cast<double>(live.structure->bodies.size()))) continue;
      anchors_[i] = {live.tables.bodies()[static_cast<std::size_t>(of[0])].body.get(), vector(1), vector(4), of[13],
                     vector(7)};
      if (anchors_[i].body != hits[i].body) anchors_[i] = {};
    }
  }

 private:
  struct Contact {
    const math::Pose& T_world_sensor;
    const physics::Body* carrier;
    const ElementHit& hit;
    const math::Vec3& along;  // the ray in the world, m
    double h_s;
    std::uint32_t active;  // elements that touch the body
  };

  // The force on B; updates the anchor. `cut`: what of its friction does not count, with the elements that touch B.
  Effect resist(const Contact& c, Anchor& anchor, CutReport::Touch& cut) const {
    const double length = math::norm(c.along);
    const math::Vec3 n = c.along / length;
    const math::Vec3& point = c.hit.point;
    const math::Pose T_world_body = c.hit.body->pose();
    const double depth = 1.0 - c.hit.fraction;  // Eq. 6.5
    Effect effect;
    const bool is_new = anchor.body != c.hit.body;
    math::Vec3 stretch;
    if (!is_new) stretch = across(c.T_world_sensor * anchor.at_sensor - T_world_body * anchor.at_body, n);  // Eq. 6.3
    effect.slipped = !is_new && math::norm(stretch) > area_m_;
    const double depth_before = is_new ? depth : anchor.depth;
    math::Vec3 stretch_before = anchor.stretch;
    if (is_new || effect.slipped) {  // Eq. 6.2
      anchor.at_sensor = math::inverse(c.T_world_sensor) * point;
      anchor.at_body = math::inverse(T_world_body) * point;
      stretch = stretch_before = {};
    }
    anchor.body = c.hit.body;
    anchor.depth = depth;
    anchor.stretch = stretch;

    const double share = 0.5 / (c.h_s * c.active);  // of a mass: the damping that is stable
    const double along_n = mobility(c.carrier, point, n) + mobility(c.hit.body, point, n);
    if (along_n <= 0.0) return effect;
    const double damping_n = std::min(damping_, share * length / along_n);
    const double normal = std::max(0.0, stiffness_ * depth + damping_n * (depth - depth_before) / c.h_s);  // Eq. 6.4
    effect.force_world = n * normal;

    // Across: a spring (Eq. 6.1, 6.12) with its damping, and what resists sliding (Eq. 6.6). All are explicit, hence
    // limited to what the lightest direction bears.
    const math::Vec3 speed = c.carrier == nullptr ? -c.hit.body->velocity_at(point)
                                                  : c.carrier->velocity_at(point) - c.hit.body->velocity_at(point);
    const math::Vec3 sliding = across(speed, n);
    const auto limit_along = [&](const math::Vec3& v) {
      const math::Vec3 t = v / math::norm(v);
      return 1.0 / std::max(mobility(c.carrier, point, t) + mobility(c.hit.body, point, t), 1e-12);
    };
    if (math::norm(stretch) > 0.0) {
      const double mass = limit_along(stretch);
      const double scale = friction_.scale == scene::FrictionScale::none           ? 1.0
                           : friction_.scale == scene::FrictionScale::normal_force ? normal
                                                                                   : depth;
      const double bears = mass / (c.h_s * c.h_s * c.active);
      const double stick = std::min(friction_.stick * scale, bears);
      const double held = std::min(friction_.damping * kDampingStep_s, share * mass);
      effect.force_world += stretch * stick + (stretch - stretch_before) * (held / c.h_s);
      // Judged without what damping adds to the normal force, which is brief.
      const double rest = friction_.scale == scene::FrictionScale::normal_force ? stiffness_ * depth : scale;
      note(cut.stick, cut.stick_limit, friction_.stick, rest > 0.0 ? bears / rest : friction_.stick, c, cut);
      note(cut.damping, cut.damping_limit, friction_.damping, share * mass / kDampingStep_s, c, cut);
    }
    if (math::norm(sliding) > 0.0) {
      const double bears = share * limit_along(sliding);
      effect.force_world += sliding * std::min(friction_.slide, bears);
      note(cut.slide, cut.slide_limit, friction_.slide, bears, c, cut);
    }
    return effect;
  }

  static void note(double& given_to, double& limit_to, double given, double limit, const Contact& c,
                   CutReport::Touch& cut) {
    if (!(given > limit)) return;
    given_to = given;
    limit_to = limit;
    cut.elements = c.active;
  }

  RayReader reader_;
  scene::ResistiveFriction friction_;
  double area_m_, stiffness_, damping_;
  std::vector<Anchor> anchors_;
  bool cut_reported_ = false, stick_cut_reported_ = false;
};

std::string number_text(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", value);
  return text;
}

}  // namespace

void report_passed_limits(const scene::Sensor& sensor, const std::vector<state::SensorRay>& rays, double own_mass_kg,
                          double step_s, const scene::Identity& at, Findings& findings) {
  const auto judge = [&](const char* key, double given, double limit, const char* unit, auto add) {
    if (!(given > limit)) return;
    (findings.*add)(at, key,
                    number_text(given) + " is more than steps of " + number_text(1e3 * step_s) +
                        " ms can bear on a body of " + number_text(own_mass_kg) + " kg: at most " + number_text(limit) +
                        unit + " counts",
                    "lower it, or the fixed timestep; a lighter body that is met and further rays on it lower the "
                    "limit");
  };
  double longest = 0.0;
  for (const state::SensorRay& ray : rays) longest = std::max(longest, math::norm(ray.end - ray.start));
  // No warning: the published gains are all beyond it, and the law is defined with the limit.
  const double slowing = 0.5 * own_mass_kg / step_s;  // N s/m
  judge("contact damping", sensor.contact_damping, slowing * longest, " N s", &Findings::information);
  judge("friction: dynamic", sensor.friction.slide, slowing, " N s/m", &Findings::warning);
  judge("friction: damping", sensor.friction.damping, slowing / kDampingStep_s, " N/m", &Findings::warning);
  // By the normal force its scale has no bound of its own (damping adds to it): judged at full depth.
  const bool by_force = sensor.friction.scale == scene::FrictionScale::normal_force;
  const double scale = by_force ? sensor.contact_stiffness : 1.0;
  if (scale > 0.0)
    judge("friction: static", sensor.friction.stick, own_mass_kg / (step_s * step_s * scale),
          by_force ? " 1/m" : " N/m", &Findings::warning);
}

SensorType resistance_sensor_type() {
  SensorType row;
  row.type = state::SensorType::resistance;
  row.make = [](const scene::Sensor& described,
                const std::vector<state::SensorRay>& rays) -> std::unique_ptr<LiveSensor> {
    return std::make_unique<LiveResistance>(described, rays);
  };
  row.saved_numbers = [](const state::SensorInfo& info) { return kNumbersPerElement * info.elements; };
  return row;
}

}  // namespace ambf::model
