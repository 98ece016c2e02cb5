#include "mesh/detail/normals.h"

#include <algorithm>
#include <cmath>

#include "math/types.h"

namespace ambf::mesh {

namespace {

using math::Vec3;

struct Corner {
  Vec3 normal;    // unit normal of its triangle; zero for a degenerate one
  double weight;  // angle of the triangle at this vertex times its area
  std::uint32_t smoothing;
  std::uint32_t number;  // of the corner: 3 * triangle + k
};

bool smooth_together(const Corner& a, const Corner& b, double cos_crease) {
  if (a.smoothing == kSmoothByAngle || b.smoothing == kSmoothByAngle) {
    return a.smoothing == b.smoothing && math::dot(a.normal, b.normal) >= cos_crease;
  }
  return (a.smoothing & b.smoothing) != 0;
}

void store(const Vec3& sum, const Corner& corner, std::vector<float>& out) {
  const double length = math::norm(sum);
  Vec3 unit = length > 0.0 ? sum / length : corner.normal;
  if (math::norm(unit) < 0.5) unit = {0.0, 0.0, 1.0};  // a degenerate triangle among its like
  float* n = out.data() + std::size_t{3} * corner.number;
  n[0] = static_cast<float>(unit.x);
  n[1] = static_cast<float>(unit.y);
  n[2] = static_cast<float>(unit.z);
}

// Each corner against each: fine for the usual handful.
void smooth_few(const std::vector<Corner>& corners, double cos_crease, std::vector<float>& out) {
  for (const Corner& a : corners) {
    Vec3 sum = a.normal * a.weight;
    for (const Corner& b : corners) {
      if (b.number != a.number && smooth_together(a, b, cos_crease)) sum += b.normal * b.weight;
    }
    store(sum, a, out);
  }
}

// The tip of a cone with thousands of triangles: those of nearly the same normal and equal smoothing are put together
// first, so that the work stays bounded.
void smooth_many(std::vector<Corner>& corners, double cos_crease, std::vector<float>& out) {
  constexpr double kSteps = 4.0;  // bins per unit along each axis of the normal
  const auto bin_of = [](const Corner& c) {
    const auto step = [](double v) { return static_cast<std::uint64_t>(std::floor((v + 1.0) * kSteps)); };
    const std::uint64_t cell = step(c.normal.x) << 8 | step(c.normal.y) << 4 | step(c.normal.z);
    return cell << 32 | c.smoothing;
  };
  std::sort(corners.begin(), corners.end(), [&bin_of](const Corner& a, const Corner& b) {
    const std::uint64_t bin_a = bin_of(a), bin_b = bin_of(b);
    return bin_a != bin_b ? bin_a < bin_b : a.number < b.number;
  });
  std::vector<Corner> bins;
  std::vector<std::size_t> ends;
  constexpr std::size_t kMaxBins = 1024;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const bool same = i > 0 && bin_of(corners[i]) == bin_of(corners[i - 1]);
    if (same || bins.size() >= kMaxBins) {
      bins.back().normal += corners[i].normal * corners[i].weight;
      ends.back() = i + 1;
    } else {
      bins.push_back({corners[i].normal * corners[i].weight, 1.0, corners[i].smoothing, static_cast<std::uint32_t>(i)});
      ends.push_back(i + 1);
    }
  }
  std::vector<Corner> unit = bins;
  for (Corner& u : unit) u.normal = math::norm(u.normal) > 0.0 ? u.normal / math::norm(u.normal) : Vec3{};
  for (std::size_t a = 0; a < bins.size(); ++a) {
    Vec3 sum = bins[a].normal;
    for (std::size_t b = 0; b < bins.size(); ++b) {
      if (a != b && smooth_together(unit[a], unit[b], cos_crease)) sum += bins[b].normal;
    }
    for (std::size_t i = bins[a].number; i < ends[a]; ++i)
      store(bins[a].smoothing == 0 ? corners[i].normal : sum, corners[i], out);
  }
}

}  // namespace

std::vector<float> compute_corner_normals(const NormalInput& input) {
  const std::vector<float>& positions = *input.positions;
  const std::vector<std::uint32_t>& triangles = *input.triangles;
  const double cos_crease = std::cos(input.crease_angle_rad);
  std::vector<float> out(3 * triangles.size(), 0.0F);

  // Corners sorted by vertex (counting sort).
  std::vector<std::uint32_t> start(positions.size() / 3 + 1, 0), order(triangles.size());
  for (std::uint32_t v : triangles) ++start[v + 1];
  for (std::size_t v = 1; v < start.size(); ++v) start[v] += start[v - 1];
  {
    std::vector<std::uint32_t> at(start.begin(), start.end() - 1);
    for (std::uint32_t c = 0; c < triangles.size(); ++c) order[at[triangles[c]]++] = c;
  }

  const auto position = [&positions](std::uint32_t v) {
    const float* p = positions.data() + std::size_t{3} * v;
    return Vec3{p[0], p[1], p[2]};
  };
  std::vector<Corner> corners;
  for (std::size_t v = 0; v + 1 < start.size(); ++v) {
    corners.clear();
    for (std::uint32_t k = start[v]; k < start[v + 1]; ++k) {
      const std::uint32_t c = order[k], t = c / 3;
      const Vec3 here = position(triangles[c]);
      const Vec3 e1 = position(triangles[3 * t + (c + 1) % 3]) - here,
                 e2 = position(triangles[3 * t + (c + 2) % 3]) - here;
      const Vec3 n = math::cross(e1, e2);
      const double length = math::norm(n);
      corners.push_back({length > 0.0 ? n / length : Vec3{}, length * std::atan2(length, math::dot(e1, e2)),
                         input.smoothing == nullptr ? kSmoothByAngle : (*input.smoothing)[t], c});
    }
    constexpr std::size_t kFew = 48;
    corners.size() <= kFew ? smooth_few(corners, cos_crease, out) : smooth_many(corners, cos_crease, out);
  }
  return out;
}

}  // namespace ambf::mesh
