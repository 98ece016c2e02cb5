// What ambf_file_reader makes of a URDF text: plain data with lines, sent over a pipe. It comes from a process that has
// parsed a stranger's file: nothing is believed before check() has passed. SI units; poses in the parent frame of URDF.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "base/wire.h"
#include "math/types.h"

namespace ambf::adf::urdf {

enum class ShapeKind : std::uint8_t { none, box, sphere, cylinder, mesh };

struct Shape {
  ShapeKind kind = ShapeKind::none;
  math::Vec3 size;  // box: lengths; sphere: radius in x; cylinder: radius in x, length in z; mesh: scale
  std::string file, texture;
  math::Pose origin;
  std::array<float, 4> rgba{};
  bool colored = false;
  std::int32_t line = 0;
};

struct Link {
  std::string name;
  std::int32_t line = 0;
  bool has_inertial = false;
  double mass = 0.0;
  math::Pose inertial;              // frame of the tensor, its origin the centre of mass
  std::array<double, 6> inertia{};  // xx, xy, xz, yy, yz, zz
  std::vector<Shape> visuals, collisions;
};

enum class JointKind : std::uint8_t { unknown, revolute, continuous, prismatic, floating, planar, fixed };

struct Joint {
  std::string name, parent, child;
  std::int32_t line = 0;
  JointKind kind = JointKind::unknown;
  math::Pose origin;
  math::Vec3 axis{1.0, 0.0, 0.0};
  bool has_limits = false, has_mimic = false;
  double lower = 0.0, upper = 0.0, effort = 0.0, damping = 0.0;
  std::string mimic_joint;
  double mimic_multiplier = 1.0, mimic_offset = 0.0;
};

// What the file says and no simulation of ours uses, by kind.
struct Unused {
  std::string what;
  std::int32_t count = 0, line = 0;  // of the first
};

struct Robot {
  std::string error;  // empty: the rest is valid
  std::int32_t error_line = 0, error_column = 0;
  std::string name, root;
  std::vector<Link> links;
  std::vector<Joint> joints;
  std::vector<Unused> unused;
};

template <typename Wire>
void transfer_shapes(Wire& wire, std::vector<Shape>& shapes) {
  wire.list(shapes, [&wire](Shape& s) {
    wire.value(s.kind);
    wire.value(s.size);
    wire.text(s.file);
    wire.text(s.texture);
    wire.value(s.origin);
    wire.value(s.rgba);
    wire.flag(s.colored);
    wire.value(s.line);
  });
}

template <typename Wire>
void transfer(Wire& wire, Robot& robot) {
  wire.text(robot.error);
  wire.value(robot.error_line);
  wire.value(robot.error_column);
  wire.text(robot.name);
  wire.text(robot.root);
  wire.list(robot.links, [&wire](Link& l) {
    wire.text(l.name);
    wire.value(l.line);
    wire.flag(l.has_inertial);
    wire.value(l.mass);
    wire.value(l.inertial);
    wire.value(l.inertia);
    transfer_shapes(wire, l.visuals);
    transfer_shapes(wire, l.collisions);
  });
  wire.list(robot.joints, [&wire](Joint& j) {
    for (std::string* text : {&j.name, &j.parent, &j.child, &j.mimic_joint}) wire.text(*text);
    wire.value(j.line);
    wire.value(j.kind);
    wire.value(j.origin);
    wire.value(j.axis);
    wire.flag(j.has_limits);
    wire.flag(j.has_mimic);
    for (double* number : {&j.lower, &j.upper, &j.effort, &j.damping, &j.mimic_multiplier, &j.mimic_offset})
      wire.value(*number);
  });
  wire.list(robot.unused, [&wire](Unused& u) {
    wire.text(u.what);
    wire.value(u.count);
    wire.value(u.line);
  });
}

// Empty, or what is wrong with the answer as it came: kinds, finiteness, names, and that joints make one tree of the
// links, whose root is `root`.
std::string check(Robot& robot);

}  // namespace ambf::adf::urdf
