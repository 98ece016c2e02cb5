#include "dvrk_arm/drivers.h"

#include <memory>

#include "dvrk_arm/ros_driver.h"
#include "dvrk_arm/ros_topics.h"

namespace ambf::dvrk_arm {

void register_drivers(ros_comm::Node& node, base::Log& log) {
  devices::register_driver({"ros_arm", {"MTML", "MTMR"}, [&node, &log](const devices::DriverRequest& request) {
                              return std::make_unique<RosDriver>(node, log, arm_topics(request));
                            }});
  devices::register_driver({"ros_generic", {}, [&node, &log](const devices::DriverRequest& request) {
                              return std::make_unique<RosDriver>(node, log, generic_topics(request));
                            }});
}

}  // namespace ambf::dvrk_arm
