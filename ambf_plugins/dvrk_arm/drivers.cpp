#include "dvrk_arm/drivers.h"

#include <memory>

#include "dvrk_arm/ros_driver.h"
#include "dvrk_arm/ros_host.h"
#include "dvrk_arm/ros_topics.h"

namespace ambf::dvrk_arm {

namespace {

// roscpp is started once in a process, and has one node.
RosHost& process_host() {
  static RosHost host;
  return host;
}

}  // namespace

void register_drivers(base::Log& log) {
  devices::register_driver({"ros_arm", {"MTML", "MTMR"}, [&log](const devices::DriverRequest& request) {
                              return std::make_unique<RosDriver>(process_host(), log, arm_topics(request));
                            }});
  devices::register_driver({"ros_generic", {}, [&log](const devices::DriverRequest& request) {
                              return std::make_unique<RosDriver>(process_host(), log, generic_topics(request));
                            }});
}

ArmConnection::ArmConnection(ros_comm::Node& node) { process_host().attach(node); }
ArmConnection::~ArmConnection() { process_host().detach(); }

}  // namespace ambf::dvrk_arm
