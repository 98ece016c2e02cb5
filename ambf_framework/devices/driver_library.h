// Drivers in shared libraries. A library offers the same interface as a built-in driver (devices/driver.h) through one
// C symbol that says for which version of it the library was made. Example and template:
// ambf_plugins/examples/circle_driver. C++17.
//
// A device's key `driver: {library: FILE}` names a library; else, when no known driver fits, every
// libambf_driver_*.so in the folders of AMBF_PLUGIN_PATH (separated by colons) is loaded. Libraries stay loaded.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "devices/driver.h"

namespace ambf::devices {

// Changes with driver.h. Sizes catch what a forgotten change of it would break.
inline constexpr std::uint32_t kDriverInterface = 1;

struct DriverLibrary {
  std::uint32_t interface_version = kDriverInterface;
  std::uint32_t traits_size = sizeof(DriverTraits), sample_size = sizeof(Sample), request_size = sizeof(DriverRequest);
  std::vector<DriverKind> (*kinds)() = nullptr;
};

// In one source file of the library; `kinds` is a function.
#define AMBF_DRIVER_LIBRARY(kinds)                                                                          \
  extern "C" __attribute__((visibility("default"))) const ambf::devices::DriverLibrary ambf_driver_library; \
  const ambf::devices::DriverLibrary ambf_driver_library {                                                  \
    ambf::devices::kDriverInterface, sizeof(ambf::devices::DriverTraits), sizeof(ambf::devices::Sample),    \
        sizeof(ambf::devices::DriverRequest), &(kinds)                                                      \
  }

// Registers the drivers of one library. Empty, or why it cannot be used. Not thread-safe, as register_driver.
std::string load_driver_library(const std::string& path);

// For people, when find_driver found none: what was wanted, which drivers are known, and what became of libraries.
std::string why_no_driver(const DriverRequest& request);

}  // namespace ambf::devices
