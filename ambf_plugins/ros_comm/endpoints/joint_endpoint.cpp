// Joints on ROS: they have no topics of their own (their body's state has their values); List describes them.
#include "ros_comm/endpoints/endpoint_kinds.h"

namespace ambf::ros_comm {

namespace {

const char* type_name(state::JointType type) {
  static constexpr const char* kNames[] = {"fixed", "revolute",   "prismatic", "linear spring", "torsion spring",
                                           "p2p",   "cone twist", "six dof",   "six dof spring"};
  return kNames[static_cast<std::size_t>(type)];
}

void describe(const state::Structure& structure, std::uint32_t slot, ambf_msgs::JointInfo& info) {
  const state::JointInfo& joint = structure.joints[slot];
  info.type = type_name(joint.type);
  info.parent = structure.objects[structure.bodies[joint.parent_body].object].name;
  info.child = structure.objects[structure.bodies[joint.child_body].object].name;
  info.limited = joint.has_limits;
  info.lower = joint.lower;
  info.upper = joint.upper;
}

}  // namespace

EndpointKind joint_endpoint_kind() {
  EndpointKind kind;
  kind.describe_joint = describe;
  return kind;
}

}  // namespace ambf::ros_comm
