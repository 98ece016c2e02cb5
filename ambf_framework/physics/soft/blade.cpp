#include "physics/blade.h"

#include <algorithm>
#include <cmath>

#include "physics/detail/world_data.h"
#include "physics/soft/detail/blade_data.h"
#include "physics/soft/soft_bodies.h"

namespace ambf::physics {
namespace detail {

using math::Vec3;

constexpr std::size_t kStateOfSample = 6;

namespace {

constexpr double kReach = 0.5;      // in weights: how far outside of an element tissue is near
constexpr double kInside = -1e-9;   // a weight
constexpr double kSlack = 1e-9;     // of a triangle that is crossed: neighbours leave no gap
constexpr double kFarCorner = 2.5;  // elements: none that is near has its first corner further away

struct Found {
  double least = -1.0;  // weight; below kInside: outside
  Vec3 rest;
  TissuePoint point;
};

std::array<double, 4> weights_in(const std::array<Vec3, 4>& t, const Vec3& at) {
  const Vec3 a = t[1] - t[0], b = t[2] - t[0], c = t[3] - t[0], p = at - t[0];
  const double six = math::dot(a, math::cross(b, c));
  const double wa = math::dot(p, math::cross(b, c)) / six, wb = math::dot(p, math::cross(c, a)) / six,
               wc = math::dot(p, math::cross(a, b)) / six;
  return {1.0 - wa - wb - wc, wa, wb, wc};
}

std::array<Vec3, 4> shape_of(const TissueData& tissue, const std::vector<Vec3>& corners, std::uint32_t element) {
  const std::uint32_t* c = tissue.solid.corners_of(element);
  return {corners[c[0]], corners[c[1]], corners[c[2]], corners[c[3]]};
}

TissuePoint point_of(const TissueData& tissue, std::uint32_t element, const std::array<double, 4>& weight) {
  const std::uint32_t* c = tissue.solid.corners_of(element);
  return {{c[0], c[1], c[2], c[3]}, weight, element};
}

// The element that a place is in, the one that it was in before all others; or the one that it is least out of.
Found locate(const TissueData& tissue, const Vec3& at, std::uint32_t before) {
  Found found;
  found.least = -kReach;
  const std::vector<Vec3>& corners = tissue.solid.positions();
  const double near = kFarCorner * tissue.grid.element_size;
  const auto consider = [&](std::uint32_t e) {
    const auto weight = weights_in(shape_of(tissue, corners, e), at);
    const double least = *std::min_element(weight.begin(), weight.end());
    if (!(least > found.least)) return;
    found.least = least;
    found.point = point_of(tissue, e, weight);
  };
  consider(before);
  for (std::uint32_t e = 0; found.least < 0.0 && e < tissue.solid.element_count(); ++e) {
    const Vec3 way = corners[tissue.solid.corners_of(e)[0]] - at;
    if (math::dot(way, way) < near * near) consider(e);
  }
  for (std::size_t k = 0; found.least > -kReach && k < 4; ++k)
    found.rest += tissue.grid.corners[found.point.corner[k]] * found.point.weight[k];
  return found;
}

// Of a saved number of an element and a place, which may be anything: whether the blade could have been there.
bool is_near(const TissueData& tissue, double element, const Vec3& rest) {
  if (!(element >= 0.0 && element < static_cast<double>(tissue.solid.element_count()))) return false;
  const auto weight = weights_in(shape_of(tissue, tissue.grid.corners, static_cast<std::uint32_t>(element)), rest);
  return std::all_of(weight.begin(), weight.end(), [](double w) { return w > -2.0 * kReach; });
}

bool crosses(const Vec3& from, const Vec3& to, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 normal = math::cross(b - a, c - a), along = to - from;
  const double size = math::norm(normal), across = math::dot(normal, along);
  if (!(size > 1e-18) || !(std::abs(across) > 1e-12 * size * math::norm(along))) return false;
  const double share = math::dot(normal, a - from) / across;
  if (!(share >= 0.0 && share <= 1.0)) return false;
  const Vec3 at = from + along * share;
  const double square = size * size;
  const double wa = math::dot(math::cross(b - at, c - at), normal) / square,
               wb = math::dot(math::cross(c - at, a - at), normal) / square;
  return wa >= -kSlack && wb >= -kSlack && wa + wb <= 1.0 + kSlack;
}

struct Quad {
  Vec3 corner[4];  // from here, from next, to next, to here
};

}  // namespace

void forget_where(BladeSample& sample) {
  sample.tissue = nullptr;
  sample.inside = sample.moved = false;
  sample.rest = {};
  sample.element = 0;
}

void BladeData::forget(const TissueData* tissue) {
  for (BladeSample& sample : samples) {
    if (tissue == nullptr || sample.tissue == tissue) forget_where(sample);
  }
  force_world = {};
}

void add_blade(TissueData& tissue, BladeData& blade, double h) {
  blade.first_spring = blade.last_spring = tissue.springs.size();
  BodyData& body = *blade.holder;
  const math::Pose T_world_body = body.owner.pose();
  const btVector3 centre = body.rigid.getWorldTransform().getOrigin();
  const double reach = tissue.grid.element_size;
  std::size_t inside = 0;
  for (const BladeSample& sample : blade.samples) inside += sample.inside ? 1 : 0;
  for (BladeSample& sample : blade.samples) {
    if (sample.tissue != nullptr && sample.tissue != &tissue) continue;
    const Vec3 at = T_world_body * sample.place;
    const btVector3 place = to_bullet(at);
    sample.moved = false;
    bool near = true;
    for (int i = 0; i < 3; ++i) near = near && place[i] > tissue.low[i] - reach && place[i] < tissue.high[i] + reach;
    if (!near) {
      forget_where(sample);
      continue;
    }
    Vec3 wanted = at, away{};
    const Vec3 along = math::rotate(T_world_body.orientation, sample.along);
    const double limit = blade.sharpness * sample.length;
    double stiffness = 0.0;
    const bool held = sample.tissue == &tissue && sample.inside;
    if (held) {
      const auto weight = weights_in(shape_of(tissue, tissue.grid.corners, sample.element), sample.rest);
      const Vec3 gap = tissue.solid.at(point_of(tissue, sample.element, weight)) - at;
      away = gap - along * math::dot(along, gap);
      stiffness = held_back_in_all(2.0 * tissue.solid.modulus() * sample.length, body, place, h,
                                   std::max<std::size_t>(inside, 1));
      if (const double force = stiffness * math::norm(away); force > limit) away = away * (limit / force);
      wanted = at + away;
    }
    const Found found = locate(tissue, wanted, sample.tissue == &tissue ? sample.element : 0);
    if (!(found.least > -kReach)) {
      forget_where(sample);
      continue;
    }
    sample.moved = sample.tissue == &tissue;
    sample.from = sample.rest;
    sample.was_inside = sample.inside;
    sample.tissue = &tissue;
    sample.rest = found.rest;
    sample.element = found.point.element;
    sample.inside = found.least >= kInside;
    if (!held || !sample.inside || tissue.springs.size() == tissue.springs.capacity()) continue;
    const btVector3 carried = body.rigid.getVelocityInLocalPoint(place - centre);
    const Vec3 moving = from_bullet(carried);
    const auto across = [&](const Vec3& v) { return v - along * math::dot(along, v); };
    const Vec3 slide = across(moving) * h;
    const Vec3 after = away + across(tissue.solid.velocity(found.point)) * h - slide;
    const double force = stiffness * math::norm(after);
    TissueSpring spring;
    spring.at = found.point;
    spring.normal = along;
    spring.side_stiffness = force > limit ? stiffness * limit / force : stiffness;
    spring.pull = (slide - away) * spring.side_stiffness;
    tissue.springs.push_back(spring);
    tissue.pulled.push_back(&body);
  }
  blade.last_spring = tissue.springs.size();
}

void sum_force(const TissueData& tissue, BladeData& blade) {
  for (std::size_t i = blade.first_spring; i < blade.last_spring; ++i) blade.force_world += tissue.spring_force[i];
}

void cut(TissueData& tissue) {
  bool any = false;
  const auto middle = [&](std::uint32_t e) {
    Vec3 sum{};
    for (int k = 0; k < 4; ++k) sum += tissue.grid.corners[tissue.solid.corners_of(e)[k]] * 0.25;
    return sum;
  };
  for (BladeData* blade : tissue.blades) {
    for (std::size_t i = 0; i + 1 < blade->samples.size(); ++i) {
      const BladeSample &a = blade->samples[i], &b = blade->samples[i + 1];
      if (!a.moved || !b.moved || a.tissue != &tissue || b.tissue != &tissue) continue;
      if (!a.inside && !a.was_inside && !b.inside && !b.was_inside) continue;
      const Quad quad{{a.from, b.from, b.rest, a.rest}};
      Vec3 low = quad.corner[0], high = low;
      for (const Vec3& c : quad.corner) {
        low = {std::min(low.x, c.x), std::min(low.y, c.y), std::min(low.z, c.z)};
        high = {std::max(high.x, c.x), std::max(high.y, c.y), std::max(high.z, c.z)};
      }
      const double reach = 2.0 * tissue.grid.element_size;
      for (std::size_t s = 0; s < tissue.grid.seams.size(); ++s) {
        if (tissue.cuts.open(s)) continue;
        const TissueSeam& seam = tissue.grid.seams[s];
        const Vec3 from = middle(seam.element[0]);
        if (from.x < low.x - reach || from.y < low.y - reach || from.z < low.z - reach || from.x > high.x + reach ||
            from.y > high.y + reach || from.z > high.z + reach)
          continue;
        const Vec3 to = middle(seam.element[1]);
        if (!crosses(from, to, quad.corner[0], quad.corner[1], quad.corner[2]) &&
            !crosses(from, to, quad.corner[0], quad.corner[2], quad.corner[3]))
          continue;
        tissue.cuts.mark(s);
        any = true;
      }
    }
  }
  if (any && tissue.cuts.apply()) tissue.follow_cuts();
  for (BladeData* blade : tissue.blades)
    for (BladeSample& sample : blade->samples) sample.moved = false;
}

}  // namespace detail

using detail::BladeData;
using detail::BladeSample;

Blade::Blade(const BladeOptions& options) : data_(std::make_unique<BladeData>()) {
  data_->sharpness = options.sharpness;
  double all = 0.0;
  for (std::size_t i = 1; i < options.edge.size(); ++i) all += math::norm(options.edge[i] - options.edge[i - 1]);
  constexpr double kSpacing = 0.0005;  // m
  const std::size_t segments = options.edge.empty() ? 0 : options.edge.size() - 1;
  const auto room = static_cast<double>(kMaxSamples - std::min(kMaxSamples - 1, segments + 1));
  const double spacing = std::max(kSpacing, all / std::max(1.0, room));
  for (std::size_t i = 0; i < segments; ++i) {
    const math::Vec3 way = options.edge[i + 1] - options.edge[i];
    const double length = math::norm(way);
    if (!(length > 0.0)) continue;
    const auto parts = static_cast<std::size_t>(std::max(1.0, std::floor(length / spacing)));
    const double share = length / static_cast<double>(parts);
    for (std::size_t k = data_->samples.empty() ? 0 : 1; k <= parts; ++k) {
      BladeSample sample;
      sample.place = options.edge[i] + way * (static_cast<double>(k) / static_cast<double>(parts));
      sample.along = way / length;
      sample.length = k == parts ? 0.5 * share : share;
      if (k == 0) sample.length = 0.5 * share;
      if (k == 1 && i > 0 && !data_->samples.empty()) data_->samples.back().length += 0.5 * share;
      data_->samples.push_back(sample);
    }
  }
}
Blade::~Blade() = default;

void Blade::use(Body* holder) {
  data_->holder = holder == nullptr ? nullptr : &holder->data();
  if (holder == nullptr) data_->forget(nullptr);
}
Body* Blade::holder() const { return data_->holder == nullptr ? nullptr : &data_->holder->owner; }
math::Vec3 Blade::force_world() const { return data_->force_world; }

double Blade::length_in_tissue() const {
  double sum = 0.0;
  for (const BladeSample& sample : data_->samples) sum += sample.inside ? sample.length : 0.0;
  return sum;
}

void Blade::get_state(std::vector<double>& out) const {
  out.clear();
  for (const BladeSample& sample : data_->samples)
    out.insert(out.end(),
               {sample.tissue == nullptr ? -1.0 : sample.tissue->owner->user_index(), sample.inside ? 1.0 : 0.0,
                static_cast<double>(sample.element), sample.rest.x, sample.rest.y, sample.rest.z});
}

void Blade::set_state(World& world, std::span<const double> state) {
  data_->forget(nullptr);
  if (state.size() != detail::kStateOfSample * data_->samples.size() || world.data().soft == nullptr) return;
  const double* from = state.data();
  for (BladeSample& sample : data_->samples) {
    for (const SoftBody* body : world.data().soft->all())
      if (body->is_tissue() && static_cast<double>(body->user_index()) == from[0]) sample.tissue = body->tissue();
    const math::Vec3 rest{from[3], from[4], from[5]};
    if (sample.tissue != nullptr && detail::is_near(*sample.tissue, from[2], rest)) {
      sample.inside = from[1] != 0.0;
      sample.element = static_cast<std::uint32_t>(from[2]);
      sample.rest = rest;
    } else {
      sample.tissue = nullptr;
    }
    from += detail::kStateOfSample;
  }
}

void add(World& world, Blade& blade) {
  std::unique_ptr<detail::SoftBodies>& all = world.data().soft;
  if (all == nullptr) all = std::make_unique<detail::SoftBodies>();
  all->add(blade.data());
}

void remove(World& world, Blade& blade) {
  if (world.data().soft != nullptr) world.data().soft->remove(blade.data());
  blade.use(nullptr);
}

}  // namespace ambf::physics
