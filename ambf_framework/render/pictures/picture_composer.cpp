#include "render/pictures/picture_composer.h"

#include <algorithm>
#include <cmath>

#include "math/rotation.h"

namespace ambf::render {

namespace {

// Nobody sees less than this move.
constexpr double kSeen_m = 2e-5, kSeen_rad = 1e-4;

bool looks_equal(const math::Pose& a, const math::Pose& b) {
  const math::Quat &p = a.orientation, &q = b.orientation;
  const double along = std::abs(p.x * q.x + p.y * q.y + p.z * q.z + p.w * q.w);  // cosine of half the angle between
  return math::norm(a.position - b.position) < kSeen_m && along > 1.0 - kSeen_rad * kSeen_rad / 8.0;
}

bool looks_equal(const std::vector<math::Pose>& a, const std::vector<math::Pose>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const math::Pose& x, const math::Pose& y) { return looks_equal(x, y); });
}

bool looks_equal(const std::vector<math::Vec3>& a, const std::vector<math::Vec3>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const math::Vec3& x, const math::Vec3& y) { return math::norm(x - y) < kSeen_m; });
}

bool looks_equal(const ScenePoses& a, const ScenePoses& b) {
  return a.lenses == b.lenses && a.beams == b.beams && looks_equal(a.bodies, b.bodies) &&
         looks_equal(a.nodes, b.nodes) &&
         std::equal(a.placed.begin(), a.placed.end(), b.placed.begin(), b.placed.end(),
                    [](const auto& x, const auto& y) { return looks_equal(x, y); });
}

bool looks_equal(const Camera& a, const Camera& b) {
  return looks_equal(a.T_world_camera, b.T_world_camera) && a.near_m == b.near_m && a.far_m == b.far_m &&
         a.field_of_view_rad == b.field_of_view_rad && a.orthographic_width_m == b.orthographic_width_m &&
         a.optics == b.optics && a.shift == b.shift;
}

bool is_plain(const Extras& extras) { return extras.debug == nullptr || extras.debug->empty(); }

}  // namespace

bool PictureComposer::shows(const PictureJob& job) const {
  const Painted& was = painted_;
  return was.plain && is_plain(job.extras) && was.structure_version == job.structure->version &&
         was.looks_version == shared_.looks_version() && was.width == job.width && was.height == job.height &&
         was.normal_maps == job.normal_maps && was.multipass == job.multipass && was.outlined == job.extras.outlined &&
         was.looks == job.extras.looks && looks_equal(was.camera, job.camera) && looks_equal(was.poses, *job.poses);
}

bool PictureComposer::paint(const PictureJob& job, std::string& why) {
  const std::vector<Light> lights = lights_of(*job.structure, *job.poses, job.camera);
  shared_.shadows().update({shared_.gpu(), renderer_.meshes(), shadow_target_.name()}, shared_.scene(),
                           job.poses->bodies, job.extras.looks, lights, job.quality);
  const double resolution = job.quality.resolution;
  const auto pixels = [&](int shown) { return std::max(1, static_cast<int>(std::lround(resolution * shown))); };
  if (!canvas_.resize(pixels(job.width), pixels(job.height), job.quality.samples, why)) return false;
  painted_ = {job.structure->version,
              shared_.looks_version(),
              *job.poses,
              job.camera,
              job.width,
              job.height,
              job.normal_maps,
              job.multipass,
              is_plain(job.extras),
              job.extras.outlined,
              job.extras.looks};
  Picture picture;
  picture.camera = job.camera;
  picture.T_world_body = &job.poses->bodies;
  picture.lights = &lights;
  picture.occlusion = job.quality.occlusion;
  picture.sharp_textures = job.quality.sharp_textures;
  picture.normal_maps = job.normal_maps;
  picture.multipass = job.multipass;
  picture.looks = &job.extras.looks;
  picture.all_bodies_shader = job.all_bodies_shader;
  renderer_.draw(picture, canvas_);
  const Extras& over = job.extras;
  const bool outlined = over.outlined.empty() || outline_.draw(shared_, {over.outlined, over.looks, job.poses->bodies},
                                                               job.camera, resolution * job.line_px, canvas_, why);
  if (!outlined) return false;
  if (over.debug != nullptr && !debug_.draw(*over.debug, job.camera, job.width, job.height, why)) return false;
  if (over.text != nullptr && resolution == 1.0) draw_over(*over.text);
  return true;
}

}  // namespace ambf::render
