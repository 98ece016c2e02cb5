#include "task_module.h"

#include <nanobind/stl/string.h>

#include "state/tasks.h"

namespace ambf::python {

namespace nb = nanobind;

nb::list names_of_tasks(const state::Structure& structure) {
  nb::list tasks;
  for (const state::TaskInfo& task : state::tasks(structure)) {
    nb::list goals, pieces, holders;
    for (const state::TaskGoal& goal : task.goals) goals.append(goal.name);
    for (const state::TaskPiece& piece : task.pieces) pieces.append(piece.name);
    for (const state::TaskHolder& holder : task.holders) holders.append(holder.name);
    tasks.append(nb::make_tuple(structure.objects[task.object].name, goals, pieces, holders));
  }
  return tasks;
}

}  // namespace ambf::python
