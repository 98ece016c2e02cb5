// The classes of crtk_msgs have the wire formats of CRTK's own package, whichever of the two is used.
#include <crtk_msgs/CartesianImpedance.h>
#include <crtk_msgs/CartesianImpedanceHalfPlaneGains.h>
#include <crtk_msgs/CartesianServo.h>
#include <crtk_msgs/CartesianState.h>
#include <crtk_msgs/JointServo.h>
#include <crtk_msgs/OperatingState.h>
#include <crtk_msgs/QueryForwardKinematics.h>
#include <crtk_msgs/QueryInverseKinematics.h>
#include <crtk_msgs/SetpointMode.h>
#include <crtk_msgs/StringStamped.h>
#include <crtk_msgs/TriggerOperatingState.h>
#include <gtest/gtest.h>
#include <ros/message_traits.h>
#include <ros/service_traits.h>

namespace {

template <class Message>
void expect_message(const char* md5) {
  EXPECT_STREQ(ros::message_traits::md5sum<Message>(), md5) << ros::message_traits::datatype<Message>();
}
template <class Service>
void expect_service(const char* md5) {
  EXPECT_STREQ(ros::service_traits::md5sum<Service>(), md5) << ros::service_traits::datatype<Service>();
}

}  // namespace

TEST(WireFormat, MessagesOfCrtkAreThoseOfItsPrograms) {
  namespace m = crtk_msgs;
  expect_message<m::OperatingState>("b1bd4021639d9d9c5fbfff78d6ff3158");
  expect_message<m::StringStamped>("5e3e46086181199270f1ac3a28a5977f");
  expect_message<m::CartesianImpedanceHalfPlaneGains>("b8790a9e2c72de6fc930123c128d3b77");
  expect_message<m::CartesianImpedance>("59675c5b57c990d0b76f7f0c9954d4f3");
  expect_message<m::CartesianState>("3913bf7ef8bcc8fa7a8eb33a46f273db");
  expect_message<m::SetpointMode>("45488f3061f396e81b1a70a7e6acdfa4");
  expect_message<m::CartesianServo>("6a249c3960a5b413513e5f1e23a82d6d");
  expect_message<m::JointServo>("660a5227424e1ddeb4a13710d9166974");
  expect_service<m::TriggerOperatingState>("d941a2d049e2c9ac5773fc4a3a8a892d");
  expect_service<m::QueryForwardKinematics>("787c6da7a75e9886573c4af11f1a381f");
  expect_service<m::QueryInverseKinematics>("ce8dbc3b4384e2f7567488e7e75496d8");
}
