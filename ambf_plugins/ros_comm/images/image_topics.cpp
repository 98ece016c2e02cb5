#include "ros_comm/images/image_topics.h"

#include "ros_comm/images/image_messages.h"

namespace ambf::ros_comm {

namespace {

constexpr std::uint32_t kImageQueue = 1;  // of slow listeners the older picture is dropped

}  // namespace

ImageTopics::Color::Color(Node& node, const std::string& topic)
    : raw(node, topic + "/ImageData", kImageQueue),
      compressed(node, topic + "/ImageData/compressed", kImageQueue),
      info(node, topic + "/camera_info", kImageQueue),
      third_generation_info(node, topic + "/CameraInfo", kImageQueue) {}

ImageTopics::Mask::Mask(Node& node, const std::string& topic)
    : image(node, topic + "/MaskData", kImageQueue), labels(node, topic + "/MaskData/labels", 1, true) {}

ImageTopics::Depth::Depth(Node& node, const std::string& topic)
    : cloud(node, topic + "/DepthData", kImageQueue),
      image(node, topic + "/depth/ImageData", kImageQueue),
      info(node, topic + "/depth/camera_info", kImageQueue) {}

ImageTopics::ImageTopics(Node& node, const std::string& camera_topic, const std::string& camera_name,
                         const state::CameraInfo& camera, const JpegEncoder& encode)
    : node_(node),
      frame_(camera_name),
      optical_frame_(camera_name + "_optical"),
      eyes_frame_(camera_name + "_left_optical"),
      encode_(encode) {
  if (camera.image.on) {
    colors_[0] = std::make_unique<Color>(node, camera_topic);
    mask_ = std::make_unique<Mask>(node, camera_topic);
  }
  if (camera.image.on && camera.lens.stereo) {
    colors_[1] = std::make_unique<Color>(node, camera_topic + "/left");
    colors_[2] = std::make_unique<Color>(node, camera_topic + "/right");
  }
  if (camera.depth.on) depth_ = std::make_unique<Depth>(node, camera_topic);
}

state::PictureWishes ImageTopics::wishes() const {
  state::PictureWishes out;
  for (std::size_t eye = 0; eye < state::kEyes; ++eye) {
    if (colors_[eye] == nullptr) continue;
    out.color[eye] = colors_[eye]->raw.subscribers() + colors_[eye]->compressed.subscribers() > 0;
    out.geometry[eye] = colors_[eye]->info.subscribers() + colors_[eye]->third_generation_info.subscribers() > 0;
  }
  if (mask_ != nullptr) {
    out.mask = mask_->image.subscribers() > 0 || (mask_->labels.subscribers() > 0 && !mask_->labelled);
  }
  if (depth_ != nullptr) {
    out.depth = depth_->image.subscribers() > 0;
    out.depth_color = depth_->cloud.subscribers() > 0;
    out.depth_geometry = depth_->info.subscribers() > 0;
  }
  return out;
}

template <class Message>
void ImageTopics::send(const TopicPublisher<Message>& topic, const Message& message) {
  topic.publish(message);
  node_.traffic().picture_sent(topic.name());
}

void ImageTopics::publish(const state::Picture& picture) {
  switch (picture.kind) {
    case state::PictureKind::color:
      if (Color* topics = colors_[static_cast<std::size_t>(picture.eye)].get()) publish_color(picture, *topics);
      break;
    case state::PictureKind::mask:
      if (mask_ != nullptr) publish_mask(picture);
      break;
    case state::PictureKind::depth:
      if (depth_ != nullptr) publish_depth(picture);
      break;
  }
}

void ImageTopics::publish_color(const state::Picture& picture, Color& topics) {
  const std::string& frame = picture.eye == state::Eye::middle ? optical_frame_ : eyes_frame_;
  for (const auto* info : {&topics.info, &topics.third_generation_info}) {
    if (info->subscribers() > 0) info->publish(camera_info(picture, frame));
  }
  if (picture.rgb.empty()) return;
  if (topics.raw.subscribers() > 0) send(topics.raw, color_image(picture, frame));
  if (topics.compressed.subscribers() == 0) return;
  std::vector<std::uint8_t> jpeg = encode_(picture.rgb, picture.intrinsics.width, picture.intrinsics.height);
  if (!jpeg.empty()) send(topics.compressed, jpeg_image(picture, std::move(jpeg), frame));
}

void ImageTopics::publish_mask(const state::Picture& picture) {
  if (!mask_->labelled || picture.structure->version != mask_->labelled_version) {
    mask_->labelled = true;
    mask_->labelled_version = picture.structure->version;
    mask_->labels.publish(object_labels(picture, optical_frame_));
  }
  if (mask_->image.subscribers() > 0) send(mask_->image, mask_image(picture, optical_frame_));
}

void ImageTopics::publish_depth(const state::Picture& picture) {
  if (depth_->info.subscribers() > 0) depth_->info.publish(camera_info(picture, optical_frame_));
  if (picture.depth_m.empty()) return;
  if (depth_->image.subscribers() > 0) send(depth_->image, depth_image(picture, optical_frame_));
  // Who asks for clouds while a picture is drawn gets the next one: this one has no colours.
  if (depth_->cloud.subscribers() > 0 && !picture.rgb.empty()) send(depth_->cloud, point_cloud(picture, frame_));
}

}  // namespace ambf::ros_comm
