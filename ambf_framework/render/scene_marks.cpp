#include "render/scene_marks.h"

namespace ambf::render {

void SceneMarks::draw_marks(const WindowMoment& moment, FlatDrawing& marks) {
  constexpr double kAxisPart = 0.08, kWidth_px = 2.5;  // of the distance to the target
  constexpr FlatColor kPickColor = {0.68F, 1.0F, 0.18F, 1.0F};
  const double aspect = static_cast<double>(moment.picture_width) / moment.picture_height;
  const Mat4 world_to_clip = projection_matrix(moment.camera, aspect) * view_matrix(moment.camera.T_world_camera);
  const double length = kAxisPart * moment.target_distance_m, width = kWidth_px * moment.scale;
  const ScenePoses& poses = *moment.poses;
  if (moment.layers->frames) {
    for (const math::Pose& T_world_body : poses.bodies) marks.axes(world_to_clip, T_world_body, length, width);
  } else if (moment.layers->picked_frame) {
    const state::Structure& structure = *moment.frame->structure;
    const std::uint32_t object = state::find(structure, moment.picked);
    if (object != state::kNone) {
      marks.axes(world_to_clip, poses.bodies[structure.objects[object].slot], length, width);
    }
  }
  for (const state::PickState& pick : moment.frame->picks) {  // by all users
    if (pick.body >= poses.bodies.size()) continue;
    const math::Vec3 at = poses.bodies[pick.body] * pick.point_body;
    const double arm = 0.15 * length;
    marks.line(world_to_clip, at, pick.target_world, width, kPickColor);
    for (const math::Vec3& axis : {math::Vec3{arm, 0, 0}, math::Vec3{0, arm, 0}, math::Vec3{0, 0, arm}}) {
      marks.line(world_to_clip, at - axis, at + axis, 2.0 * width, kPickColor);
    }
  }
}

}  // namespace ambf::render
