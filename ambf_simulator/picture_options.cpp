#include "picture_options.h"

#include <algorithm>
#include <cstdio>
#include <optional>
#include <string>
#include <vector>

#include "render/images/image_file.h"

namespace ambf::simulator {

namespace {

// "pictures/a.png:main" -> the file and the camera. Colons may be in both.
PictureFile picture_file(const std::string& text, const std::vector<std::string>& endings) {
  for (const std::string& ending : endings) {
    const std::size_t at = text.rfind(ending + ":");
    if (at != std::string::npos) return {text.substr(0, at + ending.size()), text.substr(at + ending.size() + 1)};
  }
  return {text, {}};
}

const std::vector<std::string> kPictureEndings = {".png", ".jpg", ".jpeg"};
const std::vector<std::string> kVideoEndings = {".mp4", ".mkv", ".avi", ".mov", ".webm", ".gif"};

}  // namespace

std::string read_picture_options(const boost::program_options::variables_map& map, CommandLine& o) {
  if (map.count("screenshot") != 0) {
    for (const std::string& text : map["screenshot"].as<std::vector<std::string>>()) {
      o.screenshots.push_back(picture_file(text, kPictureEndings));
      if (!render::is_image_path(o.screenshots.back().file)) {
        return "--screenshot takes FILE.png or FILE.jpg, perhaps with :CAMERA, not '" + text + "'";
      }
    }
  }
  if (map.count("video") != 0) {
    const std::string text = map["video"].as<std::string>();
    o.video = picture_file(text, kVideoEndings);
    const auto fits = [&](const std::string& ending) {
      const std::string& file = o.video.file;
      return file.size() > ending.size() && file.compare(file.size() - ending.size(), ending.size(), ending) == 0;
    };
    if (std::none_of(kVideoEndings.begin(), kVideoEndings.end(), fits)) {
      return "--video takes FILE.mp4 (.mkv, .avi, .mov, .webm, .gif), perhaps with :CAMERA, not '" + text + "'";
    }
  }
  const bool records = !o.screenshots.empty() || !o.video.file.empty();
  for (const char* name : {"fps", "seconds"}) {
    if (map.count(name) != 0 && o.video.file.empty()) return std::string("--") + name + " is only meant with --video";
  }
  for (const char* name : {"at", "picture_size", "quality"}) {
    if (map.count(name) != 0 && !records) {
      return std::string("--") + name + " is only meant with --screenshot or --video";
    }
  }
  if (map.count("fps") != 0) o.video_fps = map["fps"].as<int>();
  if (o.video_fps < 1 || o.video_fps > 1000) return "--fps must be between 1 and 1000";
  if (map.count("seconds") != 0) o.video_seconds = map["seconds"].as<double>();
  if (!(o.video_seconds > 0.0 && o.video_seconds <= 86400.0)) return "--seconds must be above 0 and at most 86400";
  if (map.count("at") != 0) o.at_seconds = map["at"].as<double>();
  if (o.at_seconds && !(*o.at_seconds >= 0.0 && *o.at_seconds <= 86400.0)) return "--at must be between 0 and 86400";
  if (map.count("picture_size") != 0) {
    const std::string text = map["picture_size"].as<std::string>();
    int used = 0;
    const int read = std::sscanf(text.c_str(), "%5dx%5d%n", &o.picture_width, &o.picture_height, &used);
    const auto fits = [](int side) { return side >= 1 && side <= render::kMaxImageSide; };
    if (read != 2 || used != static_cast<int>(text.size()) || !fits(o.picture_width) || !fits(o.picture_height)) {
      return "--picture_size takes WIDTHxHEIGHT of at most 8192 pixels a side, such as 1280x720, not '" + text + "'";
    }
  }
  if (map.count("quality") != 0) {
    const std::string text = map["quality"].as<std::string>();
    if (text == "draft") {
      o.picture_quality = PictureQuality::draft;
    } else if (text == "normal") {
      o.picture_quality = PictureQuality::normal;
    } else if (text == "fine") {
      o.picture_quality = PictureQuality::fine;
    } else {
      return "--quality must be draft, normal or fine, not '" + text + "'";
    }
  }
  if (map.count("offscreen") != 0) {
    const std::optional<render::OffscreenBackend> backend =
        render::offscreen_backend(map["offscreen"].as<std::string>());
    if (!backend) return "--offscreen must be auto, osmesa or egl, not '" + map["offscreen"].as<std::string>() + "'";
    o.offscreen = *backend;
  }
  o.gui_asked_for = map.count("show_gui") != 0 && o.show_gui;
  return {};
}

}  // namespace ambf::simulator
