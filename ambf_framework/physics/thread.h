// Threads: chains of nodes that hardly stretch and bend as round rods do (docs/tissue.md#threads). A Thread is a
// SoftBody beside Tissue. Each step is solved directly, in time that grows with the nodes only, whatever the stiffness.
// Made off the physics thread; once in a world only the physics thread may call anything here. SI units, world axes.
//
// Places along a thread are arc lengths: metres from its first node, as it is when it is not stretched. They are cut to
// 0 and rest_length().
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

#include "math/types.h"
#include "physics/soft_body.h"

namespace ambf::physics {

class Body;

namespace detail {
struct ThreadData;
}

struct ThreadMaterial {
  double radius = 0.0002;   // m, > 0
  double young = 1e8;       // Pa, >= 0: bends as a solid rod of this modulus, E pi r^4 / 4
  double density = 1150.0;  // kg/m^3, > 0
  double friction = 0.4;    // times the body's
  // N, by strain: E pi r^2, but no less than this, so that threads of a soft bend keep their length (0.2 % at 2 N).
  double min_stretching = 1000.0;
};

struct ThreadDefinition {
  std::vector<math::Vec3> nodes;  // m, body frame, 2 or more, no two neighbours at one place; straight when unloaded
  ThreadMaterial material;
  math::Pose T_world_body;
  double margin = 0.0;                                // m, more than the radius that nodes stay from surfaces
  std::vector<std::uint32_t> fixed;                   // nodes that only carry_fixed() moves
  std::vector<std::vector<std::uint32_t>> attached;   // groups of nodes that hang on a body each
  std::vector<int> collision_groups;                  // as BodyDefinition has them
  bool touches_itself = true, touches_others = true;  // threads; two meet where both touch others
};

// What pulls at a place of a thread in the coming step, and in no other. With x and v of that place as the step ends:
// stiffness (anchor + h anchor_velocity - x) + damping (anchor_velocity - v), of which `axes` says what counts.
// Implicit: stable for any stiffness. Who moves the anchor gets -spring_force() and has to bear it: against something
// of mass m, keep stiffness + damping / h below some m / h^2.
struct ThreadSpring {
  enum class Axes { all, across, along };  // of the tangent as the step begins

  double s = 0.0;              // m, where it pulls
  math::Vec3 anchor;           // m, world, as the step begins
  math::Vec3 anchor_velocity;  // m/s
  double stiffness = 0.0;      // N/m, >= 0
  double damping = 0.0;        // N s/m, >= 0
  Axes axes = Axes::all;
  double max_force = std::numeric_limits<double>::infinity();  // N: where the step would ask for more, it is this
};

class Thread final : public SoftBody {
 public:
  static constexpr std::size_t kMaxSprings = 64;    // in a step
  static constexpr std::size_t kMaxCrossings = 64;  // that bear at once, of threads that touch each other

  explicit Thread(const ThreadDefinition& definition);
  ~Thread() override;

  std::size_t node_count() const override;
  std::size_t link_count() const override;  // segments
  // Each segment, as a face of its two nodes of which the second counts twice: what rays meet, by the radius.
  const std::vector<std::array<std::uint32_t, 3>>& faces() const override;
  double mass() const override;
  math::Vec3 position(std::size_t node) const override;
  math::Vec3 velocity(std::size_t node) const override;
  bool fixed(std::size_t node) const override;
  bool has_fixed() const override;
  math::Pose centre() const override;  // turned as loaded: a thread has no orientation

  void apply_force(std::size_t node, const math::Vec3& force) override;
  void apply_wrench(const math::Wrench& wrench) override;  // a torque turns it as it would a rigid body
  void carry_fixed(const math::Pose& T_world_body, double max_speed) override;

  void reset() override;
  void get_state(std::vector<double>& out) const override;
  bool set_state(std::span<const double> state) override;
  std::size_t state_size() const override;
  std::optional<SoftDivergence> divergence(const SpeedLimits& limits = {}) const override;
  void freeze() override;
  bool frozen() const override;

  // The body that a group of `attached` hangs on from now on; null: none. Where both are as loaded.
  void attach(std::size_t group, Body* body);
  std::size_t attached_groups() const;
  // The first node hangs on this point (m, in the body's COM frame) from the next step on; the body feels it in the
  // same step. Null: on none. It survives resets and set_state(), and ends when the body leaves the world.
  void attach_first(Body* body, const math::Vec3& place = {});

  double rest_length() const;  // m
  double length() const;       // m, as stretched
  double radius() const;       // m
  math::Vec3 position_at(double s) const;
  math::Vec3 velocity_at(double s) const;
  math::Vec3 tangent_at(double s) const;  // unit, towards larger s
  double tension_at(double s) const;      // N, of the last step; negative: pushed together

  // Forces of the coming step. A force (N, world) is shared between the nodes of its segment.
  void apply_force_at(double s, const math::Vec3& force);
  // Its number, for spring_force(); kMaxSprings: there is no room.
  std::size_t add_spring(const ThreadSpring& spring);
  // N, world, on the thread, in the last step, by the number that add_spring() gave before it.
  math::Vec3 spring_force(std::size_t number) const;

  std::size_t contacts() const;                 // points that touched something in the last step
  std::size_t crossings() const;                // places where it touched itself or other threads in the last step
  bool crossings_left_out() const;              // there were more in the last step than there is room for
  math::Vec3 force_on(const Body& body) const;  // N: what it did to a body in the last step
  math::Vec3 momentum() const;                  // Ns
  math::Vec3 angular_momentum() const;          // Nms, about its centre

  detail::ThreadData* thread() const override { return thread_.get(); }

 private:
  std::unique_ptr<detail::ThreadData> thread_;
};

}  // namespace ambf::physics
