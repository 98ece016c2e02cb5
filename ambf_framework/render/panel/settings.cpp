#include "render/panel/settings.h"

#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace ambf::render {

namespace {

constexpr std::size_t kMostRecent = 12, kMostNames = 50;
constexpr double kWidest_points = 4000.0, kMostTabs = 99.0;
constexpr std::size_t kMostBytes = 1 << 16;  // more than we ever write

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

namespace {

// A line without its end. False: it makes no sense.
bool take_line(const std::string& line, PanelSettings& settings) {
  const std::size_t space = line.find(' ');
  if (space == std::string::npos) return false;
  const std::string key = line.substr(0, space), value = line.substr(space + 1);
  if (std::any_of(value.begin(), value.end(), [](char c) { return static_cast<unsigned char>(c) < ' '; })) return false;
  const auto choice = [&](const char* off, const char* on, bool& chosen) {
    if (value != off && value != on) return false;
    chosen = value == on;
    return true;
  };
  const auto number = [&](double most, double& to) {
    char* end = nullptr;
    const double read = std::strtod(value.c_str(), &end);
    if (end == value.c_str() || *end != '\0' || !(read >= 0.0 && read <= most)) return false;
    to = read;
    return true;
  };
  const auto add_to = [&](std::vector<std::string>& list, std::size_t most) {
    if (!value.empty() && list.size() < most) list.push_back(value);
    return !value.empty();
  };
  if (key == "theme") return choice("light", "dark", settings.dark);
  if (key == "units") return choice("radians", "degrees", settings.degrees);
  if (key == "width") return number(kWidest_points, settings.width_points);
  if (key == "tab") {
    double tab = 0.0;
    if (!number(kMostTabs, tab)) return false;
    settings.tab = static_cast<int>(tab);
    return true;
  }
  if (key == "pictures") {
    settings.picture_folder = value;
    return true;
  }
  if (key == "recent") return add_to(settings.recent_files, kMostRecent);
  if (key == "plot") return add_to(settings.plotted, kMostNames);
  if (key == "watch") return add_to(settings.watched, kMostNames);
  return false;
}

}  // namespace

PanelSettings read_settings(const std::string& path, std::string& problem) {
  PanelSettings settings;
  problem.clear();
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored)) return settings;
  std::string text(kMostBytes, '\0');
  std::ifstream in(path, std::ios::binary);
  in.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (!in.is_open() || in.bad() || (in.gcount() == 0 && std::filesystem::is_directory(path, ignored))) {
    problem = "it cannot be read";
    return settings;
  }
  text.resize(static_cast<std::size_t>(in.gcount()));
  std::istringstream lines(text);
  int number = 0, first = 0, wrong = 0;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    if (line.empty() || take_line(line, settings)) continue;
    if (wrong++ == 0) first = number;
  }
  if (wrong == 1) problem = "line " + std::to_string(first) + " makes no sense and is ignored";
  if (wrong > 1) {
    problem =
        std::to_string(wrong) + " lines make no sense and are ignored, the first is line " + std::to_string(first);
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
  if (!settings.picture_folder.empty()) list("pictures", {settings.picture_folder});
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
