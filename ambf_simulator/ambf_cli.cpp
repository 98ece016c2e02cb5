#include "ambf_cli.h"

#include <cstdlib>
#include <filesystem>

#include "base/spawn.h"

namespace ambf::simulator {

namespace {

namespace fs = std::filesystem;

constexpr const char* kProgram = "ambf-cli";

}  // namespace

std::vector<std::string> ambf_cli_places() {
  std::vector<std::string> places = base::places_on_path(kProgram);
  std::error_code ignored;
  const char* root = std::getenv("AMBF_ROOT_PATH");
  // <tree>/build*/bin/ambf_simulator
  const fs::path tree = root != nullptr
                            ? fs::path(root)
                            : fs::read_symlink("/proc/self/exe", ignored).parent_path().parent_path().parent_path();
  places.push_back((tree / ".venv" / "bin" / kProgram).string());
  return places;
}

std::string ambf_cli_is_missing(const std::vector<std::string>& places) {
  return std::string("there is no ") + kProgram + " on the PATH" + (places.empty() ? "" : ", nor as " + places.back()) +
         ". './dev deps' in the source tree puts it there; elsewhere: pip install ./ambf_client_py";
}

}  // namespace ambf::simulator
