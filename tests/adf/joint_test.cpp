#include "tests/adf/support.h"

namespace ambf::adf {
namespace {

using state::JointType;

const scene::Joint& only_joint(const ModelResult& result) {
  static const scene::Joint kNone;
  if (!result.model || result.model->joints.size() != 1) {
    ADD_FAILURE() << all_of(result.diagnostics);
    return kNone;
  }
  return result.model->joints.front();
}

TEST(Joint, DefaultsAreThoseOfTheReference) {
  const ModelResult result = parse_joint_keys("");
  const scene::Joint& joint = only_joint(result);
  EXPECT_EQ(joint.parent, "BODY A");
  EXPECT_EQ(joint.child, "BODY B");
  EXPECT_EQ(joint.parent_pivot, (math::Vec3{1, 2, 3}));
  EXPECT_EQ(joint.child_axis, (math::Vec3{0, 1, 0}));
  EXPECT_FALSE(joint.limits);
  EXPECT_EQ(joint.controller.output, scene::ControllerOutput::velocity);
  EXPECT_EQ(joint.controller.p, 10.0);
  EXPECT_EQ(joint.controller.d, 1.0);
  EXPECT_EQ(joint.max_motor_impulse, 0.1);
  EXPECT_TRUE(joint.enable_motor);
  EXPECT_FALSE(joint.enable_feedback);
  EXPECT_TRUE(joint.ignore_inter_collision);
  EXPECT_FALSE(joint.erp);
  EXPECT_TRUE(no_worse_than_information(result.diagnostics));
}

TEST(Joint, EveryKeyArrives) {
  const ModelResult result = parse_joint_keys(
      "offset: 0.1, joint offset: 0.2, joint limits: {low: -1, high: 2}, controller: {P: 5, I: 6, D: 7}, max motor "
      "impulse: 3,"
      "enable motor: 0, enable feedback: 1, joint erp: 0.3, joint cfm: 0.4, damping: 0.5, stiffness: 0.6, equilibrium "
      "point: 0.7,"
      "ignore inter-collision: false, passive: true, detached: true, redundant: false",
      "torsion spring");
  const scene::Joint& joint = only_joint(result);
  EXPECT_EQ(joint.child_offset, 0.1);
  EXPECT_EQ(joint.joint_offset, 0.2);
  EXPECT_EQ(*joint.limits, (std::array<double, 2>{-1, 2}));
  EXPECT_EQ(joint.controller.i, 6.0);
  EXPECT_EQ(joint.controller.output, scene::ControllerOutput::force);
  EXPECT_EQ(joint.max_motor_impulse, 3.0);
  EXPECT_FALSE(joint.enable_motor);
  EXPECT_TRUE(joint.enable_feedback);
  EXPECT_EQ(joint.erp, 0.3);
  EXPECT_EQ(joint.cfm, 0.4);
  EXPECT_EQ(joint.damping, 0.5);
  EXPECT_EQ(joint.stiffness, 0.6);
  EXPECT_EQ(joint.equilibrium, 0.7);
  EXPECT_FALSE(joint.ignore_inter_collision);
  EXPECT_TRUE(joint.identity.passive);
  EXPECT_TRUE(no_worse_than_information(result.diagnostics));
}

TEST(Joint, OffsetGoesBeforeChildOffset) {
  EXPECT_EQ(only_joint(parse_joint_keys("child offset: 0.5")).child_offset, 0.5);
  EXPECT_EQ(only_joint(parse_joint_keys("child offset: 0.5, offset: 0.25")).child_offset, 0.25);
}

TEST(Joint, EnableMotorDoesNotNeedEnableFeedback) {
  EXPECT_FALSE(only_joint(parse_joint_keys("enable motor: false")).enable_motor);
}

TEST(Joint, AllTypesOfAllSpellings) {
  const std::pair<const char*, JointType> types[] = {{"hinge", JointType::revolute},
                                                     {"continuous", JointType::revolute},
                                                     {"slider", JointType::prismatic},
                                                     {"prismatic", JointType::prismatic},
                                                     {"fixed", JointType::fixed},
                                                     {"spring", JointType::linear_spring},
                                                     {"linear spring", JointType::linear_spring},
                                                     {"torsion spring", JointType::torsion_spring},
                                                     {"angular spring", JointType::torsion_spring},
                                                     {"p2p", JointType::p2p},
                                                     {"cone twist", JointType::cone_twist},
                                                     {"six dof", JointType::six_dof},
                                                     {"six dof spring", JointType::six_dof_spring}};
  for (const auto& [word, type] : types) EXPECT_EQ(only_joint(parse_joint_keys("", word)).type, type) << word;
}

TEST(Joint, UnknownTypeDropsItAndNamesTheNearest) {
  const ModelResult result = parse_joint_keys("", "revolut");
  EXPECT_TRUE(result.model->joints.empty());
  EXPECT_EQ(result.model->bodies.size(), 2u);
  EXPECT_TRUE(says(result.diagnostics,
                   "error: \\[JOINT J: type\\] expected one of: revolute, hinge, .*found the text 'revolut' \\(did you "
                   "mean `revolute`"));
}

TEST(Joint, OutputTypeIsReadWithoutController) {
  EXPECT_EQ(only_joint(parse_joint_keys("controller output type: POSITION")).controller.output,
            scene::ControllerOutput::position);
  EXPECT_EQ(only_joint(parse_joint_keys("controller: {P: 1}, controller output type: VELOCITY")).controller.output,
            scene::ControllerOutput::velocity);
}

TEST(Joint, ReversedLimitsLeaveItFreeWithAWarning) {
  const ModelResult result = parse_joint_keys("joint limits: {low: 0.25, high: -0.2}");
  EXPECT_FALSE(only_joint(result).limits);
  EXPECT_TRUE(says(result.diagnostics, "warning: \\[JOINT J: joint limits\\] reversed: low 0.25.* above high -0.2"));
}

TEST(Joint, OneLimitAloneIsNoLimit) {
  const ModelResult result = parse_joint_keys("joint limits: {low: 0.25}");
  EXPECT_FALSE(only_joint(result).limits);
  EXPECT_TRUE(says(result.diagnostics, "warning: \\[JOINT J: joint limits\\] expected both low and high"));
}

TEST(Joint, ZeroAxisDropsIt) {
  const ModelResult result = parse(
      "bodies: [A, B]\njoints: [J]\nA: {name: A}\nB: {name: B}\n"
      "J: {name: J, parent: A, child: B, type: revolute, parent pivot: {x: 0, y: 0, z: 0}, child pivot: {x: 0, y: 0, "
      "z: 0},\n"
      "  parent axis: {x: 0, y: 0, z: 0}, child axis: {x: 0, y: 0, z: 1}}\n");
  EXPECT_TRUE(result.model->joints.empty());
  EXPECT_TRUE(says(result.diagnostics,
                   "model.yaml:6:16: error: \\[J: parent axis\\] expected a direction, found the zero vector"));
}

TEST(Joint, LongAxisIsNormalisedWithAWarningAndARoundedOneWithout) {
  const std::string start =
      "bodies: [A, B]\njoints: [J]\nnamespace: /t/\nA: {name: A, mass: 1}\nB: {name: B, mass: 1}\nJ: {name: J, parent: "
      "A, child: B, type: revolute, "
      "parent pivot: {x: 0, y: 0, z: 0}, child pivot: {x: 0, y: 0, z: 0}, child axis: {x: 0, y: 0, z: 1}, parent "
      "axis: ";
  const ModelResult longer = parse(start + "{x: 0, y: 2, z: 0}}\n");
  EXPECT_EQ(only_joint(longer).parent_axis, (math::Vec3{0, 1, 0}));
  EXPECT_TRUE(says(longer.diagnostics, "warning: \\[J: parent axis\\] is no unit vector: its length is 2"));
  const ModelResult rounded = parse(start + "{x: 0.7071, y: 0.7071, z: 0}}\n");
  EXPECT_NEAR(math::norm(only_joint(rounded).parent_axis), 1.0, 1e-15);
  EXPECT_TRUE(no_worse_than_information(rounded.diagnostics));
}

TEST(Joint, WithItselfIsAnError) {
  const ModelResult result = parse(
      "bodies: [A]\njoints: [J]\nA: {name: A}\nJ: {name: J, parent: A, child: A, parent pivot: {x: 0, y: 0, z: 0}, "
      "child pivot: {x: 0, y: 0, z: 0}}\n");
  EXPECT_TRUE(says(result.diagnostics, "error: \\[J: child\\] parent and child are the same body: 'A'"));
}

TEST(Joint, MissingParentIsAnError) {
  EXPECT_TRUE(
      says(parse("joints: [J]\nJ: {child: A, parent pivot: {x: 0, y: 0, z: 0}, child pivot: {x: 0, y: 0, z: 0}}\n")
               .diagnostics,
           "model.yaml:2:4: error: \\[J: parent\\] missing; expected text"));
}

TEST(Joint, MissingTypeIsRevoluteAndSaid) {
  const ModelResult result = parse(
      "joints: [J]\nJ: {name: J, parent: A, child: B, parent pivot: {x: 0, y: 0, z: 0}, child pivot: {x: 0, y: 0, z: "
      "0}, "
      "parent axis: {x: 1, y: 0, z: 0}, child axis: {x: 1, y: 0, z: 0}}\n");
  EXPECT_EQ(only_joint(result).type, JointType::revolute);
  EXPECT_TRUE(says(result.diagnostics, "info: \\[J: type\\] missing; revolute is assumed"));
}

TEST(Joint, SpringsReadTheMisspeltEquilibriumToo) {
  const ModelResult result = parse_joint_keys("stiffness: 4, equiblirium point: 0.5", "torsion spring");
  EXPECT_EQ(only_joint(result).equilibrium, 0.5);
  EXPECT_TRUE(says(result.diagnostics,
                   "warning: \\[JOINT J: equiblirium point\\] older spelling \\(write `equilibrium point`\\)"));
}

TEST(Joint, ConeTwistAndSixDofHaveLimitsOfTheirOwn) {
  EXPECT_EQ(only_joint(parse_joint_keys("joint limits: {x: 0.1, y: 0.2}", "cone twist")).cone_limits,
            (math::Vec3{0.1, 0.2, 0.7}));
  const ModelResult six = parse_joint_keys(
      "joint limits: {linear: {low: {x: -1, y: -2, z: -3}, high: {x: 1, y: 2, z: 3}}}, stiffness: {linear: {x: 7, y: "
      "8, z: 9}}, damping: 0.25",
      "six dof spring");
  const scene::Joint& joint = only_joint(six);
  EXPECT_EQ(joint.six_dof.linear_low, (math::Vec3{-1, -2, -3}));
  EXPECT_EQ(joint.six_dof.angular_high, (math::Vec3{1.2, 1.2, 1.2}));
  EXPECT_EQ(joint.spring.linear_stiffness, (math::Vec3{7, 8, 9}));
  EXPECT_EQ(joint.spring.angular_stiffness, (math::Vec3{1, 1, 1}));
  EXPECT_EQ(joint.spring.linear_damping, (math::Vec3{0.25, 0.25, 0.25}));
}

TEST(Joint, KeysOfOtherTypesAreSaidToHaveNoEffect) {
  EXPECT_TRUE(says(parse_joint_keys("stiffness: 4").diagnostics,
                   "warning: \\[JOINT J: stiffness\\] has no effect on a joint of type 'revolute' \\(springs have it"));
  EXPECT_TRUE(says(parse_joint_keys("joint limits: {low: -1, high: 1}", "cone twist").diagnostics,
                   "warning: \\[JOINT J: joint limits/low\\] has no effect .*'cone twist' \\(it has `x`, `y` and `z`"));
  EXPECT_TRUE(says(parse_joint_keys("joint limits: {x: 1, y: 1, z: 1}").diagnostics,
                   "warning: \\[JOINT J: joint limits/z\\] has no effect .*it has `low` and `high`"));
  EXPECT_TRUE(says(parse_joint_keys("joint limits: {low: -1, high: 1}", "six dof").diagnostics,
                   "warning: \\[JOINT J: joint limits/high\\] has no effect .*it has `linear` and `angular`"));
  // What exporters write for want of anything else to write.
  for (const char* type : {"fixed", "p2p"})
    EXPECT_TRUE(parse_joint_keys("stiffness: 0, joint limits: {low: -1, high: 1}", type).diagnostics.empty()) << type;
}

TEST(Joint, DegreesAreToldToBeRadians) {
  const ModelResult result = parse_joint_keys("joint limits: {low: -90, high: 9}, offset: 45");
  EXPECT_TRUE(says(result.diagnostics, "warning: \\[JOINT J: joint limits/low\\] more than two turns; .* in radians"));
  EXPECT_TRUE(says(result.diagnostics, "warning: \\[JOINT J: offset\\] more than two turns; .* in radians"));
  EXPECT_EQ(result.diagnostics.size(), 2u);
  EXPECT_TRUE(parse_joint_keys("joint limits: {low: -90, high: 90}", "prismatic").diagnostics.empty());
}

TEST(Joint, NegativeGainsAreSaid) {
  EXPECT_TRUE(says(parse_joint_keys("controller: {P: 5, I: 0, D: -1}").diagnostics,
                   "warning: \\[JOINT J: controller/D\\] a negative gain drives away"));
}

}  // namespace
}  // namespace ambf::adf
