// The search for drivers in shared libraries. Not thread-safe.
#pragma once

#include <map>
#include <string>

#include "devices/driver_library.h"

namespace ambf::devices {

class LibrarySearch {
 public:
  static LibrarySearch& instance();

  // That of the request's option `library`: beside the device file, else in AMBF_PLUGIN_PATH, else where the dynamic
  // linker searches.
  void load_named(const DriverRequest& request);
  // All in AMBF_PLUGIN_PATH, once for each value of it.
  void load_all();
  // Empty, or why it cannot be used. Each path is loaded once.
  std::string load(const std::string& path);
  // The libraries that cannot be used and why, each after a semicolon.
  std::string report() const;

 private:
  std::map<std::string, std::string> outcomes_;  // by path: empty, or why it cannot be used
  std::string searched_;                         // AMBF_PLUGIN_PATH
};

}  // namespace ambf::devices
