// What the edges of blades swept in a step, and the seams between elements that this opens.
#include <cmath>

#include "physics/soft/detail/blade_data.h"
#include "physics/soft/detail/tissue_places.h"

namespace ambf::physics::detail {

using math::Vec3;

namespace {

constexpr double kSlack = 1e-9;     // of a triangle that is crossed: neighbours leave no gap
constexpr double kSameSide = 1e-5;  // elements: boxes that are so far apart hold nothing that crosses
constexpr double kFlat = 0.05;      // sine: what is swept along a sheet cuts nothing apart

// A place of what was swept, and across that.
struct Swept {
  Vec3 at, normal;
};

// Whether a way crosses a triangle, and where. `one_sided`: ways that meet in the triangle's plane do so once.
bool crosses(const Vec3& from, const Vec3& to, const Vec3& a, const Vec3& b, const Vec3& c, bool one_sided,
             Swept& swept) {
  const Vec3 normal = math::cross(b - a, c - a), along = to - from;
  const double size = math::norm(normal), across = math::dot(normal, along);
  if (!(size > 1e-18) || !(std::abs(across) > 1e-12 * size * math::norm(along))) return false;
  const double share = math::dot(normal, a - from) / across;
  if (one_sided && (math::dot(normal, from - a) >= 0.0) == (math::dot(normal, to - a) >= 0.0)) return false;
  if (!(share >= 0.0 && share <= 1.0)) return false;
  const Vec3 at = from + along * share;
  const double square = size * size;
  const double wa = math::dot(math::cross(b - at, c - at), normal) / square,
               wb = math::dot(math::cross(c - at, a - at), normal) / square;
  if (!(wa >= -kSlack && wb >= -kSlack && wa + wb <= 1.0 + kSlack)) return false;
  swept = {at, normal / size};
  return true;
}

struct Quad {
  Vec3 corner[4];  // from here, from next, to next, to here
  Vec3 sheet;      // normal of the sheet; of solids none
};

// Whether two samples that follow each other are in one part of the tissue.
bool joined(const TissueData& tissue, const BladeSample& a, const BladeSample& b) {
  if (!a.moved || !b.moved || a.tissue != &tissue || b.tissue != &tissue) return false;
  if (!tissue.is_sheet()) return a.inside || a.was_inside || b.inside || b.was_inside;
  const double reach = 2.0 * math::norm(b.place - a.place) + kJump * tissue.grid.element_size;
  return math::norm(b.rest - a.rest) < reach && math::norm(b.from - a.from) < reach;
}

bool crosses(const Vec3& from, const Vec3& to, const Quad& quad, Swept& swept) {
  const bool of_sheet = math::dot(quad.sheet, quad.sheet) > 0.0;
  for (std::size_t k = 0; k < 2; ++k) {
    const Vec3 &a = quad.corner[0], &b = quad.corner[k + 1], &c = quad.corner[k + 2];
    if (of_sheet) {
      const Vec3 normal = math::cross(b - a, c - a), aslant = math::cross(normal, quad.sheet);
      if (!(math::norm(aslant) > kFlat * math::norm(normal))) continue;
    }
    if (crosses(from, to, a, b, c, of_sheet, swept)) return true;
  }
  return false;
}

}  // namespace

bool cut(TissueData& tissue) {
  bool any = false;
  const double reach = kSameSide * tissue.grid.element_size;
  const auto way_across = [&](std::uint32_t seam) {
    const auto& element = tissue.grid.seams[seam].element;
    PlaceBox box;
    box.add(tissue.middles[element[0]]);
    box.add(tissue.middles[element[1]]);
    if (tissue.is_sheet()) box.add(tissue.middles[tissue.solid.triangle_count() + seam]);
    return box;
  };
  for (BladeData* blade : tissue.blades) {
    const auto each_quad = [&](const auto& use) {
      for (std::size_t i = 0; i + 1 < blade->samples.size(); ++i) {
        const BladeSample &a = blade->samples[i], &b = blade->samples[i + 1];
        if (!joined(tissue, a, b)) continue;
        use(Quad{{a.from, b.from, b.rest, a.rest}, tissue.is_sheet() ? rest_normal(tissue, a.element) : Vec3{}});
      }
    };
    PlaceBox swept;
    each_quad([&](const Quad& quad) {
      for (const Vec3& corner : quad.corner) swept.add(corner);
    });
    if (swept.empty()) continue;
    tissue.near_seams.clear();
    for (std::uint32_t s = 0; s < tissue.grid.seams.size(); ++s)
      if (!tissue.cuts.open(s) && swept.is_near(way_across(s), reach)) tissue.near_seams.push_back(s);
    each_quad([&](const Quad& quad) {
      PlaceBox box;
      for (const Vec3& corner : quad.corner) box.add(corner);
      for (const std::uint32_t s : tissue.near_seams) {
        const TissueSeam& seam = tissue.grid.seams[s];
        const Vec3 &from = tissue.middles[seam.element[0]], &to = tissue.middles[seam.element[1]];
        if (!box.is_near(way_across(s), reach)) continue;
        // Of a sheet the way goes within it, also where that is bent.
        const Vec3& by = tissue.is_sheet() ? tissue.middles[tissue.solid.triangle_count() + s] : to;
        Swept by_blade;
        if (!crosses(from, by, quad, by_blade) && !(tissue.is_sheet() && crosses(by, to, quad, by_blade))) continue;
        tissue.cuts.mark(s, by_blade.at, by_blade.normal);
        any = true;
      }
    });
  }
  for (BladeData* blade : tissue.blades)
    for (BladeSample& sample : blade->samples) sample.moved = false;
  if (!any) return false;
  tissue.find_bounds();
  if (!tissue.cuts.apply()) return false;
  tissue.follow_cuts();
  return true;
}

}  // namespace ambf::physics::detail
