// What a thread does to the tissue that it is sewn through. Where it is taut it pulls its stitches together, by springs
// within the tissue's step: a corner of tissue bears too little of what is not solved with it. It slides through a
// stitch where its tensions on both sides differ by more than friction. Its own step (thread_step.cpp) only follows.
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "physics/detail/world_data.h"
#include "physics/soft/detail/needle_data.h"
#include "physics/soft/detail/tissue_places.h"
#include "physics/soft/held_nodes.h"
#include "physics/soft/soft_bodies.h"

namespace ambf::physics::detail {

using math::Vec3;

namespace {

constexpr double kApart = 1e-6;  // m, of thread, between a stitch and what holds the thread
constexpr int kSweeps = 16;      // along the thread, there and back: how far it slides in a step
constexpr double kOver = 2e-3;   // m, that its stretch in a span may be more than the way there: places at one place
constexpr double kSlid = 1e-9;   // m: less is none
constexpr double kAny = std::numeric_limits<double>::infinity();
constexpr auto kNothing = static_cast<std::size_t>(-1);

void add_holder(NeedleData& needle, const ThreadHolder& holder) {
  needle.holder_left_out = needle.holders.size() == needle.holders.capacity();
  if (needle.holder_left_out) return;
  needle.holders.push_back(holder);
  for (std::size_t i = needle.holders.size(); --i > 0 && needle.holders[i].s < needle.holders[i - 1].s;)
    std::swap(needle.holders[i], needle.holders[i - 1]);
}

ThreadHolder on_body(double s, BodyData& body, const btVector3& place_com) {
  const btTransform& pose = body.rigid.getWorldTransform();
  const btVector3 at = pose * place_com;
  const btVector3 v = body.rigid.getVelocityInLocalPoint(at - pose.getOrigin());
  return {s, from_bullet(at), from_bullet(v), &body, 0.0, kAny, nullptr};
}

void find_holders(NeedleData& needle, double h) {
  ThreadData& thread = *needle.thread;
  needle.holders.clear();
  for (const ThreadAttachment& each : thread.attachments) {
    if (each.body == nullptr || each.body->data().world == nullptr) continue;
    for (std::size_t i = 0; i < each.nodes.size(); ++i)
      add_holder(needle, on_body(thread.along[each.nodes[i]], each.body->data(), each.places[i]));
  }
  for (const std::uint32_t node : thread.fixed)
    add_holder(needle, {thread.along[node], thread.chain.positions()[node], thread.chain.velocities()[node], nullptr,
                        0.0, kAny, nullptr});
  for (SoftGripData* grip : thread.grips)
    for (HeldNode& held : grip->held) {
      if (held.body != thread.owner) continue;
      const double s = thread.along[held.node];
      ThreadHolder holder;
      if (grip->holder != nullptr)
        holder = on_body(s, *grip->holder, to_bullet(held.place));
      else
        holder.s = s, holder.world = held.place;
      const double stiffness = grip->options.hardness + grip->options.damping / h;
      if (!(stiffness > 0.0)) continue;
      holder.softness = 1.0 / stiffness;
      holder.max_force = grip->options.max_force;
      holder.held = &held;
      add_holder(needle, holder);
    }
}

void measure(const NeedleData& needle, ThreadSpan& span, double h) {
  const Vec3 from = span.front == nullptr ? span.holder->world : span.front->world;
  const Vec3 to = span.back == nullptr ? span.holder->world : span.back->world;
  const Vec3 v = (span.back == nullptr ? span.holder->velocity : span.back->velocity) -
                 (span.front == nullptr ? span.holder->velocity : span.front->velocity);
  const Vec3 way = to - from;
  span.distance = math::norm(way);
  span.normal = span.distance > 0.0 ? way / span.distance : Vec3{0, 0, 1};
  // What comes together now may be drawn apart within the step, or be where it was a step ago: a taut span would count
  // as loose in every other step. Two tissues move one after the other, and would overshoot by that.
  const bool apart = span.front != nullptr && span.back != nullptr && span.front->at.tissue != span.back->at.tissue;
  span.predicted = std::max({span.distance, math::norm(way + v * h), apart ? 0.0 : math::norm(way - v * h)});
  double softness = span.free < 0.0 ? span.distance / needle.thread->chain.stretching() : 0.0;
  double most = kAny;
  for (const Stitch* each : {span.front, span.back})
    if (each != nullptr) most = std::min(most, each->at.tissue->thread_stiffness);
  if (span.holder != nullptr) {
    softness += span.holder->softness;
    if (span.holder->body != nullptr)
      most = held_back_in_all(most, *span.holder->body, to_bullet(span.holder->world), h, 1);
  }
  span.stiffness = 1.0 / (1.0 / most + softness);
  span.link = span.front_spring = span.back_spring = kNothing;
}

// m, of thread, in a span.
double length_of(const ThreadSpan& span) {
  if (span.free >= 0.0) return span.free;
  const double from = span.front == nullptr ? span.holder->s : span.front->s;
  return (span.back == nullptr ? span.holder->s : span.back->s) - from;
}

// Along the thread, from its first node on, as the step begins.
void find_spans(NeedleData& needle, double h) {
  needle.spans.clear();
  Stitch* before = nullptr;
  const ThreadHolder* held = nullptr;  // the last one, if no stitch came after it
  auto holder = needle.holders.cbegin();
  const auto add = [&](Stitch* front, Stitch* back, const ThreadHolder* by) {
    ThreadSpan span;
    span.front = front, span.back = back, span.holder = by;
    measure(needle, span, h), needle.spans.push_back(span);
  };
  const auto pass_holders = [&](double until) {
    for (; holder != needle.holders.cend() && holder->s < until; ++holder) {
      if (before != nullptr) add(before, nullptr, &*holder);
      before = nullptr;
      held = &*holder;
    }
  };
  for (Stitch& each : needle.stitches) {
    pass_holders(each.s);
    if (before != nullptr || held != nullptr) add(before, &each, before == nullptr ? held : nullptr);
    before = &each;
    held = nullptr;
  }
  pass_holders(kAny);
}

// N: of the thread on both sides of each stitch, half of what is in tissue.
void find_friction(NeedleData& needle) {
  for (Stitch& each : needle.stitches)
    each.friction = needle.options.friction * each.at.tissue->grid.thickness;  // of solids 0
  for (std::size_t i = 1; i < needle.stitches.size(); ++i) {
    Stitch &newer = needle.stitches[i - 1], &older = needle.stitches[i];
    if (comes_out(older.kind) || goes_in(newer.kind)) continue;
    const double half = 0.5 * math::norm(older.world - newer.world) * needle.options.friction;
    newer.friction += half;
    older.friction += half;
  }
}

double max_force(const ThreadSpan& span) { return span.holder == nullptr ? kAny : span.holder->max_force; }

double tension_at(const ThreadSpan& span, double length) {
  return std::clamp(span.stiffness * (span.predicted - length), 0.0, max_force(span));
}
double tension_of(const ThreadSpan& span) { return tension_at(span, length_of(span)); }

// How much thread goes from the second span to the first until their tensions differ by no more than friction.
double slides(const ThreadSpan& to, const ThreadSpan& from, double friction) {
  const double pull = tension_of(to) - tension_of(from) - friction;
  if (!(pull > 0.0)) return 0.0;
  const double slack = std::max(0.0, length_of(from) - from.predicted), alone = pull / to.stiffness;
  // What pulls as hard as it may goes on so for a while.
  if (const double more = to.predicted - length_of(to) - max_force(to) / to.stiffness; more > 0.0)
    return std::min(more, slack + pull / from.stiffness);
  if (alone <= slack) return alone;
  return (pull + from.stiffness * slack) / (to.stiffness + from.stiffness);
}

void slide(const ThreadSpan& before, const ThreadSpan& after) {
  Stitch& stitch = *before.back;
  if (stitch.knot != 0) return;
  const double shift = slides(before, after, stitch.friction) - slides(after, before, stitch.friction);
  const double low = before.front == nullptr ? before.holder->s + kApart : before.front->s - kOver;
  const double high = after.back == nullptr ? after.holder->s - kApart : after.back->s + kOver;
  if (shift != 0.0 && low <= high) stitch.s = std::clamp(stitch.s + shift, low, high);
}

// The thread behind the last stitch bears nothing, or a holder; that before the first, likewise.
void slide_all(NeedleData& needle) {
  const double end = needle.thread->rest_length;
  ThreadSpan loose;  // of which there is no end
  loose.free = end;
  loose.stiffness = 1.0;
  const auto pair = [&](std::size_t i) {
    const ThreadSpan& before = needle.spans[i];
    if (before.back == nullptr || before.free >= 0.0) return;
    if (i + 1 < needle.spans.size() && needle.spans[i + 1].free < 0.0) {
      slide(before, needle.spans[i + 1]);
    } else if (before.back->knot == 0) {
      before.back->s += slides(before, loose, before.back->friction);
    }
  };
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    for (std::size_t i = needle.spans.size(); i-- > 0;) pair(i);
    for (std::size_t i = 0; i < needle.spans.size(); ++i) pair(i);
  }
}

void find_loops(NeedleData& needle, double h) {
  for (const Knot& knot : needle.knots) {
    const auto is_in = [&](const Stitch& each) { return each.knot == knot.number; };
    const auto first = std::find_if(needle.stitches.begin(), needle.stitches.end(), is_in);
    const auto last = std::find_if(needle.stitches.rbegin(), needle.stitches.rend(), is_in);
    if (first == needle.stitches.end() || &*first == &*last) continue;
    ThreadSpan span;
    span.front = &*first, span.back = &*last;
    span.free = knot.length;
    measure(needle, span, h);
    needle.spans.push_back(span);
  }
}

// The spring of a span: as it is stretched, or, where the thread will slide, one that bears what is left then. A full
// one would hold on to the velocity that the tissue had. Places that are at one place pull no more at each other.
void choose_spring(ThreadSpan& span) {
  const double before = std::max(span.before, 0.0), stretched = span.predicted - before;
  const double tension =
      std::min(tension_at(span, span.after), span.stiffness * std::max(span.predicted, span.distance));
  const bool slid = std::abs(span.after - span.before) > kSlid || tension == max_force(span);
  span.along = span.stiffness;
  span.pull = span.stiffness * (span.distance - before);
  if (!(tension > 0.0)) span.along = span.pull = 0.0;
  if (slid && tension > 0.0) {
    const double least = tension / span.stiffness;
    const double longer = span.predicted - span.distance;
    span.along = tension / std::max({least, stretched, least + longer});
    span.pull = tension - span.along * longer;
  }
  span.across = span.distance > 0.0 ? std::min(span.stiffness, tension / span.distance) : span.along;
}

}  // namespace

void begin_stitches(NeedleData& needle, double h) {
  needle.spans.clear();
  needle.holder_left_out = needle.stitch_left_out = false;
  for (Stitch& each : needle.stitches) {
    each.point = point_of(each.at);
    each.world = each.at.tissue->solid.at(each.point);
    each.velocity = each.at.tissue->solid.velocity(each.point);
    each.force_world = {};
  }
  if (needle.thread == nullptr || needle.thread->frozen || needle.stitches.empty()) return;
  find_holders(needle, h);
  find_friction(needle);
  find_spans(needle, h);
  // As it is, then as it would be if all moved on as it does.
  for (ThreadSpan& span : needle.spans) std::swap(span.predicted, span.distance);
  slide_all(needle);
  for (ThreadSpan& span : needle.spans) std::swap(span.predicted, span.distance);
  find_loops(needle, h);
  for (ThreadSpan& span : needle.spans) span.before = length_of(span);
  for (Stitch& each : needle.stitches) each.before = each.s;
  slide_all(needle);
  for (ThreadSpan& span : needle.spans) {
    span.after = length_of(span);
    choose_spring(span);
  }
  for (Stitch& each : needle.stitches) each.s = each.before;
}

bool is_beside_stitches(const NeedleData& needle, const HeldNode& held) {
  return std::any_of(needle.spans.begin(), needle.spans.end(), [&](const ThreadSpan& span) {
    return span.holder != nullptr && span.holder->held == &held && span.along > 0.0;
  });
}

void add_stitches(TissueData& tissue, NeedleData& needle, double h) {
  for (ThreadSpan& span : needle.spans) {
    Stitch* const front = span.front != nullptr && span.front->at.tissue == &tissue ? span.front : nullptr;
    Stitch* const back = span.back != nullptr && span.back->at.tissue == &tissue ? span.back : nullptr;
    span.link = span.front_spring = span.back_spring = kNothing;
    if (front == nullptr && back == nullptr) continue;
    const bool within = front != nullptr && back != nullptr;
    Vec3 other{};  // velocity of what the tissue is pulled to
    if (span.holder != nullptr) {
      other = span.holder->velocity;
    } else if (!within) {
      // Another tissue, as it is: one after the other, the two come to agree.
      Stitch& away = front != nullptr ? *span.back : *span.front;
      if (away.at.tissue->stepped) away.world = now(away.at), away.velocity = {};
      other = away.velocity;
      measure(needle, span, h);
      choose_spring(span);
    }
    if (!(span.along > 0.0)) continue;
    const Vec3 pull = span.normal * span.pull;
    if (within) {
      if (tissue.links.size() == tissue.links.capacity()) continue;
      span.link = tissue.links.size();
      tissue.links.push_back({front->point, back->point, span.normal, pull, span.along, span.across});
      continue;
    }
    if (tissue.springs.size() == tissue.springs.capacity()) continue;
    const Stitch& own = front != nullptr ? *front : *back;
    BodyData* body = nullptr;
    if (span.holder != nullptr) body = span.holder->body;
    TissueSpring spring;
    spring.at = own.point;
    spring.normal = span.normal;
    spring.normal_stiffness = span.along;
    spring.side_stiffness = span.across;
    spring.pull = (front != nullptr ? pull : -pull) + spring.holding_back(other) * h;
    (front != nullptr ? span.front_spring : span.back_spring) = tissue.springs.size();
    tissue.springs.push_back(spring);
    tissue.pulled.push_back(body);
  }
}

void sum_stitches(TissueData& tissue, NeedleData& needle, double h) {
  for (ThreadSpan& span : needle.spans) {
    if (span.link != kNothing) {
      const Vec3 force = tissue.solid.force_of(tissue.links[span.link], h);
      span.front->force_world += force;
      span.back->force_world -= force;
    }
    for (const auto& [stitch, spring] : {std::pair{span.front, span.front_spring}, {span.back, span.back_spring}}) {
      if (spring == kNothing) continue;
      const Vec3& force = tissue.spring_force[spring];
      stitch->force_world += force;
      if (span.holder == nullptr) continue;
      if (span.holder->body != nullptr && span.holder->body == needle.holder) needle.force_world += force;
      if (span.holder->held != nullptr) span.holder->held->force_world += force;
    }
    span.link = span.front_spring = span.back_spring = kNothing;
  }
}

void end_stitches(NeedleData& needle) {
  if (needle.thread == nullptr) return;
  const double end = needle.thread->rest_length;
  for (Stitch& each : needle.stitches)
    each.lost = each.s >= end || math::norm(each.force_world) > needle.options.strength;
  needle.lose_stitches();
  while (!needle.punctures.empty() && needle.punctures.front().now > needle.length + kPassed) {
    const Puncture& passed = needle.punctures.front();
    const bool sewn = !needle.thread->frozen && needle.has_thread();
    if (sewn && needle.stitches.size() == Needle::kMaxStitches) {
      needle.stitch_left_out = true;
    } else if (sewn) {
      Stitch stitch;
      stitch.at = passed.at;
      stitch.kind = passed.kind;
      stitch.s = std::min(passed.now - needle.length, needle.stitches.empty() ? end : needle.stitches.front().s);
      stitch.node = passed.node;
      stitch.force_world = passed.force_world;
      needle.stitches.insert(needle.stitches.begin(), stitch);
    }
    needle.punctures.erase(needle.punctures.begin());
  }
  needle.spans.clear();
}

}  // namespace ambf::physics::detail
