#include "physics/blade.h"

#include <algorithm>
#include <cmath>

#include "physics/detail/world_data.h"
#include "physics/soft/detail/blade_data.h"
#include "physics/soft/detail/tissue_places.h"
#include "physics/soft/soft_bodies.h"

namespace ambf::physics {
namespace detail {

using math::Vec3;

constexpr std::size_t kStateOfSample = 6;

namespace {

constexpr double kInside = -1e-9;   // a weight
constexpr double kSlack = 1e-9;     // of a triangle that is crossed: neighbours leave no gap
constexpr double kSameSide = 1e-5;  // elements: boxes that are so far apart hold nothing that crosses

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
  PlaceBox places;
  for (BladeSample& sample : blade.samples) {
    sample.followed = false;
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
    sample.followed = true;
    sample.wanted = at;
    sample.away = {};
    sample.stiffness = 0.0;
    sample.held = sample.tissue == &tissue && sample.inside;
    if (sample.held) {
      const Vec3 along = math::rotate(T_world_body.orientation, sample.along);
      const double limit = blade.sharpness * sample.length;
      const auto weight = weights_in(shape_of(tissue, tissue.grid.corners, sample.element), sample.rest);
      const Vec3 gap = tissue.solid.at(point_of(tissue, sample.element, weight)) - at;
      sample.away = gap - along * math::dot(along, gap);
      sample.stiffness = held_back_in_all(2.0 * tissue.solid.modulus() * sample.length, body, place, h,
                                          std::max<std::size_t>(inside, 1));
      if (const double force = sample.stiffness * math::norm(sample.away); force > limit)
        sample.away = sample.away * (limit / force);
      sample.wanted = at + sample.away;
    }
    places.add(sample.wanted);
  }
  find_near(tissue, places);
  for (BladeSample& sample : blade.samples) {
    if (!sample.followed) continue;
    const FoundPlace found = locate(tissue, sample.wanted, sample.tissue == &tissue ? sample.element : 0);
    if (!(found.least > -kNearWeight)) {
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
    if (!sample.held || !sample.inside || tissue.springs.size() == tissue.springs.capacity()) continue;
    const Vec3 along = math::rotate(T_world_body.orientation, sample.along);
    const double limit = blade.sharpness * sample.length;
    const btVector3 place = to_bullet(T_world_body * sample.place);
    const btVector3 carried = body.rigid.getVelocityInLocalPoint(place - centre);
    const Vec3 moving = from_bullet(carried);
    const auto across = [&](const Vec3& v) { return v - along * math::dot(along, v); };
    const Vec3 slide = across(moving) * h;
    const Vec3 after = sample.away + across(tissue.solid.velocity(found.point)) * h - slide;
    const double force = sample.stiffness * math::norm(after);
    TissueSpring spring;
    spring.at = found.point;
    spring.normal = along;
    spring.side_stiffness = force > limit ? sample.stiffness * limit / force : sample.stiffness;
    spring.pull = (slide - sample.away) * spring.side_stiffness;
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
  const double reach = kSameSide * tissue.grid.element_size;
  const auto way_across = [&](std::uint32_t seam) {
    const auto& element = tissue.grid.seams[seam].element;
    PlaceBox box;
    box.add(tissue.middles[element[0]]);
    box.add(tissue.middles[element[1]]);
    return box;
  };
  for (BladeData* blade : tissue.blades) {
    const auto each_quad = [&](const auto& use) {
      for (std::size_t i = 0; i + 1 < blade->samples.size(); ++i) {
        const BladeSample &a = blade->samples[i], &b = blade->samples[i + 1];
        if (!a.moved || !b.moved || a.tissue != &tissue || b.tissue != &tissue) continue;
        if (a.inside || a.was_inside || b.inside || b.was_inside) use(Quad{{a.from, b.from, b.rest, a.rest}});
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
        if (!crosses(from, to, quad.corner[0], quad.corner[1], quad.corner[2]) &&
            !crosses(from, to, quad.corner[0], quad.corner[2], quad.corner[3]))
          continue;
        tissue.cuts.mark(s);
        any = true;
      }
    });
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
    if (sample.tissue != nullptr && detail::is_place_of(*sample.tissue, from[2], rest)) {
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
