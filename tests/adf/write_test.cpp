// Descriptions written as ADF text read back as what they were.
#include "adf/write.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "adf/adf.h"
#include "math/rotation.h"

namespace ambf::adf {
namespace {

using state::JointType;

constexpr int kSeeds = 1000;
constexpr double kDigit = 1e-14;  // of angles, axes and directions, which are not written as they are kept

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
  void shapes(std::vector<scene::PlacedGeometry>& to, std::vector<scene::PlacedMesh>& meshes) {
    for (int i = 0, n = whole(3); i < n; ++i) to.push_back({geometry(), maybe() ? pose() : math::Pose{}});
    for (int i = 0, n = whole(3); i < n; ++i)
      meshes.push_back({"/m/" + text() + ".stl", {}, maybe() ? vector_without_zero() : math::Vec3{1, 1, 1}, pose()});
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
    shapes(b.visual.shapes, b.visual.meshes);
    shapes(b.collision.shapes, b.collision.meshes);
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

  std::mt19937 random_;
};

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
      pose(a[i].offset, b[i].offset, "offset");
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
      pose(a[i].offset, b[i].offset, "offset");
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
    ASSERT_EQ(a.visual.material.has_value(), b.visual.material.has_value()) << where;
    if (a.visual.material) {
      const scene::Material &m = *a.visual.material, &n = *b.visual.material;
      color(m.diffuse, n.diffuse, "diffuse"), color(m.ambient, n.ambient, "ambient");
      color(m.specular, n.specular, "specular"), color(m.emission, n.emission, "emission");
      exact(m.alpha, n.alpha, "alpha"), exact(m.shininess, n.shininess, "shininess");
      exact(m.metallic, n.metallic, "metallic");
    }
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
    exact(a.look_at, b.look_at, "look at"), exact(a.up, b.up, "up"), exact(a.lens, b.lens, "lens");
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
};

template <class Object>
void expect_all(const std::vector<Object>& a, const std::vector<Object>& b, unsigned seed) {
  ASSERT_EQ(a.size(), b.size()) << "seed " << seed;
  for (std::size_t i = 0; i < a.size(); ++i)
    Same{"seed " + std::to_string(seed) + " " + a[i].identity.identifier}(a[i], b[i]);
}

TEST(Write, WhatIsWrittenReadsBackAsWhatItWas) {
  Options options;
  options.look_for_files = false;
  for (unsigned seed = 0; seed < kSeeds; ++seed) {
    const scene::Model model = Some(seed).model();
    const WrittenModel written = write_model(model);
    ASSERT_TRUE(written.diagnostics.empty()) << base::to_string(written.diagnostics.front());
    const ModelResult read = parse_model(written.text, "m.yaml", options);
    ASSERT_TRUE(read.model.has_value()) << written.text;
    ASSERT_FALSE(base::has_errors(read.diagnostics)) << base::to_string(read.diagnostics.front()) << written.text;
    const scene::Model& m = *read.model;
    EXPECT_EQ(m.ignore_inter_collision, model.ignore_inter_collision);
    EXPECT_EQ(m.gravity, model.gravity);
    EXPECT_EQ(m.joint_erp, model.joint_erp);
    EXPECT_EQ(m.joint_cfm, model.joint_cfm);
    expect_all(model.bodies, m.bodies, seed);
    expect_all(model.joints, m.joints, seed);
    expect_all(model.cameras, m.cameras, seed);
    expect_all(model.lights, m.lights, seed);
    if (testing::Test::HasFailure()) {
      FAIL() << "seed " << seed << "\n" << written.text;
    }
  }
}

TEST(Write, TheHeaderListsComeFirstAndDefaultsAreLeftOut) {
  scene::Model model;
  scene::Body body;
  body.identity.identifier = "BODY a";
  body.identity.name = "a";
  body.identity.name_space = "/t/";
  model.bodies.push_back(body);
  EXPECT_EQ(write_model(model).text,
            "adf version: 1.0\nnamespace: /t/\nbodies:\n  - BODY a\n\nBODY a:\n  name: a\n  mass: 1\n");
}

TEST(Write, WhatNoKeySaysIsNamed) {
  scene::Model model;
  scene::Body body;
  body.identity.identifier = body.identity.name = "a";
  body.visual.material.emplace();
  body.visual.material->ambient = {0.9, 0.1, 0.2};
  model.bodies.push_back(body);
  const WrittenModel written = write_model(model);
  ASSERT_EQ(written.diagnostics.size(), 1u);
  EXPECT_NE(written.diagnostics.front().message.find("ambient"), std::string::npos);
}

}  // namespace
}  // namespace ambf::adf
