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

constexpr double kInside = -1e-9;  // a weight
// Of sheets.
constexpr double kOver = 0.7;  // cosine: a place that is less above the sheet is beside it

// m, of a piece of the edge with its middle at this height, in the sheet.
double length_within(const TissueData& sheet, const SheetPlace& place, const Vec3& along, double length) {
  const double half = 0.5 * length * std::abs(math::dot(along, place.normal)), side = 0.5 * sheet.grid.thickness;
  const double low = std::max(place.height - half, -side), high = std::min(place.height + half, side);
  if (half > 1e-9 * length) return high > low ? length * (high - low) / (2.0 * half) : 0.0;
  return high >= low ? length : 0.0;
}

struct SamplePlace {
  bool near = false;
  TissuePoint point;
  Vec3 rest;
  double felt = 0.0;  // m
};

// Whether a sample went over to another fold: nothing moves along a sheet that fast.
bool is_far(const TissueData& sheet, const BladeSample& sample, const Vec3& rest) {
  const Vec3 way = rest - sample.rest, normal = rest_normal(sheet, sample.element);
  return math::norm(way - normal * math::dot(normal, way)) > kJump * sheet.grid.element_size;
}

// What went through a sheet within a step is where it came in: there it is held.
SamplePlace find_on_sheet(const TissueData& sheet, const BladeSample& sample, const Vec3& along) {
  SheetPlace place = locate_on_sheet(sheet, sample.wanted, kNearSheet * sheet.grid.element_size);
  if (!place.near) return {};
  double felt = length_within(sheet, place, along, sample.length);
  if (sample.tissue == &sheet && !(felt > 0.0) && !sample.held && place.lean > kOver) {
    const double before = from_rest(sheet, sample.element, sample.rest).height;
    if (before * place.height < 0.0 && !is_far(sheet, sample, rest_of(sheet, place))) {
      place.height = std::copysign(0.49 * sheet.grid.thickness, before);
      felt = length_within(sheet, place, along, sample.length);
    }
  }
  return {true, point_of(sheet, place), rest_of(sheet, place), felt};
}

SamplePlace find(const TissueData& tissue, const BladeSample& sample, const Vec3& along) {
  if (tissue.is_sheet()) return find_on_sheet(tissue, sample, along);
  const FoundPlace found = locate(tissue, sample.wanted, sample.tissue == &tissue ? sample.element : 0);
  return {found.least > -kNearWeight, found.point, found.rest, found.least >= kInside ? sample.length : 0.0};
}

// Where the tissue is that a sample is in.
Vec3 held_at(const TissueData& tissue, const Vec3& along, BladeSample& sample) {
  if (tissue.is_sheet()) {
    const SheetPlace place = from_rest(tissue, sample.element, sample.rest);
    sample.felt = length_within(tissue, place, along, sample.length);
    return now(tissue, place);
  }
  sample.felt = sample.length;
  const auto weight = weights_in(shape_of(tissue, tissue.grid.corners, sample.element), sample.rest);
  return tissue.solid.at(point_of(tissue, sample.element, weight));
}

}  // namespace

void forget_where(BladeSample& sample) {
  sample.tissue = nullptr;
  sample.inside = sample.moved = false;
  sample.felt = 0.0;
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
      const Vec3 gap = held_at(tissue, along, sample) - at;
      sample.limit = blade.sharpness * sample.felt;
      sample.away = gap - along * math::dot(along, gap);
      sample.stiffness = held_back_in_all(2.0 * tissue.solid.modulus() * sample.felt, body, place, h,
                                          std::max<std::size_t>(inside, 1));
      if (const double force = sample.stiffness * math::norm(sample.away); force > sample.limit)
        sample.away = sample.away * (sample.limit / force);
      sample.wanted = at + sample.away;
    }
    places.add(sample.wanted);
  }
  if (tissue.is_sheet())
    find_near_triangles(tissue, places, kNearSheet * tissue.grid.element_size);
  else
    find_near(tissue, places);
  for (BladeSample& sample : blade.samples) {
    if (!sample.followed) continue;
    const Vec3 along = math::rotate(T_world_body.orientation, sample.along);
    const SamplePlace found = find(tissue, sample, along);
    if (!found.near) {
      forget_where(sample);
      continue;
    }
    sample.moved = sample.tissue == &tissue && !(tissue.is_sheet() && is_far(tissue, sample, found.rest));
    sample.from = sample.rest;
    sample.was_inside = sample.inside;
    sample.tissue = &tissue;
    sample.rest = found.rest;
    sample.element = found.point.element;
    sample.felt = found.felt;
    sample.inside = found.felt > 0.0;
    if (!sample.held || tissue.springs.size() == tissue.springs.capacity()) continue;
    if (!sample.inside && !tissue.is_sheet()) continue;  // what goes out of a sheet is held back until it has
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
    spring.side_stiffness = force > sample.limit ? sample.stiffness * sample.limit / force : sample.stiffness;
    spring.pull = (slide - sample.away) * spring.side_stiffness;
    tissue.springs.push_back(spring);
    tissue.pulled.push_back(&body);
  }
  blade.last_spring = tissue.springs.size();
}

void sum_force(const TissueData& tissue, BladeData& blade) {
  for (std::size_t i = blade.first_spring; i < blade.last_spring; ++i) blade.force_world += tissue.spring_force[i];
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
  for (const BladeSample& sample : data_->samples) sum += sample.felt;
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
      sample.felt = sample.inside ? sample.length : 0.0;  // of a sheet until its next step
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
