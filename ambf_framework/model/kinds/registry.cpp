#include "model/kinds/registry.h"

#include <algorithm>
#include <stdexcept>

#include "model/kinds/kind.h"
#include "model/kinds/soft_body.h"

namespace ambf::model {
namespace {

struct Table {
  std::vector<std::unique_ptr<Kind>> all;

  Table() {
    all.push_back(make_rigid_body_kind());
    all.push_back(make_joint_kind());
    all.push_back(make_camera_kind());
    all.push_back(make_light_kind());
    all.push_back(make_actuator_kind());
    all.push_back(make_sensor_kind());
    all.push_back(make_ghost_kind());
    all.push_back(make_vehicle_kind());
    all.push_back(make_soft_body_kind());
    all.push_back(make_task_kind());
    std::sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a->number() < b->number(); });
  }
};

std::vector<std::unique_ptr<Kind>>& table() {
  static Table table;
  return table.all;
}

}  // namespace

void register_kind(std::unique_ptr<Kind> kind) {
  const auto number = static_cast<std::size_t>(kind->number());
  state::require_open_registration("the model of kind " + std::to_string(number));
  if (number != table().size() + 1 || number >= state::kind_count())
    throw std::logic_error("kinds register their model right after their state, each once");
  table().push_back(std::move(kind));
}

// Numbers follow registration; the world, which is no object, has number 0.
const Kind& kind_of(state::ObjectKind number) { return *table()[static_cast<std::size_t>(number) - 1]; }

const std::vector<std::unique_ptr<Kind>>& kinds() { return table(); }

}  // namespace ambf::model
