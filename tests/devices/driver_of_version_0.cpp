// A library of drivers that was made for another version of the interface.
#include "devices/driver_library.h"

namespace {
std::vector<ambf::devices::DriverKind> kinds() { return {{"never", {"Never"}, nullptr}}; }
}  // namespace

extern "C" const ambf::devices::DriverLibrary ambf_driver_library;
const ambf::devices::DriverLibrary ambf_driver_library{0, 0, 0, 0, &kinds};
