// Whether the joints of a model move a CRTK arm's tip as its kinematics say (docs/crtk.md). Pure, any thread; takes
// milliseconds. C++17.
#pragma once

#include <optional>
#include <vector>

#include "adf/crtk_arms.h"
#include "base/diagnostic.h"
#include "kinematics/mechanism.h"

namespace ambf::adf {

// Nothing: they do. An error costs the arm; a warning says that it cannot be known. `base`: the body of `joints` that
// the arm's description names.
std::optional<base::Diagnostic> check_motion(const CrtkArm& arm, const std::vector<kinematics::MechanismJoint>& joints,
                                             std::size_t base);

}  // namespace ambf::adf
