#include "physics/meshes/detail/surface_probe.h"

#include <array>
#include <cmath>

#include "physics/meshes/detail/constants.h"
#include "physics/meshes/detail/feature_pair.h"

namespace ambf::physics::detail {

namespace {

// Ericson, Real-Time Collision Detection, 5.1.5.
btVector3 nearest_in(const std::array<btVector3, 3>& t, const btVector3& p) {
  const btVector3 ab = t[1] - t[0], ac = t[2] - t[0], ap = p - t[0];
  const double d1 = ab.dot(ap), d2 = ac.dot(ap);
  if (d1 <= 0.0 && d2 <= 0.0) return t[0];
  const btVector3 bp = p - t[1];
  const double d3 = ab.dot(bp), d4 = ac.dot(bp);
  if (d3 >= 0.0 && d4 <= d3) return t[1];
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0) return t[0] + ab * (d1 / (d1 - d3));
  const btVector3 cp = p - t[2];
  const double d5 = ab.dot(cp), d6 = ac.dot(cp);
  if (d6 >= 0.0 && d5 <= d6) return t[2];
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) return t[0] + ac * (d2 / (d2 - d6));
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0.0 && d4 >= d3 && d5 >= d6) return t[1] + (t[2] - t[1]) * ((d4 - d3) / ((d4 - d3) + (d5 - d6)));
  const double sum = va + vb + vc;
  return t[0] + ab * (vb / sum) + ac * (vc / sum);
}

double square_to_box(const btVector3& point, const FeatureMesh::Node& node) {
  btVector3 gap = (point - node.centre()).absolute() - node.half();
  gap.setMax({0, 0, 0});
  return gap.length2();
}

bool has_rim(const FeatureMesh& mesh, const FeatureMesh::Triangle& triangle) {
  return std::any_of(triangle.vertex.begin(), triangle.vertex.end(),
                     [&](int v) { return mesh.vertices[static_cast<std::size_t>(v)].rim; });
}

float flatness(const FeatureMesh& mesh, const FeatureMesh::Triangle& triangle) {
  const auto cone = [&](std::size_t k) { return mesh.vertices[static_cast<std::size_t>(triangle.vertex[k])].cone; };
  return std::min({cone(0), cone(1), cone(2)});
}

}  // namespace

struct MeshProbe::Nearest {
  double square;
  int triangle = -1;
  btVector3 at;
  double facing =
      0.0;  // how much the face looks at the point; of faces that meet there the one that looks most decides
};

bool MeshProbe::all_face_away(int node, const btVector3& outward) const {
  const FeatureMesh::Patch& patch = mesh_.patches[static_cast<std::size_t>(node)];
  return outward.dot(mean_normal(patch)) - static_cast<double>(patch.spread) > kFacingCosine;
}

Probed MeshProbe::probe(const btVector3& point, const btVector3& outward, double near_range, double range) {
  Probed result;
  Nearest nearest{range * range, -1, {0, 0, 0}, 0.0};
  struct Waiting {
    int node;
    double square;
  };
  std::array<Waiting, 64> stack;
  std::size_t waiting = 0;
  const double enough = near_range * near_range;
  if (!mesh_.nodes.empty()) stack[waiting++] = {0, square_to_box(point, mesh_.nodes[0])};
  for (std::size_t visits = 0; waiting > 0 && visits < kMaxProbeVisits;) {
    const Waiting here = stack[--waiting];
    if (!(here.square <= nearest.square + kSameSquaredDistance)) continue;
    if (nearest.triangle >= 0 && here.square > enough) continue;
    ++visits;
    ++visits_;
    result.near = true;
    if (visits > kCullVisits && all_face_away(here.node, outward)) continue;
    const FeatureMesh::Node& node = mesh_.nodes[static_cast<std::size_t>(here.node)];
    if (node.right < 0) {
      visits += 2;
      visits_ += 2;
      visit_triangle(node.triangle, point, outward, nearest);
      continue;
    }
    Waiting left{here.node + 1, square_to_box(point, mesh_.nodes[static_cast<std::size_t>(here.node) + 1])};
    Waiting right{node.right, square_to_box(point, mesh_.nodes[static_cast<std::size_t>(node.right)])};
    if (left.square < right.square) std::swap(left, right);
    if (waiting + 2 > stack.size()) break;
    stack[waiting++] = left;
    stack[waiting++] = right;
  }
  if (nearest.triangle < 0) return result;
  result = judge(nearest, point, outward);
  result.near = true;
  return result;
}

void MeshProbe::visit_triangle(int index, const btVector3& point, const btVector3& outward, Nearest& nearest) const {
  const FeatureMesh::Triangle& triangle = mesh_.triangles[static_cast<std::size_t>(index)];
  if (!triangle.sheet && outward.dot(triangle.normal) > kFacingCosine) return;
  const btVector3 at =
      nearest_in({corner(mesh_, triangle, 0), corner(mesh_, triangle, 1), corner(mesh_, triangle, 2)}, point);
  const btVector3 away = point - at;
  const double square = away.length2(), facing = std::abs(away.dot(triangle.normal));
  if (!(square < nearest.square - kSameSquaredDistance) &&
      !(square < nearest.square + kSameSquaredDistance && nearest.triangle >= 0 && facing > nearest.facing))
    return;
  nearest = {square, index, at, facing};
}

Probed MeshProbe::judge(const Nearest& nearest, const btVector3& point, const btVector3& outward) const {
  Probed result;
  const FeatureMesh::Triangle& triangle = mesh_.triangles[static_cast<std::size_t>(nearest.triangle)];
  const btVector3 away = point - nearest.at;
  btVector3 up = triangle.normal;
  // A sheet is met from the side that the other body comes from.
  if (triangle.sheet && (outward.isZero() ? away.dot(up) < 0.0 : outward.dot(up) > 0.0)) up = -up;
  const double length = away.length();
  const bool below = away.dot(up) < 0.0;
  result.point = nearest.at;
  result.cone = flatness(mesh_, triangle);
  result.distance = below ? -length : length;
  result.normal = length > kMinNormalLength ? away / result.distance : up;
  if (below) {
    if (length > kMaxFeatureDepth || result.normal.dot(up) < kBelowCosine || outward.isZero()) return result;
  } else if (length > kMinNormalLength) {
    if (!outermost(mesh_, triangle, nearest.at, result.normal)) return result;
    result.sharp =
        result.normal.dot(up) < kFaceDirectionCosine && (result.cone < kSmoothCone || has_rim(mesh_, triangle));
  }
  if (triangle.sheet && !outward.isZero() &&
      (result.distance < -std::max(margins_, kSheetDepth) || outward.dot(up) > -kSheetFacing))
    return result;
  result.touches = outward.dot(result.normal) <= kFacingCosine;
  return result;
}

Probed BoxProbe::probe(const btVector3& point, const btVector3&, double, double range) {
  ++visits_;
  Probed result;
  result.point = point;
  result.point.setMax(-half_);
  result.point.setMin(half_);
  const btVector3 outside = point - result.point;
  result.distance = outside.length();
  result.near = result.touches = result.distance <= range;
  if (result.distance > kMinNormalLength) {
    result.normal = outside / result.distance;
    result.sharp = result.normal.absolute()[result.normal.absolute().maxAxis()] < kFaceDirectionCosine;
    return result;
  }
  const btVector3 inside = half_ - point.absolute();
  const int axis = inside.minAxis();
  result.normal[axis] = point[axis] < 0.0 ? -1.0 : 1.0;
  result.point[axis] = result.normal[axis] * half_[axis];
  result.distance = -inside[axis];
  return result;
}

}  // namespace ambf::physics::detail
