// A joint of two bodies.
#include "scene/block_kinds.h"
#include "scene/description.h"
#include "scene/detail/groups.h"

namespace ambf::scene::group {

namespace {

constexpr Word kTypes[] = {
    word("revolute", state::JointType::revolute),
    word("hinge", state::JointType::revolute),
    word("continuous", state::JointType::revolute),
    word("prismatic", state::JointType::prismatic),
    word("slider", state::JointType::prismatic),
    word("fixed", state::JointType::fixed),
    word("linear spring", state::JointType::linear_spring),
    word("spring", state::JointType::linear_spring),
    word("torsion spring", state::JointType::torsion_spring),
    word("torsional spring", state::JointType::torsion_spring),
    word("angular spring", state::JointType::torsion_spring),
    word("p2p", state::JointType::p2p),
    word("cone twist", state::JointType::cone_twist),
    word("six dof", state::JointType::six_dof),
    word("six dof spring", state::JointType::six_dof_spring),
};

constexpr Key kJointKeys[] = {
    {.name = "parent",
     .type = KeyType::text,
     .member = to<&Joint::parent>(),
     .meaning = "Body block; a part of its name is enough when only one body has it.",
     .required = true},
    {.name = "child", .type = KeyType::text, .member = to<&Joint::child>(), .meaning = "Likewise.", .required = true},
    {.name = "type",
     .type = KeyType::choice,
     .member = to<&Joint::type>(),
     .meaning =
         "hinge, revolute and continuous are one, slider and prismatic too, and so are the names of each spring.",
     .words = kTypes},
    {.name = "parent pivot",
     .type = KeyType::vector,
     .member = to<&Joint::parent_pivot>(),
     .unit = "m",
     .meaning = "In the parent's frame.",
     .required = true},
    {.name = "child pivot",
     .type = KeyType::vector,
     .member = to<&Joint::child_pivot>(),
     .unit = "m",
     .meaning = "In the child's frame.",
     .required = true},
    {.name = "parent axis", .type = KeyType::vector, .meaning = "In the parent's frame; p2p needs none."},
    {.name = "child axis", .type = KeyType::vector, .meaning = "In the child's frame; p2p needs none."},
    {.name = "offset",
     .type = KeyType::number,
     .member = to<&Joint::child_offset>(),
     .unit = "rad",
     .meaning = "Turn of the child about the parent axis."},
    {.name = "child offset",
     .type = KeyType::number,
     .member = to<&Joint::child_offset>(),
     .unit = "rad",
     .meaning = "The same.",
     .preferred = "offset"},
    {.name = "joint offset",
     .type = KeyType::number,
     .member = to<&Joint::joint_offset>(),
     .unit = "rad",
     .meaning = "Moves the zero of the joint."},
    {.name = "joint limits",
     .type = KeyType::map,
     .unit = "rad or m",
     .fallback = "none",
     .meaning = "low and high. cone twist: x, y, z. six dof: linear and angular, each low and high. A revolute joint "
                "without is continuous.",
     .sub = &kJointLimits},
    {.name = "controller",
     .type = KeyType::map,
     .member = to<&Joint::controller>(),
     .fallback = "velocity with P = 10, D = 1",
     .meaning = "With it the output is FORCE.",
     .sub = &kJointGains},
    {.name = "controller output type",
     .type = KeyType::choice,
     .member = to<&Joint::controller, &JointGains::output>(),
     .fallback = "see controller",
     .words = kOutputWords,
     .instead = "FORCE"},
    {.name = "max motor impulse",
     .type = KeyType::number,
     .member = to<&Joint::max_motor_impulse>(),
     .unit = "Ns or Nms",
     .meaning = "Most that the motor does in one step: velocity output, velocity commands, holding still. With FORCE "
                "output it bounds the integral's share only; effort commands it does not bound.",
     .rule = Rule::not_negative},
    {.name = "enable motor", .type = KeyType::boolean, .member = to<&Joint::enable_motor>()},
    {.name = "enable feedback",
     .type = KeyType::boolean,
     .member = to<&Joint::enable_feedback>(),
     .meaning = "Measures the joint's forces."},
    {.name = "joint erp",
     .type = KeyType::number,
     .member = to<&Joint::erp>(),
     .fallback = "the file's, else 0.8",
     .rule = Rule::not_negative},
    {.name = "joint cfm",
     .type = KeyType::number,
     .member = to<&Joint::cfm>(),
     .fallback = "the file's, else 0",
     .rule = Rule::not_negative},
    {.name = "damping",
     .type = KeyType::number_or_map,
     .unit = "Ns/m or Nms/rad",
     .fallback = "0 (six dof spring: 0.7)",
     .meaning = "Viscous. six dof spring: linear and angular.",
     .sub = &kLinearAngular,
     .rule = Rule::not_negative},
    {.name = "stiffness",
     .type = KeyType::number_or_map,
     .unit = "N/m or Nm/rad",
     .fallback = "0 (six dof spring: 1)",
     .meaning = "Springs.",
     .sub = &kLinearAngular,
     .rule = Rule::not_negative},
    {.name = "equilibrium point",
     .type = KeyType::number_or_map,
     .unit = "m or rad",
     .fallback = "middle of the limits",
     .meaning = "Springs.",
     .sub = &kLinearAngular},
    {.name = "equiblirium point",
     .type = KeyType::number_or_map,
     .sub = &kLinearAngular,
     .status = KeyStatus::older,
     .preferred = "equilibrium point"},
    {.name = "hold",
     .type = KeyType::boolean,
     .member = to<&Joint::hold>(),
     .meaning = "Keeps its last position target when the command ends, because nothing came for 0.5 s. Without it the "
                "joint is let go then: an arm sinks half a second after its script."},
    {.name = "mimic",
     .type = KeyType::map,
     .member = to<&Joint::mimic>(),
     .fallback = "none",
     .meaning =
         "Follows another joint, and moves it in turn: a row of the solver ties both, as gears do. With `--solver "
         "direct` only.",
     .sub = &kMimic},
    {.name = "ignore inter-collision",
     .type = KeyType::boolean,
     .member = to<&Joint::ignore_inter_collision>(),
     .meaning = "No collisions between parent and child."},
    {.name = "detached",
     .type = KeyType::boolean,
     .meaning = "Written by the Blender add-on.",
     .status = KeyStatus::ignored},
    {.name = "redundant",
     .type = KeyType::boolean,
     .meaning = "Written by the Blender add-on.",
     .status = KeyStatus::ignored},
    {.name = "origin",
     .type = KeyType::map,
     .meaning = "Never had an effect.",
     .sub = &kPose,
     .status = KeyStatus::ignored},
    {.name = "axis", .type = KeyType::vector, .meaning = "Never had an effect.", .status = KeyStatus::ignored},
};

constexpr Key kJointGainsKeys[] = {
    {.name = "P", .type = KeyType::number, .member = to<&JointGains::p>(), .meaning = "On the error."},
    {.name = "I", .type = KeyType::number, .member = to<&JointGains::i>(), .meaning = "On its integral."},
    {.name = "D", .type = KeyType::number, .member = to<&JointGains::d>(), .meaning = "On its derivative."},
};

constexpr Key kJointLimitsKeys[] = {
    {.name = "low", .type = KeyType::number, .unit = "rad or m", .meaning = "Both are needed."},
    {.name = "high", .type = KeyType::number, .unit = "rad or m"},
    {.name = "x",
     .type = KeyType::number,
     .member = to<&Joint::cone_limits, &math::Vec3::x>(),
     .unit = "rad",
     .meaning = "cone twist",
     .rule = Rule::not_negative},
    {.name = "y",
     .type = KeyType::number,
     .member = to<&Joint::cone_limits, &math::Vec3::y>(),
     .unit = "rad",
     .meaning = "cone twist",
     .rule = Rule::not_negative},
    {.name = "z",
     .type = KeyType::number,
     .member = to<&Joint::cone_limits, &math::Vec3::z>(),
     .unit = "rad",
     .meaning = "cone twist",
     .rule = Rule::not_negative},
    {.name = "linear",
     .type = KeyType::map,
     .fallback = "-1.2 to 1.2",
     .meaning = "six dof, six dof spring",
     .sub = &kRangeXyz},
    {.name = "angular",
     .type = KeyType::map,
     .fallback = "-1.2 to 1.2",
     .meaning = "six dof, six dof spring",
     .sub = &kRangeXyz},
};

constexpr Key kMimicKeys[] = {
    {.name = "joint",
     .type = KeyType::text,
     .member = to<&Mimic::joint>(),
     .meaning = "Joint block that it follows; a part of its name is enough when only one joint has it.",
     .required = true},
    {.name = "multiplier",
     .type = KeyType::number,
     .member = to<&Mimic::multiplier>(),
     .meaning = "On the other's angle or shift."},
    {.name = "offset",
     .type = KeyType::number,
     .member = to<&Mimic::offset>(),
     .unit = "rad or m",
     .meaning = "Added."},
};

constexpr Key kRangeXyzKeys[] = {
    {.name = "low", .type = KeyType::vector, .required = true},
    {.name = "high", .type = KeyType::vector, .required = true},
};

constexpr Key kLinearAngularKeys[] = {
    {.name = "linear", .type = KeyType::vector},
    {.name = "angular", .type = KeyType::vector},
};

constexpr const Group* kIdentityOnly[] = {&kIdentity};

}  // namespace

const Group kJoint{.title = "joint",
                   .meaning = "A joint of two bodies.",
                   .keys = kJointKeys,
                   .includes = kIdentityOnly,
                   .is_block = true};
const Group kJointGains{.title = "gains of a joint", .keys = kJointGainsKeys};
const Group kJointLimits{.title = "joint limits", .keys = kJointLimitsKeys};
const Group kMimic{.title = "mimic", .meaning = "q = multiplier q_joint + offset.", .keys = kMimicKeys};
const Group kRangeXyz{.title = "limits of six dof", .keys = kRangeXyzKeys};
const Group kLinearAngular{.title = "values of six dof spring", .keys = kLinearAngularKeys};

}  // namespace ambf::scene::group

namespace ambf::scene::kind {

const BlockKind kJoint{
    .group = &group::kJoint,
    .list = {.name = "joints", .type = KeyType::texts, .meaning = "Joint blocks to load, in this order."},
    .prefix = "JOINT ",
    .simulated = true};

}  // namespace ambf::scene::kind
