// A step of a needle in one tissue: punctures slide along its arc, its tip presses, goes on and comes out.
#include <algorithm>
#include <cmath>

#include "physics/detail/world_data.h"
#include "physics/soft/detail/needle_data.h"
#include "physics/soft/detail/tissue_places.h"
#include "physics/soft/soft_bodies.h"

namespace ambf::physics::detail {

using math::Vec3;

namespace {

constexpr double kStraight = 0.5;   // cosine: a tip that presses more aslant slips off
constexpr double kReach = 0.25;     // of the needle's length, in which a puncture is looked for
constexpr double kBeside = 0.5;     // elements, along the needle: what is nearer to a puncture of a sheet is that
constexpr double kGivesWay = 0.1;   // elements: a tip that presses a sheet by its puncture force is so far beyond it
constexpr std::size_t kSpared = 8;  // punctures that are never within the tissue

// What holds the needle in the world in this step.
struct Placed {
  TissueData& tissue;
  NeedleData& needle;
  BodyData& body;
  math::Pose T;
  btVector3 centre;
  double h;
  std::size_t springs;  // of the needle, about

  Vec3 place(double s) const { return T * needle.place(s); }
  Vec3 tangent(double s) const { return math::rotate(T.orientation, needle.tangent(s)); }
  double nearest(const Vec3& at, double s) const {
    return needle.nearest(math::inverse(T) * at, s, kReach * needle.length);
  }
  Vec3 carried(const Vec3& at) const { return from_bullet(body.rigid.getVelocityInLocalPoint(to_bullet(at) - centre)); }
  double stiffness(const Vec3& at) const {
    return held_back_in_all(tissue.corner_stiffness, body, to_bullet(at), h, springs);
  }
};

// False: no tissue is near.
bool find(TissueData& tissue, const Vec3& at, std::uint32_t before, TissuePlace& place) {
  if (tissue.is_sheet()) {
    PlaceBox box;
    box.add(at);
    const double reach = kNearSheet * tissue.grid.element_size;
    find_near_triangles(tissue, box, reach);
    SheetPlace found = locate_on_sheet(tissue, at, reach);
    found.height = 0.0;
    if (found.near) place = {&tissue, found.triangle, rest_of(tissue, found)};
    return found.near;
  }
  tissue.near_elements.clear();
  FoundPlace found = locate(tissue, at, before);
  if (!(found.least >= 0.0)) {
    PlaceBox box;
    box.add(at);
    find_near(tissue, box);
    found = locate(tissue, at, before);
  }
  if (!(found.least > -kNearWeight)) return false;
  place = {&tissue, found.point.element, found.rest};
  return true;
}

struct Crossing {
  double share = 2.0;  // of the way; above 1: none
  bool inward = false;
};

// The first face that a way crosses.
Crossing first_crossing(const TissueData& tissue, const Vec3& from, const Vec3& to) {
  Crossing first;
  const btVector3 start = to_bullet(from), along = to_bullet(to) - start;
  for (std::uint32_t i = 0; i < tissue.grid.faces.size(); ++i) {
    if (!tissue.cuts.shows_face(i)) continue;
    const auto& face = tissue.grid.faces[i];
    const btVector3 &a = tissue.at[face[0]], &b = tissue.at[face[1]], &c = tissue.at[face[2]];
    bool apart = false;
    for (int axis = 0; axis < 3 && !apart; ++axis) {
      const double low = std::min(start[axis], start[axis] + along[axis]),
                   high = std::max(start[axis], start[axis] + along[axis]);
      apart = std::min({a[axis], b[axis], c[axis]}) > high || std::max({a[axis], b[axis], c[axis]}) < low;
    }
    if (apart) continue;
    // Moeller and Trumbore (1997); neighbours leave no gap.
    const btVector3 ab = b - a, ac = c - a, normal = ab.cross(ac);
    const double across = -normal.dot(along);
    if (!(std::abs(across) > 0.0)) continue;
    const btVector3 off = start - a, turned = off.cross(along);
    const double u = ac.dot(turned) / across, v = -ab.dot(turned) / across, share = normal.dot(off) / across;
    if (!(u >= -1e-9 && v >= -1e-9 && u + v <= 1.0 + 1e-9 && share >= 0.0 && share <= 1.0)) continue;
    if (share < first.share) first = {share, across > 0.0};
  }
  return first;
}

// False: there is no room.
bool puncture(NeedleData& needle, const TissuePlace& at, PunctureKind kind, double s) {
  const std::size_t room = Needle::kMaxPunctures - (kind == PunctureKind::inner ? kSpared : 0);
  if (needle.punctures.size() >= room) return false;
  Puncture made;
  made.at = at;
  made.kind = kind;
  made.stuck = made.now = s;
  if (kind != PunctureKind::inner) made.node = nearest_node(*at.tissue, at.rest);
  needle.punctures.push_back(made);
  return true;
}

// Where punctures are along the needle. One that the tip was drawn back through ends: the way in opens that again. One
// that the rear went through ends, or goes over to the thread when the step ends.
void slide(const Placed& in) {
  NeedleData& needle = in.needle;
  for (Puncture& each : needle.punctures)
    if (each.at.tissue == &in.tissue) each.now = in.nearest(detail::now(each.at), each.now);
  while (!needle.punctures.empty()) {
    const Puncture& newest = needle.punctures.back();
    if (newest.at.tissue != &in.tissue || !(newest.now < -kPassed)) break;
    if (newest.kind == PunctureKind::exit) {
      needle.tip = TipState::inside;
      needle.tip_at = newest.at;
    } else if (goes_in(newest.kind) && needle.tip != TipState::unknown) {
      needle.tip = TipState::outside;
      needle.tip_at = {};
    }
    needle.punctures.pop_back();
  }
  while (!needle.punctures.empty() && needle.punctures.front().at.tissue == &in.tissue && needle.thread == nullptr &&
         needle.punctures.front().now > needle.length + kPassed)
    needle.punctures.erase(needle.punctures.begin());
  if (needle.punctures.empty() && needle.tip == TipState::inside) needle.forget_tip();  // all of it is in tissue
}

// From outside: the arc between the tip and the last puncture must not be within tissue, or go through a sheet.
void look(const Placed& in) {
  NeedleData& needle = in.needle;
  const bool is_sheet = in.tissue.is_sheet();
  double until = needle.punctures.empty() ? needle.length : needle.punctures.back().now;
  // A puncture holds a sheet beside the arc, and the arc goes through it a little before.
  if (is_sheet && !needle.punctures.empty() && needle.punctures.back().at.tissue == &in.tissue)
    until -= kBeside * in.tissue.grid.element_size;
  double from = 0.0;
  for (std::size_t i = 1; i < needle.along.size() && from < until; ++i) {
    const double to = std::min(needle.along[i], until);
    const Vec3 start = in.place(from), end = in.place(to);
    const Crossing met = first_crossing(in.tissue, start, end);
    from = to;
    if (met.share > 1.0) continue;
    // Seen from the tip: what is crossed outward is the face that the tip came in by.
    if (met.inward && !is_sheet) return;
    needle.seen_inside = true;
    if (needle.tip != TipState::outside) return;
    TissuePlace place;
    if (!find(in.tissue, start + (end - start) * met.share, 0, place)) return;
    needle.tip = TipState::touching;
    needle.tip_at = place;
    return;
  }
}

void add_spring(const Placed& in, const TissueSpring& spring) {
  in.tissue.springs.push_back(spring);
  in.tissue.pulled.push_back(&in.body);
}

bool has_room(const TissueData& tissue) { return tissue.springs.size() < tissue.springs.capacity(); }

// Inner punctures behind the tip, so that the channel is where the needle went.
void fill_channel(const Placed& in) {
  NeedleData& needle = in.needle;
  const double spacing = in.tissue.grid.element_size;
  while (!needle.punctures.empty() && needle.punctures.back().at.tissue == &in.tissue) {
    const double s = needle.punctures.back().now - spacing;
    TissuePlace place;
    if (s < 0.0 || !find(in.tissue, in.place(s), needle.punctures.back().at.element, place)) return;
    if (!puncture(needle, place, PunctureKind::inner, s)) return;
  }
}

// The tip in or on tissue takes it along with up to the puncture force, and goes on through it beyond that.
void press(const Placed& in) {
  NeedleData& needle = in.needle;
  const Vec3 tip = in.place(0.0), forward = -in.tangent(0.0);
  const double limit = needle.options.puncture_force;
  double stiffness = in.stiffness(tip);
  // A light sheet gives way within a step, and what the tip went beyond it in the step is not what it bears.
  if (in.tissue.is_sheet()) stiffness = std::min(stiffness, limit / (kGivesWay * in.tissue.grid.element_size));
  Vec3 at = now(needle.tip_at), gap = at - tip;
  double ahead = math::dot(gap, forward);
  if (needle.tip == TipState::touching) {
    const bool drawn_back = ahead > 0.0, presses = limit == 0.0 || stiffness * math::norm(gap) > limit;
    if (drawn_back || (presses && -ahead < kStraight * math::norm(gap))) {
      needle.tip = TipState::outside;
      needle.tip_at = {};
      return;
    }
    const PunctureKind kind = in.tissue.is_sheet() ? PunctureKind::through : PunctureKind::entry;
    if (presses && puncture(needle, needle.tip_at, kind, in.nearest(at, 0.0))) {
      needle.tip = TipState::inside;
      if (kind == PunctureKind::through) {
        needle.tip = TipState::outside;
        needle.tip_at = {};
        return;
      }
    }
  }
  if (needle.tip == TipState::inside && (ahead > 0.0 || stiffness * -ahead > limit)) {
    const Vec3 wanted = ahead > 0.0 ? tip : tip - forward * (limit / stiffness);
    const Crossing met = first_crossing(in.tissue, at, wanted);
    TissuePlace place;
    const bool out = met.share <= 1.0 && !met.inward;
    const bool found = find(in.tissue, out ? at + (wanted - at) * met.share : wanted, needle.tip_at.element, place);
    if (found) needle.tip_at = place;
    if ((out || !found) && !(ahead > 0.0) &&
        puncture(needle, needle.tip_at, PunctureKind::exit, in.nearest(now(needle.tip_at), 0.0))) {
      needle.tip = TipState::outside;
      needle.tip_at = {};
      return;
    }
    at = now(needle.tip_at);
    gap = at - tip;
    ahead = math::dot(gap, forward);
    fill_channel(in);
  }
  if (!has_room(in.tissue)) return;
  TissueSpring spring;
  spring.at = point_of(needle.tip_at);
  spring.normal = forward;
  const Vec3 slide = in.carried(tip) * in.h;
  const bool on_face = needle.tip == TipState::touching;
  const auto felt = [&](const Vec3& v) { return on_face ? v : forward * math::dot(v, forward); };
  Vec3 away = felt(gap);
  if (math::dot(away, forward) > 0.0) away -= forward * math::dot(away, forward);  // it does not pull
  if (const double force = stiffness * math::norm(away); force > limit) away = away * (limit / force);
  const Vec3 after = away + felt(in.tissue.solid.velocity(spring.at) * in.h - slide);
  spring.pushes = in.tissue.is_sheet();  // what is light may turn back within the step
  if (math::dot(after, forward) > 0.0 && !spring.pushes) return;
  const double force = stiffness * math::norm(after);
  spring.normal_stiffness = force > limit ? stiffness * limit / force : stiffness;
  spring.side_stiffness = on_face ? spring.normal_stiffness : 0.0;
  spring.pull = (felt(slide) - away) * spring.normal_stiffness;
  add_spring(in, spring);
}

// m, of the needle in tissue, that a puncture stands for.
double share_of(const NeedleData& needle, std::size_t i) {
  const std::vector<Puncture>& all = needle.punctures;
  double length = 0.0;
  if (all[i].kind == PunctureKind::through) return all[i].at.tissue->grid.thickness;
  if (i > 0 && !comes_out(all[i - 1].kind)) length += 0.5 * std::abs(all[i - 1].now - all[i].now);
  if (all[i].kind == PunctureKind::exit) return length;
  if (i + 1 < all.size()) return length + 0.5 * std::abs(all[i].now - all[i + 1].now);
  return length + std::max(0.0, all[i].now);
}

// Across the needle a puncture is held; along it friction holds, as in contacts (tissue_step.cpp).
void hold(const Placed& in, Puncture& each, double friction) {
  const Vec3 place = in.place(each.now), along = in.tangent(each.now);
  const double stiffness = in.stiffness(place), strength = in.needle.options.strength;
  const auto across = [&](const Vec3& v) { return v - along * math::dot(along, v); };
  TissueSpring spring;
  spring.at = point_of(each.at);
  spring.normal = along;
  const Vec3 slide = in.carried(place) * in.h, moved = in.tissue.solid.velocity(spring.at) * in.h - slide;
  Vec3 away = across(in.tissue.solid.at(spring.at) - place);
  const double force = stiffness * math::norm(away + across(moved));
  spring.side_stiffness = force > strength ? stiffness * strength / force : stiffness;
  spring.pull = (across(slide) - away) * spring.side_stiffness;
  double stretched = each.now - each.stuck;
  if (stiffness * std::abs(stretched) > friction) {
    stretched = std::copysign(friction / stiffness, stretched);
    each.stuck = each.now - stretched;
  }
  const double rubbing = stiffness * std::abs(stretched + math::dot(along, moved));
  spring.normal_stiffness = rubbing > friction ? stiffness * friction / rubbing : stiffness;
  spring.pull += along * ((math::dot(along, slide) - stretched) * spring.normal_stiffness);
  each.needle = place;
  each.spring = in.tissue.springs.size();
  each.has_spring = true;
  add_spring(in, spring);
}

void tear_out(const Placed& in) {
  NeedleData& needle = in.needle;
  const auto torn = [&](const Puncture& each) {
    if (each.at.tissue != &in.tissue) return false;
    const Vec3 place = in.place(each.now), along = in.tangent(each.now), off = detail::now(each.at) - place;
    return in.stiffness(place) * math::norm(off - along * math::dot(along, off)) > needle.options.strength;
  };
  const bool newest = !needle.punctures.empty() && torn(needle.punctures.back());
  std::erase_if(needle.punctures, torn);
  if (needle.tip == TipState::inside && (newest || needle.punctures.empty())) needle.forget_tip();
}

}  // namespace

TissuePoint point_of(const TissuePlace& at) {
  if (at.tissue->is_sheet()) return point_of(*at.tissue, from_rest(*at.tissue, at.element, at.rest));
  return point_of(*at.tissue, at.element,
                  weights_in(shape_of(*at.tissue, at.tissue->grid.corners, at.element), at.rest));
}

Vec3 now(const TissuePlace& at) { return at.tissue->solid.at(point_of(at)); }

bool is_near_needle(const TissueData& tissue, const NeedleData& needle) {
  if (needle.tip_at.tissue == &tissue) return true;
  for (const Puncture& each : needle.punctures)
    if (each.at.tissue == &tissue) return true;
  const math::Pose T = needle.holder->owner.pose();
  btVector3 low(SIMD_INFINITY, SIMD_INFINITY, SIMD_INFINITY), high = -low;
  for (const Vec3& corner : needle.corner) {
    low.setMin(to_bullet(T * corner));
    high.setMax(to_bullet(T * corner));
  }
  return TestAabbAgainstAabb2(low, high, tissue.low, tissue.high);
}

void add_needle(TissueData& tissue, NeedleData& needle, double h) {
  BodyData& body = *needle.holder;
  const Placed in{tissue,
                  needle,
                  body,
                  body.owner.pose(),
                  body.rigid.getWorldTransform().getOrigin(),
                  h,
                  needle.punctures.size() + 1};
  needle.first_spring = tissue.springs.size();
  slide(in);
  tear_out(in);
  if (needle.tip == TipState::outside || needle.tip == TipState::unknown) look(in);
  if (needle.tip_at.tissue == &tissue) press(in);
  for (std::size_t i = 0; i < needle.punctures.size(); ++i) {
    Puncture& each = needle.punctures[i];
    if (each.at.tissue != &tissue) continue;
    each.has_spring = false;
    if (has_room(tissue)) hold(in, each, needle.options.friction * share_of(needle, i));
  }
  needle.last_spring = tissue.springs.size();
}

void sum_force(const TissueData& tissue, NeedleData& needle) {
  for (std::size_t i = needle.first_spring; i < needle.last_spring; ++i) needle.force_world += tissue.spring_force[i];
  for (Puncture& each : needle.punctures)
    if (each.at.tissue == &tissue) each.force_world = each.has_spring ? tissue.spring_force[each.spring] : Vec3{};
}

}  // namespace ambf::physics::detail
