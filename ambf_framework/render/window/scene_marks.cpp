#include "render/window/scene_marks.h"

#include "render/marks/layer_shapes.h"
#include "render/window/keys.h"
#include "render/window/measure.h"

namespace ambf::render {

bool SceneMarks::on_input(const WindowMoment& moment, const Input& input) {
  const auto* key = std::get_if<KeyInput>(&input);
  if (key != nullptr && !key->released && action_of(key->key, key->modifiers, key->held) == Action::measure) {
    moment.shows.measure->set_on(!moment.shows.measure->on());
    return true;
  }
  return moment.shows.measure->on_input(moment, input);
}

void SceneMarks::draw_debug(const WindowMoment& moment, WorldShapes& debug) {
  const LayerInput input{
      *moment.frame,
      *moment.poses,
      moment.choices.picked,
      PixelScale(moment.camera, moment.sizes.picture_width, moment.sizes.picture_height, moment.sizes.scale),
      moment.shows.looks->by_slot(*moment.frame->structure),
      devices_};
  draw_layers(*moment.shows.layers, input, debug);
  draw_picks(input, debug);
  draw_devices(input, debug);
  draw_visible_ghosts(input, debug);
  if (!moment.shows.layers->shows(LayerId::sensors)) draw_visible_sensors(input, debug);
  if (!moment.shows.layers->shows(LayerId::actuators)) draw_visible_actuators(input, debug);
  moment.shows.measure->draw(moment, debug);
}

}  // namespace ambf::render
