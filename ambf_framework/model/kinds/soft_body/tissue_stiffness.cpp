// How stiff tissue may be in steps of the world.
#include <algorithm>

#include "model/kinds/soft_body/detail/builder.h"

namespace ambf::model {

namespace {

// Far beyond the iterations that are made a step no longer moves it less, but throws it about: sheets from three times
// as many on, solids from several hundred times.
constexpr std::size_t kMaxWantedOfSheet = 200, kMaxWantedOfSolid = 3000;

}  // namespace

double soften(physics::TissueDefinition& definition, std::unique_ptr<physics::Tissue>& body) {
  const std::size_t allowed_iterations = body->is_sheet() ? kMaxWantedOfSheet : kMaxWantedOfSolid;
  double bound = 0.0;
  for (int i = 0; i < 8 && body->wanted_iterations() > allowed_iterations; ++i) {
    const double ratio = static_cast<double>(allowed_iterations) / static_cast<double>(body->wanted_iterations());
    double stiffest = 0.0;
    const auto find = [&](const auto& elements) {
      for (const auto& element : elements) stiffest = std::max(stiffest, element.stiffness);
    };
    find(definition.grid.elements), find(definition.grid.triangles);
    const double allowed = stiffest * 0.98 * ratio * ratio;
    const auto limit = [&](auto& elements) {
      for (auto& element : elements) element.stiffness = std::min(element.stiffness, allowed);
    };
    limit(definition.grid.elements), limit(definition.grid.triangles);
    bound = definition.material.young * allowed;
    body = std::make_unique<physics::Tissue>(definition);
  }
  return bound;
}

}  // namespace ambf::model
