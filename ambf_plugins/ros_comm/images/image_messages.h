// From pictures to ROS messages. Pure functions; private to ros_comm. C++17.
#pragma once

#include <ambf_msgs/ObjectLabels.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/CompressedImage.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/PointCloud2.h>

#include <string>

#include "state/picture.h"

namespace ambf::ros_comm {

sensor_msgs::Image color_image(const state::Picture& picture, const std::string& frame_id);
sensor_msgs::Image depth_image(const state::Picture& picture, const std::string& frame_id);  // 32FC1, m
sensor_msgs::Image mask_image(const state::Picture& picture, const std::string& frame_id);   // mono16
sensor_msgs::CompressedImage jpeg_image(const state::Picture& picture, std::vector<std::uint8_t> jpeg,
                                        const std::string& frame_id);
sensor_msgs::CameraInfo camera_info(const state::Picture& picture, const std::string& frame_id);

// One point a pixel, rows as in the picture, NaN where nothing is. In the camera's own frame: x backwards, y right, z
// up.
sensor_msgs::PointCloud2 point_cloud(const state::Picture& picture, const std::string& frame_id);

ambf_msgs::ObjectLabels object_labels(const state::Picture& picture, const std::string& frame_id);

}  // namespace ambf::ros_comm
