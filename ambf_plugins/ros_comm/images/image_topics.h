// The topics of one camera's pictures: what is listened to and what is sent. Private to ros_comm. C++17.
//
//   ImageData, ImageData/compressed, camera_info,       publish image; for a stereo camera also left/... and right/...
//   CameraInfo
//   MaskData, MaskData/labels                           publish image
//   DepthData, depth/ImageData, depth/camera_info       publish depth
#pragma once

#include <ambf_msgs/ObjectLabels.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/CompressedImage.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/PointCloud2.h>

#include <array>
#include <atomic>
#include <memory>
#include <string>

#include "ros_comm/endpoints/topics.h"
#include "ros_comm/images/jpeg_encoder.h"
#include "state/picture.h"

namespace ambf::ros_comm {

class ImageTopics {
 public:
  // Throws when ROS does not accept a topic.
  ImageTopics(Node& node, const std::string& camera_topic, const std::string& camera_name,
              const state::CameraInfo& camera, const JpegEncoder& encode);

  state::PictureWishes wishes() const;          // any thread
  void publish(const state::Picture& picture);  // one thread

 private:
  struct Color {
    Color(Node& node, const std::string& topic);
    TopicPublisher<sensor_msgs::Image> raw;
    TopicPublisher<sensor_msgs::CompressedImage> compressed;
    TopicPublisher<sensor_msgs::CameraInfo> info;
    TopicPublisher<sensor_msgs::CameraInfo> third_generation_info;  // the same by the topic of AMBF 3.0
  };
  struct Mask {
    Mask(Node& node, const std::string& topic);
    TopicPublisher<sensor_msgs::Image> image;
    TopicPublisher<ambf_msgs::ObjectLabels> labels;
    std::atomic<bool> labelled{false};   // once at least
    std::uint64_t labelled_version = 0;  // of the structure
  };
  struct Depth {
    Depth(Node& node, const std::string& topic);
    TopicPublisher<sensor_msgs::PointCloud2> cloud;
    TopicPublisher<sensor_msgs::Image> image;
    TopicPublisher<sensor_msgs::CameraInfo> info;
  };

  void publish_color(const state::Picture& picture, Color& topics);
  void publish_mask(const state::Picture& picture);
  void publish_depth(const state::Picture& picture);
  template <class Message>
  void send(const TopicPublisher<Message>& topic, const Message& message);

  Node& node_;
  const std::string frame_, optical_frame_;
  const std::string
      eyes_frame_;  // of both eyes, as ROS has it: the left one's; P[3] of the right one says how far aside that is
  const JpegEncoder& encode_;
  std::array<std::unique_ptr<Color>, state::kEyes> colors_;
  std::unique_ptr<Mask> mask_;
  std::unique_ptr<Depth> depth_;
};

}  // namespace ambf::ros_comm
