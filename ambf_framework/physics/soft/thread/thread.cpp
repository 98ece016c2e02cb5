#include "physics/thread.h"

#include <algorithm>
#include <cmath>

#include "physics/detail/body_data.h"
#include "physics/needle.h"
#include "physics/soft/detail/thread_data.h"
#include "physics/soft/held_nodes.h"

namespace ambf::physics {

using detail::ThreadData;
using detail::to_bullet;
using math::Vec3;

namespace {

// N/m for each m of thread that lies on something: 20 N on a round edge of 1 mm press it in by less than 0.3 mm.
constexpr double kContactStiffness = 5e7;
// An attached node by a contact of as much thread (m).
constexpr double kAttachedLength = 0.002;
constexpr std::size_t kRoomForGrips = 4;    // more allocate when they hold
constexpr std::size_t kRoomForNeedles = 2;  // that draw it at once
constexpr double kFreeNear = 4.0;           // radii from an attached node within which its body is not met

struct Centre {
  double mass = 0.0;
  Vec3 place{};
};

Centre centre_of(const detail::ThreadChain& chain, bool with_fixed) {
  Centre centre;
  for (std::size_t i = 0; i < chain.node_count(); ++i) {
    if (chain.fixed(i) && !with_fixed) continue;
    centre.mass += chain.masses()[i];
    centre.place += chain.positions()[i] * chain.masses()[i];
  }
  if (centre.mass > 0.0) centre.place = centre.place / centre.mass;
  return centre;
}

}  // namespace

namespace detail {

ThreadData::ThreadData(const ThreadDefinition& given, const SoftBody& owned_by)
    : owner(&owned_by),
      chain(given),
      rest(given.nodes),
      T_world_loaded(given.T_world_body),
      radius(given.material.radius),
      margin(given.material.radius + given.margin),
      friction(given.material.friction),
      fixed(given.fixed),
      collision_groups(given.collision_groups),
      node_stiffness(kContactStiffness * kAttachedLength),
      touches_itself(given.touches_itself),
      touches_others(given.touches_others) {
  const std::vector<double>& lengths = chain.lengths();
  const auto segments = static_cast<std::uint32_t>(lengths.size());
  for (std::uint32_t i = 0; i <= segments; ++i) {
    const double around = (i > 0 ? lengths[i - 1] : 0.0) + (i < segments ? lengths[i] : 0.0);
    contact_stiffness.push_back(kContactStiffness * around / 2.0);
  }
  along.push_back(0.0);
  for (std::uint32_t i = 0; i < segments; ++i) {
    rest_length += lengths[i];
    along.push_back(rest_length);
    longest = std::max(longest, lengths[i]);
    faces.push_back({i, i + 1, i + 1});
    contact_stiffness.push_back(kContactStiffness * lengths[i]);
  }
  std::size_t hanging = 1;
  for (const std::vector<std::uint32_t>& nodes : given.attached) {
    attachments.push_back({nodes, nullptr, std::vector<btVector3>(nodes.size())});
    hanging += nodes.size();
  }
  attachments.push_back({{0}, nullptr, {btVector3(0, 0, 0)}});
  last_good = chain.positions();
  holds.resize(contact_stiffness.size());
  at.resize(rest.size());
  found.reserve(holds.size());
  pulls.reserve(kHolds * holds.size() + hanging + kRoomForGrips * SoftGrip::kMaxNodes + Thread::kMaxSprings +
                kRoomForNeedles * Needle::kMaxStitches);
  pulled.reserve(pulls.capacity());
  pulled_hold.reserve(pulls.capacity());
  pull_force.reserve(pulls.capacity());
  asked.reserve(Thread::kMaxSprings);
  answered.reserve(Thread::kMaxSprings);
  grips.reserve(kRoomForGrips);
  near_faces.reserve(faces.size());
  for (std::uint32_t i = 0; (touches_itself || touches_others) && i < segments; i += kBlock)
    blocks.push_back({i, std::min(i + kBlock, segments), {}, 0.0});
  locate();
}

void ThreadData::restart() {
  for (auto& each : holds) each.fill({});
  chain.forget_tension();
  chain.forget_forces();
  asked.clear();
  answered.clear();
  carried = false;
  crossings = 0;
  crossings_left_out = false;
  ++restarts;
  ++moves;
}

void ThreadData::forget(const BodyData& body) {
  for (auto& each : holds)
    for (ThreadHold& hold : each)
      if (hold.body == &body) hold.body = nullptr;
  for (ThreadAttachment& attachment : attachments)
    if (attachment.body == &body.owner) attachment.body = nullptr;
  pulls.clear();
  pulled.clear();
  pulled_hold.clear();
  pull_force.clear();
}

void ThreadData::place_attachment(ThreadAttachment& attachment) {
  if (attachment.body == nullptr) return;
  const math::Pose T_com_body = math::inverse(attachment.body->initial_com_pose());
  for (std::size_t i = 0; i < attachment.nodes.size(); ++i)
    attachment.places[i] = to_bullet(T_com_body * (T_world_loaded * rest[attachment.nodes[i]]));
}

void ThreadData::move_fixed(double h) {
  for (const std::uint32_t node : fixed) {
    Vec3 speed{};
    if (carried) {
      speed = (carried_to * rest[node] - chain.positions()[node]) / h;
      const double size = math::norm(speed);
      if (size > max_carried_speed) speed = speed * (max_carried_speed / size);
    }
    chain.set_velocity(node, speed);
  }
  carried = false;
}

void ThreadData::locate() {
  low = btVector3(SIMD_INFINITY, SIMD_INFINITY, SIMD_INFINITY);
  high = -low;
  for (std::size_t i = 0; i < at.size(); ++i) {
    at[i] = to_bullet(chain.positions()[i]);
    low.setMin(at[i]);
    high.setMax(at[i]);
  }
  low -= btVector3(margin, margin, margin);
  high += btVector3(margin, margin, margin);
}

void ThreadData::find_bounds() {
  if (bounded == moves) return;
  bounded = moves;
  locate();
  node_low = low;
  node_high = high;
}

bool ThreadData::hangs_on(const ThreadPoint& point, const BodyData& body) const {
  for (const ThreadAttachment& attachment : attachments) {
    if (attachment.body != &body.owner) continue;
    for (const std::uint32_t node : attachment.nodes) {
      const double apart = point.segment + point.share - node;
      if (std::abs(apart) <= 1.0 || std::abs(apart) * chain.lengths()[point.segment] <= kFreeNear * radius) return true;
    }
  }
  return false;
}

}  // namespace detail

Thread::Thread(const ThreadDefinition& definition) : thread_(std::make_unique<ThreadData>(definition, *this)) {}
Thread::~Thread() { detail::let_go(*this); }

std::size_t Thread::node_count() const { return thread_->chain.node_count(); }
std::size_t Thread::link_count() const { return thread_->faces.size(); }
const std::vector<std::array<std::uint32_t, 3>>& Thread::faces() const { return thread_->faces; }
double Thread::mass() const { return centre_of(thread_->chain, false).mass; }
Vec3 Thread::position(std::size_t node) const { return thread_->chain.positions()[node]; }
Vec3 Thread::velocity(std::size_t node) const { return thread_->chain.velocities()[node]; }
bool Thread::fixed(std::size_t node) const { return thread_->chain.fixed(node); }
bool Thread::has_fixed() const { return !thread_->fixed.empty(); }

math::Pose Thread::centre() const {
  return {centre_of(thread_->chain, true).place, thread_->T_world_loaded.orientation};
}

void Thread::apply_force(std::size_t node, const Vec3& force) { thread_->chain.add_force(node, force); }

// Each node gets the force that gives it the acceleration of a rigid body; of a straight one none about its line.
void Thread::apply_wrench(const math::Wrench& wrench) {
  detail::ThreadChain& chain = thread_->chain;
  const Centre centre = centre_of(chain, false);
  if (!(centre.mass > 0.0)) return;
  btMatrix3x3 inertia(0, 0, 0, 0, 0, 0, 0, 0, 0);
  double size = 0.0;
  for (std::size_t i = 0; i < chain.node_count(); ++i) {
    if (chain.fixed(i)) continue;
    const btVector3 r = to_bullet(chain.positions()[i] - centre.place);
    size += r.length2() * chain.masses()[i];
    for (int row = 0; row < 3; ++row) {
      inertia[row] -= r * (r[row] * chain.masses()[i]);
      inertia[row][row] += r.length2() * chain.masses()[i];
    }
  }
  Vec3 turning{};
  if (size > 0.0) {
    for (int row = 0; row < 3; ++row) inertia[row][row] += 1e-9 * size;
    turning = detail::from_bullet(inertia.inverse() * to_bullet(wrench.torque));
  }
  for (std::size_t i = 0; i < chain.node_count(); ++i) {
    if (chain.fixed(i)) continue;
    const Vec3 pull = wrench.force / centre.mass + math::cross(turning, chain.positions()[i] - centre.place);
    chain.add_force(i, pull * chain.masses()[i]);
  }
}

void Thread::carry_fixed(const math::Pose& T_world_body, double max_speed) {
  thread_->carried = true;
  thread_->carried_to = T_world_body;
  thread_->max_carried_speed = max_speed;
}

void Thread::reset() {
  detail::let_go(*this);
  for (std::size_t i = 0; i < node_count(); ++i)
    thread_->chain.put(i, thread_->T_world_loaded * thread_->rest[i], Vec3{});
  thread_->frozen = false;
  thread_->restart();
}

std::size_t Thread::state_size() const { return 6 * node_count(); }

void Thread::get_state(std::vector<double>& out) const {
  out.clear();
  for (std::size_t i = 0; i < node_count(); ++i)
    for (const Vec3& v : {position(i), velocity(i)})
      for (const double value : {v.x, v.y, v.z}) out.push_back(value);
}

bool Thread::set_state(std::span<const double> state) {
  if (state.size() != state_size()) return false;
  for (std::size_t i = 0; i < node_count(); ++i) {
    const double* value = &state[6 * i];
    thread_->chain.put(i, {value[0], value[1], value[2]}, {value[3], value[4], value[5]});
  }
  thread_->last_good = thread_->chain.positions();
  thread_->frozen = false;
  thread_->restart();
  return true;
}

std::optional<SoftDivergence> Thread::divergence(const SpeedLimits& limits) const {
  if (thread_->frozen) return std::nullopt;
  for (std::size_t i = 0; i < node_count(); ++i) {
    const double speed = math::norm(velocity(i));
    if (!(speed <= limits.linear && math::is_finite(position(i)))) return SoftDivergence{this, i, speed};
  }
  return std::nullopt;
}

void Thread::freeze() {
  detail::let_go(*this);
  for (std::size_t i = 0; i < node_count(); ++i) thread_->chain.put(i, thread_->last_good[i], Vec3{});
  thread_->restart();
  thread_->frozen = true;
}
bool Thread::frozen() const { return thread_->frozen; }

void Thread::attach(std::size_t group, Body* body) {
  thread_->attachments[group].body = body;
  thread_->place_attachment(thread_->attachments[group]);
}
std::size_t Thread::attached_groups() const { return thread_->attachments.size() - 1; }

void Thread::attach_first(Body* body, const Vec3& place) {
  detail::ThreadAttachment& first = thread_->attachments.back();
  first.body = body;
  first.places[0] = to_bullet(place);
  thread_->needle = nullptr;
}

double Thread::rest_length() const { return thread_->rest_length; }
double Thread::radius() const { return thread_->radius; }

double Thread::length() const {
  double sum = 0.0;
  for (std::size_t i = 0; i + 1 < node_count(); ++i) sum += math::norm(position(i + 1) - position(i));
  return sum;
}

Vec3 Thread::position_at(double s) const { return thread_->chain.at(thread_->chain.point_at(s)); }
Vec3 Thread::velocity_at(double s) const { return thread_->chain.velocity(thread_->chain.point_at(s)); }
Vec3 Thread::tangent_at(double s) const { return thread_->chain.tangent(thread_->chain.point_at(s).segment); }
double Thread::tension_at(double s) const { return thread_->chain.tension(thread_->chain.point_at(s).segment); }

void Thread::apply_force_at(double s, const Vec3& force) {
  const detail::ThreadPoint point = thread_->chain.point_at(s);
  thread_->chain.add_force(point.segment, force * (1.0 - point.share));
  thread_->chain.add_force(point.segment + 1, force * point.share);
}

std::size_t Thread::add_spring(const ThreadSpring& spring) {
  if (thread_->asked.size() == kMaxSprings || thread_->frozen) return kMaxSprings;
  thread_->asked.push_back(spring);
  return thread_->asked.size() - 1;
}

Vec3 Thread::spring_force(std::size_t number) const {
  return number < thread_->answered.size() ? thread_->answered[number] : Vec3{};
}

std::size_t Thread::contacts() const { return thread_->contacts; }
std::size_t Thread::crossings() const { return thread_->crossings; }
bool Thread::crossings_left_out() const { return thread_->crossings_left_out; }

Vec3 Thread::force_on(const Body& body) const {
  Vec3 sum{};
  for (std::size_t i = 0; i < thread_->pull_force.size(); ++i)
    if (thread_->pulled[i] == &body.data()) sum -= thread_->pull_force[i];
  return sum;
}

Vec3 Thread::momentum() const {
  Vec3 sum{};
  for (std::size_t i = 0; i < node_count(); ++i) sum += velocity(i) * thread_->chain.masses()[i];
  return sum;
}

Vec3 Thread::angular_momentum() const {
  const Vec3 centre = centre_of(thread_->chain, true).place;
  Vec3 sum{};
  for (std::size_t i = 0; i < node_count(); ++i)
    sum += math::cross(position(i) - centre, velocity(i) * thread_->chain.masses()[i]);
  return sum;
}

}  // namespace ambf::physics
