// The comm instance of a camera on ROS: its pose like any other, and its pictures where its file publishes some. Private to ros_comm.
// C++17.
#pragma once

#include <memory>
#include <string>

#include "ros_comm/endpoints/pose_endpoint.h"
#include "ros_comm/images/image_desk.h"

namespace ambf::ros_comm {

class CameraEndpoint final : public comm::Endpoint {
 public:
  CameraEndpoint(Node& node, ImageDesk& desk, const state::ObjectInfo& object, const std::string& topic,
                 state::CommandAbility& command, state::ObserveAbility& observe, ParameterServer& parameters)
      : pose_(node, object, topic, command, parameters) {
    const std::shared_ptr<const state::Structure> structure = observe.structure();
    const std::uint32_t found = state::find(*structure, object.id);
    if (found == state::kNone) return;  // it is gone already
    const state::CameraInfo& camera = structure->cameras[structure->objects[found].slot];
    if (camera.image.on || camera.depth.on) {
      pictures_ = std::make_unique<ImageDesk::Place>(desk, object, topic, camera);
    }
  }

  bool has_subscribers() const override { return pose_.has_subscribers(); }
  void publish(const state::Frame& frame, std::uint32_t slot) override { pose_.publish(frame, slot); }
  void watch(const state::Frame& frame, bool active) override { pose_.watch(frame, active); }

 private:
  PoseEndpoint<ambf_msgs::CameraState, ambf_msgs::CameraCmd> pose_;
  std::unique_ptr<ImageDesk::Place> pictures_;
};

}  // namespace ambf::ros_comm
