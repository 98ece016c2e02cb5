// What gains of a resistive sensor steps can bear, as far as it is known before anything is met. Loader thread.
#pragma once

#include <vector>

#include "model/detail/findings.h"
#include "scene/sensor.h"
#include "state/sensors.h"

namespace ambf::model {

// Tells (of damping along the ray as information, else as a warning) each gain that will be cut whatever the rays meet,
// with its limit: two bodies never oppose more mass than the sensor's own has (`own_mass_kg`), and at least one element
// touches (EQUATIONS 17, docs/sensors.md). What the other body and further elements lower is not known here. `rays`: at
// least one; `step_s` > 0.
void report_passed_limits(const scene::Sensor& sensor, const std::vector<state::SensorRay>& rays, double own_mass_kg,
                          double step_s, const scene::Identity& at, Findings& findings);

}  // namespace ambf::model
