// What the wheels of one vehicle compute in one step: impulses of suspensions and tyres that act together, by sweeps
// over all of them. Private to physics/wheels/. Physics thread.
#pragma once

#include <cstddef>
#include <vector>

#include "physics/detail/body_data.h"
#include "physics/wheels.h"

namespace ambf::physics {

namespace detail {

// The tyre is a spring of this frequency and critical damping with its share of the chassis: on a slope of 10 degrees
// it gives way by 0.04 mm.
inline constexpr double kTyreFrequency = 200.0;  // rad/s

// What moves when impulses act: the chassis, and bodies on the ground.
struct WheelMover {
  const BodyData* body = nullptr;
  btVector3 linear{0, 0, 0}, angular{0, 0, 0};  // in the coming step

  void push(const btVector3& direction, const btVector3& change, double impulse) {
    linear += direction * (body->rigid.getInvMass() * impulse);
    angular += change * impulse;
  }
};

// One direction at one contact.
struct WheelRow {
  btVector3 direction{0, 0, 0};
  btVector3 turn{0, 0, 0}, change{0, 0, 0};                // of the chassis: lever x direction, and that by its inertia
  btVector3 turn_ground{0, 0, 0}, change_ground{0, 0, 0};  // of the body below
  double mobility = 0.0, impulse = 0.0;                    // 1/kg, Ns

  WheelRow() = default;
  WheelRow(const btVector3& along, const btVector3& lever, const WheelMover& chassis, const btVector3& point,
           const WheelMover* ground);
  double speed(const WheelMover& chassis, const WheelMover* ground) const {
    const double own = direction.dot(chassis.linear) + turn.dot(chassis.angular);
    return ground == nullptr ? own : own - direction.dot(ground->linear) - turn_ground.dot(ground->angular);
  }
};

// A spring with its damper over the coming step: impulse = -elastic - soft * speed.
struct WheelSpring {
  double elastic = 0.0, soft = 0.0;
  double leak = 0.0;  // share of its stretch that rolling takes away in the step

  // The tyre's: x is its stretch, x' = (x + h v) / (1 + leak) that at the end of the step; force k x' + d (x' - x) / h.
  static WheelSpring of_tyre(double stretch, double leak, double mass, double h);
  // That it gives where the speed without it would be `speed`.
  double impulse(double speed, double mobility) const { return -(elastic + soft * speed) / (1.0 + soft * mobility); }
};

// The stretch at the step's beginning from which the tyre would come to give this impulse at this speed.
double stretch_for(double impulse, double speed, double leak, double mass, double h);

}  // namespace detail

// The room for it is made once.
struct Wheels::Solver {
  struct Contact {
    std::size_t wheel = 0, ground = 0;  // ground: index into `grounds`; kStill: it does not give way
    detail::WheelRow normal, forward, side;
    detail::WheelSpring suspension, rolling, tyre;
    double drive = 0.0, brake = 0.0, friction = 0.0;  // Ns, Ns, of the load
    double forward_speed = 0.0, side_speed = 0.0;     // of the ground itself where it does not give way, m/s
    double normal_speed = 0.0;
    bool slips = false, brake_slips = false;
  };
  static constexpr std::size_t kStill = ~std::size_t{0};

  detail::WheelMover chassis;
  std::vector<detail::WheelMover> grounds;
  std::vector<Contact> contacts;
  double tyre_mass = 0.0;  // kg, a wheel's share of the chassis

  detail::WheelMover* ground_of(const Contact& contact) {
    return contact.ground == kStill ? nullptr : &grounds[contact.ground];
  }
  std::size_t ground(const detail::BodyData& body);  // its index; kStill: static
  // Until no speed changes noticeably any more.
  void solve();

 private:
  double set(detail::WheelRow& row, detail::WheelMover* below, double impulse);
  double sweep();
};

}  // namespace ambf::physics
