#include "render/panel/detail/settings_files.h"

#include <utility>

namespace ambf::render {

SettingsFiles::SettingsFiles(base::Log& log, std::string file, std::string scene)
    : log_(log),
      file_(std::move(file)),
      scene_(std::move(scene)),
      layout_file_(file_.empty() || scene_.empty() ? std::string() : layout_path(file_, scene_)) {}

PanelSettings SettingsFiles::read() {
  if (file_.empty()) return {};
  std::string problem;
  const auto report = [&](const std::string& file) {
    if (!problem.empty()) log_.warning("the panel's settings, %s: %s", file.c_str(), problem.c_str());
  };
  saved_ = read_settings(file_, problem);
  report(file_);
  if (!layout_file_.empty()) {
    read_layout(layout_file_, saved_, problem);
    report(layout_file_);
  }
  return saved_;
}

void SettingsFiles::save(const PanelSettings& settings) {
  if (file_.empty() || settings == saved_) return;
  saved_ = settings;
  const bool kept = write_settings(file_, settings);
  const bool layout_kept = layout_file_.empty() || write_layout(layout_file_, scene_, settings);
  if ((kept && layout_kept) || refusal_logged_) return;
  refusal_logged_ = true;
  log_.warning("the panel's settings cannot be kept in '%s'", file_.c_str());
}

}  // namespace ambf::render
