// What ros_comm does for each kind of object: how its topics are opened, which lists of the Step service are its own,
// how List shows it. One entry a kind, each in a file of its own; the rest of ros_comm names no kind. An object whose
// kind has no entry has no topics. Kinds are added before the first simulation starts, from one thread, and only read
// afterwards. C++17.
#pragma once

#include <ambf_msgs/JointInfo.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "comm/middleware.h"
#include "state/abilities/abilities.h"
#include "state/structure.h"

namespace ambf::ros_comm {

class ImageDesk;
class Node;
class ParameterServer;
class StepLists;

// What endpoints are made with. All of it outlives them.
struct EndpointParts {
  Node& node;
  ImageDesk& images;
  ParameterServer& parameters;
  const state::Abilities& simulation;
};

struct EndpointKind {
  // Opens the topics of an object; throws when ROS rejects a name. Null: objects of this kind have none.
  std::unique_ptr<comm::Endpoint> (*open)(const EndpointParts& parts, const state::ObjectInfo& object,
                                          const std::string& topic) = nullptr;
  const StepLists* step = nullptr;  // null: the Step service has no lists for this kind
  // Set for joints, which List and Load answer in lists of their own: fills what only a joint has.
  void (*describe_joint)(const state::Structure& structure, std::uint32_t slot, ambf_msgs::JointInfo& info) = nullptr;
};

// Replaces the entry of a kind that has one.
void add_endpoint_kind(state::ObjectKind kind, const EndpointKind& entry);

// Null when the kind has no entry.
const EndpointKind* endpoint_kind(state::ObjectKind kind);

struct RegisteredEndpointKind {
  state::ObjectKind kind;
  EndpointKind entry;
};
// In the order in which they were added; the built-in ones first, in the order of their lists in the Step service.
const std::vector<RegisteredEndpointKind>& endpoint_kinds();

// For EndpointKind::open.
template <class SomeEndpoint>
std::unique_ptr<comm::Endpoint> make_endpoint(const EndpointParts& parts, const state::ObjectInfo& object,
                                              const std::string& topic) {
  return std::make_unique<SomeEndpoint>(parts, object, topic);
}

// The built-in entries.
EndpointKind actuator_endpoint_kind();
EndpointKind body_endpoint_kind();
EndpointKind camera_endpoint_kind();
EndpointKind ghost_endpoint_kind();
EndpointKind joint_endpoint_kind();
EndpointKind light_endpoint_kind();
EndpointKind sensor_endpoint_kind();
EndpointKind soft_body_endpoint_kind();
EndpointKind task_endpoint_kind();
EndpointKind vehicle_endpoint_kind();

}  // namespace ambf::ros_comm
