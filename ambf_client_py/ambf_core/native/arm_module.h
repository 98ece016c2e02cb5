// The part of the module _ambf_core with the kinematics of known arms.
#pragma once

#include <nanobind/nanobind.h>

namespace ambf::python {

void bind_arms(nanobind::module_& m);

}  // namespace ambf::python
