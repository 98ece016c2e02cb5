// The simulator's window on worlds of a Python program, for the module _ambf_view. It has a thread of its own, so that
// it answers while the program computes, and so that its OpenGL never meets that of pictures.
#pragma once

#include <nanobind/nanobind.h>

namespace ambf::python {

void bind_window(nanobind::module_& m);

}  // namespace ambf::python
