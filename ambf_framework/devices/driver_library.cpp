#include "devices/driver_library.h"

#include <dlfcn.h>

#include <algorithm>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <sstream>

#include "devices/detail/library_search.h"

namespace ambf::devices {

namespace {

namespace fs = std::filesystem;

constexpr const char* kSymbol = "ambf_driver_library";
constexpr const char* kPrefix = "libambf_driver_";

std::string plugin_path() {
  const char* const value = std::getenv("AMBF_PLUGIN_PATH");
  return value == nullptr ? "" : value;
}

std::vector<fs::path> plugin_folders() {
  std::vector<fs::path> folders;
  std::istringstream path(plugin_path());
  for (std::string folder; std::getline(path, folder, ':');) {
    if (!folder.empty()) folders.emplace_back(folder);
  }
  return folders;
}

// Sorted, so that which of two drivers of one type comes first does not depend on the disk.
std::vector<fs::path> libraries_in(const fs::path& folder) {
  std::vector<fs::path> found;
  std::error_code unreadable;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, unreadable)) {
    const std::string name = entry.path().filename().string();
    if (name.rfind(kPrefix, 0) == 0 && entry.path().extension() == ".so") found.push_back(entry.path());
  }
  std::sort(found.begin(), found.end());
  return found;
}

std::string load_and_register(const std::string& path) {
  void* const handle = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (handle == nullptr) return dlerror();
  const auto* library = static_cast<const DriverLibrary*>(dlsym(handle, kSymbol));
  if (library == nullptr) return std::string("it has no symbol ") + kSymbol + " (AMBF_DRIVER_LIBRARY)";
  const DriverLibrary ours;
  if (library->interface_version != ours.interface_version) {
    return "it was made for version " + std::to_string(library->interface_version) +
           " of the driver interface, this program has version " + std::to_string(ours.interface_version) +
           ": build it again";
  }
  if (library->traits_size != ours.traits_size || library->sample_size != ours.sample_size ||
      library->request_size != ours.request_size) {
    return "it was made with other headers of the driver interface: build it again";
  }
  try {
    for (DriverKind& kind : library->kinds()) register_driver(std::move(kind));
  } catch (const std::exception& e) {
    return e.what();
  }
  return {};
}

}  // namespace

LibrarySearch& LibrarySearch::instance() {
  static LibrarySearch search;
  return search;
}

std::string LibrarySearch::load(const std::string& path) {
  const auto [outcome, is_new] = outcomes_.try_emplace(path);
  if (is_new) outcome->second = load_and_register(path);
  return outcome->second;
}

void LibrarySearch::load_named(const DriverRequest& request) {
  const auto named = request.options.find("library");
  if (named == request.options.end()) return;
  const fs::path beside = fs::path(request.folder) / named->second;
  if (fs::exists(beside)) {
    load(beside.string());
    return;
  }
  for (const fs::path& folder : plugin_folders()) {
    if (fs::exists(folder / named->second)) {
      load((folder / named->second).string());
      return;
    }
  }
  load(named->second);  // wherever the dynamic linker searches
}

void LibrarySearch::load_all() {
  if (plugin_path() == searched_) return;
  searched_ = plugin_path();
  for (const fs::path& folder : plugin_folders()) {
    for (const fs::path& library : libraries_in(folder)) load(library.string());
  }
}

std::string LibrarySearch::report() const {
  std::string text;
  for (const auto& [path, problem] : outcomes_) {
    if (!problem.empty()) text += "; " + path + ": " + problem;
  }
  return text;
}

std::string load_driver_library(const std::string& path) { return LibrarySearch::instance().load(path); }

std::string why_no_driver(const DriverRequest& request) {
  std::string text = request.type.empty() ? "no driver answers to the hardware name '" + request.hardware_name + "'"
                                          : "there is no driver of type '" + request.type + "'";
  text += "; known are";
  for (const DriverKind& kind : driver_kinds()) {
    text += (&kind == &driver_kinds().front() ? " " : ", ") + kind.type;
    for (const std::string& name : kind.hardware_names) {
      text += (&name == &kind.hardware_names.front() ? " (" : ", ") + name;
    }
    if (!kind.hardware_names.empty()) text += ")";
  }
  const std::string path = plugin_path();
  text += "; " + (path.empty() ? "AMBF_PLUGIN_PATH, where libraries with further drivers are searched, is not set"
                               : "libraries " + std::string(kPrefix) + "*.so are searched in " + path);
  return text + LibrarySearch::instance().report();
}

}  // namespace ambf::devices
