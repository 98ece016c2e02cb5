#include "render/panel/settings.h"

#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>

namespace ambf::render {

namespace {

constexpr std::size_t kMostRecent = 12, kMostNames = 50;
constexpr double kWidest_points = 4000.0;

}  // namespace

void PanelSettings::used_file(const std::string& path) {
  std::erase(recent_files, path);
  recent_files.insert(recent_files.begin(), path);
  if (recent_files.size() > kMostRecent) recent_files.resize(kMostRecent);
}

std::string settings_path() {
  const char* config = std::getenv("XDG_CONFIG_HOME");
  if (config != nullptr && *config == '/') return std::string(config) + "/ambf/panel.conf";
  const char* home = std::getenv("HOME");
  if (home == nullptr || *home != '/') return {};
  return std::string(home) + "/.config/ambf/panel.conf";
}

PanelSettings read_settings(const std::string& path) {
  PanelSettings settings;
  std::ifstream in(path);
  for (std::string line; std::getline(in, line);) {
    const std::size_t space = line.find(' ');
    if (space == std::string::npos) continue;
    const std::string key = line.substr(0, space), value = line.substr(space + 1);
    const auto add_to = [&](std::vector<std::string>& list, std::size_t most) {
      if (list.size() < most && !value.empty()) list.push_back(value);
    };
    if (key == "theme") settings.dark = value != "light";
    if (key == "units") settings.degrees = value == "degrees";
    if (key == "width") {
      const double width = std::strtod(value.c_str(), nullptr);
      if (width >= 0.0 && width <= kWidest_points) settings.width_points = width;
    }
    if (key == "tab") settings.tab = std::clamp(std::atoi(value.c_str()), 0, 99);
    if (key == "recent") add_to(settings.recent_files, kMostRecent);
    if (key == "plot") add_to(settings.plotted, kMostNames);
    if (key == "watch") add_to(settings.watched, kMostNames);
  }
  return settings;
}

bool write_settings(const std::string& path, const PanelSettings& settings) {
  if (path.empty()) return false;
  std::error_code ignored;
  std::filesystem::create_directories(std::filesystem::path(path).parent_path(), ignored);
  const std::string beside = path + "." + std::to_string(getpid());
  std::ofstream out(beside);
  out << "theme " << (settings.dark ? "dark" : "light") << "\nunits " << (settings.degrees ? "degrees" : "radians")
      << "\nwidth " << settings.width_points << "\ntab " << settings.tab << "\n";
  const auto list = [&](const char* key, const std::vector<std::string>& values) {
    for (const std::string& value : values) {
      if (value.find('\n') == std::string::npos) out << key << " " << value << "\n";
    }
  };
  list("recent", settings.recent_files);
  list("plot", settings.plotted);
  list("watch", settings.watched);
  out.close();
  std::error_code failed;
  if (out) std::filesystem::rename(beside, path, failed);
  if (!out || failed) std::filesystem::remove(beside, ignored);
  return out && !failed;
}

}  // namespace ambf::render
