// The options of a simulation and its world file, as physics, catalogue and time keeper want them. Pure.
#pragma once

#include <memory>

#include "model/catalogue.h"
#include "model/live_world.h"
#include "runtime/detail/time_keeper.h"
#include "runtime/options.h"
#include "scene/description.h"

namespace ambf::runtime {

const char* solver_name(Solver solver);  // as --solver calls it
TimeConfig time_config(const SimulationOptions& options, const scene::World& world);
model::CatalogueOptions catalogue_options(const SimulationOptions& options, const scene::World& world);
// `commands` must outlive it.
std::unique_ptr<model::LiveWorld> make_live_world(const SimulationOptions& options, const scene::World& world,
                                                  model::CommandTable& commands);

}  // namespace ambf::runtime
