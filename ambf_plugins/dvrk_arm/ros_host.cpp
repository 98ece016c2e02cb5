#include "dvrk_arm/ros_host.h"

#include "dvrk_arm/ros_driver.h"

namespace ambf::dvrk_arm {

void RosHost::attach(ros_comm::Node& node) {
  const std::unique_lock<std::shared_mutex> lock(mutex_);
  ending_ = false;
  node_ = &node;
}

void RosHost::detach() {
  ending_ = true;  // a driver that is opening gives up
  const std::unique_lock<std::shared_mutex> lock(mutex_);
  const std::lock_guard<std::mutex> drivers_lock(drivers_mutex_);
  for (RosDriver* driver : drivers_) driver->end_session();
  node_ = nullptr;
}

void RosHost::add(RosDriver& driver) {
  const std::lock_guard<std::mutex> lock(drivers_mutex_);
  drivers_.insert(&driver);
}

void RosHost::remove(RosDriver& driver) {
  const std::lock_guard<std::mutex> lock(drivers_mutex_);
  drivers_.erase(&driver);
}

}  // namespace ambf::dvrk_arm
