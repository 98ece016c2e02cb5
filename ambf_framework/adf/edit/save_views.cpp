// Where cameras and lights are.
#include <cmath>

#include "adf/detail/save_present.h"
#include "math/rotation.h"
#include "scene/keys.h"

namespace ambf::adf {

namespace {

constexpr const char* const kXyz[3] = {"x", "y", "z"};

// As model/ makes a camera's frame: x backwards, y right, z up.
math::Pose pose_of(const scene::Camera& camera) {
  const math::Vec3 back = math::normalized(camera.location - camera.look_at, {1.0, 0.0, 0.0});
  const math::Vec3 right = math::normalized(math::cross(camera.up, back), {0.0, 1.0, 0.0});
  const math::Vec3 up = math::cross(back, right);
  const double R[9] = {back.x, right.x, up.x, back.y, right.y, up.y, back.z, right.z, up.z};
  return {camera.location, math::from_matrix(R)};
}

void set_parent(const std::string& before, const std::string& now, Change& change) {
  if (before != now) change.key("parent").scalar = now;
}

void set_camera(const Value& block, const scene::Camera& before, const ViewPlace& now, Change& change) {
  set_parent(before.parent, now.parent, change);
  const math::Pose& T = now.T_parent_object;
  if (before.parent == now.parent && is_near(pose_of(before), T, kUnmoved)) return;
  const double distance = math::norm(before.look_at - before.location);
  const math::Vec3 back = math::rotate(T.orientation, {1.0, 0.0, 0.0});
  const auto set = [&](const char* key, const math::Vec3& wanted) {
    Change inner;
    set_numbers(block.find(key), wanted, kXyz, inner);
    if (!inner.empty()) change.key(key) = std::move(inner);
  };
  set("location", T.position);
  set("look at", T.position - back * distance);
  set("up", math::rotate(T.orientation, {0.0, 0.0, 1.0}));
}

void set_light(const Value& block, const scene::Light& before, const ViewPlace& now, Change& change) {
  set_parent(before.parent, now.parent, change);
  const math::Pose& T = now.T_parent_object;
  const math::Vec3 direction = math::rotate(T.orientation, {1.0, 0.0, 0.0});
  const math::Vec3 old_direction = math::normalized(before.direction, {0.0, 0.0, -1.0});
  const auto set = [&](const char* key, const math::Vec3& wanted) {
    Change inner;
    set_numbers(block.find(key), wanted, kXyz, inner);
    if (!inner.empty()) change.key(key) = std::move(inner);
  };
  if (math::norm(T.position - before.location) > kUnmoved) set("location", T.position);
  if (math::norm(direction - old_direction) > kUnmoved) set("direction", direction);
}

template <class Object, class Now, class Set>
void set_all(const Value& root, const char* list, const std::vector<Object>& described, const std::vector<Now>& present,
             Set set, Change& change) {
  for (const Now& now : present) {
    const auto block = root.find(now.place.block);
    if (!block || !lists(root, list, now.place.block)) continue;
    for (const Object& before : described) {
      if (before.identity.identifier != now.place.block) continue;
      Change moved;
      set(*block, before, now.place, moved);
      if (!moved.empty()) change.key(now.place.block) = std::move(moved);
    }
  }
}

}  // namespace

void set_views(const Value& root, const std::vector<scene::Camera>& cameras, const std::vector<scene::Light>& lights,
               const Present& present, Change& change) {
  set_all(root, "cameras", cameras, present.cameras, set_camera, change);
  set_all(root, "lights", lights, present.lights, set_light, change);
}

std::string text_of_moved_defaults(const std::string& text, const scene::Model& views, const Present& present) {
  const Document document(text);
  const Value root = document.root();
  const auto vector = [](const math::Vec3& v) {
    return "{x: " + scene::text_of(v.x) + ", y: " + scene::text_of(v.y) + ", z: " + scene::text_of(v.z) + "}";
  };
  std::string added;
  const auto add = [&](const char* list, const auto& objects, const auto& now_of, const auto& keys_of) {
    if (root.find(list)) return;  // there are no others
    for (const auto& object : objects) {
      for (const auto& now : now_of) {
        if (now.place.block != object.identity.identifier) continue;
        const auto [keys, T_before] = keys_of(object);
        if (is_near(T_before, now.place.T_parent_object, kUnmoved) && now.place.parent.empty() && now.now == now.loaded)
          continue;
        added += std::string(list) + ": [" + object.identity.identifier + "]\n" + object.identity.identifier +
                 ": {name: " + object.identity.name + ", " + keys + "}\n";
      }
    }
  };
  using Keys = std::pair<std::string, math::Pose>;
  add("cameras", views.cameras, present.cameras, [&](const scene::Camera& camera) {
    return Keys{
        "location: " + vector(camera.location) + ", look at: " + vector(camera.look_at) + ", up: " + vector(camera.up),
        pose_of(camera)};
  });
  add("lights", views.lights, present.lights, [&](const scene::Light& light) {
    const math::Vec3 direction = math::normalized(light.direction, {0.0, 0.0, -1.0});
    return Keys{"location: " + vector(light.location) + ", direction: " + vector(light.direction),
                {light.location, math::rotation_between({1.0, 0.0, 0.0}, direction)}};
  });
  return added.empty() || text.ends_with('\n') ? added : "\n" + added;
}

}  // namespace ambf::adf
