#include "render/navigation/framing.h"

#include <algorithm>
#include <cmath>

#include "math/rotation.h"
#include "render/scene/object_kind.h"

namespace ambf::render {

namespace {

using math::Vec3;

constexpr double kGroundRadius = 2.0;  // m
constexpr double kMargin = 1.08;       // of the picture's width and height
constexpr double kSmallest = 0.02;     // m: nothing is looked at from nearer than this shows in full

// What a picture shows along one of its axes, 1 m ahead: so far around a middle that may be beside the camera's axis.
struct Reach {
  double middle = 0.0, half = 1.0;  // m
};

// Along one axis of the picture: where the camera must stand so that the picture just holds all of them, and how far
// back.
struct Fit {
  double aside = 0.0, back = 0.0;  // m
  Reach reach;
  // Where it must stand further back, so that what just fitted is in the middle.
  double aside_at(double stands) const { return aside - reach.middle * (stands - back); }
};
Fit fit(const std::vector<Sphere>& things, const Vec3& aside, const Vec3& backward, const Reach& reach) {
  const double upper = std::atan(reach.middle + reach.half), lower = std::atan(reach.half - reach.middle);
  const double s_upper = std::sin(upper), c_upper = std::cos(upper), s_lower = std::sin(lower),
               c_lower = std::cos(lower);
  // The picture's two sides are planes through the camera: every sphere lies inwards of both (Graphics Gems' "tightest
  // view").
  double left = -1e300, right = -1e300;
  for (const Sphere& thing : things) {
    const double a = math::dot(thing.centre, aside), b = math::dot(thing.centre, backward);
    right = std::max(right, c_upper * a + s_upper * b + thing.radius);
    left = std::max(left, -c_lower * a + s_lower * b + thing.radius);
  }
  const double both = std::sin(upper + lower);
  return {(s_lower * right - s_upper * left) / both, (c_lower * right + c_upper * left) / both, reach};
}

}  // namespace

namespace {

struct Things {
  std::vector<Sphere> things, room;
};
Things sort_things(const state::Structure& structure, const SceneBatches& scene,
                   const std::vector<math::Pose>& T_world_body, state::ModelId newer_than) {
  Things sorted;
  for (const DrawBatch& batch : scene.batches) {
    for (const DrawInstance& instance : batch.instances) {
      const bool soft = instance.soft != state::kNone;
      if (!soft && instance.body >= structure.bodies.size()) continue;
      const state::ObjectInfo& object =
          structure.objects[soft ? scene.soft[instance.soft].object() : structure.bodies[instance.body].object];
      if (object.model <= newer_than) continue;
      const Sphere sphere = bounds_in_world(scene, instance, T_world_body);
      if (!std::isfinite(math::norm(sphere.centre)) || sphere.radius < 0.0) continue;
      const bool room = sphere.radius > kGroundRadius || is_room(structure, object);
      (room ? sorted.room : sorted.things).push_back(sphere);
    }
  }
  return sorted;
}

}  // namespace

std::vector<Sphere> things_in(const state::Structure& structure, const SceneBatches& scene,
                              const std::vector<math::Pose>& T_world_body) {
  const Things all = sort_things(structure, scene, T_world_body, state::kWorldModel);
  return all.things.empty() ? all.room : all.things;
}

std::vector<Sphere> things_of_models(const state::Structure& structure, const SceneBatches& scene,
                                     const std::vector<math::Pose>& T_world_body, state::ModelId newer_than) {
  return sort_things(structure, scene, T_world_body, newer_than).things;
}

std::vector<Sphere> things_in(const state::Frame& frame) {
  MeshIdentity meshes;
  std::vector<math::Pose> T_world_body;
  for (const state::BodyState& body : frame.bodies) T_world_body.push_back(body.T_world_body);
  SceneBatches scene = make_scene_batches(*frame.structure, meshes);
  std::vector<math::Vec3> nodes;
  node_positions(frame, nodes);
  pose_soft_surfaces(nodes, scene);
  return things_in(*frame.structure, scene, T_world_body);
}

Framing framing(const std::vector<Sphere>& things, double aspect) {
  Camera front_right;
  front_right.T_world_camera = looking_at(Vec3{1.0, 0.5, 0.6}, {});
  return framing(things, aspect, front_right);
}

Framing framing(const std::vector<Sphere>& things, double aspect, const Camera& like) {
  Framing out;
  Camera& camera = out.camera;
  camera.field_of_view_rad = like.field_of_view_rad;
  camera.optics = like.optics;
  camera.T_world_camera.orientation = like.T_world_camera.orientation;
  const Vec3 back = backward(camera.T_world_camera), aside = right(camera.T_world_camera),
             above = up(camera.T_world_camera);
  const PicturePlane seen = picture_plane(camera, aspect);
  // A slanted picture shows all of its height in less than its width.
  const double upright = std::max(seen.half_width - std::abs(seen.slant), 0.1 * seen.half_width);
  const Fit wide = fit(things, aside, back, {seen.middle_right, upright / kMargin});
  const Fit high = fit(things, above, back, {seen.middle_up, seen.half_height / kMargin});
  double nearest = -1e300, farthest = 1e300;
  for (const Sphere& thing : things) {
    nearest = std::max(nearest, math::dot(thing.centre, back) + thing.radius);
    farthest = std::min(farthest, math::dot(thing.centre, back) - thing.radius);
  }
  const double stands = std::max({wide.back, high.back, nearest + kSmallest});
  camera.T_world_camera.position = wide.aside_at(stands) * aside + high.aside_at(stands) * above + stands * back;
  const double middle = stands - (nearest + farthest) / 2.0;
  // Room to move about: towards things, and away from them to where the horizon still shows.
  camera.near_m = 0.05 * std::max(stands - nearest, kSmallest);
  camera.far_m = std::max(20.0 * middle, 4.0 * (stands - farthest));
  out.view = {camera.T_world_camera, std::max(middle, kSmallest)};
  return out;
}

}  // namespace ambf::render
