#include "render/scene/surface_ray.h"

#include <algorithm>
#include <cmath>

#include "mesh/appearance.h"
#include "mesh/mesh.h"

namespace ambf::render {

namespace {

// Share of the way from -> from + along at which the segment meets a box; above 1 when it does not.
double meets_box(const mesh::BoundingBox& box, const math::Vec3& from, const math::Vec3& along) {
  constexpr double kNever = 2.0;
  double enter = 0.0, leave = 1.0;
  const double starts[] = {from.x, from.y, from.z}, ways[] = {along.x, along.y, along.z};
  const double least[] = {box.min.x, box.min.y, box.min.z}, most[] = {box.max.x, box.max.y, box.max.z};
  for (int i = 0; i < 3; ++i) {
    if (ways[i] == 0.0) {
      if (starts[i] < least[i] || starts[i] > most[i]) return kNever;
      continue;
    }
    const double a = (least[i] - starts[i]) / ways[i], b = (most[i] - starts[i]) / ways[i];
    enter = std::max(enter, std::min(a, b));
    leave = std::min(leave, std::max(a, b));
  }
  return enter <= leave ? enter : kNever;
}

// Möller and Trumbore, "Fast, minimum storage ray/triangle intersection", 1997; both sides count.
double meets_triangle(const math::Vec3& a, const math::Vec3& b, const math::Vec3& c, const math::Vec3& from,
                      const math::Vec3& along) {
  constexpr double kNever = 2.0;
  const math::Vec3 ab = b - a, ac = c - a, p = math::cross(along, ac);
  const double determinant = math::dot(ab, p);
  if (determinant == 0.0) return kNever;
  const math::Vec3 t = from - a;
  const double u = math::dot(t, p) / determinant;
  if (u < 0.0 || u > 1.0) return kNever;
  const math::Vec3 q = math::cross(t, ab);
  const double v = math::dot(along, q) / determinant;
  if (v < 0.0 || u + v > 1.0) return kNever;
  const double share = math::dot(ac, q) / determinant;
  return share >= 0.0 ? share : kNever;
}

// The nearest share of the way, or `best` when there is none nearer.
double meets_mesh(const mesh::Mesh& mesh, const math::Vec3& from, const math::Vec3& along, double best) {
  if (meets_box(mesh.bounds, from, along) > best) return best;
  for (const mesh::Submesh& part : mesh.submeshes) {
    for (std::size_t i = 0; i + 2 < part.triangles.size(); i += 3) {
      best = std::min(best, meets_triangle(part.vertex(part.triangles[i]), part.vertex(part.triangles[i + 1]),
                                           part.vertex(part.triangles[i + 2]), from, along));
    }
  }
  return best;
}

}  // namespace

std::optional<SurfaceHit> first_surface(const state::Structure& structure, const std::vector<math::Pose>& T_world_body,
                                        const std::vector<BodyLook>& looks, bool collision_shapes, const Ray& ray) {
  double best = 1.0;
  std::optional<SurfaceHit> hit;
  const math::Vec3 along = ray.to - ray.from;
  const auto look_at = [&](std::uint32_t slot, const mesh::Appearance* appearance) {
    if (appearance == nullptr) return;
    for (const mesh::AppearancePart& part : appearance->parts) {
      if (part.mesh == nullptr || part.scale <= 0.0) continue;
      const math::Pose T_part_world = math::inverse(T_world_body[slot] * part.T_body_part);
      const math::Vec3 from = (1.0 / part.scale) * (T_part_world * ray.from);
      const double share =
          meets_mesh(*part.mesh, from, (1.0 / part.scale) * math::rotate(T_part_world.orientation, along), best);
      if (share >= best) continue;
      best = share;
      const math::Vec3 point = ray.from + share * along;
      hit = SurfaceHit{slot, math::inverse(T_world_body[slot]) * point, point};
    }
  };
  const std::size_t count = std::min(structure.bodies.size(), T_world_body.size());
  for (std::uint32_t slot = 0; slot < count; ++slot) {
    const state::BodyInfo& body = structure.bodies[slot];
    const bool drawn = body.appearance != nullptr && body.appearance->visible && !look_of(looks, slot).hidden;
    if (drawn) look_at(slot, body.appearance.get());
    if (collision_shapes) look_at(slot, body.collision_appearance.get());
  }
  return hit;
}

}  // namespace ambf::render
