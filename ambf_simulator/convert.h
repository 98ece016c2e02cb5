// `ambf_simulator --convert URDF ADF`: a robot written as URDF becomes an ADF file that loads as the same model.
#pragma once

#include "command_line.h"

namespace ambf::simulator {

// Prints what there is to say of the URDF file. False: nothing was written, and an error said why. A file that exists
// is never replaced.
bool convert(const CommandLine& options);

}  // namespace ambf::simulator
