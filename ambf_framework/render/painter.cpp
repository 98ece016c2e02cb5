#include "render/painter.h"

namespace ambf::render {

bool Painter::paint(const PaintJob& job, std::string& why) {
  const std::vector<Light> lights = lights_of(*job.structure, *job.poses, job.camera);
  shared_.shadows().update({shared_.gpu(), renderer_.meshes(), shadow_target_.name()}, shared_.scene(),
                           job.poses->bodies, lights, job.quality);
  if (!canvas_.resize(job.width, job.height, job.quality.samples, why)) return false;
  canvas_.bind();
  Picture picture;
  picture.camera = job.camera;
  picture.width = job.width;
  picture.height = job.height;
  picture.T_world_body = &job.poses->bodies;
  picture.lights = &lights;
  picture.soft_shadows = job.quality.samples > 1;
  picture.tint = job.tint;
  picture.marks = job.marks;
  renderer_.draw(picture);
  return true;
}

}  // namespace ambf::render
