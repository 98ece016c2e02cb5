#include "render/panel/detail/settings.h"

#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <utility>

#include "base/hash.h"

namespace ambf::render {

namespace {

constexpr std::size_t kMaxRecent = 12, kMaxNames = 50;
constexpr double kWidest_points = 4000.0, kMaxTabs = 99.0;
constexpr std::size_t kMaxBytes = 1 << 16;  // more than we ever write

}  // namespace

void PanelSettings::used_file(const std::string& path) {
  std::erase(recent_files, path);
  recent_files.insert(recent_files.begin(), path);
  if (recent_files.size() > kMaxRecent) recent_files.resize(kMaxRecent);
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
    if (!number(kMaxTabs, tab)) return false;
    settings.tab = static_cast<int>(tab);
    return true;
  }
  if (key == "pictures") {
    settings.picture_folder = value;
    return true;
  }
  if (key == "scene") return true;  // in a layout file, for the reader
  if (key == "topic") return true;  // written by versions with a tab of topics
  if (key == "recent") return add_to(settings.recent_files, kMaxRecent);
  if (key == "plot") return add_to(settings.plotted, kMaxNames);
  if (key == "watch") return add_to(settings.watched, kMaxNames);
  return false;
}

// False: there is none, or it cannot be read.
bool read_file(const std::string& path, PanelSettings& settings, std::string& problem) {
  problem.clear();
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored)) return false;
  std::string text(kMaxBytes, '\0');
  std::ifstream in(path, std::ios::binary);
  in.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (!in.is_open() || in.bad() || (in.gcount() == 0 && std::filesystem::is_directory(path, ignored))) {
    problem = "it cannot be read";
    return false;
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
  return true;
}

// Beside and renamed.
bool write_file(const std::string& path, const std::string& text) {
  if (path.empty()) return false;
  std::error_code ignored;
  std::filesystem::create_directories(std::filesystem::path(path).parent_path(), ignored);
  const std::string beside = path + "." + std::to_string(getpid());
  std::ofstream out(beside);
  out << text;
  out.close();
  std::error_code failed;
  if (out) std::filesystem::rename(beside, path, failed);
  if (!out || failed) std::filesystem::remove(beside, ignored);
  return out && !failed;
}

void add_list(std::ostream& out, const char* key, const std::vector<std::string>& values) {
  for (const std::string& value : values) {
    if (value.find('\n') == std::string::npos) out << key << " " << value << "\n";
  }
}

void add_layout(std::ostream& out, const PanelSettings& settings) {
  out << "width " << settings.width_points << "\ntab " << settings.tab << "\n";
  add_list(out, "plot", settings.plotted);
  add_list(out, "watch", settings.watched);
}

}  // namespace

PanelSettings read_settings(const std::string& path, std::string& problem) {
  PanelSettings settings;
  read_file(path, settings, problem);
  return settings;
}

void read_layout(const std::string& path, PanelSettings& settings, std::string& problem) {
  PanelSettings layout;
  layout.width_points = settings.width_points;
  layout.tab = settings.tab;
  if (!read_file(path, layout, problem)) return;
  settings.width_points = layout.width_points;
  settings.tab = layout.tab;
  settings.plotted = std::move(layout.plotted);
  settings.watched = std::move(layout.watched);
}

std::string layout_path(const std::string& settings_path, const std::string& scene) {
  base::Fnv1a hash;
  hash.add_text(scene);
  char number[20];
  std::snprintf(number, sizeof number, "_%016llx", static_cast<unsigned long long>(hash.value()));
  // The scene's first file, for people.
  const std::filesystem::path first = scene.substr(0, scene.find('\n'));
  return (std::filesystem::path(settings_path).parent_path() / "scenes" / (first.stem().string() + number + ".conf"))
      .string();
}

bool write_settings(const std::string& path, const PanelSettings& settings) {
  std::ostringstream out;
  out << "theme " << (settings.dark ? "dark" : "light") << "\nunits " << (settings.degrees ? "degrees" : "radians")
      << "\n";
  if (!settings.picture_folder.empty()) add_list(out, "pictures", {settings.picture_folder});
  add_list(out, "recent", settings.recent_files);
  add_layout(out, settings);
  return write_file(path, out.str());
}

bool write_layout(const std::string& path, const std::string& scene, const PanelSettings& settings) {
  std::ostringstream out;
  std::istringstream files(scene);
  for (std::string file; std::getline(files, file);) add_list(out, "scene", {file});
  add_layout(out, settings);
  return write_file(path, out.str());
}

}  // namespace ambf::render
