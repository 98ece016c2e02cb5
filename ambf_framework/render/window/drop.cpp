#include "render/window/drop.h"

#include <algorithm>
#include <cctype>
#include <filesystem>

namespace ambf::render {

namespace fs = std::filesystem;

std::string refusal_of_drop(const std::string& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  const std::string name = "'" + fs::path(path).filename().string() + "'";
  if (error || !fs::exists(status)) return "not loaded: " + name + " cannot be found";
  if (fs::is_directory(status)) return "not loaded: " + name + " is a folder; drop the ADF files in it";
  if (!fs::is_regular_file(status)) return "not loaded: " + name + " is no ordinary file";
  std::string ending = fs::path(path).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (ending == ".yaml" || ending == ".yml" || ending == ".ambf" || ending == ".urdf") return {};
  if (ending == ".xacro") return "not loaded: " + name + " has macros; expand them: xacro " + name + " > robot.urdf";
  return "not loaded: " + name + " is no ADF or URDF file (.yaml, .ambf or .urdf)";
}

}  // namespace ambf::render
