// Two messages of ROS that not every system has the headers of: tf2_msgs/TFMessage and std_srvs/Trigger, as ROS's
// serialization wants them. Their types and md5 are ROS's. C++17.
#pragma once

#include <geometry_msgs/TransformStamped.h>
#include <ros/message_traits.h>
#include <ros/serialization.h>
#include <ros/service_traits.h>

#include <cstdint>
#include <string>
#include <vector>

namespace ambf::crtk {

struct Transforms {
  std::vector<geometry_msgs::TransformStamped> transforms;
};

struct TriggerRequest {};
struct TriggerResponse {
  std::uint8_t success = 0;
  std::string message;
};
struct Trigger {
  using Request = TriggerRequest;
  using Response = TriggerResponse;
};

}  // namespace ambf::crtk

namespace ros {
namespace message_traits {

template <>
struct IsMessage<ambf::crtk::Transforms> : TrueType {};
template <>
struct IsMessage<ambf::crtk::TriggerRequest> : TrueType {};
template <>
struct IsMessage<ambf::crtk::TriggerResponse> : TrueType {};

template <>
struct MD5Sum<ambf::crtk::Transforms> {
  static const char* value() { return "94810edda583a504dfda3829e70d7eec"; }
  static const char* value(const ambf::crtk::Transforms&) { return value(); }
};
template <>
struct MD5Sum<ambf::crtk::TriggerRequest> {
  static const char* value() { return "d41d8cd98f00b204e9800998ecf8427e"; }
  static const char* value(const ambf::crtk::TriggerRequest&) { return value(); }
};
template <>
struct MD5Sum<ambf::crtk::TriggerResponse> {
  static const char* value() { return "937c9679a518e3a18d831e57125ea522"; }
  static const char* value(const ambf::crtk::TriggerResponse&) { return value(); }
};

template <>
struct DataType<ambf::crtk::Transforms> {
  static const char* value() { return "tf2_msgs/TFMessage"; }
  static const char* value(const ambf::crtk::Transforms&) { return value(); }
};
template <>
struct DataType<ambf::crtk::TriggerRequest> {
  static const char* value() { return "std_srvs/TriggerRequest"; }
  static const char* value(const ambf::crtk::TriggerRequest&) { return value(); }
};
template <>
struct DataType<ambf::crtk::TriggerResponse> {
  static const char* value() { return "std_srvs/TriggerResponse"; }
  static const char* value(const ambf::crtk::TriggerResponse&) { return value(); }
};

template <>
struct Definition<ambf::crtk::Transforms> {
  static const char* value() {
    static const std::string text = std::string("geometry_msgs/TransformStamped[] transforms\n") +
                                    std::string(80, '=') + "\nMSG: geometry_msgs/TransformStamped\n" +
                                    Definition<geometry_msgs::TransformStamped>::value();
    return text.c_str();
  }
  static const char* value(const ambf::crtk::Transforms&) { return value(); }
};
template <>
struct Definition<ambf::crtk::TriggerRequest> {
  static const char* value() { return "\n"; }
  static const char* value(const ambf::crtk::TriggerRequest&) { return value(); }
};
template <>
struct Definition<ambf::crtk::TriggerResponse> {
  static const char* value() { return "bool success\nstring message\n"; }
  static const char* value(const ambf::crtk::TriggerResponse&) { return value(); }
};

}  // namespace message_traits

namespace serialization {

template <>
struct Serializer<ambf::crtk::Transforms> {
  template <typename Stream, typename T>
  inline static void allInOne(Stream& stream, T message) {  // NOLINT(readability-identifier-naming): ROS calls it
    stream.next(message.transforms);
  }
  ROS_DECLARE_ALLINONE_SERIALIZER
};
template <>
struct Serializer<ambf::crtk::TriggerRequest> {
  template <typename Stream, typename T>
  inline static void allInOne(Stream&, T) {}  // NOLINT(readability-identifier-naming): ROS calls it
  ROS_DECLARE_ALLINONE_SERIALIZER
};
template <>
struct Serializer<ambf::crtk::TriggerResponse> {
  template <typename Stream, typename T>
  inline static void allInOne(Stream& stream, T message) {  // NOLINT(readability-identifier-naming): ROS calls it
    stream.next(message.success);
    stream.next(message.message);
  }
  ROS_DECLARE_ALLINONE_SERIALIZER
};

}  // namespace serialization

namespace service_traits {

template <class T>
struct TriggerSum {
  static const char* value() { return "937c9679a518e3a18d831e57125ea522"; }
  static const char* value(const T&) { return value(); }
};
template <>
struct MD5Sum<ambf::crtk::TriggerRequest> : TriggerSum<ambf::crtk::TriggerRequest> {};
template <>
struct MD5Sum<ambf::crtk::TriggerResponse> : TriggerSum<ambf::crtk::TriggerResponse> {};

template <class T>
struct TriggerName {
  static const char* value() { return "std_srvs/Trigger"; }
  static const char* value(const T&) { return value(); }
};
template <>
struct DataType<ambf::crtk::TriggerRequest> : TriggerName<ambf::crtk::TriggerRequest> {};
template <>
struct DataType<ambf::crtk::TriggerResponse> : TriggerName<ambf::crtk::TriggerResponse> {};

}  // namespace service_traits
}  // namespace ros
