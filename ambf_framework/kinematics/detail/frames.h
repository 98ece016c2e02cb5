// Rotations and rigid transforms as matrices, inside this folder.
#pragma once

#include <Eigen/Dense>
#include <cmath>

#include "kinematics/chain.h"

namespace ambf::kinematics {

constexpr double kPi = 3.14159265358979323846;

using Rotation = Eigen::Matrix3d;
using Vector = Eigen::Vector3d;

struct Frame {
  Rotation r = Rotation::Identity();
  Vector p = Vector::Zero();
};

inline Frame operator*(const Frame& a, const Frame& b) { return {a.r * b.r, a.r * b.p + a.p}; }
inline Frame inverse(const Frame& a) { return {a.r.transpose(), -(a.r.transpose() * a.p)}; }

inline Rotation rot_x(double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return (Rotation() << 1, 0, 0, 0, c, -s, 0, s, c).finished();
}
inline Rotation rot_y(double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return (Rotation() << c, 0, s, 0, 1, 0, -s, 0, c).finished();
}
inline Rotation rot_z(double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return (Rotation() << c, -s, 0, s, c, 0, 0, 0, 1).finished();
}

Frame to_frame(const math::Pose& pose);
math::Pose to_pose(const Frame& frame);

// Frame of every axis after its motion.
std::vector<Frame> frames(const Chain& chain, const Joints& joints);
Frame tip_frame(const Chain& chain, const Joints& joints);
// 6 x n, along the base's axes.
Eigen::MatrixXd spatial_jacobian(const Chain& chain, const Joints& joints);
// Rotation from a to b as a vector in the frame that both are expressed in.
Vector rotation_vector(const Rotation& a, const Rotation& b);
PoseDifference difference(const Frame& a, const Frame& b);

}  // namespace ambf::kinematics
