// A rigid body.
#include "scene/block_kinds.h"
#include "scene/description.h"
#include "scene/detail/groups.h"

namespace ambf::scene::group {

namespace {

constexpr Key kBodyKeys[] = {
    {.name = "mass",
     .type = KeyType::number,
     .member = to<&Body::mass>(),
     .unit = "kg",
     .meaning = "0: static.",
     .rule = Rule::not_negative},
    {.name = "inertia",
     .type = KeyType::map,
     .unit = "kg m^2",
     .fallback = "of the collision shape",
     .meaning = "Principal, at the centre of mass.",
     .sub = &kInertia},
    {.name = "inertial offset",
     .type = KeyType::map,
     .member = to<&Body::inertial_offset>(),
     .fallback = "mean of the collision mesh's vertices; none for primitives",
     .meaning = "Pose of the centre of mass in the body.",
     .sub = &kPose},
    {.name = "gravity",
     .type = KeyType::vector,
     .member = to<&Body::gravity>(),
     .unit = "m/s^2",
     .fallback = "the file's, else the world's"},
    {.name = "location",
     .type = KeyType::map,
     .member = to<&Body::T_world_body>(),
     .fallback = "the origin",
     .meaning = "Pose of the body (its mesh) in the world.",
     .sub = &kPose},
    {.name = "friction",
     .type = KeyType::map,
     .member = to<&Body::surface>(),
     .meaning = "Bullet's coefficients.",
     .sub = &kFriction},
    {.name = "restitution",
     .type = KeyType::number,
     .member = to<&Body::surface, &Surface::restitution>(),
     .rule = Rule::not_negative},
    {.name = "damping",
     .type = KeyType::map,
     .member = to<&Body::surface>(),
     .meaning = "Part of the velocity that is lost in a second.",
     .sub = &kBodyDamping},
    {.name = "controller",
     .type = KeyType::map,
     .fallback = "velocity with P = 10, D = 1",
     .meaning = "Cartesian controller. A channel that is given has FORCE as output, the other one stays at VELOCITY.",
     .sub = &kCartesianController},
    {.name = "controller output type",
     .type = KeyType::choice,
     .meaning = "Output of both channels; read with `controller` only.",
     .words = kOutputWords,
     .instead = "FORCE"},
    {.name = "hold",
     .type = KeyType::boolean,
     .member = to<&Body::hold>(),
     .meaning =
         "Keeps its last pose target, and position targets of joints commanded through it, when the command ends, "
         "because nothing came for 0.5 s. Without it they are let go then."},
    {.name = "publish children names",
     .type = KeyType::boolean,
     .member = to<&Body::publish_children_names>(),
     .meaning = "In the State topic."},
    {.name = "publish joint names",
     .type = KeyType::boolean,
     .member = to<&Body::publish_joint_names>(),
     .meaning = "In the State topic."},
    {.name = "publish joint positions",
     .type = KeyType::boolean,
     .member = to<&Body::publish_joint_positions>(),
     .meaning = "In the State topic; velocities and efforts too."},
    {.name = "inertial offset undef", .type = KeyType::text, .status = KeyStatus::ignored},
    {.name = "resistive surface",
     .type = KeyType::map,
     .meaning = "Rays that feel and resist, one a triangle.",
     .sub = &kResistiveSurface},
};

constexpr Key kInertiaKeys[] = {
    {.name = "ix", .type = KeyType::number, .unit = "kg m^2", .rule = Rule::not_negative, .required = true},
    {.name = "iy", .type = KeyType::number, .unit = "kg m^2", .rule = Rule::not_negative, .required = true},
    {.name = "iz", .type = KeyType::number, .unit = "kg m^2", .rule = Rule::not_negative, .required = true},
};

constexpr Key kFrictionKeys[] = {
    {.name = "static",
     .type = KeyType::number,
     .member = to<&Surface::friction>(),
     .meaning = "Sliding.",
     .rule = Rule::not_negative},
    {.name = "rolling",
     .type = KeyType::number,
     .member = to<&Surface::rolling_friction>(),
     .unit = "m",
     .meaning =
         "Lever that resists rolling; at most 2 % of the reach of a body that is no ball, capsule, cylinder or cone.",
     .rule = Rule::not_negative},
};

constexpr Key kBodyDampingKeys[] = {
    {.name = "linear", .type = KeyType::number, .member = to<&Surface::linear_damping>(), .rule = Rule::not_negative},
    {.name = "angular", .type = KeyType::number, .member = to<&Surface::angular_damping>(), .rule = Rule::not_negative},
};

constexpr Key kCartesianControllerKeys[] = {
    {.name = "linear",
     .type = KeyType::map,
     .member = to<&Body::linear>(),
     .unit = "N/m",
     .meaning = "Gains in world axes.",
     .sub = &kGains},
    {.name = "angular",
     .type = KeyType::map,
     .member = to<&Body::angular>(),
     .unit = "Nm/rad",
     .meaning = "Gains in the body's axes.",
     .sub = &kGains},
};

constexpr const Group* kLooks[] = {&kIdentity, &kVisual, &kCollision, &kColor};

}  // namespace

const Group kBody{.title = "body", .meaning = "A rigid body.", .keys = kBodyKeys, .includes = kLooks, .is_block = true};
const Group kInertia{.title = "inertia", .keys = kInertiaKeys};
const Group kFriction{.title = "friction", .keys = kFrictionKeys};
const Group kBodyDamping{.title = "damping of a body", .keys = kBodyDampingKeys};
const Group kCartesianController{.title = "controller of a body", .keys = kCartesianControllerKeys};

}  // namespace ambf::scene::group

namespace ambf::scene::kind {

const BlockKind kBody{
    .group = &group::kBody,
    .list = {.name = "bodies", .type = KeyType::texts, .meaning = "Body blocks to load, in this order."},
    .prefix = "BODY ",
    .simulated = true};

}  // namespace ambf::scene::kind
