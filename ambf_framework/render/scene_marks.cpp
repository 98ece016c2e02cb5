#include "render/scene_marks.h"

#include "render/layer_drawing.h"

namespace ambf::render {

void SceneMarks::draw_debug(const WindowMoment& moment, DebugDraw& debug) {
  const LayerInput input{*moment.frame, *moment.poses, moment.picked,
                         PixelScale(moment.camera, moment.picture_width, moment.picture_height, moment.scale)};
  draw_layers(*moment.layers, input, debug);
  draw_picks(input, debug);
}

}  // namespace ambf::render
