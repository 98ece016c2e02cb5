// Rotations: conversions between quaternion, roll-pitch-yaw, axis-angle and rotation vector, and the rotation between
// two vectors (Alg. 2 of the dissertation as corrected in the design notes). Pure functions, any thread.
#pragma once

#include "math/types.h"

namespace ambf::math {

// Unit vector along v; the fallback when |v| is below 1e-12.
Vec3 normalized(const Vec3& v, const Vec3& fallback = {0.0, 0.0, 1.0});
// Unit quaternion along q; identity when |q| is below 1e-12.
Quat normalized(const Quat& q);

// Fixed-axis roll, pitch, yaw (rad): R = Rz(yaw) Ry(pitch) Rx(roll), the ADF's `orientation: {r, p, y}`.
Quat from_rpy(double roll, double pitch, double yaw);
// The inverse, with pitch in [-pi/2, pi/2] and roll = 0 at the two singular pitches. Returns {roll, pitch, yaw}.
Vec3 to_rpy(const Quat& q);

// Right-handed turn by `angle_rad` about `axis` (unit).
Quat from_axis_angle(const Vec3& axis, double angle_rad);

// Rotation vector of q, |log| in [0, pi]; and its inverse (Exp(w) = rotation by |w| about w).
Vec3 log(const Quat& q);
Quat exp(const Vec3& rotation_vector);

// Shortest rotation R with R a = b for unit vectors (Alg. 2). Antiparallel vectors turn about a x n_x, or b x n_y where
// a is along x: shipped joints depend on that choice.
Quat rotation_between(const Vec3& a, const Vec3& b);

// Row-major 3x3 rotation matrix <-> quaternion (input must be a rotation).
void to_matrix(const Quat& q, double out_row_major[9]);
Quat from_matrix(const double row_major[9]);

}  // namespace ambf::math
