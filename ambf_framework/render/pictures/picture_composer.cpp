#include "render/pictures/picture_composer.h"

namespace ambf::render {

bool PictureComposer::paint(const PictureJob& job, std::string& why) {
  const std::vector<Light> lights = lights_of(*job.structure, *job.poses, job.camera);
  shared_.shadows().update({shared_.gpu(), renderer_.meshes(), shadow_target_.name()}, shared_.scene(),
                           job.poses->bodies, job.extras.looks, lights, job.quality);
  if (!canvas_.resize(job.width, job.height, job.quality.samples, why)) return false;
  Picture picture;
  picture.camera = job.camera;
  picture.T_world_body = &job.poses->bodies;
  picture.lights = &lights;
  picture.occlusion = job.quality.occlusion;
  picture.sharp_textures = job.quality.sharp_textures;
  picture.normal_maps = job.normal_maps;
  picture.multipass = job.multipass;
  picture.tints = &job.extras.tints;
  picture.looks = &job.extras.looks;
  picture.all_bodies_shader = job.all_bodies_shader;
  renderer_.draw(picture, canvas_);
  const Extras& over = job.extras;
  if (over.debug != nullptr && !debug_.draw(*over.debug, job.camera, job.width, job.height, why)) return false;
  if (over.text != nullptr) draw_over(*over.text);
  return true;
}

}  // namespace ambf::render
