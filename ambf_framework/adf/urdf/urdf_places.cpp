#include <cstdlib>
#include <filesystem>
#include <sstream>

#include "adf/detail/files.h"
#include "adf/detail/urdf_writer.h"

namespace ambf::adf::urdf {

namespace fs = std::filesystem;

namespace {

bool is_package(const fs::path& folder, const std::string& name) {
  const FileText xml = read_text((folder / "package.xml").string());
  if (!xml.text) return false;
  const std::size_t open = xml.text->find("<name>");
  const std::size_t close = xml.text->find("</name>");
  return open != std::string::npos && close != std::string::npos && close > open &&
         xml.text->substr(open + 6, close - open - 6).find(name) != std::string::npos;
}

// Folders that package `name` may be, best first.
std::vector<std::string> package_places(const std::string& name, const std::string& urdf_path) {
  std::vector<std::string> places;
  const char* path = std::getenv("ROS_PACKAGE_PATH");
  std::stringstream folders(path == nullptr ? "" : path);
  for (std::string folder; std::getline(folders, folder, ':');) {
    if (folder.empty()) continue;
    places.push_back((fs::path(folder) / name).string());
    if (fs::path(folder).filename() == name) places.push_back(folder);
  }
  std::error_code error;
  for (fs::path at = fs::absolute(folder_of(urdf_path), error); !error; at = at.parent_path()) {
    if (is_package(at, name) || at.filename() == name) places.push_back(at.string());
    std::error_code absent;
    if (fs::is_directory(at / name, absent)) places.push_back((at / name).string());
    if (at == at.parent_path()) break;
  }
  return places;
}

}  // namespace

std::vector<std::string> mesh_places(const std::string& name, const std::string& urdf_path) {
  const auto after = [&name](const std::string& scheme) { return name.substr(scheme.size()); };
  if (name.starts_with("file://")) return {resolve(folder_of(urdf_path), after("file://"))};
  const std::string scheme = name.starts_with("package://") ? "package://"
                             : name.starts_with("model://") ? "model://"
                                                            : "";
  if (scheme.empty()) return {resolve(folder_of(urdf_path), name)};
  const std::string rest = after(scheme);
  const std::size_t slash = std::min(rest.find('/'), rest.size());
  std::vector<std::string> files;
  for (const std::string& folder : package_places(rest.substr(0, slash), urdf_path)) {
    files.push_back(resolve(folder, rest.substr(std::min(slash + 1, rest.size()))));
  }
  // Of a package that is nowhere, messages name where it would be beside the file.
  if (files.empty()) files.push_back(resolve(folder_of(urdf_path), rest));
  return files;
}

}  // namespace ambf::adf::urdf
