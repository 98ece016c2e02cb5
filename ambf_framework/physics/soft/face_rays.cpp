#include "physics/soft/face_rays.h"

#include <algorithm>

#include "physics/detail/world_data.h"
#include "physics/soft/detail/soft_data.h"
#include "physics/soft/detail/thread_data.h"
#include "physics/soft/detail/tissue_data.h"

namespace ambf::physics {
namespace detail {
namespace {

struct Corners {
  const btVector3 &a, &b, &c;
};

RayFaces& seen_of(const SoftBody& body) {
  if (body.is_thread()) return *body.thread();
  if (body.is_tissue()) return *body.tissue();
  return body.data();
}

void find_bounds(const SoftBody& body) {
  if (body.is_tissue())
    body.tissue()->find_bounds();
  else if (body.is_thread())
    body.thread()->find_bounds();
  else
    body.data().find_bounds();
}

bool shows(const SoftBody& body, std::size_t face) { return !body.is_tissue() || body.tissue()->cuts.shows_face(face); }

// Where its nodes are; after find_bounds().
const btVector3* nodes_of(const SoftBody& body) {
  if (body.is_thread()) return body.thread()->at.data();
  return body.is_tissue() ? body.tissue()->at.data() : body.data().now.data();
}

Corners corners_of(const btVector3* at, const std::array<std::uint32_t, 3>& face) {
  return {at[face[0]], at[face[1]], at[face[2]]};
}

bool meets(const Corners& face, const btVector3& low, const btVector3& high) {
  for (int i = 0; i < 3; ++i) {
    const double least = std::min({face.a[i], face.b[i], face.c[i]}),
                 most = std::max({face.a[i], face.b[i], face.c[i]});
    if (!(least <= high[i] && most >= low[i])) return false;  // also without any for nodes that are not finite
  }
  return true;
}

// Moeller and Trumbore (1997), from both sides. Edges belong to both of their faces, so that no ray slips between.
bool meets(const Corners& face, const btVector3& start, const btVector3& along, double& fraction, btVector3& normal) {
  const btVector3 ab = face.b - face.a, ac = face.c - face.a;
  normal = ab.cross(ac);
  const double across = -normal.dot(along);
  if (!(std::abs(across) > 0.0)) return false;
  const btVector3 from = start - face.a, turned = from.cross(along);
  const double scale = 1.0 / across, u = ac.dot(turned) * scale, v = -ab.dot(turned) * scale;
  constexpr double kEdge = -1e-12;
  if (!(u >= kEdge && v >= kEdge && u + v <= 1.0 - kEdge)) return false;
  const double at = normal.dot(from) * scale;
  if (!(at >= 0.0 && at < fraction)) return false;
  fraction = at;
  return true;
}

// A segment of a thread: where the ray comes as near to it as its radius. Ends are round.
bool meets(const Corners& segment, double radius, const btVector3& start, const btVector3& along, double& fraction,
           btVector3& normal) {
  const btVector3 axis = segment.b - segment.a, from = start - segment.a;
  const double axis2 = axis.length2(), along2 = along.length2(), both = axis.dot(along);
  if (!(axis2 > 0.0 && along2 > 0.0)) return false;
  const double cross = axis2 * along2 - both * both;
  double of_ray = cross > 1e-12 * axis2 * along2 ? (both * axis.dot(from) - axis2 * along.dot(from)) / cross : 0.0;
  const double of_axis = std::min(std::max((axis.dot(from) + of_ray * both) / axis2, 0.0), 1.0);
  of_ray = along.dot(axis * of_axis - from) / along2;
  const double apart2 = (from + along * of_ray - axis * of_axis).length2();
  if (!(apart2 <= radius * radius)) return false;
  // Back from the nearest place to the surface there.
  const double leans = std::max(cross / (axis2 * along2), 0.01);
  const double at = of_ray - std::sqrt((radius * radius - apart2) / (along2 * leans));
  if (!(at >= 0.0 && at < fraction)) return false;
  normal = from + along * at - axis * of_axis;
  if (!(normal.length2() > 0.0)) normal = -along;
  fraction = at;
  return true;
}

}  // namespace

std::uint64_t find_faces(const std::vector<SoftBody*>& bodies, const btVector3& low, const btVector3& high) {
  std::uint64_t seen = 0;
  for (std::size_t number = 0; number < bodies.size(); ++number) {
    const SoftBody& body = *bodies[number];
    RayFaces& data = seen_of(body);
    data.near_faces.clear();
    find_bounds(body);
    if (!TestAabbAgainstAabb2(low, high, data.node_low, data.node_high)) continue;
    const double reach = body.is_thread() ? body.thread()->radius : 0.0;
    const btVector3 around(reach, reach, reach);
    const btVector3 from = low - around, to = high + around;
    const btVector3* at = nodes_of(body);
    const std::vector<std::array<std::uint32_t, 3>>& faces = body.faces();
    const auto look = [&](std::size_t begin, std::size_t end) {
      for (std::size_t face = begin; face < end; ++face)
        if (meets(corners_of(at, faces[face]), from, to) && shows(body, face))
          data.near_faces.push_back(static_cast<std::uint32_t>(face));
    };
    if (body.is_of_links())
      body.data().runs.each_face_near({from, to}, faces.size(), look);
    else
      look(0, faces.size());
    if (!data.near_faces.empty()) seen += (data.moves + 1) * (2 * number + 0x9e3779b97f4a7c15U);
  }
  return seen;
}

FaceHit cast_at_faces(const std::vector<SoftBody*>& bodies, const btVector3& start, const btVector3& along,
                      double nearer) {
  FaceHit hit;
  hit.fraction = nearer;
  for (const SoftBody* body : bodies) {
    for (const std::uint32_t face : seen_of(*body).near_faces) {
      btVector3 normal;
      const Corners corners = corners_of(nodes_of(*body), body->faces()[face]);
      if (!(body->is_thread() ? meets(corners, body->thread()->radius, start, along, hit.fraction, normal)
                              : meets(corners, start, along, hit.fraction, normal)))
        continue;
      hit.body = body;
      hit.face = static_cast<int>(face);
      hit.normal = normal;
    }
  }
  if (hit.body == nullptr) return hit;
  hit.normal.normalize();
  if (hit.normal.dot(along) > 0.0) hit.normal = -hit.normal;
  return hit;
}

}  // namespace detail

std::optional<SoftRayHit> ray_cast_soft(const World& world, const math::Vec3& from, const math::Vec3& to) {
  constexpr double kNodeSize = 0.01;  // of the distance
  if (world.data().soft == nullptr) return std::nullopt;
  const std::vector<SoftBody*>& bodies = world.data().soft->all();
  const btVector3 start = detail::to_bullet(from), end = detail::to_bullet(to), along = end - start;
  btVector3 low = start, high = start;
  low.setMin(end);
  high.setMax(end);
  detail::find_faces(bodies, low, high);
  const detail::FaceHit face = detail::cast_at_faces(bodies, start, along, 1.0);
  SoftRayHit hit;
  hit.fraction = face.fraction;
  for (SoftBody* body : bodies) {
    if (body == face.body) {
      hit.body = body;
      hit.face = face.face;
    }
    if (!body->faces().empty() && !body->is_thread()) continue;
    for (std::size_t node = 0; node < body->node_count(); ++node) {
      const btVector3 at = detail::to_bullet(body->position(node)) - start;
      const double fraction = at.dot(along) / along.length2();
      if (!(fraction > 0.0 && fraction < hit.fraction)) continue;
      if ((at - along * fraction).length() > kNodeSize * fraction * along.length()) continue;
      hit = {body, -1, node, {}, fraction};
    }
  }
  if (hit.body == nullptr) return std::nullopt;
  hit.point = from + (to - from) * hit.fraction;
  return hit;
}

}  // namespace ambf::physics
