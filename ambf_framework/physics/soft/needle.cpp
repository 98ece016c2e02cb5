#include "physics/needle.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "physics/detail/world_data.h"
#include "physics/soft/detail/needle_data.h"
#include "physics/soft/detail/tissue_places.h"
#include "physics/soft/soft_bodies.h"

namespace ambf::physics {
namespace detail {

using math::Vec3;

namespace {

constexpr std::size_t kStateOfTip = 6, kStateOfPuncture = 8;
// What a puncture's last number says in a saved state: its kind; of stitches that and this, or that it is a knot.
constexpr double kStitch = 10.0, kKnot = 20.0;
constexpr double kOverlap = 0.01;  // m, of thread: by how much one may be before the one that it follows
constexpr int kArcParts = 64;      // of a circle's arc: half a circle of 26 mm is met to 3 um

// Three places as many on the circle through them; on a line they stay as they are.
std::vector<Vec3> rounded(const std::vector<Vec3>& given) {
  if (given.size() != 3) return given;
  const Vec3 a = given[1] - given[0], b = given[2] - given[0], normal = math::cross(a, b);
  const double square = math::dot(normal, normal);
  if (!(square > 1e-12 * math::dot(a, a) * math::dot(b, b))) return given;
  const Vec3 to_centre =
      (math::cross(normal, a) * math::dot(b, b) + math::cross(b, normal) * math::dot(a, a)) / (2.0 * square);
  const Vec3 centre = given[0] + to_centre, x = -to_centre;
  const Vec3 y = math::cross(normal, x) / std::sqrt(square);
  const auto angle_of = [&](const Vec3& place) {
    const Vec3 r = place - centre;
    const double angle = std::atan2(math::dot(r, y), math::dot(r, x));
    return angle > 0.0 ? angle : angle + 2.0 * M_PI;
  };
  const double all = angle_of(given[2]);
  std::vector<Vec3> made;
  for (int i = 0; i <= kArcParts; ++i) {
    const double angle = all * i / kArcParts;
    made.push_back(centre + x * std::cos(angle) + y * std::sin(angle));
  }
  return made;
}

// What a saved state says of a place, which may be anything: whether it can be one.
bool take_place(const std::vector<SoftBody*>& bodies, const double* from, TissuePlace& place) {
  place = {};
  for (const SoftBody* body : bodies) {
    if (!body->is_tissue() || static_cast<double>(body->user_index()) != from[0]) continue;
    const Vec3 rest{from[2], from[3], from[4]};
    if (!is_place_of(*body->tissue(), from[1], rest)) return false;
    place = {body->tissue(), static_cast<std::uint32_t>(from[1]), rest};
    return true;
  }
  return false;
}

// Likewise, of the kind of a puncture there.
bool take_kind(double from, const TissuePlace& at, PunctureKind& kind) {
  if (at.tissue->is_sheet()) {
    kind = PunctureKind::through;
    return from == static_cast<double>(kind);
  }
  for (const PunctureKind each : {PunctureKind::entry, PunctureKind::exit})
    if (from == static_cast<double>(each)) kind = each;
  return from != static_cast<double>(PunctureKind::through);
}

// What it says of a stitch or a knot, likewise.
void take_stitch(const std::vector<SoftBody*>& bodies, const double* from, NeedleData& needle) {
  const bool counts = from[6] >= 0.0 && from[6] <= static_cast<double>(Needle::kMaxKnots);
  if (needle.thread == nullptr || !counts) return;
  const auto knot = static_cast<std::uint32_t>(from[6]);
  if (from[7] == kKnot) {
    const bool fits = needle.knots.size() < Needle::kMaxKnots && knot > 0 && !needle.has_knot(knot);
    if (fits && from[5] >= 0.0) needle.knots.push_back({knot, from[5]});
    return;
  }
  Stitch stitch;
  const double least = needle.stitches.empty() ? 0.0 : needle.stitches.back().s - kOverlap;
  if (needle.stitches.size() == Needle::kMaxStitches || !take_place(bodies, from, stitch.at)) return;
  if (!(from[5] >= least && from[5] <= needle.thread->rest_length)) return;
  stitch.s = from[5];
  stitch.knot = knot;
  if (!take_kind(from[7] - kStitch, stitch.at, stitch.kind)) return;
  stitch.node = nearest_node(*stitch.at.tissue, stitch.at.rest);
  needle.stitches.push_back(stitch);
}

void put_place(const TissuePlace& place, std::vector<double>& out) {
  out.insert(out.end(), {place.tissue == nullptr ? -1.0 : place.tissue->owner->user_index(),
                         static_cast<double>(place.element), place.rest.x, place.rest.y, place.rest.z});
}

}  // namespace

Vec3 NeedleData::place(double s) const {
  if (s <= 0.0) return corner.front() + direction.front() * s;
  if (s >= length) return corner.back() + direction.back() * (s - length);
  const auto i = static_cast<std::size_t>(std::upper_bound(along.begin(), along.end(), s) - along.begin());
  return corner[i - 1] + (corner[i] - corner[i - 1]) * ((s - along[i - 1]) / (along[i] - along[i - 1]));
}

Vec3 NeedleData::tangent(double s) const {
  if (s <= 0.0) return direction.front();
  if (s >= length) return direction.back();
  const auto i = static_cast<std::size_t>(std::upper_bound(along.begin(), along.end(), s) - along.begin());
  const double share = (s - along[i - 1]) / (along[i] - along[i - 1]);
  const Vec3 sum = direction[i - 1] * (1.0 - share) + direction[i] * share;
  const double size = math::norm(sum);
  return size > 0.0 ? sum / size : direction[i];
}

double NeedleData::nearest(const Vec3& point, double s, double reach) const {
  const double middle = std::clamp(s, 0.0, length);
  double least = std::numeric_limits<double>::max(), found = s;
  for (std::size_t i = 0; i + 1 < corner.size(); ++i) {
    if (along[i + 1] < middle - reach || along[i] > middle + reach) continue;
    const Vec3 way = corner[i + 1] - corner[i];
    double share = math::dot(point - corner[i], way) / math::dot(way, way);
    if (i > 0) share = std::max(share, 0.0);
    if (i + 2 < corner.size()) share = std::min(share, 1.0);
    const Vec3 off = point - corner[i] - way * share;
    if (const double square = math::dot(off, off); square < least) {
      least = square;
      found = along[i] + share * (along[i + 1] - along[i]);
    }
  }
  return found;
}

void NeedleData::forget_tip() {
  tip = TipState::unknown;
  tip_at = {};
}

void NeedleData::forget(const TissueData* tissue) {
  if (tissue == nullptr || tip_at.tissue == tissue) forget_tip();
  const auto goes = [&](const auto& each) { return tissue == nullptr || each.at.tissue == tissue; };
  std::erase_if(punctures, goes);
  for (Stitch& each : stitches) each.lost = goes(each);
  lose_stitches();
  spans.clear();
  on_surfaces.clear();
  force_world = {};
}

void NeedleData::hang_thread() const {
  if (thread == nullptr) return;
  ThreadAttachment& first = thread->attachments.back();
  if (holder == nullptr) {
    if (!has_thread()) return;
    first.body = nullptr;
    thread->needle = nullptr;
    return;
  }
  thread->needle = this;
  first.body = &holder->owner;
  first.places[0] = to_bullet(math::inverse(holder->initial.T_body_com) * corner.back());
}

void NeedleData::take_free_thread() const {
  if (thread != nullptr && thread->needle == nullptr && thread->attachments.back().body == nullptr) hang_thread();
}

void NeedleData::leave_thread() {
  stitches.clear();
  knots.clear();
  spans.clear();
  if (has_thread()) {
    thread->attachments.back().body = nullptr;
    thread->needle = nullptr;
  }
  thread = nullptr;
}

std::size_t nearest_node(const TissueData& tissue, const Vec3& rest) {
  std::size_t found = 0;
  double least = std::numeric_limits<double>::max();
  for (std::size_t i = 0; i < tissue.grid.points.size(); ++i) {
    if (!tissue.cuts.shows_point(i)) continue;
    const TissuePoint& point = tissue.grid.points[i];
    Vec3 off = -rest;
    for (std::size_t k = 0; k < 4; ++k) off += tissue.grid.corners[point.corner[k]] * point.weight[k];
    if (const double square = math::dot(off, off); square < least) least = square, found = i;
  }
  return found;
}

}  // namespace detail

using detail::NeedleData;
using detail::Puncture;
using detail::TipState;

Needle::Needle(const NeedleOptions& options) : data_(std::make_unique<NeedleData>()) {
  NeedleData& data = *data_;
  data.options = options;
  for (const math::Vec3& place : detail::rounded(options.arc)) {
    const double way = data.corner.empty() ? 0.0 : math::norm(place - data.corner.back());
    if (!data.corner.empty() && !(way > 0.0)) continue;
    data.length += way;
    data.corner.push_back(place);
    data.along.push_back(data.length);
  }
  const std::size_t last = data.corner.empty() ? 0 : data.corner.size() - 1;
  for (std::size_t i = 0; i <= last && last > 0; ++i) {
    const math::Vec3 way = data.corner[std::min(i + 1, last)] - data.corner[i == 0 ? 0 : i - 1];
    const double size = math::norm(way);
    data.direction.push_back(size > 0.0 ? way / size : math::Vec3{});  // it goes back as it came
  }
  // The ends of an arc go on as it does there, not as its last chord.
  if (last >= 2 && options.arc.size() == 3) {
    const auto mirrored = [](const math::Vec3& end, const math::Vec3& chord) {
      const math::Vec3 along = chord / math::norm(chord);
      return along * (2.0 * math::dot(along, end)) - end;
    };
    data.direction.front() = mirrored(data.direction[1], data.corner[1] - data.corner[0]);
    data.direction.back() = mirrored(data.direction[last - 1], data.corner[last] - data.corner[last - 1]);
  }
  data.punctures.reserve(kMaxPunctures);
  data.stitches.reserve(kMaxStitches);
  data.knots.reserve(kMaxKnots);
  data.holders.reserve(kMaxHolders);
  data.spans.reserve(kMaxStitches + kMaxKnots + kMaxHolders + 1);
  data.on_surfaces.reserve(kMaxPunctures + kMaxStitches);
}
Needle::~Needle() = default;

void Needle::use(Body* holder) {
  NeedleData& data = *data_;
  detail::BodyData* const next = holder == nullptr ? nullptr : &holder->data();
  if (next == data.holder) return;
  if (next == nullptr || data.holder != nullptr) data.forget(nullptr);
  data.holder = next;
  data.hang_thread();
}

void Needle::draw(Thread* thread) {
  detail::ThreadData* const next = thread == nullptr ? nullptr : thread->thread();
  if (next == data_->thread) return;
  data_->leave_thread();
  data_->thread = next;
  data_->hang_thread();
}

Body* Needle::holder() const { return data_->holder == nullptr ? nullptr : &data_->holder->owner; }
math::Vec3 Needle::force_world() const { return data_->force_world; }
double Needle::length() const { return data_->length; }
std::size_t Needle::punctures() const { return data_->punctures.size(); }
bool Needle::tip_inside() const { return data_->tip == TipState::inside; }
std::size_t Needle::stitches() const { return data_->stitches.size(); }

std::span<const SurfacePuncture> Needle::on_surfaces() const {
  NeedleData& data = *data_;
  data.on_surfaces.clear();
  for (const Puncture& each : data.punctures)
    if (each.kind != detail::PunctureKind::inner)
      data.on_surfaces.push_back({each.at.tissue->owner, each.node, each.needle, each.force_world, -1.0,
                                  each.kind == detail::PunctureKind::exit, each.at.rest});
  for (std::size_t i = data.stitches.size(); i-- > 0;)
    if (const detail::Stitch& each = data.stitches[i]; each.kind != detail::PunctureKind::inner)
      data.on_surfaces.push_back({each.at.tissue->owner, each.node, detail::now(each.at), each.force_world, each.s,
                                  each.kind == detail::PunctureKind::exit, each.at.rest});
  return data.on_surfaces;
}

void Needle::get_state(std::vector<double>& out) const {
  out.clear();
  out.push_back(static_cast<double>(data_->tip));
  detail::put_place(data_->tip_at, out);
  for (const Puncture& each : data_->punctures) {
    detail::put_place(each.at, out);
    out.insert(out.end(), {each.stuck, each.now, static_cast<double>(each.kind)});
  }
  for (const detail::Stitch& each : data_->stitches) {
    detail::put_place(each.at, out);
    out.insert(out.end(), {each.s, static_cast<double>(each.knot), detail::kStitch + static_cast<double>(each.kind)});
  }
  for (const detail::Knot& each : data_->knots) {
    detail::put_place({}, out);
    out.insert(out.end(), {each.length, static_cast<double>(each.number), detail::kKnot});
  }
}

void Needle::set_state(World& world, std::span<const double> state) {
  NeedleData& data = *data_;
  data.forget(nullptr);
  if (state.size() < detail::kStateOfTip || state.size() > kMaxState || world.data().soft == nullptr) return;
  if ((state.size() - detail::kStateOfTip) % detail::kStateOfPuncture != 0) return;
  const std::vector<SoftBody*>& bodies = world.data().soft->all();
  detail::TissuePlace place;
  const bool is_somewhere = detail::take_place(bodies, &state[1], place);
  for (const TipState each : {TipState::outside, TipState::touching, TipState::inside})
    if (state[0] == static_cast<double>(each) && (each == TipState::outside || is_somewhere)) data.tip = each;
  if (data.tip == TipState::inside && place.tissue->is_sheet()) data.tip = TipState::unknown;  // nothing is in a sheet
  if (data.tip == TipState::touching || data.tip == TipState::inside) data.tip_at = place;
  for (std::size_t at = detail::kStateOfTip; at < state.size(); at += detail::kStateOfPuncture) {
    Puncture puncture;
    const double* from = &state[at];
    if (from[7] >= detail::kStitch) {
      detail::take_stitch(bodies, from, data);
      continue;
    }
    if (data.punctures.size() == kMaxPunctures) continue;
    if (!detail::take_place(bodies, from, puncture.at)) continue;
    puncture.stuck = from[5];
    puncture.now = from[6];
    if (!(std::abs(puncture.stuck) <= 2.0 * data.length && std::abs(puncture.now) <= 2.0 * data.length)) continue;
    if (!detail::take_kind(from[7], puncture.at, puncture.kind)) continue;
    puncture.node = detail::nearest_node(*puncture.at.tissue, puncture.at.rest);
    if (data.holder != nullptr) puncture.needle = data.holder->owner.pose() * data.place(puncture.now);
    data.punctures.push_back(puncture);
  }
  for (detail::Stitch& each : data.stitches)
    if (!data.has_knot(each.knot)) each.knot = 0;
  data.lose_stitches();
}

void add(World& world, Needle& needle) {
  std::unique_ptr<detail::SoftBodies>& all = world.data().soft;
  if (all == nullptr) all = std::make_unique<detail::SoftBodies>();
  all->add(needle.data());
}

void remove(World& world, Needle& needle) {
  if (world.data().soft != nullptr) world.data().soft->remove(needle.data());
  needle.use(nullptr);
  needle.draw(nullptr);
}

}  // namespace ambf::physics
