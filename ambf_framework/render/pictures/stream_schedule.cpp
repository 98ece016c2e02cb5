#include "render/pictures/detail/stream_schedule.h"

#include <algorithm>

namespace ambf::render {

namespace {

state::PictureWishes wishes_of(const state::Structure& structure, std::uint32_t slot, const state::PictureSink& sink) {
  const state::CameraInfo& info = structure.cameras[slot];
  if (!info.image.on && !info.depth.on) return {};
  return sink.wishes(structure.objects[info.object].id);
}

void add_images(const state::CameraInfo& info, const state::Lens& lens, const state::PictureWishes& wishes,
                std::uint32_t slot, std::vector<StreamOrder>& orders) {
  for (const state::Eye eye : {state::Eye::middle, state::Eye::left, state::Eye::right}) {
    if (eye != state::Eye::middle && !lens.stereo) continue;
    const auto at = static_cast<std::size_t>(eye);
    StreamOrder order;
    order.camera = slot;
    order.eye = eye;
    order.width = info.image.width;
    order.height = info.image.height;
    order.color = wishes.color[at];
    order.color_geometry = wishes.color[at] || wishes.geometry[at];
    order.mask = eye == state::Eye::middle && wishes.mask;
    if (order.color_geometry || order.mask) orders.push_back(order);
  }
}

void add_depth(const state::CameraInfo& info, const state::PictureWishes& wishes, std::uint32_t slot,
               std::vector<StreamOrder>& orders) {
  if (!wishes.depth && !wishes.depth_color && !wishes.depth_geometry) return;
  // Where the picture is due, too, and of the same size, it is drawn once.
  const auto same = std::find_if(orders.begin(), orders.end(), [&](const StreamOrder& order) {
    return order.camera == slot && order.eye == state::Eye::middle && order.width == info.depth.width &&
           order.height == info.depth.height;
  });
  StreamOrder* order = nullptr;
  if (same != orders.end()) {
    order = &*same;
  } else {
    orders.emplace_back();
    order = &orders.back();
    order->camera = slot;
    order->width = info.depth.width;
    order->height = info.depth.height;
  }
  order->depth = wishes.depth || wishes.depth_color;
  order->depth_color = wishes.depth_color;
  order->depth_geometry = order->depth || wishes.depth_geometry;
}

}  // namespace

std::vector<StreamOrder> StreamSchedule::due(const state::Frame& frame, const state::PictureSink& sink, bool all) {
  std::vector<StreamOrder> orders;
  const state::Structure& structure = *frame.structure;
  const auto now = [&](const state::ImageStream& stream) {
    return stream.on && (all || updates_ % std::max(1U, stream.interval) == 0);
  };
  for (std::uint32_t slot = 0; slot < structure.cameras.size(); ++slot) {
    const state::CameraInfo& info = structure.cameras[slot];
    if (!now(info.image) && !now(info.depth)) continue;
    const state::PictureWishes wishes = wishes_of(structure, slot, sink);
    if (now(info.image)) add_images(info, frame.cameras[slot].lens, wishes, slot, orders);
    if (now(info.depth)) add_depth(info, wishes, slot, orders);
  }
  ++updates_;
  return orders;
}

bool anything_wanted(const state::Structure& structure, const state::PictureSink& sink) {
  for (std::uint32_t slot = 0; slot < structure.cameras.size(); ++slot) {
    if (anything(wishes_of(structure, slot, sink))) return true;
  }
  return false;
}

}  // namespace ambf::render
