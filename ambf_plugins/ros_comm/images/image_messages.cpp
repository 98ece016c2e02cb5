#include "ros_comm/images/image_messages.h"

#include <cmath>
#include <cstring>
#include <limits>
#include <utility>

#include "state/soft_bodies.h"

namespace ambf::ros_comm {

namespace {

std_msgs::Header header_of(const state::Picture& picture, const std::string& frame_id) {
  std_msgs::Header header;
  header.stamp.fromNSec(static_cast<std::uint64_t>(picture.system_ns));
  header.frame_id = frame_id;
  return header;
}

template <class Pixel>
sensor_msgs::Image image(const state::Picture& picture, const std::string& frame_id, const char* encoding,
                         const std::vector<Pixel>& pixels, std::size_t values_a_pixel) {
  sensor_msgs::Image out;
  out.header = header_of(picture, frame_id);
  out.width = static_cast<std::uint32_t>(picture.intrinsics.width);
  out.height = static_cast<std::uint32_t>(picture.intrinsics.height);
  out.encoding = encoding;
  out.is_bigendian = 0;
  out.step = static_cast<std::uint32_t>(out.width * values_a_pixel * sizeof(Pixel));
  out.data.resize(pixels.size() * sizeof(Pixel));
  std::memcpy(out.data.data(), pixels.data(), out.data.size());
  return out;
}

sensor_msgs::PointField field(const char* name, std::uint32_t offset) {
  sensor_msgs::PointField out;
  out.name = name;
  out.offset = offset;
  out.datatype = sensor_msgs::PointField::FLOAT32;
  out.count = 1;
  return out;
}

}  // namespace

sensor_msgs::Image color_image(const state::Picture& picture, const std::string& frame_id) {
  return image(picture, frame_id, "rgb8", picture.rgb, 3);
}

sensor_msgs::Image depth_image(const state::Picture& picture, const std::string& frame_id) {
  return image(picture, frame_id, "32FC1", picture.depth_m, 1);
}

sensor_msgs::Image mask_image(const state::Picture& picture, const std::string& frame_id) {
  return image(picture, frame_id, "mono16", picture.mask, 1);
}

sensor_msgs::CompressedImage jpeg_image(const state::Picture& picture, std::vector<std::uint8_t> jpeg,
                                        const std::string& frame_id) {
  sensor_msgs::CompressedImage out;
  out.header = header_of(picture, frame_id);
  out.format = "rgb8; jpeg compressed bgr8";  // as image_transport's own plugin says it
  out.data = std::move(jpeg);
  return out;
}

sensor_msgs::CameraInfo camera_info(const state::Picture& picture, const std::string& frame_id) {
  const state::Intrinsics& in = picture.intrinsics;
  sensor_msgs::CameraInfo out;
  out.header = header_of(picture, frame_id);
  out.width = static_cast<std::uint32_t>(in.width);
  out.height = static_cast<std::uint32_t>(in.height);
  // ROS knows no parallel rays: a name of our own keeps programs from dividing by z.
  out.distortion_model = in.orthographic ? "orthographic" : "plumb_bob";
  out.D.assign(5, 0.0);
  out.K = {in.fx, in.skew, in.cx, 0.0, in.fy, in.cy, 0.0, 0.0, 1.0};
  out.R = {1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0};
  out.P = {in.fx, in.skew, in.cx, -in.fx * in.baseline_m, 0.0, in.fy, in.cy, 0.0, 0.0, 0.0, 1.0, 0.0};
  return out;
}

sensor_msgs::PointCloud2 point_cloud(const state::Picture& picture, const std::string& frame_id) {
  const state::Intrinsics& in = picture.intrinsics;
  sensor_msgs::PointCloud2 out;
  out.header = header_of(picture, frame_id);
  out.width = static_cast<std::uint32_t>(in.width);
  out.height = static_cast<std::uint32_t>(in.height);
  out.fields = {field("x", 0), field("y", 4), field("z", 8), field("rgb", 12)};
  out.point_step = 16;
  out.row_step = out.point_step * out.width;
  out.is_bigendian = 0;
  out.is_dense = 0;
  const std::size_t points = picture.depth_m.size();
  out.data.resize(points * out.point_step);
  std::uint8_t* to = out.data.data();
  for (std::size_t i = 0; i < points; ++i, to += out.point_step) {
    const double depth = static_cast<double>(picture.depth_m[i]);
    const double along = in.orthographic ? 1.0 : depth;
    const std::size_t column = i % out.width, row = i / out.width;
    const double u = static_cast<double>(column), v = static_cast<double>(row);
    const double down = (v - in.cy) / in.fy, right = (u - in.cx - in.skew * down) / in.fx;
    float point[3] = {static_cast<float>(-depth), static_cast<float>(right * along), static_cast<float>(-down * along)};
    if (picture.points_m.size() >= 3 * points) {
      point[1] = picture.points_m[3 * i];
      point[2] = -picture.points_m[3 * i + 1];
    }
    if (std::isnan(depth)) point[1] = point[2] = std::numeric_limits<float>::quiet_NaN();
    std::memcpy(to, point, sizeof point);
    if (picture.rgb.size() < 3 * (i + 1)) continue;
    const std::uint8_t* rgb = &picture.rgb[3 * i];
    const std::uint32_t packed = (std::uint32_t{rgb[0]} << 16) | (std::uint32_t{rgb[1]} << 8) | rgb[2];
    std::memcpy(to + 12, &packed, sizeof packed);
  }
  return out;
}

ambf_msgs::ObjectLabels object_labels(const state::Picture& picture, const std::string& frame_id) {
  ambf_msgs::ObjectLabels out;
  out.header = header_of(picture, frame_id);
  const auto add = [&](std::uint32_t index) {
    const state::ObjectInfo& object = picture.structure->objects[index];
    out.ids.push_back(state::mask_id(object.id));
    out.names.push_back(object.name);
  };
  for (const state::BodyInfo& body : picture.structure->bodies) add(body.object);
  for (const state::SoftBodyInfo& body : state::soft_bodies(*picture.structure)) add(body.object);
  return out;
}

}  // namespace ambf::ros_comm
