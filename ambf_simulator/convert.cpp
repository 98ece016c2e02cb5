#include "convert.h"

#include <cstdio>

#include "adf/urdf_import.h"
#include "base/whole_file.h"

namespace ambf::simulator {

bool convert(const CommandLine& options) {
  const std::string &from = options.convert_files.front(), &to = options.convert_files.back();
  const adf::ConvertedUrdf converted = adf::convert_urdf_file(from, {options.free_base, options.merge_fixed, to});
  for (const base::Diagnostic& diagnostic : converted.diagnostics)
    std::printf("%s\n", base::to_string(diagnostic).c_str());
  if (!converted.adf) return false;
  const std::string problem = base::write_whole_file(to, *converted.adf, base::IfExists::refuse);
  if (!problem.empty()) {
    std::printf("error: %s\n", problem.c_str());
    return false;
  }
  std::printf("%s: written\n", to.c_str());
  return true;
}

}  // namespace ambf::simulator
