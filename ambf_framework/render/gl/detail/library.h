// Why a graphics library could not be opened, for users. Any thread, right after dlopen() in the same one.
#pragma once

#include <dlfcn.h>

#include <string>

namespace ambf::render {

// `package`: of Debian.
inline std::string library_problem(const std::string& library, const std::string& package) {
  const char* error = dlerror();
  const std::string why = error == nullptr ? "" : error;
  // A library that is there may lack one of its own, or room in the address space.
  if (why.empty() || (why.rfind(library, 0) == 0 && why.find("No such file") != std::string::npos))
    return library + " is not installed (Debian: " + package + ")";
  return library + " is installed, but cannot be loaded: " + why;
}

}  // namespace ambf::render
