// What input devices show in the scene: their tools, their targets, and the frames of their mapping.
#include <algorithm>

#include "render/marks/device_text.h"
#include "render/marks/layer_shapes.h"

namespace ambf::render {

namespace {

struct NamedFrame {
  const char* name;
  math::Pose T_world;
};

// The 17 frames of Table 3.3 of the dissertation, in its order.
std::vector<NamedFrame> frames_in_world(const state::MappingFrames& f) {
  const math::Pose& T_world_u = f.T_world_u;
  const math::Pose T_world_base = T_world_u * f.T_u_base;
  return {{"S-W", {}},
          {"U", T_world_u},
          {"IID", T_world_u * f.T_u_iid},
          {"IID-B", T_world_base},
          {"IID-E", T_world_base * f.T_base_e},
          {"IID-BO", T_world_base * f.T_base_bo},
          {"IID-TO", T_world_base * f.T_base_e * f.T_e_to},
          {"IID-CL", T_world_u * f.T_u_iid_cl},
          {"IID-PRE-CL", T_world_u * f.T_u_iid_pre_cl},
          {"SDE", f.T_world_sde},
          {"SDE-BO", f.T_world_sde_bo},
          {"SDE-TO", f.T_world_sde * f.T_sde_to},
          {"SDE-REF", f.T_world_ref},
          {"SDE-REF-O", f.T_world_ref_o},
          {"CAM", f.T_world_cam},
          {"CAM-CL", f.T_world_cam_cl},
          {"CAM-PRE-CL", f.T_world_cam_pre_cl}};
}

}  // namespace

void draw_device_frames(const LayerInput& in, WorldShapes& out) {
  constexpr double kLength_px = 40.0, kWidth_px = 2.0;
  for (unsigned device = 0; in.devices != nullptr && device < in.devices->count(); ++device) {
    state::DeviceStatus status;
    if (!in.devices->status(device, status)) continue;
    const std::shared_ptr<const state::DeviceInfo> info = in.devices->info(device);
    for (const NamedFrame& frame : frames_in_world(status.frames)) {
      const double length = in.scale.metres(frame.T_world.position, kLength_px);
      out.axes(frame.T_world, length, kWidth_px * in.scale.ui());
      out.text(frame.T_world.position, info->name + ' ' + frame.name, color_of(*info), length);
    }
  }
}

void draw_devices(const LayerInput& in, WorldShapes& out) {
  constexpr double kDisc_px = 9.0;
  const state::Structure& structure = *in.frame.structure;
  for (unsigned device = 0; in.devices != nullptr && device < in.devices->count(); ++device) {
    const std::shared_ptr<const state::DeviceInfo> info = in.devices->info(device);
    const std::uint32_t object = state::find(structure, info->effector);
    state::DeviceStatus status;
    if (object == state::kNone || !in.devices->status(device, status)) continue;
    if (structure.objects[object].slot >= in.poses.bodies.size()) continue;
    if (is_left(*info, status)) continue;
    const DeviceRemark remark = remark_on(*info, status);
    const DebugColor color = color_of(*info, remark.alert);
    const math::Vec3& tool = in.poses.bodies[structure.objects[object].slot].position;
    out.point(tool, color, kDisc_px * in.scale.ui(), Seen::through);
    out.text(tool, remark.text.empty() ? info->name : info->name + ": " + remark.text, color);
    if (!info->visible) continue;
    const DebugColor ball = {static_cast<float>(info->visible_color.x), static_cast<float>(info->visible_color.y),
                             static_cast<float>(info->visible_color.z), 1.0F};
    out.sphere(status.frames.T_world_ref.position, info->visible_size / 2.0, ball);
  }
}

}  // namespace ambf::render
