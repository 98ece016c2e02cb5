#include "render/painter.h"

namespace ambf::render {

bool Painter::paint(const PaintJob& job, std::string& why) {
  const std::vector<Light> lights = lights_of(*job.structure, *job.poses, job.camera);
  shared_.shadows().update({shared_.gpu(), renderer_.meshes(), shadow_target_.name()}, shared_.scene(),
                           job.poses->bodies, lights, job.quality);
  if (!canvas_.resize(job.width, job.height, job.quality.samples, why)) return false;
  Picture picture;
  picture.camera = job.camera;
  picture.T_world_body = &job.poses->bodies;
  picture.lights = &lights;
  picture.occlusion = job.quality.occlusion;
  picture.normal_maps = job.normal_maps;
  picture.multipass = job.multipass;
  picture.tint = job.tint;
  picture.marks = job.marks;
  renderer_.draw(picture, canvas_);
  return true;
}

}  // namespace ambf::render
