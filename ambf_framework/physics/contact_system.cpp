#include "physics/contact_system.h"

#include <algorithm>
#include <cmath>

namespace ambf::physics {
namespace {

// Summed as three independent chains: the sweep waits for this number.
inline double dot3(const double* a, const double* b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

inline double relative_velocity(const ContactRow& row, int body_a, int body_b, const BodyDelta* bodies) {
  double velocity = 0.0;
  if (body_a >= 0) {
    const BodyDelta& a = bodies[body_a];
    velocity = dot3(row.axis, a.linear) + dot3(row.angular_a, a.angular);
  }
  if (body_b >= 0) {
    const BodyDelta& b = bodies[body_b];
    velocity += dot3(row.angular_b, b.angular) - dot3(row.axis, b.linear);
  }
  return velocity;
}

inline void add_impulse(const ContactRow& row, double impulse, int body_a, int body_b, BodyDelta* bodies) {
  if (body_a >= 0) {
    BodyDelta& a = bodies[body_a];
    for (int i = 0; i < 3; ++i) {
      a.linear[i] += row.axis[i] * a.inverse_mass[i] * impulse;
      a.angular[i] += row.response_a[i] * impulse;
    }
  }
  if (body_b >= 0) {
    BodyDelta& b = bodies[body_b];
    for (int i = 0; i < 3; ++i) {
      b.linear[i] -= row.axis[i] * b.inverse_mass[i] * impulse;
      b.angular[i] += row.response_b[i] * impulse;
    }
  }
}

// The impulse that would meet the row's target were it alone.
inline double wanted_change(const ContactRow& row, int body_a, int body_b, const BodyDelta* bodies) {
  return row.target - row.impulse * row.softness -
         relative_velocity(row, body_a, body_b, bodies) * row.inverse_diagonal;
}

inline double squared_error(double change, double inverse_diagonal) {
  const double error = inverse_diagonal > 0.0 ? change / inverse_diagonal : 0.0;
  return error * error;
}

}  // namespace

void ContactSystem::clear() {
  normals_.clear();
  frictions_.clear();
  rollings_.clear();
}

void ContactSystem::apply(const ContactRow& row, double impulse, int body_a, int body_b, BodyDelta* bodies) {
  add_impulse(row, impulse, body_a, body_b, bodies);
}

double ContactSystem::sweep(BodyDelta* bodies) {
  double largest = 0.0;
  for (NormalRow& row : normals_) {
    const double wanted = row.impulse + wanted_change(row, row.body_a, row.body_b, bodies);
    const double allowed = wanted > 0.0 ? wanted : 0.0;
    const double change = allowed - row.impulse;
    row.impulse = allowed;
    add_impulse(row, change, row.body_a, row.body_b, bodies);
    largest = std::max(largest, squared_error(change, row.inverse_diagonal));
  }
  for (FrictionRows& rows : frictions_) {
    const double limit = rows.coefficient * normals_[static_cast<std::size_t>(rows.normal)].impulse;
    // A point without pressure has no friction; one that never had any costs nothing.
    if (limit <= 0.0 && rows.direction[0].impulse == 0.0 && rows.direction[1].impulse == 0.0) continue;
    ContactRow& first = rows.direction[0];
    ContactRow& second = rows.direction[1];
    const double old_first = first.impulse;
    first.impulse += wanted_change(first, rows.body_a, rows.body_b, bodies);
    add_impulse(first, first.impulse - old_first, rows.body_a, rows.body_b, bodies);
    const double old_second = second.impulse;
    if (rows.count > 1) second.impulse += wanted_change(second, rows.body_a, rows.body_b, bodies);
    double give_back = 0.0;  // of the first direction, so that both lie within the circle
    const double length_squared = first.impulse * first.impulse + second.impulse * second.impulse;
    if (length_squared > limit * limit) {
      const double scale = limit > 0.0 ? limit / std::sqrt(length_squared) : 0.0;
      give_back = first.impulse * (scale - 1.0);
      first.impulse *= scale;
      second.impulse *= scale;
    }
    if (give_back != 0.0) add_impulse(first, give_back, rows.body_a, rows.body_b, bodies);
    if (rows.count > 1) add_impulse(second, second.impulse - old_second, rows.body_a, rows.body_b, bodies);
    largest = std::max(largest, std::max(squared_error(first.impulse - old_first, first.inverse_diagonal),
                                         squared_error(second.impulse - old_second, second.inverse_diagonal)));
  }
  for (RollingRow& row : rollings_) {
    const double pressure = normals_[static_cast<std::size_t>(row.normal)].impulse;
    if (pressure <= 0.0 && row.impulse == 0.0) continue;
    const double limit = std::min(row.coefficient * pressure, row.coefficient);
    const double wanted = row.impulse + wanted_change(row, row.body_a, row.body_b, bodies);
    const double allowed = std::max(-limit, std::min(limit, wanted));
    const double change = allowed - row.impulse;
    row.impulse = allowed;
    add_impulse(row, change, row.body_a, row.body_b, bodies);
    largest = std::max(largest, squared_error(change, row.inverse_diagonal));
  }
  return largest;
}

}  // namespace ambf::physics
