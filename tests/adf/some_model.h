// Long: one class, a function for each kind of block.
// Descriptions at random, of what any file can say.
#pragma once

#include <cmath>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "math/rotation.h"
#include "scene/actuator.h"
#include "scene/block_kinds.h"
#include "scene/description.h"
#include "scene/ghost.h"
#include "scene/sensor.h"
#include "scene/soft_body.h"
#include "scene/task.h"
#include "scene/vehicle.h"

namespace ambf::adf::test {

using state::JointType;

// A description of any kind that a file can give; each member is its default in a third of all.
class Some {
 public:
  explicit Some(unsigned seed) : random_(seed) {}

  scene::Model model() {
    scene::Model m;
    m.name = m.file = "m.yaml";
    const std::string own = maybe() ? "/other/" : "/ambf/env/";
    m.ignore_inter_collision = maybe();
    if (maybe()) m.gravity = vector();
    if (maybe()) m.joint_erp = positive();
    if (maybe()) m.joint_cfm = positive();
    for (int i = 0, n = 1 + whole(4); i < n; ++i) m.bodies.push_back(body(i, own));
    for (int i = 0, n = whole(4); i < n; ++i) m.joints.push_back(joint(i, own));
    for (int i = 0, n = whole(3); i < n; ++i) m.cameras.push_back(camera(i, own));
    for (int i = 0, n = whole(3); i < n; ++i) m.lights.push_back(light(i, own));
    blocks(m, own);
    return m;
  }

 private:
  bool maybe() { return whole(3) != 0; }
  int whole(int below) { return static_cast<int>(random_() % static_cast<unsigned>(below)); }
  double number() { return std::ldexp(static_cast<double>(static_cast<int>(random_())), -29) + 1e-3 * whole(7); }
  double positive() { return std::abs(number()) + 1e-3; }
  double fraction() { return std::ldexp(static_cast<double>(random_()), -32); }
  math::Vec3 vector() { return {number(), number(), maybe() ? number() : 0.0}; }
  math::Pose pose() { return {vector(), math::from_rpy(number(), 0.3 * number(), number())}; }
  math::Vec3 axis() { return math::normalized(math::Vec3{number(), number(), positive()}); }
  std::string text() {
    static const char* const kTexts[] = {"plain", "two words", "a: b",     "#no comment", "quote\"d", "it's", "yes",
                                         "1.5",   "~",         "\xC3\xA9", "{x}",         "- item",   "a\\b"};
    return kTexts[whole(static_cast<int>(std::size(kTexts)))];
  }

  scene::Identity identity(const char* prefix, int i, const std::string& own) {
    scene::Identity it;
    it.identifier = prefix + text() + std::to_string(i);
    it.name = std::string(1, prefix[0]) + std::to_string(i);
    it.name_space = whole(4) == 0 ? "/else/" : own;
    it.passive = !maybe();
    if (maybe()) it.rate_low_hz = positive(), it.rate_high_hz = it.rate_low_hz + positive();
    return it;
  }

  scene::Geometry geometry() {
    scene::Geometry g;
    g.shape = static_cast<scene::Shape>(whole(6));
    g.size = {positive(), positive(), positive()};
    g.radius = positive();
    g.height = 2.0 * g.radius + positive();
    g.axis = static_cast<scene::Axis>(whole(3));
    g.normal = axis();
    g.offset = number();
    return g;
  }
  void shapes(std::vector<scene::PlacedGeometry>& to, std::vector<scene::PlacedMesh>& meshes, bool drawn) {
    const auto color = [&] { return drawn && !maybe() ? std::optional(material()) : std::nullopt; };
    for (int i = 0, n = whole(3); i < n; ++i) to.push_back({geometry(), maybe() ? pose() : math::Pose{}, color()});
    for (int i = 0, n = whole(3); i < n; ++i)
      meshes.push_back(
          {"/m/" + text() + ".stl", {}, maybe() ? vector_without_zero() : math::Vec3{1, 1, 1}, pose(), color()});
  }
  math::Vec3 vector_without_zero() { return {positive(), -positive(), positive()}; }

  scene::Material material() {
    scene::Material m;
    m.diffuse = {fraction(), fraction(), fraction()};
    m.alpha = fraction();
    if (maybe()) {  // a plain colour
      m.ambient = {0.5 * m.diffuse.r, 0.5 * m.diffuse.g, 0.5 * m.diffuse.b};
      return m;
    }
    m.specular = {fraction(), fraction(), fraction()};
    m.emission = {fraction(), fraction(), fraction()};
    m.shininess = static_cast<unsigned>(whole(100));
    m.metallic = maybe() ? fraction() : 0.0;
    return m;
  }

  scene::ChannelGains gains(scene::ControllerOutput output) {
    scene::ChannelGains g;
    g.p = vector(), g.i = vector(), g.d = maybe() ? vector() : math::Vec3{number(), 0, 0};
    g.output = output;
    return g;
  }

  scene::Body body(int i, const std::string& own) {
    scene::Body b;
    b.identity = identity("BODY ", i, own);
    shapes(b.visual.shapes, b.visual.meshes, true);
    shapes(b.collision.shapes, b.collision.meshes, false);
    const bool drawn = b.visual.shapes.size() + b.visual.meshes.size() > 0;
    const bool collides = b.collision.shapes.size() + b.collision.meshes.size() > 0;
    if (!collides && maybe()) b.collision.mesh_file = "/m/c.stl";
    if (!drawn && (collides || !b.collision.mesh_file.empty()) && maybe()) b.visual.mesh_file = "/m/v.stl";
    b.collision.mesh_type = static_cast<scene::CollisionMeshType>(whole(4));
    if (maybe()) b.collision.offset = pose();
    if (maybe()) b.collision.margin = positive();
    for (int k = 0, n = whole(3); k < n; ++k) b.collision.groups.push_back(k * 7);
    if (maybe()) b.scale = b.visual.scale = b.collision.scale = positive();
    b.visual.visible = maybe();
    if (maybe()) b.visual.material = material();
    b.mass = maybe() ? positive() : 0.0;
    if (maybe()) b.inertia = math::Vec3{positive(), positive(), positive()};
    if (maybe()) b.inertial_offset = pose();
    if (maybe()) b.gravity = vector();
    if (maybe()) b.T_world_body = pose();
    if (maybe()) b.surface = {positive(), positive(), fraction(), fraction(), fraction()};
    const auto output = static_cast<scene::ControllerOutput>(whole(3));
    if (maybe()) b.linear = gains(output), b.angular = gains(output);
    if (whole(5) == 0) b.linear = gains(scene::ControllerOutput::force), b.angular = {};
    b.hold = !maybe();
    b.publish_children_names = !maybe();
    b.publish_joint_names = maybe();
    return b;
  }

  scene::Joint joint(int i, const std::string& own) {
    scene::Joint j;
    j.identity = identity("JOINT ", i, own);
    j.parent = "BODY " + text(), j.child = "BODY other " + text();
    j.type = static_cast<JointType>(whole(9));
    j.parent_pivot = vector(), j.child_pivot = vector();
    j.parent_axis = axis(), j.child_axis = axis();
    if (maybe()) j.child_offset = number();
    if (maybe()) j.joint_offset = number();
    const bool one_axis = j.type == JointType::revolute || j.type == JointType::prismatic ||
                          j.type == JointType::linear_spring || j.type == JointType::torsion_spring;
    if (one_axis && maybe()) j.limits = {-positive(), positive()};
    if (j.type == JointType::cone_twist && maybe()) j.cone_limits = {positive(), positive(), positive()};
    if (j.type == JointType::six_dof || j.type == JointType::six_dof_spring)
      j.six_dof = {{-1, -2, -3}, vector_without_sign(), {-1, -1, -number() - 9}, vector_without_sign()};
    if (j.type == JointType::six_dof_spring) {
      j.spring = {vector_without_sign(), vector_without_sign(), vector(), vector(),
                  vector_without_sign(), vector_without_sign()};
    } else {
      if (maybe()) j.damping = positive();
      if (maybe()) j.stiffness = positive();
      if (maybe()) j.equilibrium = number();
    }
    j.controller.output = static_cast<scene::ControllerOutput>(whole(3));
    if (maybe()) j.controller.p = number(), j.controller.i = number();
    if (maybe()) j.max_motor_impulse = positive();
    j.enable_motor = maybe(), j.enable_feedback = !maybe();
    if (maybe()) j.erp = positive();
    if (maybe()) j.cfm = positive();
    j.ignore_inter_collision = maybe(), j.hold = !maybe();
    if (one_axis && maybe()) j.mimic = {"JOINT " + text(), number(), maybe() ? number() : 0.0};
    return j;
  }
  math::Vec3 vector_without_sign() { return {positive(), positive(), positive()}; }

  scene::Camera camera(int i, const std::string& own) {
    scene::Camera c;
    c.identity = identity("CAMERA ", i, own);
    if (maybe()) c.parent = "BODY " + text();
    c.location = vector();
    c.look_at = c.location + math::Vec3{1, number(), 0.1};
    if (maybe()) c.up = {0.1, 0, 1};
    if (maybe()) c.lens.near_m = 0.01 * positive(), c.lens.far_m = 10.0 + positive();
    if (maybe()) c.lens.field_of_view_rad = 0.1 + fraction();
    if (!maybe()) c.lens.orthographic = true, c.lens.orthographic_width_m = positive();
    if (!maybe()) c.lens.stereo = true;
    if (!maybe()) c.lens.optics = {0.5 + fraction(), fraction() - 0.5, fraction() - 0.5, 0.1 * fraction()};
    if (maybe()) c.lens.eye_separation_m = positive(), c.lens.focal_length_m = positive();
    if (maybe()) c.controlling_devices = {text(), "MTM R"};
    c.monitor = static_cast<unsigned>(whole(3));
    c.visible = maybe();
    c.image = {.on = maybe(), .interval = 1 + static_cast<unsigned>(whole(5)), .width = 320, .height = 200};
    c.depth.on = maybe();
    if (!maybe()) c.depth_noise = {.on = true, .mean = number(), .std_dev = positive(), .bias = number()};
    c.multipass = maybe();
    if (maybe()) c.mouse = {number(), number(), 1.0, number()};
    return c;
  }

  scene::Light light(int i, const std::string& own) {
    scene::Light l;
    l.identity = identity("LIGHT ", i, own);
    if (maybe()) l.parent = text();
    if (maybe()) l.location = vector();
    l.direction = axis();
    if (maybe()) l.beam.spot_exponent = positive(), l.beam.cutoff_angle_rad = fraction() + 0.1;
    if (maybe()) l.beam.attenuation_linear = positive();
    l.beam.shadow_quality = whole(6);
    return l;
  }

  void blocks(scene::Model& m, const std::string& own) {
    for (const scene::Body& body : std::vector<scene::Body>(m.bodies))
      if (whole(4) == 0) m.blocks.push_back(surface(body));
    const auto add = [&](const scene::BlockKind& kind, const char* prefix, auto make) {
      for (int i = 0, n = whole(3); i < n; ++i) {
        scene::KindBlock block{&kind, identity(prefix, i, own), {}};
        using Description = decltype(make(block));
        block.description = std::make_shared<const Description>(make(block));
        m.blocks.push_back(std::move(block));
      }
    };
    // In the order in which a file's blocks are read.
    for (const scene::BlockKind* kind : scene::block_kinds()) {
      if (kind == &scene::kind::kGhostObject) add(*kind, "GHOST ", [this](auto&) { return ghost(); });
      if (kind == &scene::kind::kSensor) add(*kind, "SENSOR ", [this](auto&) { return sensor(); });
      if (kind == &scene::kind::kActuator) add(*kind, "ACTUATOR ", [this](auto&) { return actuator(); });
      if (kind == &scene::kind::kSoftBody) add(*kind, "SOFT ", [this](auto&) { return soft_body(); });
      if (kind == &scene::kind::kTask) add(*kind, "TASK ", [this](auto&) { return task(); });
      if (kind == &scene::kind::kVehicle)
        add(*kind, "VEHICLE ", [&](const scene::KindBlock& block) { return vehicle(block, m.bodies); });
    }
  }

  scene::KindBlock surface(const scene::Body& body) {
    scene::Sensor s;
    s.type = state::SensorType::resistance;
    s.parent = body.identity.identifier;
    rays_of_mesh(s);
    s.range_m = positive();
    s.contact_area_m = positive(), s.contact_stiffness = positive(), s.contact_damping = positive();
    s.visible = maybe(), s.visible_size_m = positive();
    s.friction = {positive(), positive(), positive(), static_cast<scene::FrictionScale>(whole(3))};
    s.mesh_scale = body.scale;
    scene::KindBlock block{&scene::kind::kSensor, body.identity, std::make_shared<const scene::Sensor>(s)};
    block.identity.identifier += " resistive surface";
    block.identity.name += "_resistive_surface";
    return block;
  }
  void rays_of_mesh(scene::Sensor& s) {
    s.mesh_files = {"/m/" + text() + ".obj"};
    s.placement = {maybe(), !maybe(), !maybe()};
    if (!s.placement.edges && !s.placement.vertices) s.placement.faces = true;
    s.depth_m = positive();
    if (!maybe()) s.wrap = {{"/m/onto " + text() + ".obj"}, maybe() ? positive() : 0.0};
  }

  scene::Sensor sensor() {
    scene::Sensor s;
    s.type = static_cast<state::SensorType>(whole(6));
    if (maybe()) s.parent = "BODY " + text();
    if (maybe()) s.T_parent_sensor = pose();
    if (maybe()) s.range_m = positive();
    const bool rays = s.type == state::SensorType::proximity || s.type == state::SensorType::resistance ||
                      s.type == state::SensorType::range;
    const int kind = whole(3);
    if (rays && kind == 0)
      for (int i = 0, n = 1 + whole(3); i < n; ++i) s.array.push_back({vector(), axis()});
    if (rays && kind == 1) rays_of_mesh(s);
    if (rays && kind == 2) s.parametric = {2 + whole(60), positive(), positive(), maybe() ? positive() : 0.0};
    if (s.type == state::SensorType::force_torque) s.joint = "JOINT " + text();
    if (maybe()) s.visible = true, s.visible_size_m = positive();
    if (maybe()) s.matching_key = text();
    if (rays && !s.matching_key.empty()) s.success_when = static_cast<state::SuccessWhen>(whole(4));
    if (maybe()) s.hold_s = positive();
    if (!maybe()) s.range_noise = {.on = true, .mean = number(), .std_dev = positive(), .bias = number()};
    if (maybe()) s.noise_seed = whole(1000);
    if (maybe()) s.friction = {positive(), positive(), positive(), static_cast<scene::FrictionScale>(whole(3))};
    if (maybe()) s.contact_area_m = positive(), s.contact_stiffness = positive(), s.contact_damping = positive();
    if (maybe()) s.distance_threshold_m = positive(), s.contact_details = false;
    if (maybe()) s.noise = {positive(), positive()};
    if (maybe()) s.rays_per_step = whole(50);
    return s;
  }

  scene::Actuator actuator() {
    scene::Actuator a;
    a.type = static_cast<state::ActuatorType>(whole(2));
    a.parent = "BODY " + text(), a.sensor = "SENSOR " + text();
    if (maybe()) a.T_parent_actuator = pose();
    if (maybe()) a.visible = true, a.visible_size_m = positive();
    if (maybe()) a.max_impulse = positive(), a.tau = positive();
    a.trigger = static_cast<state::Trigger>(whole(3));
    if (a.trigger == state::Trigger::jaw) a.jaw = "BODY jaw " + text(), a.below = fraction();
    if (maybe()) a.hardness = positive(), a.damping = positive();
    if (maybe()) a.strength_N = positive(), a.range_m = positive();
    if (whole(3) != 0) return a;
    a.type = state::ActuatorType::needle;
    a.trigger = state::Trigger::command;
    a.sensor.clear(), a.jaw.clear(), a.below = 0.5;
    a.arc = {{positive(), number(), 0.0}, {0.0, number(), positive()}, {-1.0, 0.0, number()}};
    a.puncture_force = positive(), a.needle_friction = positive(), a.strength_N = positive();
    return a;
  }

  template <class Object>
  void looks(Object& object) {
    shapes(object.visual.shapes, object.visual.meshes, true);
    shapes(object.collision.shapes, object.collision.meshes, false);
    if (maybe()) object.visual.scale = object.collision.scale = positive();
    object.visual.visible = maybe();
    if (maybe()) object.visual.material = material();
    if (maybe()) object.collision.groups = {3, whole(900) + 4};
  }

  scene::Ghost ghost() {
    scene::Ghost g;
    looks(g);
    if (maybe()) g.parent = "BODY " + text(), g.T_parent_ghost = pose();
    if (maybe()) g.drag = fraction();
    return g;
  }

  scene::SoftBody soft_body() {
    scene::SoftBody s;
    looks(s);
    if (maybe()) s.mass = positive();
    if (maybe()) s.T_model_body = pose();
    if (maybe()) s.config.kLST = fraction(), s.config.kDP = fraction(), s.config.kPR = number();
    if (maybe()) s.config.timescale = positive(), s.config.viterations = whole(20), s.config.flags = 0x11;
    if (maybe()) s.config.bending_distance = whole(5), s.config.clusters = whole(30);
    for (int i = 0, n = whole(4); i < n; ++i) s.config.fixed_nodes.push_back(whole(500));
    s.randomize_constraints = !maybe();
    s.is_tissue = !maybe();
    if (!s.is_tissue) return s;
    if (maybe()) s.tissue.young = 1000.0 * positive(), s.tissue.poisson = 0.49 * fraction();
    if (maybe()) s.tissue.density = 1000.0 * positive(), s.tissue.element_size = positive();
    if (maybe()) s.tissue.relaxation = {0.1 + 0.8 * fraction(), positive()}, s.tissue.friction = positive();
    if (maybe()) s.tissue.kind = scene::TissueKind::sheet, s.tissue.thickness = positive();
    if (maybe()) s.tissue.touches = maybe() ? scene::TissueTouches::others : scene::TissueTouches::none;
    if (maybe()) {
      s.tissue.kind = scene::TissueKind::thread, s.tissue.radius = positive();
      for (int i = 0; i < 3; ++i) s.tissue.points.push_back({positive() + i, number(), number()});
    }
    for (int i = 0, n = whole(3); i < n; ++i) {
      scene::TissueRegion r;
      const int shape = whole(3);
      if (shape == 0) r.box = math::Vec3{positive(), positive(), positive()};
      if (shape == 1) r.sphere = positive();
      if (shape == 2) r.vertices = {whole(9), 10 + whole(9)};
      if (maybe()) r.location = pose();
      r.fixed = !maybe(), r.stiffness = positive();
      if (maybe()) r.density = positive(), r.attach_to = "BODY " + text();
      s.tissue.regions.push_back(std::move(r));
    }
    return s;
  }

  scene::Vehicle vehicle(const scene::KindBlock& block, std::vector<scene::Body>& bodies) {
    scene::Vehicle v;
    v.parent = "BODY chassis";
    for (int i = 0, n = 1 + whole(4); i < n; ++i) {
      scene::Wheel w;
      w.body = "BODY wheel " + std::to_string(i);
      w.radius_m = positive(), w.rest_length_m = positive(), w.connection = vector();
      if (maybe()) w.width_m = positive(), w.friction = positive(), w.stiffness = positive();
      if (maybe()) w.damping = positive(), w.compression = positive(), w.roll_influence = fraction();
      if (maybe()) w.down = {0, 0.6, -0.8}, w.axle = {1, 0, 0};
      w.front = maybe();
      if (maybe()) w.steering_low = -fraction(), w.steering_high = fraction();
      if (maybe()) w.max_drive_N = positive(), w.max_brake_N = positive();
      if (!maybe()) {
        w.mesh = "/m/" + text() + ".obj";
        scene::Body drawn;
        drawn.identity = block.identity;
        w.body = drawn.identity.identifier = "WHEEL " + std::to_string(i) + " of " + block.identity.name;
        drawn.identity.name = "wheel" + std::to_string(i) + "_of_" + block.identity.name;
        drawn.identity.passive = true;
        drawn.mass = 0.0;
        drawn.visual.mesh_file = w.mesh;
        bodies.push_back(std::move(drawn));
      }
      v.wheels.push_back(std::move(w));
    }
    return v;
  }

  scene::Task task() {
    scene::Task t;
    if (maybe()) t.parent = "BODY " + text(), t.T_parent_task = pose();
    t.order = static_cast<state::TaskOrder>(whole(2));
    if (maybe()) t.drop_height_m = positive();
    t.holders = {"BODY left " + text(), "BODY right " + text()};
    if (maybe()) t.avoid = {"BODY " + text()};
    for (int i = 0, n = 1 + whole(3); i < n; ++i) {
      scene::TaskGoal g;
      g.name = text() + std::to_string(i);
      g.pieces = {"BODY piece " + text(), "BODY other " + text()};
      if (maybe()) g.piece = g.pieces.front(), g.pieces = {g.piece};
      if (maybe()) g.point = vector(), g.place = "BODY place", g.T_place_goal = pose();
      g.sensor = maybe() ? "SENSOR " + text() : "";
      if (g.sensor.empty() || maybe()) g.tolerance_m = vector_without_sign();
      if (maybe()) g.angle_tolerance_rad = positive();
      if (g.angle_tolerance_rad && maybe()) g.axis = axis(), g.either_way = maybe();
      if (maybe()) g.hold_s = positive(), g.released = maybe(), g.hand_over = !maybe();
      if (!maybe()) g.held_by = t.holders.back();
      t.goals.push_back(std::move(g));
    }
    return t;
  }

  std::mt19937 random_;
};

}  // namespace ambf::adf::test
