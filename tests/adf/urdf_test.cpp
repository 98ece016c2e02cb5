// URDF robots as models: forward kinematics against a computation of the test's own, masses and inertia, what is
// folded, refused and reported.
#include "adf/urdf_import.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <random>

#include "adf/detail/urdf_writer.h"
#include "math/rotation.h"

namespace ambf::adf {
namespace {

using math::Pose;
using math::Vec3;

std::string number(double v) {
  char text[40];
  std::snprintf(text, sizeof text, "%.17g", v);
  return text;
}

std::string origin(const Vec3& xyz, const Vec3& rpy) {
  return "<origin xyz=\"" + number(xyz.x) + " " + number(xyz.y) + " " + number(xyz.z) + "\" rpy=\"" + number(rpy.x) +
         " " + number(rpy.y) + " " + number(rpy.z) + "\"/>";
}

const char* const kInertial =
    "<inertial><mass value=\"1\"/><inertia ixx=\"0.1\" ixy=\"0\" ixz=\"0\" iyy=\"0.1\" iyz=\"0\" "
    "izz=\"0.1\"/></inertial>";

struct TestJoint {
  int parent = 0;
  std::string type;
  Pose T_parent_joint;
  Vec3 axis;
};

// Seven links, each on an earlier one; every other one with a mesh that is placed in its link.
class RandomTree {
 public:
  explicit RandomTree(unsigned seed) : rng_(seed) {
    text_ = "<robot name=\"tree\">" + link(0);
    for (int i = 1; i < 7; ++i) {
      TestJoint joint;
      joint.parent = static_cast<int>(rng_() % static_cast<unsigned>(i));
      joint.type = std::array{"revolute", "prismatic", "fixed", "continuous"}[rng_() % 4];
      const Vec3 xyz = vector(), rpy = angles();
      joint.T_parent_joint = {xyz, math::from_rpy(rpy.x, rpy.y, rpy.z)};
      joint.axis = rng_() % 2 == 0 ? math::normalized(vector())
                                   : std::array<Vec3, 3>{{{1, 0, 0}, {0, -1, 0}, {0, 0, 1}}}[rng_() % 3];
      text_ += link(i) + "<joint name=\"j" + std::to_string(i) + "\" type=\"" + joint.type + "\">" + origin(xyz, rpy) +
               "<parent link=\"l" + std::to_string(joint.parent) + "\"/><child link=\"l" + std::to_string(i) +
               "\"/><axis xyz=\"" + number(joint.axis.x) + " " + number(joint.axis.y) + " " + number(joint.axis.z) +
               "\"/><limit lower=\"-2\" upper=\"2\" effort=\"50\" velocity=\"1\"/></joint>";
      joints_.push_back(joint);
    }
    text_ += "</robot>";
  }

  const std::string& text() const { return text_; }
  const std::vector<TestJoint>& joints() const { return joints_; }
  const Pose& T_link_visual(int link) const { return T_link_visual_[static_cast<std::size_t>(link)]; }
  double value() { return std::uniform_real_distribution(-1.5, 1.5)(rng_); }

 private:
  Vec3 vector() { return {value(), value(), value()}; }
  Vec3 angles() {
    const auto right = [this] { return M_PI / 2 * (static_cast<int>(rng_() % 3) - 1); };
    return rng_() % 2 == 0 ? vector() : Vec3{right(), right(), right()};
  }
  std::string link(int i) {
    const bool visual = i % 2 == 1;
    const Vec3 xyz = vector(), rpy = angles();
    T_link_visual_.push_back(visual ? Pose{xyz, math::from_rpy(rpy.x, rpy.y, rpy.z)} : Pose{});
    return "<link name=\"l" + std::to_string(i) + "\">" + kInertial +
           (visual ? "<visual>" + origin(xyz, rpy) + "<geometry><mesh filename=\"a.stl\"/></geometry></visual>" : "") +
           "</link>";
  }

  std::mt19937 rng_;
  std::string text_;
  std::vector<TestJoint> joints_;
  std::vector<Pose> T_link_visual_;
};

Pose turn(const Vec3& axis, double angle) { return {{}, math::from_axis_angle(axis, angle)}; }

// EQUATIONS 12: the pose of the child of an ADF joint in its parent at joint value q.
Pose T_parent_child(const scene::Joint& j, double q) {
  const bool slides = j.type == state::JointType::prismatic;
  const math::Quat R0 = math::rotation_between(j.child_axis, j.parent_axis);
  const Pose frame{j.parent_pivot, math::from_axis_angle(j.parent_axis, j.child_offset) * R0};
  const Pose moved =
      slides ? Pose{j.parent_axis * q, {}} : turn(j.parent_axis, j.type == state::JointType::fixed ? 0.0 : q);
  const Pose placed{frame.position + (slides ? moved.position : Vec3{}), moved.orientation * frame.orientation};
  return placed * Pose{j.child_pivot * -1.0, {}};
}

void expect_equal(const Pose& a, const Pose& b, const std::string& what) {
  EXPECT_LT(math::norm(a.position - b.position), 1e-9) << what;
  EXPECT_LT(math::norm(math::log(math::inverse(a.orientation) * b.orientation)), 1e-9) << what;
}

ModelResult load(const std::string& text, UrdfOptions urdf = {}) {
  Options options;
  options.look_for_files = false;
  options.urdf = urdf;
  return parse_model(text, "robot.urdf", options);
}

std::string messages(const ModelResult& result) {
  std::string text;
  for (const base::Diagnostic& d : result.diagnostics) text += std::to_string(d.line) + ": " + d.message + "\n";
  return text;
}

TEST(Urdf, ForwardKinematicsOfRandomTrees) {
  for (unsigned seed = 0; seed < 40; ++seed) {
    RandomTree tree(seed);
    const ModelResult result = load(tree.text());
    ASSERT_TRUE(result.model) << messages(result);
    std::map<std::string, const scene::Joint*> joints;
    for (const scene::Joint& j : result.model->joints) joints[j.identity.name] = &j;
    std::map<std::string, const scene::Body*> bodies;
    for (const scene::Body& b : result.model->bodies) bodies[b.identity.name] = &b;
    ASSERT_EQ(bodies.size(), 7U);
    ASSERT_EQ(joints.size(), 6U);
    for (const bool moved : {false, true}) {
      std::vector<Pose> T_world_link{{}}, T_world_body{bodies.at("l0")->T_world_body};
      for (int i = 1; i < 7; ++i) {
        const TestJoint& j = tree.joints()[static_cast<std::size_t>(i - 1)];
        const double q = moved ? tree.value() : 0.0;
        const Pose motion = j.type == "fixed" ? Pose{} : j.type == "prismatic" ? Pose{j.axis * q, {}} : turn(j.axis, q);
        const auto parent = static_cast<std::size_t>(j.parent);
        T_world_link.push_back(T_world_link[parent] * j.T_parent_joint * motion);
        T_world_body.push_back(T_world_body[parent] * T_parent_child(*joints.at("j" + std::to_string(i)), q));
        const std::string what =
            "seed " + std::to_string(seed) + ", link " + std::to_string(i) + " on a joint of type " + j.type;
        expect_equal(T_world_body.back(), T_world_link.back() * tree.T_link_visual(i), what);
        if (!moved) expect_equal(bodies.at("l" + std::to_string(i))->T_world_body, T_world_body.back(), what);
        if (HasFailure()) return;
      }
    }
  }
}

const std::string kArm = R"(<?xml version="1.0"?>
<robot name="arm">
  <material name="blue"><color rgba="0.1 0.2 0.8 1"/></material>
  <link name="world"/>
  <joint name="stand" type="fixed"><parent link="world"/><child link="base"/><origin xyz="0 0 1"/></joint>
  <link name="base"><visual><geometry><box size="0.2 0.2 0.1"/></geometry><material name="blue"/></visual></link>
  <joint name="elbow" type="revolute"><parent link="base"/><child link="fore arm"/><axis xyz="0 1 0"/>
    <limit lower="-1" upper="2" effort="40" velocity="1"/><dynamics damping="0.7" friction="0.1"/></joint>
  <link name="fore arm">
    <inertial><origin xyz="0.1 0.2 0.3" rpy="0.4 0.5 0.6"/><mass value="2"/>
      <inertia ixx="0.03" ixy="0.002" ixz="-0.004" iyy="0.04" iyz="0.001" izz="0.05"/></inertial>
    <visual><origin xyz="0 0 0.1"/><geometry><cylinder radius="0.05" length="0.3"/></geometry></visual>
    <visual><geometry><sphere radius="0.06"/></geometry><material name="blue"/></visual>
    <collision><geometry><sphere radius="0.06"/></geometry></collision>
  </link>
  <joint name="flange" type="fixed"><parent link="fore arm"/><child link="tool0"/><origin xyz="0 0 0.3"/></joint>
  <link name="tool0"/>
  <joint name="swing" type="continuous"><parent link="tool0"/><child link="hand"/><axis xyz="1 0 0"/></joint>
  <link name="hand"/>
  <gazebo reference="hand"/><gazebo/>
</robot>
)";

TEST(Urdf, LinksAndJointsBecomeBodiesAndJointsOfTheirNames) {
  const ModelResult result = load(kArm);
  ASSERT_TRUE(result.model) << messages(result);
  const scene::Model& model = *result.model;
  ASSERT_EQ(model.bodies.size(), 3U) << "`world` and `tool0` have no mass: they are part of what they are fixed to";
  const scene::Body &base = model.bodies[0], &arm = model.bodies[1], &hand = model.bodies[2];
  EXPECT_EQ(base.identity.name, "base");
  EXPECT_EQ(base.mass, 0.0);
  EXPECT_EQ(base.T_world_body.position, (Vec3{0, 0, 1}));
  ASSERT_TRUE(base.visual.material);
  EXPECT_EQ(base.visual.material->diffuse.b, 0.8);
  EXPECT_EQ(arm.identity.name, "forearm");
  ASSERT_EQ(arm.visual.shapes.size(), 2U);
  EXPECT_FALSE(arm.visual.material) << "each visual has its own";
  EXPECT_FALSE(arm.visual.shapes[0].material);
  ASSERT_TRUE(arm.visual.shapes[1].material);
  EXPECT_EQ(arm.visual.shapes[1].material->diffuse.b, 0.8);
  EXPECT_EQ(arm.collision.shapes.size(), 1U);
  EXPECT_EQ(hand.mass, 1e-3);
  ASSERT_EQ(model.joints.size(), 2U);
  const scene::Joint& elbow = model.joints[0];
  ASSERT_TRUE(elbow.limits);
  EXPECT_EQ((*elbow.limits)[0], -1.0);
  EXPECT_EQ((*elbow.limits)[1], 2.0);
  EXPECT_EQ(elbow.damping, 0.7);
  EXPECT_DOUBLE_EQ(elbow.max_motor_impulse, 0.04);
  EXPECT_EQ(elbow.identity.where.line, 7);
  EXPECT_FALSE(model.joints[1].limits);
  EXPECT_EQ(model.joints[1].parent_pivot, (Vec3{0, 0, 0.3}));
  const std::string said = messages(result);
  EXPECT_NE(said.find("19: link 'hand' has no mass"), std::string::npos) << said;
  EXPECT_NE(said.find("2 x elements `gazebo`"), std::string::npos) << said;
  EXPECT_NE(said.find("1 x joint friction"), std::string::npos) << said;
}

TEST(Urdf, MassCentreAndTensorStay) {
  const ModelResult result = load(kArm);
  ASSERT_TRUE(result.model);
  const scene::Body& arm = result.model->bodies[1];
  EXPECT_EQ(arm.mass, 2.0);
  ASSERT_TRUE(arm.inertia && arm.inertial_offset);
  EXPECT_EQ(arm.inertial_offset->position, (Vec3{0.1, 0.2, 0.3}));
  double U[9], R[9];
  math::to_matrix(arm.inertial_offset->orientation, U);
  math::to_matrix(math::from_rpy(0.4, 0.5, 0.6), R);
  const double moments[3] = {arm.inertia->x, arm.inertia->y, arm.inertia->z};
  const double given[3][3] = {{0.03, 0.002, -0.004}, {0.002, 0.04, 0.001}, {-0.004, 0.001, 0.05}};
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      double ours = 0.0, theirs = 0.0;
      for (int k = 0; k < 3; ++k) ours += U[3 * i + k] * moments[k] * U[3 * j + k];
      for (int k = 0; k < 3; ++k)
        for (int l = 0; l < 3; ++l) theirs += R[3 * i + k] * given[k][l] * R[3 * j + l];
      EXPECT_NEAR(ours, theirs, 1e-12);
    }
  }
}

TEST(Urdf, FixedJointsCanBeMergedAndTheBaseFreed) {
  const std::string text = "<robot name=\"r\"><link name=\"a\">" + std::string(kInertial) + "</link><link name=\"b\">" +
                           kInertial +
                           "</link><joint name=\"j\" type=\"fixed\"><parent link=\"a\"/><child link=\"b\"/>"
                           "<origin xyz=\"2 0 0\"/></joint></robot>";
  EXPECT_EQ(load(text).model->bodies.size(), 2U);
  UrdfOptions options;
  options.merge_fixed = options.free_base = true;
  const ModelResult merged = load(text, options);
  ASSERT_EQ(merged.model->bodies.size(), 1U);
  const scene::Body& body = merged.model->bodies[0];
  EXPECT_EQ(body.mass, 2.0);
  EXPECT_EQ(body.inertial_offset->position, (Vec3{1, 0, 0}));
  double moments[3] = {body.inertia->x, body.inertia->y, body.inertia->z};
  std::sort(moments, moments + 3);
  EXPECT_NEAR(moments[0], 0.2, 1e-12);
  EXPECT_NEAR(moments[1], 2.2, 1e-12);  // and 1 kg at 1 m, twice
}

TEST(Urdf, RefusalsNameThePlace) {
  const auto refused = [](const std::string& text) {
    const ModelResult result = load(text);
    EXPECT_FALSE(result.model);
    return messages(result);
  };
  EXPECT_NE(refused("<robot name=\"r\">\n<link name=\"a\"/>\n<oops>\n</robot>").find(": the URDF is refused"),
            std::string::npos);
  EXPECT_NE(
      refused("<robot name=\"r\">\n<link name=\"a\"/>\n<joint name=\"j\" type=\"hinge\">\n<parent link=\"a\"/><child "
              "link=\"b\"/></joint></robot>")
          .find("3: the URDF is refused"),
      std::string::npos);
  EXPECT_NE(refused("<robot name=\"r&#10;namespace: /evil/\"><link name=\"a\"/></robot>").find("name"),
            std::string::npos);
  EXPECT_NE(refused("<robot name=\"r\" xmlns:xacro=\"x\"><xacro:include/></robot>").find("xacro"), std::string::npos);
  std::string deep = "<robot name=\"r\">";
  for (int i = 0; i < 300000; ++i) deep += "<a>";
  EXPECT_NE(refused(deep).find("nested more than 200"), std::string::npos);
}

TEST(Urdf, MimicNamesTheJointThatIsFollowed) {
  const auto robot = [](const std::string& mimic) {
    std::string text = "<robot name=\"r\">";
    for (const char* link : {"palm", "left", "right"})
      text += "<link name=\"" + std::string(link) + "\">" + kInertial + "</link>";
    return text + "<joint name=\"l\" type=\"continuous\"><parent link=\"palm\"/><child link=\"left\"/></joint>" +
           "<joint name=\"r\" type=\"continuous\"><parent link=\"palm\"/><child link=\"right\"/>" + mimic +
           "</joint></robot>";
  };
  const ModelResult result = load(robot("<mimic joint=\"l\" multiplier=\"-1\" offset=\"0.2\"/>"));
  ASSERT_TRUE(result.model) << messages(result);
  const scene::Mimic& mimic = result.model->joints.at(1).mimic;
  EXPECT_EQ(mimic.joint, "JOINT l");
  EXPECT_EQ(mimic.multiplier, -1.0);
  EXPECT_EQ(mimic.offset, 0.2);
  EXPECT_EQ(result.model->joints.at(0).mimic.joint, "");
  EXPECT_EQ(messages(result).find("mimic"), std::string::npos) << messages(result);
  const ModelResult wrong = load(robot("<mimic joint=\"none\"/>"));
  ASSERT_TRUE(wrong.model);
  EXPECT_NE(messages(wrong).find("mimics 'none'"), std::string::npos) << messages(wrong);
}

TEST(Urdf, APackageIsFoundAboveTheFile) {
  const std::filesystem::path home = testing::TempDir() + "ambf_urdf_" + std::to_string(getpid());
  std::filesystem::create_directories(home / "my_robot/urdf");
  const std::vector<std::string> places =
      urdf::mesh_places("package://my_robot/meshes/a.stl", (home / "my_robot/urdf/r.urdf").string());
  std::filesystem::remove_all(home);
  EXPECT_NE(std::find(places.begin(), places.end(), (home / "my_robot/meshes/a.stl").string()), places.end());
}

// What is written is ordinary ADF, and reads back as what was loaded.
TEST(Urdf, TheConvertedTextLoadsAsTheSameModel) {
  const ConvertedUrdf converted = convert_urdf(kArm, "robot.urdf");
  ASSERT_TRUE(converted.adf);
  const ModelResult direct = load(kArm), text = load(*converted.adf);
  ASSERT_TRUE(direct.model && text.model);
  ASSERT_EQ(direct.model->bodies.size(), text.model->bodies.size());
  for (std::size_t i = 0; i < direct.model->bodies.size(); ++i) {
    const scene::Body &a = direct.model->bodies[i], &b = text.model->bodies[i];
    EXPECT_EQ(a.identity.name, b.identity.name);
    EXPECT_EQ(a.T_world_body, b.T_world_body);
    EXPECT_EQ(a.inertia, b.inertia);
  }
}

// Where the ADF file will lie, its meshes are named from there, so that both can move together.
TEST(Urdf, AConvertedFileNamesMeshesFromItsOwnFolder) {
  const std::filesystem::path home = testing::TempDir() + "ambf_urdf_convert_" + std::to_string(getpid());
  std::filesystem::create_directories(home / "robot/meshes");
  std::filesystem::create_directories(home / "adf");
  std::ofstream(home / "robot/meshes/a.stl") << "solid a\nendsolid a\n";
  std::ofstream(home / "robot/r.urdf") << "<robot name=\"r\"><link name=\"a\"><visual><geometry><mesh filename=\""
                                          "meshes/a.stl\"/></geometry></visual></link></robot>";
  const ConvertedUrdf converted =
      convert_urdf_file((home / "robot/r.urdf").string(), {false, false, (home / "adf/r.yaml").string()});
  ASSERT_TRUE(converted.adf);
  EXPECT_NE(converted.adf->find("mesh: \"../robot/meshes/a.stl\""), std::string::npos) << *converted.adf;
  EXPECT_FALSE(convert_urdf_file((home / "robot/meshes/a.stl").string()).adf);
  EXPECT_FALSE(convert_urdf_file((home / "absent.urdf").string()).adf);
  std::filesystem::remove_all(home);
}

}  // namespace
}  // namespace ambf::adf
