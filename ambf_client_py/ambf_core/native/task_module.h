// Tasks as a Python program sees them: names of their goals, pieces and holders. With the interpreter's lock.
#pragma once

#include <nanobind/nanobind.h>

#include "state/structure.h"

namespace ambf::python {

// (name, goals, pieces, holders) of each task.
nanobind::list names_of_tasks(const state::Structure& structure);

}  // namespace ambf::python
