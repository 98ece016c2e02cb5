// Wheels below a body, the chassis: each a ray down its suspension, a spring and damper along it, and a tyre where it
// meets the ground. The law of Bullet's raycast vehicle (suspension scaled by the chassis' mass, forces where the ray
// ends, roll influence), with three differences: all forces of a step are solved together and implicitly, on the
// velocity that the step is going to have; a tyre gives way a little before it slips, so that what stands does not
// creep; the ground feels what the wheels do. docs/vehicles.md has the equations. Physics thread; act() and advance()
// allocate nothing.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "physics/rays.h"
#include "physics/world.h"

namespace ambf::physics {

// Vectors are in the chassis' COM frame.
struct Wheel {
  math::Vec3 connection;            // upper end of the suspension, m
  math::Vec3 down{0.0, 0.0, -1.0};  // unit, along the suspension
  math::Vec3 axle{0.0, -1.0, 0.0};  // unit; the wheel drives along -down x axle
  double radius = 0.0;              // m
  double rest_length = 0.0;         // m, of the suspension without load
  double stiffness = 0.0;           // 1/s^2: spring force by the chassis' mass and compression
  double compression = 0.0;         // 1/s: damping while it is compressed, by the chassis' mass
  double relaxation = 0.0;          // 1/s: while it expands
  double friction = 0.0;            // largest force across the ground by the one into it
  double roll_influence = 1.0;      // share of a sideways force's lever that rolls the chassis
};

struct WheelOrder {
  bool present = true;    // false: the wheel is not there yet
  double steering = 0.0;  // rad about -down
  double drive = 0.0;     // N, forwards
  double brake = 0.0;     // N, the largest with which it resists rolling
};
inline bool operator==(const WheelOrder& a, const WheelOrder& b) {
  return a.present == b.present && a.steering == b.steering && a.drive == b.drive && a.brake == b.brake;
}

// What a wheel keeps from step to step.
struct WheelMotion {
  double steering = 0.0;           // rad, as ordered last
  double angle = 0.0, rate = 0.0;  // rad and rad/s about its axis, positive when it rolls forwards
  // How far the tyre has given way, forwards and towards the axle's side, m.
  double stretch_forward = 0.0, stretch_side = 0.0;
};

// Where it stands, of the newest poses; the forces are those of the last step.
struct WheelContact {
  const Body* ground = nullptr;  // null: in the air
  math::Vec3 point, normal;      // world
  double length = 0.0;           // m, of the suspension
  math::Vec3 force;              // N on the chassis, world: by suspension and tyre
};

class Wheels {
 public:
  explicit Wheels(std::vector<Wheel> wheels);
  ~Wheels();

  std::size_t size() const { return wheels_.size(); }
  const Wheel& wheel(std::size_t i) const { return wheels_[i]; }
  // Before a step, with an order for each wheel: applies what acts on chassis and ground.
  void act(const World& world, Body& chassis, std::span<const WheelOrder> orders);
  // After it: where the wheels stand now, and how far they have turned.
  void advance(const World& world, const Body& chassis);
  // The same without a step: the chassis or the ground was put elsewhere.
  void look(const World& world, const Body& chassis);
  // In the chassis' COM frame: the hub's centre, axes as the chassis' where it neither steers nor has rolled.
  math::Pose T_chassis_hub(std::size_t i) const;

  const WheelContact& contact(std::size_t i) const { return contacts_[i]; }
  std::vector<WheelMotion>& motions() { return motions_; }
  const std::vector<WheelMotion>& motions() const { return motions_; }
  // The ground may be gone, or was put elsewhere by a restore. The next act() wakes the chassis.
  void forget();
  // As new: nothing rolled, nothing gave way.
  void reset();

 private:
  struct Solver;

  bool may_rest(std::span<const WheelOrder> orders, bool changed) const;
  void lay_rows(const Body& chassis, double h);
  void remember(double h);

  std::vector<Wheel> wheels_;
  std::vector<Ray> rays_;
  std::vector<BundleHit> hits_;
  RayBundle bundle_;
  std::vector<WheelOrder> orders_;  // obeyed last
  bool obeyed_ = false;             // any, since forget()
  std::vector<WheelMotion> motions_;
  std::vector<WheelContact> contacts_;
  std::vector<bool> locked_;  // the brake holds the wheel
  std::unique_ptr<Solver> solver_;
};

}  // namespace ambf::physics
