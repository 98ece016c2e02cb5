// Compares descriptions.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "math/rotation.h"
#include "scene/actuator.h"
#include "scene/description.h"
#include "scene/ghost.h"
#include "scene/sensor.h"
#include "scene/soft_body.h"
#include "scene/task.h"
#include "scene/vehicle.h"

namespace ambf::adf::test {

constexpr double kDigit = 1e-14;  // of angles, axes and directions, which are not written as they are kept

// Equality by members, apart from the table that writer and parser share.
struct Same {
  std::string where;
  template <class T>
  void exact(const T& a, const T& b, const char* member) const {
    EXPECT_TRUE(a == b) << where << " " << member;
  }
  void turned(const math::Quat& a, const math::Quat& b, const char* member) const {
    EXPECT_LT(math::norm(math::log(math::inverse(a) * b)), kDigit) << where << " " << member;
  }
  void pose(const math::Pose& a, const math::Pose& b, const char* member) const {
    exact(a.position, b.position, member);
    turned(a.orientation, b.orientation, member);
  }
  void pose(const std::optional<math::Pose>& a, const std::optional<math::Pose>& b, const char* member) const {
    ASSERT_EQ(a.has_value(), b.has_value()) << where << " " << member;
    if (a) pose(*a, *b, member);
  }
  void direction(const math::Vec3& a, const math::Vec3& b, const char* member) const {
    EXPECT_LT(math::norm(a - b), kDigit) << where << " " << member;
  }
  void color(const scene::Color& a, const scene::Color& b, const char* member) const {
    exact(a.r, b.r, member), exact(a.g, b.g, member), exact(a.b, b.b, member);
  }
  void material(const std::optional<scene::Material>& a, const std::optional<scene::Material>& b) const {
    ASSERT_EQ(a.has_value(), b.has_value()) << where;
    if (!a) return;
    color(a->diffuse, b->diffuse, "diffuse"), color(a->ambient, b->ambient, "ambient");
    color(a->specular, b->specular, "specular"), color(a->emission, b->emission, "emission");
    exact(a->alpha, b->alpha, "alpha"), exact(a->shininess, b->shininess, "shininess");
    exact(a->metallic, b->metallic, "metallic");
  }
  // In files intrinsics are pixels, not ratios.
  void lens(state::Lens a, const state::Lens& b) const {
    state::Optics &p = a.optics, q = b.optics;
    if (!(p == state::Optics{})) {
      constexpr double kPixels = 1e-13;
      EXPECT_NEAR(p.focal_ratio, q.focal_ratio, kPixels) << where;
      EXPECT_NEAR(p.axis_right, q.axis_right, kPixels) << where;
      EXPECT_NEAR(p.axis_down, q.axis_down, kPixels) << where;
      EXPECT_NEAR(p.skew, q.skew, kPixels) << where;
      EXPECT_NEAR(a.field_of_view_rad, b.field_of_view_rad, kPixels) << where;
      p = q, a.field_of_view_rad = b.field_of_view_rad;
    }
    exact(a, b, "lens");
  }
  void identity(const scene::Identity& a, const scene::Identity& b) const {
    exact(a.identifier, b.identifier, "identifier"), exact(a.name, b.name, "name");
    exact(a.name_space, b.name_space, "namespace"), exact(a.passive, b.passive, "passive");
    exact(a.rate_low_hz, b.rate_low_hz, "low"), exact(a.rate_high_hz, b.rate_high_hz, "high");
  }
  void shapes(const std::vector<scene::PlacedGeometry>& a, const std::vector<scene::PlacedGeometry>& b) const {
    ASSERT_EQ(a.size(), b.size()) << where;
    for (std::size_t i = 0; i < a.size(); ++i) {
      const scene::Geometry &g = a[i].geometry, &h = b[i].geometry;
      using scene::Shape;
      exact(g.shape, h.shape, "shape");
      pose(a[i].offset, b[i].offset, "offset"), material(a[i].material, b[i].material);
      if (g.shape == Shape::box) exact(g.size, h.size, "size");
      if (g.shape != Shape::box && g.shape != Shape::plane) exact(g.radius, h.radius, "radius");
      if (g.shape == Shape::plane) direction(g.normal, h.normal, "normal"), exact(g.offset, h.offset, "distance");
      if (g.shape == Shape::cylinder || g.shape == Shape::cone || g.shape == Shape::capsule)
        exact(g.height, h.height, "height"), exact(g.axis, h.axis, "axis");
    }
  }
  void meshes(const std::vector<scene::PlacedMesh>& a, const std::vector<scene::PlacedMesh>& b) const {
    ASSERT_EQ(a.size(), b.size()) << where;
    for (std::size_t i = 0; i < a.size(); ++i) {
      exact(a[i].file, b[i].file, "mesh"), exact(a[i].scale, b[i].scale, "scale");
      pose(a[i].offset, b[i].offset, "offset"), material(a[i].material, b[i].material);
    }
  }
  void gains(const scene::ChannelGains& a, const scene::ChannelGains& b, const char* member) const {
    exact(a.p, b.p, member), exact(a.i, b.i, member), exact(a.d, b.d, member), exact(a.output, b.output, member);
  }
  void operator()(const scene::Body& a, const scene::Body& b) const {
    identity(a.identity, b.identity);
    shapes(a.visual.shapes, b.visual.shapes), meshes(a.visual.meshes, b.visual.meshes);
    shapes(a.collision.shapes, b.collision.shapes), meshes(a.collision.meshes, b.collision.meshes);
    exact(a.visual.mesh_file, b.visual.mesh_file, "mesh"), exact(a.visual.visible, b.visual.visible, "visible");
    exact(a.collision.mesh_file, b.collision.mesh_file, "collision mesh");
    exact(a.collision.mesh_type, b.collision.mesh_type, "mesh type");
    exact(a.collision.margin, b.collision.margin, "margin"), exact(a.collision.groups, b.collision.groups, "groups");
    pose(a.collision.offset, b.collision.offset, "collision offset");
    exact(a.scale, b.scale, "scale"), exact(a.visual.scale, b.visual.scale, "scale");
    material(a.visual.material, b.visual.material);
    exact(a.mass, b.mass, "mass"), exact(a.inertia, b.inertia, "inertia"), exact(a.gravity, b.gravity, "gravity");
    pose(a.inertial_offset, b.inertial_offset, "inertial offset"), pose(a.T_world_body, b.T_world_body, "location");
    gains(a.linear, b.linear, "linear"), gains(a.angular, b.angular, "angular");
    const scene::Surface &s = a.surface, &t = b.surface;
    exact(s.friction, t.friction, "friction"), exact(s.rolling_friction, t.rolling_friction, "rolling");
    exact(s.restitution, t.restitution, "restitution"), exact(s.linear_damping, t.linear_damping, "damping");
    exact(s.angular_damping, t.angular_damping, "damping"), exact(a.hold, b.hold, "hold");
    exact(a.publish_children_names, b.publish_children_names, "children");
    exact(a.publish_joint_names, b.publish_joint_names, "joint names");
  }
  void operator()(const scene::Joint& a, const scene::Joint& b) const {
    identity(a.identity, b.identity);
    exact(a.parent, b.parent, "parent"), exact(a.child, b.child, "child"), exact(a.type, b.type, "type");
    exact(a.parent_pivot, b.parent_pivot, "pivot"), exact(a.child_pivot, b.child_pivot, "pivot");
    direction(a.parent_axis, b.parent_axis, "axis"), direction(a.child_axis, b.child_axis, "axis");
    exact(a.child_offset, b.child_offset, "offset"), exact(a.joint_offset, b.joint_offset, "joint offset");
    exact(a.limits, b.limits, "limits"), exact(a.cone_limits, b.cone_limits, "cone");
    exact(a.six_dof.linear_low, b.six_dof.linear_low, "six"),
        exact(a.six_dof.linear_high, b.six_dof.linear_high, "six");
    exact(a.six_dof.angular_low, b.six_dof.angular_low, "six");
    exact(a.six_dof.angular_high, b.six_dof.angular_high, "six");
    exact(a.spring.linear_stiffness, b.spring.linear_stiffness, "spring");
    exact(a.spring.angular_equilibrium, b.spring.angular_equilibrium, "spring");
    exact(a.spring.angular_damping, b.spring.angular_damping, "spring");
    exact(a.damping, b.damping, "damping"), exact(a.stiffness, b.stiffness, "stiffness");
    exact(a.equilibrium, b.equilibrium, "equilibrium");
    exact(a.controller.p, b.controller.p, "P"), exact(a.controller.i, b.controller.i, "I");
    exact(a.controller.d, b.controller.d, "D"), exact(a.controller.output, b.controller.output, "output");
    exact(a.max_motor_impulse, b.max_motor_impulse, "impulse"), exact(a.enable_motor, b.enable_motor, "motor");
    exact(a.enable_feedback, b.enable_feedback, "feedback"), exact(a.erp, b.erp, "erp"), exact(a.cfm, b.cfm, "cfm");
    exact(a.ignore_inter_collision, b.ignore_inter_collision, "ignore"), exact(a.hold, b.hold, "hold");
    exact(a.mimic.joint, b.mimic.joint, "mimic"), exact(a.mimic.offset, b.mimic.offset, "mimic");
    exact(a.mimic.multiplier, b.mimic.multiplier, "mimic");
  }
  void operator()(const scene::Camera& a, const scene::Camera& b) const {
    identity(a.identity, b.identity);
    exact(a.parent, b.parent, "parent"), exact(a.location, b.location, "location");
    exact(a.look_at, b.look_at, "look at"), exact(a.up, b.up, "up"), lens(a.lens, b.lens);
    exact(a.controlling_devices, b.controlling_devices, "devices"), exact(a.monitor, b.monitor, "monitor");
    exact(a.visible, b.visible, "visible"), exact(a.multipass, b.multipass, "multipass");
    exact(a.image.on, b.image.on, "image"), exact(a.image.interval, b.image.interval, "interval");
    exact(a.image.width, b.image.width, "width"), exact(a.image.height, b.image.height, "height");
    exact(a.depth.on, b.depth.on, "depth"), exact(a.depth_noise.on, b.depth_noise.on, "noise");
    exact(a.depth_noise.mean, b.depth_noise.mean, "noise"), exact(a.depth_noise.bias, b.depth_noise.bias, "noise");
    exact(a.mouse.pan, b.mouse.pan, "mouse"), exact(a.mouse.arcball, b.mouse.arcball, "mouse");
  }
  void operator()(const scene::Light& a, const scene::Light& b) const {
    identity(a.identity, b.identity);
    exact(a.parent, b.parent, "parent"), exact(a.location, b.location, "location");
    direction(a.direction, b.direction, "direction"), exact(a.beam, b.beam, "beam");
  }
  template <class Object>
  void looks(const Object& a, const Object& b) const {
    shapes(a.visual.shapes, b.visual.shapes), meshes(a.visual.meshes, b.visual.meshes);
    shapes(a.collision.shapes, b.collision.shapes), meshes(a.collision.meshes, b.collision.meshes);
    exact(a.visual.mesh_file, b.visual.mesh_file, "mesh"), exact(a.visual.visible, b.visual.visible, "visible");
    exact(a.visual.scale, b.visual.scale, "scale"), exact(a.collision.scale, b.collision.scale, "scale");
    exact(a.collision.groups, b.collision.groups, "groups");
    material(a.visual.material, b.visual.material);
  }
  void operator()(const scene::KindBlock& a, const scene::KindBlock& b) const {
    identity(a.identity, b.identity);
    ASSERT_EQ(a.kind, b.kind) << where;
    if (a.kind == &scene::kind::kSensor) block(a.as<scene::Sensor>(), b.as<scene::Sensor>());
    if (a.kind == &scene::kind::kActuator) block(a.as<scene::Actuator>(), b.as<scene::Actuator>());
    if (a.kind == &scene::kind::kGhostObject) block(a.as<scene::Ghost>(), b.as<scene::Ghost>());
    if (a.kind == &scene::kind::kSoftBody) block(a.as<scene::SoftBody>(), b.as<scene::SoftBody>());
    if (a.kind == &scene::kind::kVehicle) block(a.as<scene::Vehicle>(), b.as<scene::Vehicle>());
    if (a.kind == &scene::kind::kTask) block(a.as<scene::Task>(), b.as<scene::Task>());
  }
  void block(const scene::Sensor& a, const scene::Sensor& b) const {
    exact(a.parent, b.parent, "parent"), exact(a.type, b.type, "type");
    pose(a.T_parent_sensor, b.T_parent_sensor, "location"), exact(a.range_m, b.range_m, "range");
    ASSERT_EQ(a.array.size(), b.array.size()) << where;
    for (std::size_t i = 0; i < a.array.size(); ++i)
      exact(a.array[i].offset, b.array[i].offset, "ray"), exact(a.array[i].direction, b.array[i].direction, "ray");
    exact(a.mesh_files, b.mesh_files, "mesh"), exact(a.mesh_scale, b.mesh_scale, "mesh scale");
    exact(a.parametric.resolution, b.parametric.resolution, "parametric");
    exact(a.parametric.horizontal_rad, b.parametric.horizontal_rad, "parametric");
    exact(a.parametric.vertical_rad, b.parametric.vertical_rad, "parametric");
    exact(a.parametric.start_offset_m, b.parametric.start_offset_m, "parametric");
    exact(a.visible, b.visible, "visible"), exact(a.visible_size_m, b.visible_size_m, "visible size");
    exact(a.matching_key, b.matching_key, "key"), exact(a.success_when, b.success_when, "success");
    exact(a.hold_s, b.hold_s, "hold"), exact(a.noise_seed, b.noise_seed, "seed");
    exact(a.range_noise.on, b.range_noise.on, "noise"), exact(a.range_noise.mean, b.range_noise.mean, "noise");
    exact(a.range_noise.std_dev, b.range_noise.std_dev, "noise");
    exact(a.range_noise.bias, b.range_noise.bias, "noise");
    exact(a.friction.stick, b.friction.stick, "friction"), exact(a.friction.slide, b.friction.slide, "friction");
    exact(a.friction.damping, b.friction.damping, "friction"), exact(a.friction.scale, b.friction.scale, "friction");
    exact(a.contact_area_m, b.contact_area_m, "area"), exact(a.contact_damping, b.contact_damping, "damping");
    exact(a.contact_stiffness, b.contact_stiffness, "stiffness"), exact(a.depth_m, b.depth_m, "depth");
    exact(a.joint, b.joint, "joint"), exact(a.distance_threshold_m, b.distance_threshold_m, "threshold");
    exact(a.contact_details, b.contact_details, "details"), exact(a.noise.linear, b.noise.linear, "noise");
    exact(a.noise.angular, b.noise.angular, "noise"), exact(a.rays_per_step, b.rays_per_step, "rays per step");
    exact(a.placement.faces, b.placement.faces, "faces"), exact(a.placement.edges, b.placement.edges, "edges");
    exact(a.placement.vertices, b.placement.vertices, "vertices");
    exact(a.wrap.onto_files, b.wrap.onto_files, "onto"), exact(a.wrap.offset_m, b.wrap.offset_m, "wrap");
  }
  void block(const scene::Actuator& a, const scene::Actuator& b) const {
    exact(a.parent, b.parent, "parent"), exact(a.type, b.type, "type"), exact(a.sensor, b.sensor, "sensor");
    pose(a.T_parent_actuator, b.T_parent_actuator, "location"), exact(a.visible, b.visible, "visible");
    exact(a.visible_size_m, b.visible_size_m, "visible size"), exact(a.max_impulse, b.max_impulse, "impulse");
    exact(a.tau, b.tau, "tau"), exact(a.trigger, b.trigger, "trigger"), exact(a.jaw, b.jaw, "jaw");
    exact(a.below, b.below, "below"), exact(a.hardness, b.hardness, "hardness");
    exact(a.damping, b.damping, "damping"), exact(a.strength_N, b.strength_N, "strength");
    exact(a.range_m, b.range_m, "range"), exact(a.arc, b.arc, "arc");
    exact(a.puncture_force, b.puncture_force, "puncture force");
    exact(a.needle_friction, b.needle_friction, "friction");
  }
  void block(const scene::Ghost& a, const scene::Ghost& b) const {
    looks(a, b);
    exact(a.parent, b.parent, "parent"), pose(a.T_parent_ghost, b.T_parent_ghost, "location");
    exact(a.drag, b.drag, "drag");
  }
  void block(const scene::SoftBody& a, const scene::SoftBody& b) const {
    looks(a, b);
    exact(a.mass, b.mass, "mass"), pose(a.T_model_body, b.T_model_body, "location");
    const scene::SoftConfig &c = a.config, &d = b.config;
    exact(c.kLST, d.kLST, "kLST"), exact(c.kDP, d.kDP, "kDP"), exact(c.kPR, d.kPR, "kPR");
    exact(c.timescale, d.timescale, "timescale"), exact(c.viterations, d.viterations, "viterations");
    exact(c.flags, d.flags, "flags"), exact(c.bending_distance, d.bending_distance, "bending");
    exact(c.clusters, d.clusters, "clusters"), exact(c.fixed_nodes, d.fixed_nodes, "fixed nodes");
    exact(a.randomize_constraints, b.randomize_constraints, "randomize"), exact(a.is_tissue, b.is_tissue, "tissue");
    const scene::Tissue &t = a.tissue, &u = b.tissue;
    exact(t.young, u.young, "young"), exact(t.poisson, u.poisson, "poisson"), exact(t.density, u.density, "density");
    exact(t.element_size, u.element_size, "element"), exact(t.friction, u.friction, "friction");
    exact(t.relaxation.share, u.relaxation.share, "share"), exact(t.relaxation.time, u.relaxation.time, "time");
    exact(t.touches, u.touches, "touches"), exact(t.kind, u.kind, "kind of tissue");
    exact(t.radius, u.radius, "radius"), exact(t.thickness, u.thickness, "thickness"),
        exact(t.points, u.points, "points");
    ASSERT_EQ(t.regions.size(), u.regions.size()) << where;
    for (std::size_t i = 0; i < t.regions.size(); ++i) {
      const scene::TissueRegion &r = t.regions[i], &s = u.regions[i];
      exact(r.box, s.box, "box"), exact(r.sphere, s.sphere, "sphere"), exact(r.vertices, s.vertices, "vertices");
      pose(r.location, s.location, "region"), exact(r.fixed, s.fixed, "fixed"), exact(r.density, s.density, "density");
      exact(r.stiffness, s.stiffness, "stiffness"), exact(r.attach_to, s.attach_to, "attach");
    }
  }
  void block(const scene::Vehicle& a, const scene::Vehicle& b) const {
    exact(a.parent, b.parent, "chassis");
    ASSERT_EQ(a.wheels.size(), b.wheels.size()) << where;
    for (std::size_t i = 0; i < a.wheels.size(); ++i) {
      const scene::Wheel &v = a.wheels[i], &w = b.wheels[i];
      exact(v.body, w.body, "wheel"), exact(v.mesh, w.mesh, "mesh"), exact(v.width_m, w.width_m, "width");
      exact(v.radius_m, w.radius_m, "radius"), exact(v.friction, w.friction, "friction");
      exact(v.stiffness, w.stiffness, "stiffness"), exact(v.compression, w.compression, "compression");
      exact(v.damping, w.damping, "damping"), exact(v.rest_length_m, w.rest_length_m, "rest length");
      exact(v.roll_influence, w.roll_influence, "roll"), direction(v.down, w.down, "down");
      direction(v.axle, w.axle, "axle"), exact(v.connection, w.connection, "offset"), exact(v.front, w.front, "front");
      exact(v.steering_low, w.steering_low, "steering"), exact(v.steering_high, w.steering_high, "steering");
      exact(v.max_drive_N, w.max_drive_N, "drive"), exact(v.max_brake_N, w.max_brake_N, "brake");
    }
  }
  void block(const scene::Task& a, const scene::Task& b) const {
    exact(a.parent, b.parent, "parent"), pose(a.T_parent_task, b.T_parent_task, "location");
    exact(a.order, b.order, "order"), exact(a.drop_height_m, b.drop_height_m, "drop");
    exact(a.holders, b.holders, "holders"), exact(a.avoid, b.avoid, "avoid");
    ASSERT_EQ(a.goals.size(), b.goals.size()) << where;
    for (std::size_t i = 0; i < a.goals.size(); ++i) {
      const scene::TaskGoal &g = a.goals[i], &h = b.goals[i];
      exact(g.name, h.name, "name"), exact(g.piece, h.piece, "piece"), exact(g.pieces, h.pieces, "pieces");
      exact(g.point, h.point, "point"), exact(g.place, h.place, "place");
      pose(g.T_place_goal, h.T_place_goal, "goal"), exact(g.tolerance_m, h.tolerance_m, "tolerance");
      exact(g.angle_tolerance_rad, h.angle_tolerance_rad, "angle"), exact(g.either_way, h.either_way, "either way");
      ASSERT_EQ(g.axis.has_value(), h.axis.has_value()) << where;
      if (g.axis) direction(*g.axis, *h.axis, "axis");
      exact(g.sensor, h.sensor, "sensor"), exact(g.hold_s, h.hold_s, "hold"), exact(g.released, h.released, "released");
      exact(g.held_by, h.held_by, "held by"), exact(g.hand_over, h.hand_over, "hand over");
    }
  }
};

}  // namespace ambf::adf::test
