// The world: bodies and joints and one fixed step. Belongs to one thread at a time (the physics thread); the Bullet
// library below is not thread-safe, so two worlds may not step at the same moment either unless they share nothing.
// Never owns bodies, joints or shapes; never reads a clock other than to measure its phases; never prints.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "math/types.h"
#include "physics/body.h"
#include "physics/grasp.h"
#include "physics/joint.h"

namespace ambf::physics {

namespace detail {
struct WorldData;
}

// direct: all joint rows of an island solved exactly together, contacts by sequential impulse around them.
enum class SolverKind { direct, si, mlcp };

struct WorldOptions {
  math::Vec3 gravity{0.0, 0.0, -9.8};  // m/s^2
  double step = 0.001;                 // s, h
  SolverKind solver = SolverKind::direct;
  int iterations = 0;           // 0: 10; sweeps end earlier once nothing is wrong by more than 1e-6 m/s
  int friction_directions = 2;  // 1: what held things creep, only for comparison
  bool sleeping = true;
  int pooled_pairs = 4096;          // pairs of shapes near each other with memory from the start (1.4 KB each)
  bool preparation_thread = false;  // starts the thread that set_real_time() needs
};

struct Contact {
  const Body* body_a = nullptr;
  const Body* body_b = nullptr;
  math::Vec3 point_on_a, point_on_b;  // world, m
  math::Vec3 normal_on_b;             // world, from b towards a
  double distance = 0.0;              // m, negative: penetration
  double normal_impulse = 0.0;        // Ns in the last step, >= 0
  math::Vec3 friction_impulse;        // Ns on a, world
};

struct RayFilter {
  const Body* ignored = nullptr;
  std::span<const Body* const> also_ignored;
  bool hit_static = true;
  // A ray that starts inside a solid hits it at once: fraction 0, normal against the ray. Else it sees nothing of
  // that body.
  bool hit_from_inside = false;
};

struct RayHit {
  const Body* body = nullptr;
  math::Vec3 point, normal;  // world
  double fraction = 0.0;     // along from -> to
  int triangle = -1;         // of a triangle mesh
};

// Mean seconds a step of the last sampled steps.
struct PhaseTimes {
  double collision = 0.0, solver = 0.0, integration = 0.0;
};

struct SpeedLimits {
  double linear = 1e4;   // m/s
  double angular = 1e4;  // rad/s
};

// A body that diverged, and the bodies that were frozen with it.
struct FrozenGroup {
  std::vector<Body*> bodies;                       // the diverged one first
  double linear_speed = 0.0, angular_speed = 0.0;  // of the diverged one, m/s and rad/s; may be NaN
};

// Which world a saved state must fit.
struct StateLayout {
  std::vector<bool> is_static;  // of each body, in order of addition
  std::size_t joints = 0;
  std::size_t grasps = 0;
  double step = 0.0;  // s
};

// What is wrong with a saved state, and of what.
struct StateFault {
  enum class Of { whole, body, joint, grasp };
  Of of = Of::whole;
  std::size_t index = 0;  // of the body, joint or grasp
  std::string message;
};

class World {
 public:
  explicit World(const WorldOptions& options = {});
  ~World();
  World(const World&) = delete;
  World& operator=(const World&) = delete;

  const WorldOptions& options() const;
  void set_gravity(const math::Vec3& gravity);  // wakes every body that follows it

  // Order of addition is the canonical order of restarts. Bodies before their joints; joints leave before their bodies.
  void add(Body& body);
  void remove(Body& body);  // wakes what rested on it
  void add(Joint& joint);
  void remove(Joint& joint);
  void add(Grasp& grasp);  // it holds nothing yet
  void remove(Grasp& grasp);
  void release_grasps();  // all of them let go
  std::size_t body_count() const;
  std::size_t joint_count() const;
  std::size_t awake_count() const;  // moving bodies that are not asleep

  // Whether the wall clock decides how many steps are made. Then what a contact needs once and takes longer than a
  // step (fine surfaces of crowded meshes) is prepared by the preparation thread, and contacts are coarser until it
  // is ready; otherwise the step prepares it, so that results do not depend on the clock (the default; always so
  // without that thread).
  void set_real_time(bool real_time);

  // Exactly one step of h. Forces applied before it act in it and are cleared by it.
  void step();
  std::uint64_t steps() const;  // since construction or restore_state(): the saved count
  PhaseTimes phase_times() const;

  // Contacts of the last step: fills `out` and returns how many there are (may be more than out.size()).
  std::size_t contacts(std::span<Contact> out) const;
  std::optional<RayHit> ray_cast(const math::Vec3& from, const math::Vec3& to, const RayFilter& filter = {}) const;

  // Spring-like pulls at points of moving bodies, each by at most the body's mass (in Ns a step, along each axis). -1
  // when base::kMaxPicks pull, and for a static body. A pull ends with its body, and by restore_state() and reset().
  int begin_pull(Body& body, const math::Vec3& point_world);
  void move_pull(int pull, const math::Vec3& target_world);
  void end_pull(int pull);
  const Body* pulled(int pull) const;        // null: it has ended
  math::Wrench pull_wrench(int pull) const;  // on the body in the last step, at its COM in world axes

  // The first body whose state is not finite or too fast; null if all is well.
  const Body* first_diverged(const SpeedLimits& limits = {}) const;
  // Freezes every diverged body with all that joints connect to it: at rest where the last step found it, and static
  // to everything else (loads rest on it, no force moves it), until release_frozen(), reset() or restore_state(). Pulls
  // on it end. Allocates when there is any.
  std::vector<FrozenGroup> freeze_diverged(const SpeedLimits& limits = {});
  // The body and all frozen bodies that joints connect to it move again, from rest. Does nothing unless it is frozen.
  void release_frozen(Body& body);
  std::size_t frozen_count() const;  // bodies

  // Steps so far in which triangle meshes were so many and so near each other that some wait more than four steps
  // between two looks at their contacts.
  std::uint64_t crowded_steps() const;
  // Where so many moving bodies are at one place that not all of their pairs are met in a step: the body that is near
  // most others, how many these are, and in how many steps so far pairs were left out.
  struct Crowd {
    const Body* body = nullptr;  // null: no such place, or the body is gone
    std::size_t near_bodies = 0;
    std::uint64_t steps = 0;
  };
  Crowd crowd() const;
  // Two bodies, one of them a moving triangle mesh, of which no others are deeper inside each other; null if none
  // touch.
  std::array<const Body*, 2> max_depth_meshes() const;

  // Saving restarts this world canonically (pairs and warm starts dropped, everything re-added in its order), and so
  // does restoring: both then continue bit for bit alike, in this or any other world of the same bodies, joints and
  // grasps in the same order. Allocates. Restoring what check_state() refuses changes nothing and returns false.
  void save_state(std::vector<std::byte>& out);
  bool restore_state(std::span<const std::byte> state);
  // Bytes from a file are trusted in nothing: another structure or version, and every value that no world of ours
  // would have saved (not finite, no rotation, no such drive, faster than first_diverged allows) is a fault. Any
  // thread.
  static std::optional<StateFault> check_state(std::span<const std::byte> state, const StateLayout& layout);
  // Everything back to its initial state, canonically.
  void reset();

  detail::WorldData& data() const { return *data_; }

 private:
  std::unique_ptr<detail::WorldData> data_;
};

// Allocations Bullet has made in this process: its own, not ours.
std::uint64_t bullet_allocation_count();

}  // namespace ambf::physics
