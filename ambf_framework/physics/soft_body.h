// Soft bodies as Bullet's btSoftBody has them: nodes with mass, links between them solved by position, `config` as in
// AMBF 2.0 (docs/soft_bodies.md). Links, solver and the effect of each setting are Bullet's. Nodes meet rigid bodies by
// exact distances, planes and triangle meshes included, where Bullet interpolates on a grid of 25 cm; and what they do
// to rigid bodies is a force of the coming step, so that joints hold against it. A SoftBody is made off the physics
// thread; once in a world only the physics thread may call anything here. SI units, world axes.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "math/types.h"
#include "physics/world.h"
#include "scene/soft_body.h"

namespace ambf::physics {

namespace detail {
struct SoftData;
struct ThreadData;
struct TissueData;
}  // namespace detail

// Nodes that differ from the rest; where parts overlap, factors multiply.
struct SoftPart {
  std::vector<std::uint32_t> nodes;
  double density = 1.0;    // times the mass of the others: of all nodes it stays as given
  double stiffness = 1.0;  // times kLST, at most 1 together, of links between nodes of the part
};

struct SoftDefinition {
  std::vector<math::Vec3> nodes;                        // m, body frame; no two at one place
  std::vector<std::array<std::uint32_t, 3>> triangles;  // of nodes; each edge becomes a link
  std::vector<std::array<std::uint32_t, 2>> lines;      // further links
  math::Pose T_world_body;
  double mass = 1.0;                 // kg, > 0, spread evenly over all nodes
  double margin = 0.001;             // m, how far from a surface nodes stay
  scene::SoftConfig config;          // fixed_nodes are not read
  std::vector<std::uint32_t> fixed;  // nodes
  std::vector<SoftPart> parts;
  std::size_t attached_grips = 0;  // grips that hold it from the first step on; more allocate when they hold
  bool randomize_constraints = false;
  std::vector<int> collision_groups;  // as BodyDefinition has them
};

class SoftBody;

// The first node of a body whose state is not finite or too fast.
struct SoftDivergence {
  const SoftBody* body = nullptr;
  std::size_t node = 0;
  double speed = 0.0;  // m/s; may be NaN
};

class SoftBody {
 public:
  static constexpr std::size_t kMaxTissuePoints = 512;  // points of tissue that touch its triangles at once

  explicit SoftBody(const SoftDefinition& definition);
  virtual ~SoftBody();  // has left its world
  SoftBody(const SoftBody&) = delete;
  SoftBody& operator=(const SoftBody&) = delete;

  virtual std::size_t node_count() const;
  virtual std::size_t link_count() const;                                  // bending links included
  virtual const std::vector<std::array<std::uint32_t, 3>>& faces() const;  // nodes, as SoftDefinition has them
  virtual double mass() const;                                             // kg, of the nodes that are not fixed
  virtual math::Vec3 position(std::size_t node) const;
  virtual math::Vec3 velocity(std::size_t node) const;
  virtual bool fixed(std::size_t node) const;
  virtual bool has_fixed() const;
  // The centre of all nodes' masses as loaded, and how the body has turned since then: the rotation that fits its nodes
  // best, in the body frame's axes.
  virtual math::Pose centre() const;

  // Act in the next step, and add up. A wrench at the centre acts on all nodes as it would on a rigid body.
  virtual void apply_force(std::size_t node, const math::Vec3& force);
  virtual void apply_wrench(const math::Wrench& wrench);
  // The fixed nodes go, in the next step, where this pose of the body puts them, at most `max_speed` m/s fast.
  virtual void carry_fixed(const math::Pose& T_world_body, double max_speed);

  // As loaded.
  virtual void reset();
  // All that its next steps depend on: here positions and velocities of all nodes, three numbers each. What follows
  // set_state() is, bit for bit, what followed World::save_state() when the state was the same: both renew what grows
  // with history. False, and nothing changes: it is of another number of nodes.
  virtual void get_state(std::vector<double>& out) const;
  virtual bool set_state(std::span<const double> state);
  virtual std::size_t state_size() const;  // how many numbers that are

  virtual std::optional<SoftDivergence> divergence(const SpeedLimits& limits = {}) const;
  // A frozen body stays where the last good step left its nodes, meets nothing and is not stepped, until reset() or
  // set_state().
  virtual void freeze();
  virtual bool frozen() const;
  // It lay still for half a second, or as long as its trembling hides a creep, and nothing near it has changed since:
  // its steps are left out (WorldOptions::sleeping). Threads never do.
  bool asleep() const;

  // For the owner; not used here.
  void set_user_index(std::uint32_t index);
  std::uint32_t user_index() const;

  // One of three: Bullet's links, tissue of our own (physics/tissue.h), or a thread (physics/thread.h).
  bool is_of_links() const { return data_ != nullptr; }
  bool is_tissue() const { return tissue() != nullptr; }
  bool is_thread() const { return thread() != nullptr; }
  detail::SoftData& data() const { return *data_; }
  virtual detail::TissueData* tissue() const { return nullptr; }
  virtual detail::ThreadData* thread() const { return nullptr; }

 protected:
  SoftBody();  // of a body that is not made of Bullet's links

 private:
  std::unique_ptr<detail::SoftData> data_;  // null: it is none of Bullet's
  std::uint32_t user_index_ = 0;
};

// Order of addition is that of steps. While a world has any, World::step() begins with theirs, once all other forces of
// the step were applied: they meet rigid bodies where these are, with the velocity that the forces will give them, and
// the reactions act as forces in the same step. Bullet may allocate in it.
void add(World& world, SoftBody& body);
void remove(World& world, SoftBody& body);
std::size_t soft_body_count(const World& world);

// What a ray meets first of the soft bodies: a face, or, of a body without faces and of threads, a node within 1 % of
// its distance.
struct SoftRayHit {
  SoftBody* body = nullptr;
  int face = -1;         // of faces(); -1: a node
  std::size_t node = 0;  // where there is no face
  math::Vec3 point;      // world
  double fraction = 0.0;
};
std::optional<SoftRayHit> ray_cast_soft(const World& world, const math::Vec3& from, const math::Vec3& to);

// Freezes every soft body with a node whose state is not finite or too fast, and returns them. Allocates when there is
// any.
std::vector<SoftDivergence> freeze_diverged_soft_bodies(World& world, const SpeedLimits& limits = {});

}  // namespace ambf::physics
