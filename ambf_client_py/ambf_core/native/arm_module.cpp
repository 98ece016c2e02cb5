// Known arms for Python: kinematics/arm.h on lists of numbers. ambf_core.Arm documents it.
#include "arm_module.h"

#include <nanobind/stl/array.h>
#include <nanobind/stl/map.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include <cmath>
#include <utility>

#include "adf/arms.h"

namespace nb = nanobind;

namespace ambf::python {
namespace {

using kinematics::Joints;
using PoseNumbers = std::array<double, 7>;  // position, quaternion x y z w

math::Pose pose_of(const PoseNumbers& n) { return {{n[0], n[1], n[2]}, {n[3], n[4], n[5], n[6]}}; }

PoseNumbers numbers_of(const math::Pose& pose) {
  const auto& [p, q] = pose;
  return {p.x, p.y, p.z, q.x, q.y, q.z, q.w};
}

class PythonArm {
 public:
  PythonArm(const std::string& name, const std::string& tool) : arm_(adf::known_arms().find(name, tool)) {
    if (arm_ == nullptr) {
      throw nb::key_error(("there is no arm '" + name + "'" + (tool.empty() ? "" : " with '" + tool + "'")).c_str());
    }
  }
  const kinematics::Arm& arm() const { return *arm_; }

  PoseNumbers forward(const Joints& joints) const { return numbers_of(kinematics::forward(*arm_, checked(joints))); }

  std::tuple<Joints, std::string> inverse(const PoseNumbers& pose, const Joints& seed) const {
    const kinematics::Answer answer = kinematics::inverse(*arm_, pose_of(pose), checked(seed));
    return {answer.joints, to_string(answer.status)};
  }

  // inverse(), to_adf() with a closed jaw, its values as messages carry them, and what these mean: in one call, as
  // environments make it for each action.
  std::tuple<std::vector<double>, Joints, PoseNumbers> reach(const PoseNumbers& pose, const Joints& seed) const {
    const kinematics::Answer answer = kinematics::inverse(*arm_, pose_of(pose), checked(seed));
    std::map<std::string, double> positions = kinematics::to_adf(*arm_, {answer.joints, 0.0});
    std::vector<double> values;
    for (auto& [name, value] : positions) {
      value = static_cast<float>(value);
      values.push_back(value);
    }
    const auto [joints, opening] = from_adf(positions);
    return {values, joints, forward(joints)};
  }

  std::vector<double> jacobian(const Joints& joints, bool body) const {
    using kinematics::JacobianFrame;
    return kinematics::jacobian(*arm_, checked(joints), body ? JacobianFrame::body : JacobianFrame::spatial);
  }

  std::map<std::string, double> to_adf(const Joints& joints, double opening) const {
    return kinematics::to_adf(*arm_, {checked(joints), opening});
  }

  std::tuple<Joints, double> from_adf(const std::map<std::string, double>& positions) const {
    const auto found = kinematics::from_adf(*arm_, positions);
    if (!found) throw nb::key_error("not all joints of the arm are given");
    return {found->joints, found->opening};
  }

 private:
  const Joints& checked(const Joints& joints) const {
    bool good = joints.size() == arm_->size();
    for (const double value : joints) good = good && std::isfinite(value);
    if (good) return joints;
    throw nb::value_error((arm_->name + " has " + std::to_string(arm_->size()) + " joints, all finite").c_str());
  }

  const kinematics::Arm* arm_;  // lives as long as the library
};

}  // namespace

void bind_arms(nb::module_& m) {
  nb::class_<PythonArm>(m, "Arm")
      .def(nb::init<const std::string&, const std::string&>())
      .def_prop_ro("names", [](const PythonArm& of) { return of.arm().names; })
      .def_prop_ro("tool", [](const PythonArm& of) { return of.arm().tool; })
      .def_prop_ro("lower", [](const PythonArm& of) { return of.arm().lower; })
      .def_prop_ro("upper", [](const PythonArm& of) { return of.arm().upper; })
      .def_prop_ro("home", [](const PythonArm& of) { return of.arm().home; })
      .def("forward", &PythonArm::forward)
      .def("inverse", &PythonArm::inverse)
      .def("reach", &PythonArm::reach)
      .def("jacobian", &PythonArm::jacobian)
      .def("to_adf", &PythonArm::to_adf)
      .def("from_adf", &PythonArm::from_adf);
  m.def("arm_names", [] { return adf::known_arms().names; });
}

}  // namespace ambf::python
