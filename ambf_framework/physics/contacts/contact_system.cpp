#include "physics/contacts/contact_system.h"

#include <algorithm>
#include <cmath>

namespace ambf::physics {
namespace {

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

// Each returns the velocity error it met, squared.
inline double solve_normal(NormalRow& row, BodyDelta* bodies) {
  const double wanted =
      row.impulse + wanted_change(row, row.body_a, row.body_b, bodies) - row.evening * (row.impulse - row.mean);
  const double allowed = wanted > 0.0 ? wanted : 0.0;
  const double change = allowed - row.impulse;
  row.impulse = allowed;
  add_impulse(row, change, row.body_a, row.body_b, bodies);
  return squared_error(change, row.inverse_diagonal);
}

inline double solve_push(NormalRow& row, BodyDelta* moves) {
  const double velocity = relative_velocity(row, row.body_a, row.body_b, moves);
  const double wanted = row.push_impulse + row.push - row.push_impulse * row.softness - velocity * row.inverse_diagonal;
  const double allowed = wanted > 0.0 ? wanted : 0.0;
  const double change = allowed - row.push_impulse;
  row.push_impulse = allowed;
  add_impulse(row, change, row.body_a, row.body_b, moves);
  return squared_error(change, row.inverse_diagonal);
}

inline double solve_friction(FrictionRows& rows, double pressure, BodyDelta* bodies, bool& slipped) {
  ContactRow& first = rows.direction[0];
  ContactRow& second = rows.direction[1];
  // A point without pressure has no friction; one that had none costs nothing.
  if (pressure <= 0.0 && first.impulse == 0.0 && second.impulse == 0.0) return 0.0;
  const double limit = rows.coefficient * pressure;
  const bool both = rows.count > 1;
  const double change_first = wanted_change(first, rows.body_a, rows.body_b, bodies);
  const double change_second = both ? wanted_change(second, rows.body_a, rows.body_b, bodies) : 0.0;
  const double old_first = first.impulse;
  const double old_second = second.impulse;
  first.impulse += change_first;
  second.impulse += change_second - rows.coupling * change_first;  // as if the first had been applied already
  if (!(first.impulse * first.impulse + second.impulse * second.impulse <= limit * limit)) {
    slipped = true;
    // It slips. One weight for both directions, so that the force turns against the slip, and back onto the circle.
    double weight_first = 1.0;
    double weight_second = 1.0;
    if (both && first.inverse_diagonal > second.inverse_diagonal)
      weight_first = second.inverse_diagonal / first.inverse_diagonal;
    if (both && second.inverse_diagonal > first.inverse_diagonal)
      weight_second = first.inverse_diagonal / second.inverse_diagonal;
    const double slip_first = old_first + weight_first * change_first;
    const double slip_second = old_second + weight_second * change_second;
    const double length = std::sqrt(slip_first * slip_first + slip_second * slip_second);
    const double scale = length > limit ? limit / length : (length <= limit ? 1.0 : 0.0);  // 0: not a number
    first.impulse = scale > 0.0 ? slip_first * scale : 0.0;
    second.impulse = scale > 0.0 ? slip_second * scale : 0.0;
  }
  add_impulse(first, first.impulse - old_first, rows.body_a, rows.body_b, bodies);
  if (both) add_impulse(second, second.impulse - old_second, rows.body_a, rows.body_b, bodies);
  return std::max(squared_error(first.impulse - old_first, first.inverse_diagonal),
                  squared_error(second.impulse - old_second, second.inverse_diagonal));
}

inline double solve_rolling(RollingRow& row, double pressure, BodyDelta* bodies) {
  if (pressure <= 0.0 && row.impulse == 0.0) return 0.0;
  const double limit = std::min(row.coefficient * pressure, row.coefficient);
  const double wanted = row.impulse + wanted_change(row, row.body_a, row.body_b, bodies);
  const double allowed = std::max(-limit, std::min(limit, wanted));
  const double change = allowed - row.impulse;
  row.impulse = allowed;
  add_impulse(row, change, row.body_a, row.body_b, bodies);
  return squared_error(change, row.inverse_diagonal);
}

inline double pressure_of(const NormalRow& row) { return row.impulse + row.passed; }

// Calls f with 0 .. count - 1, or the other way round.
template <class F>
inline void visit(std::size_t count, bool backwards, F&& f) {
  for (std::size_t i = 0; i < count; ++i) f(backwards ? count - 1 - i : i);
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

void ContactSystem::couple(FrictionRows& rows, const BodyDelta* bodies) {
  const ContactRow& first = rows.direction[0];
  const ContactRow& second = rows.direction[1];
  double sum = 0.0;
  for (int i = 0; i < 3; ++i) {
    if (rows.body_a >= 0) {
      sum += first.axis[i] * second.axis[i] * bodies[rows.body_a].inverse_mass[i] +
             second.angular_a[i] * first.response_a[i];
    }
    if (rows.body_b >= 0) {
      sum += first.axis[i] * second.axis[i] * bodies[rows.body_b].inverse_mass[i] +
             second.angular_b[i] * first.response_b[i];
    }
  }
  rows.coupling = sum * second.inverse_diagonal;
}

void ContactSystem::even_out() {
  constexpr double kSameDirection = 0.999;
  const auto same_face = [](const NormalRow& a, const NormalRow& b) {
    return a.body_a == b.body_a && a.body_b == b.body_b && dot3(a.axis, b.axis) > kSameDirection;
  };
  for (std::size_t begin = 0, end = 0; begin < normals_.size(); begin = end) {
    double sum = normals_[begin].impulse;
    for (end = begin + 1; end < normals_.size() && same_face(normals_[begin], normals_[end]); ++end)
      sum += normals_[end].impulse;
    for (std::size_t i = begin; i < end; ++i) {
      normals_[i].mean = sum / static_cast<double>(end - begin);
      if (end - begin == 1 || normals_[i].body_a < 0 || normals_[i].body_b < 0) normals_[i].evening = 0.0;
    }
  }
}

double ContactSystem::sweep(BodyDelta* bodies, bool backwards) {
  double largest = 0.0;
  slipped_ = false;
  visit(normals_.size(), backwards,
        [&](std::size_t i) { largest = std::max(largest, solve_normal(normals_[i], bodies)); });
  visit(frictions_.size(), backwards, [&](std::size_t i) {
    const double pressure = pressure_of(normals_[frictions_[i].normal]);
    largest = std::max(largest, solve_friction(frictions_[i], pressure, bodies, slipped_));
  });
  for (RollingRow& row : rollings_) {
    largest = std::max(largest, solve_rolling(row, pressure_of(normals_[row.normal]), bodies));
  }
  return largest;
}

double ContactSystem::velocity(const NormalRow& row, const BodyDelta* bodies) {
  return relative_velocity(row, row.body_a, row.body_b, bodies);
}

double ContactSystem::shortfall(const NormalRow& row, const BodyDelta* bodies) {
  return wanted_change(row, row.body_a, row.body_b, bodies);
}

double ContactSystem::pushed(const NormalRow& row, const BodyDelta* moves) {
  return relative_velocity(row, row.body_a, row.body_b, moves) * row.inverse_diagonal;
}

double ContactSystem::sweep_pushes(BodyDelta* moves, bool backwards) {
  double largest = 0.0;
  visit(normals_.size(), backwards,
        [&](std::size_t i) { largest = std::max(largest, solve_push(normals_[i], moves)); });
  return largest;
}

}  // namespace ambf::physics
