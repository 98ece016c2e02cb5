#include "ambf_cli.h"

#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <sstream>

namespace ambf::simulator {

namespace {

namespace fs = std::filesystem;

constexpr const char* kProgram = "ambf-cli";

}  // namespace

std::vector<std::string> ambf_cli_places() {
  std::vector<std::string> places;
  const char* path = std::getenv("PATH");
  std::stringstream folders(path != nullptr ? path : "");
  for (std::string folder; std::getline(folders, folder, ':');) {
    if (!folder.empty()) places.push_back((fs::path(folder) / kProgram).string());
  }
  std::error_code ignored;
  const char* root = std::getenv("AMBF_ROOT_PATH");
  // <tree>/build*/bin/ambf_simulator
  const fs::path tree = root != nullptr
                            ? fs::path(root)
                            : fs::read_symlink("/proc/self/exe", ignored).parent_path().parent_path().parent_path();
  places.push_back((tree / ".venv" / "bin" / kProgram).string());
  return places;
}

std::string find_ambf_cli(const std::vector<std::string>& places) {
  for (const std::string& place : places) {
    std::error_code ignored;
    if (fs::is_regular_file(place, ignored) && access(place.c_str(), X_OK) == 0) return place;
  }
  return {};
}

std::string ambf_cli_is_missing(const std::vector<std::string>& places) {
  return std::string("there is no ") + kProgram + " on the PATH" + (places.empty() ? "" : ", nor as " + places.back()) +
         ". './dev deps' in the source tree puts it there; elsewhere: pip install ./ambf_client_py";
}

}  // namespace ambf::simulator
