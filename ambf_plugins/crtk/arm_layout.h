// From an arm's description to what the simulation needs of it. Pure functions, any thread. C++17.
#pragma once

#include <string>

#include "adf/crtk_arms.h"
#include "crtk/arm_motion.h"

namespace ambf::crtk {

// Of all its tools together; the one in use may leave less.
ArmLimits limits_of(const adf::CrtkArm& arm);

// ADF text of a model with the arm's one block (crtk/arm_kind.h); `base`: the body that its joints hang on.
std::string model_text(const adf::CrtkArm& arm, const std::string& base);

}  // namespace ambf::crtk
