#include "render/painter.h"

namespace ambf::render {

bool Painter::build(std::string& why) { return renderer_.build(why) && shadows_.build(why); }

base::Diagnostics Painter::take(const state::Structure& structure) {
  if (scene_made_ && scene_.version == structure.version) return {};
  scene_made_ = true;
  scene_ = make_draw_scene(structure, meshes_);
  return store_.prepare(scene_);
}

bool Painter::paint(const PaintJob& job, std::string& why) {
  const std::vector<Light> lights = lights_of(*job.structure, *job.poses, job.camera);
  if (job.quality.shadow_interval == 0) {
    shadows_.disable();
  } else if (pictures_ % job.quality.shadow_interval == 0) {
    shadows_.render(store_, renderer_.meshes(), scene_, job.poses->bodies, lights, job.quality.shadow_side);
  }
  ++pictures_;
  if (!canvas_.resize(job.width, job.height, job.quality.samples, why)) return false;
  canvas_.bind();
  Picture picture;
  picture.camera = job.camera;
  picture.width = job.width;
  picture.height = job.height;
  picture.scene = &scene_;
  picture.T_world_body = &job.poses->bodies;
  picture.lights = &lights;
  picture.shadows = &shadows_;
  picture.soft_shadows = job.quality.samples > 1;
  picture.tint = job.tint;
  picture.marks = job.marks;
  renderer_.draw(picture);
  return true;
}

}  // namespace ambf::render
