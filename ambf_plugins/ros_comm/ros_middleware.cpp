#include "ros_comm/ros_middleware.h"

#include "ros_comm/body_endpoint.h"
#include "ros_comm/node.h"
#include "ros_comm/pose_endpoint.h"
#include "ros_comm/world_endpoint.h"

namespace ambf::ros_comm {

namespace {

class Endpoints final : public RosMiddleware {
 public:
  explicit Endpoints(base::Log& log) : node_(log) {}

  bool available() const override { return node_.connected(); }

  std::unique_ptr<comm::Endpoint> open_world(const std::string& world_name, state::Control& control) override {
    return guarded(world_name, [&] { return std::make_unique<WorldEndpoint>(node_, world_name, control); });
  }

  std::unique_ptr<comm::Endpoint> open(const state::ObjectInfo& object, state::Control& control) override {
    return guarded(object.name, [&]() -> std::unique_ptr<comm::Endpoint> {
      switch (object.kind) {
        case state::ObjectKind::rigid_body: return std::make_unique<BodyEndpoint>(node_, object, control);
        case state::ObjectKind::camera: return std::make_unique<CameraEndpoint>(node_, object, control);
        case state::ObjectKind::light: return std::make_unique<LightEndpoint>(node_, object, control);
        case state::ObjectKind::joint:
        case state::ObjectKind::world: break;
      }
      return nullptr;
    });
  }

 private:
  // ROS throws for names and types it does not accept; no exception leaves this plugin.
  template <class Make>
  std::unique_ptr<comm::Endpoint> guarded(const std::string& name, Make make) {
    try {
      return make();
    } catch (const std::exception& e) {
      node_.log().error("ROS: no topics for '%s': %s", name.c_str(), e.what());
      return nullptr;
    }
  }

  Node node_;
};

}  // namespace

std::unique_ptr<RosMiddleware> RosMiddleware::start(base::Log& log) { return std::make_unique<Endpoints>(log); }

}  // namespace ambf::ros_comm
